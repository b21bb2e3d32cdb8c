// SPDX-License-Identifier: MIT
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/volume/ReceiverBox.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <cmath>
#include <limits>
#include <map>

namespace gnomon {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

void expand(ReceiverBox& all, const osg::BoundingBox& box, const osg::Matrixd& sceneFromBox) {
    const osg::Vec3d middle = osg::Vec3d(box.center()) * sceneFromBox,
                     half = (osg::Vec3d(box._max) - osg::Vec3d(box._min)) / 2.0;
    glm::dvec3 reach(0.0);
    for (int row = 0; row < 3; ++row)
        reach += half[row] * glm::dvec3(std::abs(sceneFromBox(row, 0)), std::abs(sceneFromBox(row, 1)),
                                        std::abs(sceneFromBox(row, 2)));
    all.low = glm::min(all.low, toGlm(middle) - reach);
    all.high = glm::max(all.high, toGlm(middle) + reach);
}

} // namespace

bool ReceiverBox::fits(const ReceiverBox& other) const {
    if (!std::isfinite(glm::dot(low + high, glm::dvec3(1.0))))
        return !std::isfinite(glm::dot(other.low + other.high, glm::dvec3(1.0)));
    return glm::all(glm::lessThanEqual(low, other.low)) && glm::all(glm::greaterThanEqual(high, other.high)) &&
           glm::distance(low, high) <= 2.0 * glm::distance(other.low, other.high);
}

ReceiverBox ReceiverBox::grown() const {
    constexpr double share = 1.0 / 16.0;
    return {low - share * (high - low), high + share * (high - low)};
}

/// Leaves share few matrices.
ReceiverBox receiversOf(const ViewFrame& view, const SceneFrame& scene) {
    const osg::Matrixd sceneFromEye = scene.sceneFromEye(view);
    std::map<const osg::RefMatrix*, osg::Matrixd> known;
    ReceiverBox all{glm::dvec3(never), glm::dvec3(-never)};
    for (const osgUtil::RenderLeaf* leaf : view.seen) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid()) return {glm::dvec3(-never), glm::dvec3(never)};
        const auto found = known.find(leaf->_modelview.get());
        const osg::Matrixd& sceneFromBox =
            found != known.end()
                ? found->second
                : known.emplace(leaf->_modelview.get(), modelviewOf(*leaf) * sceneFromEye).first->second;
        expand(all, box, sceneFromBox);
    }
    return all;
}

} // namespace gnomon
