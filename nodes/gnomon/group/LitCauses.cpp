// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/RayScene.h>
#include <gnomon/base/BoxAbout.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/RaySceneCache.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/geometry/Across.h>
#include <gnomon/geometry/DrawnError.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/geometry/ShadowReach.h>
#include <gnomon/group/LitCauses.h>
#include <gnomon/group/SceneFrame.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <osg/CullFace>
#include <osg/FrontFace>
#include <osg/TriangleFunctor>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr std::size_t mostReceivers = 7;       // nine points each: 63 rays to the light
constexpr std::size_t mostTriangles = 200000;  // of an enclosing node: a tree of these takes a fifth of a second
constexpr double nearlyAll = 0.95, cone = 0.5; // the cosine of 60°

/// The drawables below a node that cast.
struct CastingNode {
    const osg::Node* node = nullptr;
    osg::BoundingBoxd bounds;
    CasterList pieces;
    std::size_t triangles = 0;
};

const osg::Node* parentOf(const osg::Drawable& drawable) {
    return drawable.getNumParents() > 0 ? drawable.getParent(0) : static_cast<const osg::Node*>(&drawable);
}

/// The one with the largest bounds.
CastingNode largestNode(const Casters& casters) {
    std::map<const osg::Node*, CastingNode> nodes;
    for (const auto& piece : casters.list) {
        CastingNode& entry = nodes[parentOf(*piece->drawable)];
        entry.node = parentOf(*piece->drawable);
        entry.bounds.expandBy(piece->bounds);
        entry.pieces.push_back(piece);
        entry.triangles += piece->triangles;
    }
    CastingNode largest;
    for (const auto& [node, entry] : nodes)
        if (entry.bounds.valid() && (!largest.node || entry.bounds.radius() > largest.bounds.radius())) largest = entry;
    return largest;
}

/// Boxes of what is seen in the group's frame, but for a node's own; the largest.
std::vector<osg::BoundingBoxd> boxesOf(const CastersInView& seen, const CastingNode& without) {
    std::set<const osg::Drawable*> left;
    for (const auto& piece : without.pieces) left.insert(piece->drawable);
    const osg::Matrixd groupFromEye = osg::Matrixd::inverse(seen.eyeFromGroup);
    std::vector<osg::BoundingBoxd> boxes;
    for (const osgUtil::RenderLeaf* leaf : seen.receivers) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid() || left.count(leaf->_drawable)) continue;
        boxes.push_back(boxAbout(box, modelviewOf(*leaf) * groupFromEye));
    }
    const auto larger = [](const auto& a, const auto& b) { return a.radius() > b.radius(); };
    std::sort(boxes.begin(), boxes.end(), larger);
    boxes.resize(std::min(boxes.size(), mostReceivers));
    return boxes;
}

/// Of each box its middle, and places a little inside its corners, for these may touch walls.
std::vector<osg::Vec3d> pointsIn(const std::vector<osg::BoundingBoxd>& boxes) {
    constexpr double inside = 0.9;
    std::vector<osg::Vec3d> points;
    for (const osg::BoundingBoxd& box : boxes) {
        const osg::Vec3d middle = box.center();
        points.push_back(middle);
        for (unsigned i = 0; i < 8; ++i) points.push_back(middle + (osg::Vec3d(box.corner(i)) - middle) * inside);
    }
    return points;
}

/// The i-th of directions that fill a cone evenly.
glm::dvec3 directionAbout(const glm::dvec3& axis, std::size_t i, std::size_t count) {
    const double height = 1.0 - (1.0 - cone) * (double(i) + 0.5) / double(count), turn = double(i) * 2.399963; // golden
    const auto [u, v] = across(axis);
    return height * axis + std::sqrt(1.0 - height * height) * (std::cos(turn) * u + std::sin(turn) * v);
}

template <class Test>
bool holdsForNearlyAll(const std::vector<osg::Vec3d>& points, Test test) {
    return double(std::count_if(points.begin(), points.end(), test)) >= nearlyAll * double(points.size());
}

/// Whether what rays meet, in its frame, is before the light and about all points.
bool encloses(const RayScene& rays, const SceneFrame& frame, const std::vector<osg::Vec3d>& points,
              const osg::Vec4d& light) {
    const std::optional<glm::dvec4> local = lightInScene(light, frame);
    if (!local) return false;
    const auto towards = [&](const glm::dvec3& point) {
        return local->w == 0.0 ? glm::dvec3(*local) : glm::dvec3(*local) - point;
    };
    const double reach = local->w == 0.0 ? std::numeric_limits<double>::infinity() : 1.0;
    std::size_t i = 0;
    return holdsForNearlyAll(points, [&](const osg::Vec3d& place) {
        const glm::dvec3 point = frame.point(place), way = towards(point);
        return rays.blocked({point, way, reach}) &&
               rays.blocked({point, directionAbout(glm::normalize(way), i++, points.size())});
    });
}

