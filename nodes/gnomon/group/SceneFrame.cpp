// SPDX-License-Identifier: MIT
#include <gnomon/casters/Casters.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/SceneFrame.h>

#include <glm/geometric.hpp>
#include <osg/io_utils>

#include <cmath>
#include <sstream>
#include <vector>

namespace gnomon {

std::optional<glm::dvec4> lightInScene(const osg::Vec4d& inGroup, const SceneFrame& scene) {
    const glm::dvec4 given = toGlm(inGroup);
    const glm::dvec4 light = given.w == 0.0 ? glm::dvec4(glm::normalize(glm::dvec3(given)), 0.0)
                                            : glm::dvec4(glm::dvec3(given) / given.w - scene.origin, 1.0);
    if (!(std::isfinite(given.w) && std::isfinite(light.x) && std::isfinite(light.y) && std::isfinite(light.z)))
        return std::nullopt;
    return light;
}

std::optional<SpotCone> spotOf(const ShadowLight& light) {
    const glm::dvec3 axis = glm::normalize(toGlm(light.direction));
    if (light.inGroup.w() == 0.0 || !(light.cutoff >= 0.0 && light.cutoff <= 90.0) ||
        !std::isfinite(axis.x + axis.y + axis.z))
        return std::nullopt;
    return SpotCone{axis, osg::DegreesToRadians(light.cutoff)};
}

std::string notUsable(const osg::Vec4d& light) {
    std::ostringstream cause;
    cause << "the light at (" << light << ") has no finite position or direction. Set the light's position.";
    return cause.str();
}

std::optional<ScreenRect> boundsBehind(const osg::BoundingBoxd& inGroup, const SceneFrame& scene,
                                       const glm::dmat4& clipFromScene, const glm::dvec4& light) {
    std::vector<glm::dvec4> points;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner = scene.point(inGroup.corner(i)), at(light);
        points.push_back(clipFromScene * glm::dvec4(corner, 1.0));
        points.push_back(clipFromScene * glm::dvec4(light.w == 0.0 ? -at : corner - at, 0.0));
    }
    return screenBounds(points);
}

std::optional<ScreenRect> ViewFrame::boundsBehind(const osg::BoundingBoxd& inGroup, const ShadowLight& light) const {
    const SceneFrame scene(inGroup.center());
    const auto usable = lightInScene(light.inGroup, scene);
    return usable ? gnomon::boundsBehind(inGroup, scene, scene.clipFromScene(*this), *usable) : std::nullopt;
}

std::vector<CasterBox> boxesOf(const Casters& casters) {
    std::vector<CasterBox> boxes;
    for (const auto& piece : casters.list)
        if (piece->bounds.valid()) boxes.push_back({piece->drawable.get(), piece->bounds});
    return boxes;
}

} // namespace gnomon
