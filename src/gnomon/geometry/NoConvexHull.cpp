// SPDX-License-Identifier: MIT
// convexHull() in a build without Qhull.
#include <gnomon/OptionalParts.h>
#include <gnomon/geometry/ConvexHull.h>

#include <stdexcept>

namespace gnomon {

std::optional<ConvexHull> convexHull(const std::vector<glm::dvec3>&) {
    throw std::runtime_error(whyMissing(OptionalPart::Terrain));
}

} // namespace gnomon
