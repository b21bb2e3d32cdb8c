// SPDX-License-Identifier: MIT
// RayScene in a build without Embree: none can be made, and the constructors say why.
#include <gnomon/OptionalParts.h>
#include <gnomon/RayScene.h>

#include <stdexcept>

namespace gnomon {
namespace {

[[noreturn]] void refuse() { throw std::runtime_error(whyMissing(OptionalPart::Traced)); }

} // namespace

struct RayScene::Embree {};

RayScene::RayScene(const TriangleSoup&, const Progress&) { refuse(); }
RayScene::RayScene(const std::vector<PlacedRayScene>&) { refuse(); }
RayScene::~RayScene() = default;

// Nobody has a scene to call these for.
RayHit RayScene::closest(const Ray&) const { refuse(); }
bool RayScene::blocked(const Ray&) const { refuse(); }
void RayScene::closest(const Ray*, std::size_t, RayHit*) const { refuse(); }
void RayScene::blocked(const Ray*, std::size_t, std::uint8_t*) const { refuse(); }
glm::dvec3 RayScene::lifted(const glm::dvec3&, const glm::dvec3&) const { refuse(); }
double RayScene::margin(const glm::dvec3&) const { refuse(); }
std::size_t RayScene::leftOut() const { refuse(); }
double RayScene::reach() const { refuse(); }
double RayScene::longestSide() const { refuse(); }

} // namespace gnomon