std::vector<std::string> findEnclosing(const CastersInView& seen, const std::vector<ShadowLight>& lights) {
    const CastingNode node = largestNode(seen.casters);
    if (!node.node || node.triangles > mostTriangles) return {};
    const std::vector<osg::Vec3d> points = pointsIn(boxesOf(seen, node));
    const auto isInside = [&](const osg::Vec3d& point) { return node.bounds.contains(point); };
    if (points.empty() || !holdsForNearlyAll(points, isInside)) return {};
    const osg::ref_ptr<const CasterMesh> mesh = meshOf(node.pieces);
    const RayScene rays(soupOf(*mesh));
    std::vector<std::string> causes;
    for (const ShadowLight& light : lights)
        if (encloses(rays, SceneFrame(toGlm(mesh->origin)), points, light.inGroup))
            causes.push_back(
                "nearly all that light " + std::to_string(light.number) +
                " could reach in this view is in the shadow of '" + nameOf(*node.node) +
                "', which stands around it. Take that node out of the casters (setCasters(), --casters), or draw it "
                "at the far plane, as skies are.");
    return causes;
}

} // namespace

std::vector<std::string> enclosingCauses(const CastersInView& seen, const std::vector<ShadowLight>& lights) {
    try {
        return findEnclosing(seen, lights);
    } catch (const std::runtime_error&) { // no tree for rays: traced tells why
        return {};
    }
}

namespace {

/// Looks for a triangle that is not culled.
struct SeenFace {
    osg::Matrixd clipFromLocal;
    double sign = 1.0; ///< of what is seen; counter-clockwise triangles are positive.
    bool found = false;

    void operator()(const osg::Vec3& a, const osg::Vec3& b, const osg::Vec3& c, bool = false) {
        if (found) return;
        osg::Vec3d corners[3];
        const osg::Vec3* locals[] = {&a, &b, &c};
        for (int i = 0; i < 3; ++i) {
            const osg::Vec4d clip = osg::Vec4d(osg::Vec3d(*locals[i]), 1.0) * clipFromLocal;
            corners[i] = {clip.x(), clip.y(), clip.w()}; // homogeneous: right behind the eye, too
        }
        found = sign * (corners[0] * (corners[1] ^ corners[2])) > 0.0;
    }
};

/// True if nothing of a leaf is seen because all its faces are turned so that face culling leaves them out: of the triangles
/// up to the first that is seen.
bool areAllFacesCulled(const osgUtil::RenderLeaf& leaf) {
    if (!isOn(leaf._parent, GL_CULL_FACE)) return false;
    const auto* culled = resolved<osg::CullFace>(leaf._parent, osg::StateAttribute::CULLFACE);
    const auto* front = resolved<osg::FrontFace>(leaf._parent, osg::StateAttribute::FRONTFACE);
    const auto mode = culled ? culled->getMode() : osg::CullFace::BACK;
    if (mode == osg::CullFace::FRONT_AND_BACK) return true;
    osg::TriangleFunctor<SeenFace> faces;
    if (!leaf._drawable->supports(faces)) return false;
    faces.clipFromLocal = modelviewOf(leaf) * projectionOf(leaf);
    const bool isClockwise = front && front->getMode() == osg::FrontFace::CLOCKWISE;
    faces.sign = isClockwise == (mode == osg::CullFace::BACK) ? -1.0 : 1.0;
    leaf._drawable->accept(faces);
    return !faces.found;
}

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
        return boxAbout(drawable->getBoundingBox(), groupFromLocal * frameFromGroup);
    }
};

