// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/Plane.h>
#include <gnomon/auto/FlatReceivers.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/geometry/ScreenBounds.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <unordered_map>

namespace gnomon {
namespace {

constexpr std::size_t mostPlanes = 8;   // each is one more draw of all casters
constexpr std::size_t mostBodies = 128; // that are compared with one another: a millisecond
constexpr double grazing = 1e-4;        // sine: light along a plane gives it no light to take away
constexpr double flatness = 1e-6;       // of a size

/// The plane of a box that is flat in its own frame.
std::optional<glm::dvec4> planeOf(const osg::BoundingBox& box) {
    if (!box.valid()) return std::nullopt;
    const glm::dvec3 low = toGlm(osg::Vec3d(box._min)), high = toGlm(osg::Vec3d(box._max)), size = high - low;
    const int axis = size.x == 0.0 ? 0 : size.y == 0.0 ? 1 : 2;
    if (size[axis] != 0.0) return std::nullopt;
    glm::dvec4 plane(0.0);
    plane[axis] = 1.0;
    plane.w = -low[axis];
    return plane;
}

/// Collects the receivers of one view.
class Finder {
public:
    Finder(const AutoView& view, ConvexBodies& bodies) : _view(view), _bodies(bodies) {
        for (const auto& piece : view.casters.list) _pieces.emplace(piece->drawable.get(), piece.get());
        _groupFromEye = glm::inverse(toGlm(view.frame.eyeFromGroup));
        _eye = eyeIn(toGlm(view.frame.eyeFromGroup * view.frame.projection));
    }

    FlatReceivers find() {
        lookAtCasters();
        lookAtReceivers();
        if (_result.obstacle.empty()) lookForShadowsOnBodies();
        if (_result.obstacle.empty()) keepPlanesInUse();
        return _result;
    }

private:
    void refuse(const std::string& why) {
        if (_result.obstacle.empty()) _result.obstacle = why;
    }

    void lookAtCasters() {
        const std::string cutOut = whyCutOut(_view.casters);
        if (!cutOut.empty()) refuse(cutOut);
        if (!_view.casters.own.empty()) refuse("a caster draws itself, so nobody knows where its shadow falls");
    }

    void lookAtReceivers() {
        for (const osgUtil::RenderLeaf* leaf : _view.frame.seen) {
            if (!_result.obstacle.empty()) break;
            if (writesDepth(leaf->_parent)) lookAt(*leaf);
        }
    }

    void lookAt(const osgUtil::RenderLeaf& leaf) {
        const auto [first, end] = _pieces.equal_range(leaf._drawable.get());
        const auto flat = planeOf(leaf._drawable->getBoundingBox());
        if (flat && first == end) {
            const auto inGroup = transformedPlane(_groupFromEye * toGlm(modelviewOf(leaf)), *flat);
            return inGroup ? addPlane(rounded(*inGroup), leaf) : addBox(leaf);
        }
        if (first == end) return addBox(leaf);
        for (auto entry = first; entry != end; ++entry) addPiece(*entry->second, leaf);
    }

    /// The way by the eye is never quite the same.
    glm::dvec4 rounded(const glm::dvec4& plane) const {
        constexpr double step = 1e-9;
        const double size = step * std::exp2(std::ceil(std::log2(std::max(reach(), 1e-300))));
        return {glm::round(glm::dvec3(plane) / step) * step, std::round(plane.w / size) * size};
    }

    void addPiece(const CasterDrawable& piece, const osgUtil::RenderLeaf& leaf) {
        if (const auto flat = planeOf(piece.drawable->getBoundingBox()))
            if (const auto inGroup = transformedPlane(toGlm(piece.groupFromLocal), *flat))
                return addPlane(*inGroup, leaf);
        const DrawableBodies& found = _bodies.of(piece);
        if (!found.looked) return refuse("the receiver '" + nameOf(leaf) + "' has too many triangles to be looked at");
        if (!found.convex) return refuse("the receiver '" + nameOf(leaf) + "' is not convex");
        for (const ConvexBody& body : found.bodies) {
            if (body.isPlate())
                addPlane(body.planes.front(), leaf);
            else
                _receiving.push_back(&body);
        }
        if (_receiving.size() > mostBodies) refuse("there are too many receivers to be compared with one another");
    }

