// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowQuery.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/RaySceneCache.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/group/ShadowProbe.h>

#include <glm/geometric.hpp>
#include <osg/Transform>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon {
namespace {

/// From the nearest group above a technique down to it, both included.
osg::NodePath pathFromGroup(const ShadowTechnique& technique) {
    for (const osg::NodePath& path : technique.getParentalNodePaths())
        for (std::size_t i = path.size(); i-- > 0;)
            if (dynamic_cast<const ShadowCasterGroup*>(path[i]))
                return {path.begin() + static_cast<std::ptrdiff_t>(i), path.end()};
    throw std::invalid_argument(
        "gnomon::ShadowQuery: " + technique.describe() +
        " has no ShadowCasterGroup above it. Make it a child of the group that holds the casters.");
}

template <typename Answer>
std::vector<std::uint8_t> forEach(std::size_t count, Answer answer) {
    std::vector<std::uint8_t> answers(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) { answers[i] = answer(i); });
    return answers;
}

} // namespace

ShadowQuery::ShadowQuery(const ShadowTechnique& technique, const ShadowLight& light) : _technique(&technique) {
    if (const std::string why = technique.whyUnavailable(); !why.empty()) throw std::runtime_error(why);
    osg::NodePath path = pathFromGroup(technique);
    const auto& group = dynamic_cast<const ShadowCasterGroup&>(*path.front());
    path.erase(path.begin());
    _groupFromTechnique = osg::computeLocalToWorld(path, false);
    _group = &group;
    _casters = group.casters();
    const CasterLayers& layers = _casters->layers();
    const auto usable = lightInScene(light.inGroup, SceneFrame(layers.origin));
    if (!usable)
        throw std::invalid_argument(
            "gnomon::ShadowQuery: the light has no finite position or direction. Set its position.");
    _origin = layers.origin;
    _light = *usable;
    _scene = RaySceneCache().of(*_casters, "ShadowQuery");
    _answers = technique.answersFor(probe());
}

ShadowQuery::ShadowQuery(const ShadowQuery& other) = default;
ShadowQuery& ShadowQuery::operator=(const ShadowQuery& other) = default;
ShadowQuery::~ShadowQuery() = default;

ShadowProbe ShadowQuery::probe() const { return {*_scene, *_group, _origin, _light, _groupFromTechnique, _answers}; }

ShadowQuery ShadowQuery::exact() const {
    ShadowQuery result = *this;
    result._technique = nullptr;
    return result;
}

bool ShadowQuery::isLit(const osg::Vec3d& point) const {
    const glm::dvec3 local = SceneFrame(_origin).point(point);
    return _technique ? _technique->isLit(probe(), local) : probe().reachesFrom(local);
}

bool ShadowQuery::isBlocked(const osg::Vec3d& from, const osg::Vec3d& to) const {
    const SceneFrame scene(_origin);
    const glm::dvec3 a = scene.point(from), b = scene.point(to), along = glm::normalize(b - a);
    const glm::dvec3 start = a + _scene->margin(a) * along, end = b - _scene->margin(b) * along;
    if (!(glm::dot(end - start, along) > 0.0)) return false;
    return _scene->blocked({start, end - start, 1.0});
}

double ShadowQuery::litShare(const osg::BoundingBoxd& box, unsigned side) const {
    const unsigned n = std::clamp(side, 1u, 256u);
    const osg::Vec3d cell = (box._max - box._min) / n;
    const std::vector<std::uint8_t> lit = forEach(std::size_t{n} * n * n, [&](std::size_t i) {
        const osg::Vec3d at(double(i % n) + 0.5, double(i / n % n) + 0.5, double(i / n / n) + 0.5);
        return isLit(box._min + osg::componentMultiply(at, cell));
    });
    return double(std::count(lit.begin(), lit.end(), 1)) / double(lit.size());
}

std::vector<std::uint8_t> ShadowQuery::areLit(const std::vector<osg::Vec3d>& points) const {
    return forEach(points.size(), [&](std::size_t i) { return isLit(points[i]); });
}

std::vector<std::uint8_t> ShadowQuery::areBlocked(const osg::Vec3d& from, const std::vector<osg::Vec3d>& to) const {
    return forEach(to.size(), [&](std::size_t i) { return isBlocked(from, to[i]); });
}

} // namespace gnomon
