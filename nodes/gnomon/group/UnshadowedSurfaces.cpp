// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/base/PlacedBox.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/geometry/ShadowReach.h>
#include <gnomon/group/FaceCulling.h>
#include <gnomon/group/UnshadowedSurfaces.h>

#include <algorithm>

namespace gnomon {
namespace {

constexpr std::size_t mostSurfaces = 32;
constexpr double outermost = 0.2; // share of a box's size that is left out: corners of round things are empty
constexpr double flatness = 1e-3; // of a floor: its thickness by its size

AlignedBox shrunk(const osg::BoundingBoxd& box) {
    const osg::Vec3d margin = (box._max - box._min) * (outermost / 2.0);
    return {toGlm(box._min + margin), toGlm(box._max - margin)};
}

/// A drawable where it is.
struct Placed {
    const osg::Drawable* drawable;
    osg::Matrixd groupFromLocal;
    osg::BoundingBoxd inGroup;
    const osgUtil::RenderLeaf* leaf = nullptr; ///< of a surface.

    bool isSame(const Placed& other) const {
        if (drawable != other.drawable) return false;
        const osg::Vec3d middle = drawable->getBoundingBox().center();
        const double apart = (middle * groupFromLocal - middle * other.groupFromLocal).length();
        return apart <= 1e-6 * inGroup.radius(); // one matrix came by way of the eye
    }
    osg::BoundingBoxd in(const osg::Matrixd& frameFromGroup) const {
        return placedBox(drawable->getBoundingBox(), groupFromLocal * frameFromGroup);
    }
};

template <typename Leaves>
std::vector<Placed> placed(const Leaves& leaves, const osg::Matrixd& groupFromEye) {
    std::vector<Placed> result;
    for (const osgUtil::RenderLeaf* leaf : leaves) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid()) continue;
        const osg::Matrixd groupFromLocal = modelviewOf(*leaf) * groupFromEye;
        result.push_back({leaf->_drawable.get(), groupFromLocal, placedBox(box, groupFromLocal), leaf});
    }
    return result;
}

/// Takes away what of a box is behind a floor as the light sees it, if all of the box is over or under the floor.
void cutBehind(const osg::BoundingBoxd& floor, const osg::Vec4d& light, osg::BoundingBoxd& box) {
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        const bool isFlat = floor._max[axis] - floor._min[axis] <= flatness * floor.radius();
        const bool isAllOver = floor._min[u] <= box._min[u] && floor._max[u] >= box._max[u] &&
                               floor._min[v] <= box._min[v] && floor._max[v] >= box._max[v];
        if (!isFlat || !isAllOver) continue;
        if (light[axis] > light.w() * floor._max[axis])
            box._min[axis] = std::max(box._min[axis], floor._min[axis]);
        else
            box._max[axis] = std::min(box._max[axis], floor._max[axis]);
    }
}

/// The largest first, without what is sunk in a floor that gets its shadow.
std::vector<Placed> surfacesOf(const LitView& view, const LeafSet& shadowed, const osg::Vec4d& light) {
    const osg::Matrixd groupFromEye = osg::Matrixd::inverse(view.eyeFromGroup);
    std::vector<Placed> surfaces = placed(view.receivers, groupFromEye);
    for (const Placed& floor : placed(shadowed, groupFromEye))
        for (Placed& surface : surfaces) cutBehind(floor.inGroup, light, surface.inGroup);
    const auto isNothing = [](const Placed& surface) { return !surface.inGroup.valid(); };
    surfaces.erase(std::remove_if(surfaces.begin(), surfaces.end(), isNothing), surfaces.end());
    const auto larger = [](const Placed& a, const Placed& b) { return a.inGroup.radius() > b.inGroup.radius(); };
    std::stable_sort(surfaces.begin(), surfaces.end(), larger);
    surfaces.resize(std::min(surfaces.size(), mostSurfaces));
    return surfaces;
}

/// Boxes are tight in the frame of their own drawable: the shadow has to reach in both frames.
bool canShadow(const Placed& caster, const Placed& surface, const osg::Vec4d& light) {
    if (caster.isSame(surface)) return false;
    if (!shadowReaches(shrunk(caster.inGroup), shrunk(surface.inGroup), toGlm(light))) return false;
    for (const Placed* owner : {&caster, &surface}) {
        const osg::Matrixd localFromGroup = osg::Matrixd::inverse(owner->groupFromLocal);
        if (!localFromGroup.valid()) continue; // flattened: its box is tight in no frame
        if (!shadowReaches(shrunk(caster.in(localFromGroup)), shrunk(surface.in(localFromGroup)),
                           toGlm(light * localFromGroup)))
            return false;
    }
    return true;
}

} // namespace

std::string unshadowedSurface(const LitView& view, const LeafSet& shadowed,
                              const std::set<const osg::Drawable*>& notCasting) {
    std::vector<Placed> casters;
    for (const auto& piece : view.casters.list)
        if (piece->bounds.valid() && !notCasting.count(piece->drawable))
            casters.push_back({piece->drawable, piece->groupFromLocal, piece->bounds});
    const osg::Vec4d light = view.light.inGroup.w() < 0.0 ? -view.light.inGroup : view.light.inGroup;
    for (const Placed& surface : surfacesOf(view, shadowed, light)) {
        const auto shadows = [&](const Placed& caster) { return canShadow(caster, surface, light); };
        if (std::any_of(casters.begin(), casters.end(), shadows) && !areAllFacesCulled(*surface.leaf))
            return nameOf(*surface.drawable);
    }
    return {};
}

} // namespace gnomon