    /// Of something that does not cast.
    void addBox(const osgUtil::RenderLeaf& leaf) {
        const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
        if (!box.valid()) return refuse("a receiver has no bounds");
        const glm::dmat4 groupFromLeaf = _groupFromEye * toGlm(modelviewOf(leaf));
        ConvexBody body;
        for (unsigned i = 0; i < 8; ++i)
            body.corners.emplace_back(groupFromLeaf * glm::dvec4(toGlm(osg::Vec3d(box.corner(i))), 1.0));
        _boxes.push_back(body);
    }

    void addPlane(glm::dvec4 plane, const osgUtil::RenderLeaf& leaf) {
        const double towards = glm::dot(glm::dvec3(plane), glm::dvec3(_view.towards)) + plane.w * _view.towards.w;
        if (std::abs(towards) <= grazing * (_view.towards.w == 0.0 ? 1.0 : reach())) return;
        if (towards < 0.0) plane = -plane;
        if (!(glm::dot(plane, _eye) > 0.0)) return refuse("a flat receiver is seen from the side away from the light");
        if (!depthPlacementOf(leaf._parent).isPlain() || isPulledForward(leaf._parent))
            return refuse("a flat receiver has a polygon offset or a depth range");
        _result.leaves.insert(&leaf);
        const auto isSame = [&](const osg::Vec4d& other) {
            return glm::length(toGlm(other) - plane) <= flatness * (1.0 + std::abs(plane.w));
        };
        if (std::any_of(_result.planes.begin(), _result.planes.end(), isSame)) return;
        _result.planes.emplace_back(plane.x, plane.y, plane.z, plane.w);
        if (_result.planes.size() > mostPlanes) refuse("there are more than eight flat receivers");
    }

    double reach() const { return _view.casters.bounds.radius(); }

    std::vector<const ConvexBody*> allBodies() {
        std::vector<const ConvexBody*> all;
        for (const auto& piece : _view.casters.list)
            if (piece->bounds.valid())
                for (const ConvexBody& body : _bodies.of(*piece).bodies) all.push_back(&body);
        return all;
    }

    void lookForShadowsOnBodies() {
        std::vector<const ConvexBody*> receiving = _receiving;
        for (const ConvexBody& box : _boxes) receiving.push_back(&box);
        if (receiving.empty()) return;
        const std::vector<const ConvexBody*> casting = allBodies();
        if (casting.size() * receiving.size() > mostBodies * mostBodies)
            return refuse("there are too many casters to be compared with the receivers");
        for (const ConvexBody* body : receiving)
            for (const ConvexBody* caster : casting)
                if (caster != body && mayShadow(*caster, *body, _view.towards))
                    return refuse("objects shadow one another");
    }

    /// Those that a caster reaches above.
    void keepPlanesInUse() {
        const osg::BoundingBoxd& box = _view.casters.bounds;
        const double thick = flatness * box.radius();
        const auto isBare = [&](const osg::Vec4d& plane) {
            double highest = -reach();
            for (const auto& piece : _view.casters.list)
                for (unsigned i = 0; piece->bounds.valid() && i < 8; ++i)
                    highest = std::max(highest, distance(toGlm(plane), toGlm(osg::Vec3d(piece->bounds.corner(i)))));
            return !(highest > thick);
        };
        auto& planes = _result.planes;
        planes.erase(std::remove_if(planes.begin(), planes.end(), isBare), planes.end());
    }

    const AutoView& _view;
    ConvexBodies& _bodies;
    std::unordered_multimap<const osg::Drawable*, const CasterDrawable*> _pieces;
    glm::dmat4 _groupFromEye{1.0};
    glm::dvec4 _eye{0.0};
    std::vector<const ConvexBody*> _receiving;
    std::vector<ConvexBody> _boxes;
    FlatReceivers _result;
};

} // namespace

FlatReceivers findFlatReceivers(const AutoView& view, ConvexBodies& bodies) { return Finder(view, bodies).find(); }

FlatLeaves::FlatLeaves(const Leaves& seen, const LeafSet& flat) {
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (flat.count(seen[i])) _places.push_back(i);
    take(seen);
}

/// A view that stands still mostly has its leaves at their old addresses, too.
const std::shared_ptr<const LeafSet>& FlatLeaves::in(const Leaves& seen) {
    std::size_t same = 0;
    while (same < _places.size() && seen[_places[same]] == _leaves[same]) ++same;
    if (same < _places.size()) take(seen);
    return _set;
}

void FlatLeaves::take(const Leaves& seen) {
    _leaves.clear();
    for (const std::size_t place : _places) _leaves.push_back(seen[place]);
    _set = std::make_shared<const LeafSet>(_leaves.begin(), _leaves.end());
}

} // namespace gnomon