template <typename Leaves>
std::vector<Placed> placed(const Leaves& leaves, const osg::Matrixd& groupFromEye) {
    std::vector<Placed> result;
    for (const osgUtil::RenderLeaf* leaf : leaves) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid()) continue;
        const osg::Matrixd groupFromLocal = modelviewOf(*leaf) * groupFromEye;
        result.push_back({leaf->_drawable.get(), groupFromLocal, boxAbout(box, groupFromLocal), leaf});
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
std::vector<Placed> surfacesOf(const CastersInView& seen, const LeafSet& shadowed, const osg::Vec4d& light) {
    const osg::Matrixd groupFromEye = osg::Matrixd::inverse(seen.eyeFromGroup);
    std::vector<Placed> surfaces = placed(seen.receivers, groupFromEye);
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

std::string unshadowedSurface(const CastersInView& seen, const ShadowLight& from, const LeafSet& shadowed,
                              const std::set<const osg::Drawable*>& notCasting) {
    std::vector<Placed> casters;
    for (const auto& piece : seen.casters.list)
        if (piece->bounds.valid() && !notCasting.count(piece->drawable))
            casters.push_back({piece->drawable, piece->groupFromLocal, piece->bounds});
    const osg::Vec4d light = from.inGroup.w() < 0.0 ? -from.inGroup : from.inGroup;
    for (const Placed& surface : surfacesOf(seen, shadowed, light)) {
        const auto shadows = [&](const Placed& caster) { return canShadow(caster, surface, light); };
        if (std::any_of(casters.begin(), casters.end(), shadows) && !areAllFacesCulled(*surface.leaf))
            return nameOf(*surface.drawable);
    }
    return {};
}

namespace {

constexpr int depthBits = 24;

/// In clip space.
using Corners = std::array<glm::dvec4, 8>;

Corners cornersOf(const osg::BoundingBoxd& box, const glm::dmat4& clipFromBox) {
    return boxCorners(toGlm(box._min), toGlm(box._max), clipFromBox);
}

bool isNearer(const glm::dvec4& a, const glm::dvec4& b) { return a.w < b.w; }

double nearestOf(const Corners& corners) { return std::min_element(corners.begin(), corners.end(), isNearer)->w; }
double farthestOf(const Corners& corners) { return std::max_element(corners.begin(), corners.end(), isNearer)->w; }

/// True if some of it is in view and as large as a pixel.
bool isSeen(const Corners& corners, const osg::Vec2d& pixels) {
    const auto isBeforeFarPlane = [](const glm::dvec4& corner) { return corner.z <= corner.w; };
    if (std::none_of(corners.begin(), corners.end(), isBeforeFarPlane)) return false;
    const std::optional<ScreenRect> place = screenBounds(corners);
    if (!place) return false;
    const glm::dvec2 size = 0.5 * (place->high - place->low) * glm::dvec2(pixels.x(), pixels.y());
    return std::max(size.x, size.y) >= 1.0;
}

} // namespace

/// Depth is d = (a z + b) / w with w = c z + e, so that it changes by |a e - b c| / w² along z. A step of 2^(1 - bits), for d
/// goes from -1 to 1, is w² 2^(1 - bits) / |a e - b c| long, and a pixel 2 w / (scale · pixels) wide.
double coarseDepthFrom(const osg::Matrixd& projection, const DepthPixels& pixels) {
    const double change = std::abs(projection(2, 2) * projection(3, 3) - projection(3, 2) * projection(2, 3));
    const double across =
        std::max(std::abs(projection(0, 0)) * pixels.size.x(), std::abs(projection(1, 1)) * pixels.size.y());
    return std::ldexp(change, depthBits) / (across * pixels.steps);
}

bool reachesCoarseDepth(const CastersInView& seen, const osg::Matrixd& projection, const DepthPixels& pixels) {
    const osg::BoundingBoxd& box = seen.casters.bounds;
    return box.valid() &&
           farthestOf(cornersOf(box, toGlm(seen.eyeFromGroup * projection))) > coarseDepthFrom(projection, pixels);
}

std::string coarselyPlaced(const CastersInView& seen, const osg::Matrixd& projection, const DepthPixels& pixels) {
    const double coarse = coarseDepthFrom(projection, pixels);
    const glm::dmat4 clipFromGroup = toGlm(seen.eyeFromGroup * projection);
    for (const auto& piece : seen.casters.list) {
        if (!piece->bounds.valid()) continue;
        const Corners corners = cornersOf(piece->bounds, clipFromGroup);
        if (nearestOf(corners) > coarse && isSeen(corners, pixels.size)) return nameOf(*piece->drawable);
    }
    return {};
}

/// Off by the offset that all of a leaf's vertices share: what is as wide as it is far from its origin is drawn well at the eye. The
/// bound is some three times what is seen; from four pixels of it on shadows are wrong away from their edges, by map and by volume.
/// Steps of depth tell what is far away, too, from what its vertices put there.
std::string drawnOffItsPlace(const std::vector<const osgUtil::RenderLeaf*>& leaves, const osg::Matrixd& projection,
                             const osg::Vec2d& pixels) {
    constexpr double mostPixels = 4.0, mostSteps = 64.0;
    const glm::dmat4 lens = toGlm(projection);
    const double aPixel = coarseDepthFrom(projection, {pixels, 1.0}), // of them, a step's length is the distance
        steps = std::ldexp(drawnError(lens, lens, pixels.x(), 1.0, 0.0).depth, depthBits);
    for (const osgUtil::RenderLeaf* leaf : leaves) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid()) continue;
        const glm::dmat4 eyeFromLocal = toGlm(modelviewOf(*leaf));
        const glm::dvec3 low = toGlm(osg::Vec3d(box._min)), high = toGlm(osg::Vec3d(box._max));
        const glm::dvec3 shared = glm::max(glm::max(low, -high), 0.0);
        const double rounding =
            std::ldexp(glm::dot(glm::abs(glm::dvec3(glm::row(eyeFromLocal, 2))), shared), -depthBits);
        if (!(steps * rounding > mostPixels * aPixel)) continue;
        if (steps * rounding > mostSteps * nearestOf(boxCorners(low, high, lens * eyeFromLocal)))
            return nameOf(*leaf->_drawable);
    }
    return {};
}

} // namespace gnomon
