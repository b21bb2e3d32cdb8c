// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/RayScene.h>
#include <gnomon/base/PlacedBox.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/RaySceneCache.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/geometry/Across.h>
#include <gnomon/group/EnclosingCasters.h>
#include <gnomon/group/LocalLight.h>

#include <glm/geometric.hpp>

#include <algorithm>
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
    CasterDrawables::List pieces;
    std::size_t triangles = 0;
};

const osg::Node* parentOf(const osg::Drawable& drawable) {
    return drawable.getNumParents() > 0 ? drawable.getParent(0) : static_cast<const osg::Node*>(&drawable);
}

/// The one with the largest bounds.
CastingNode largestNode(const CasterDrawables& casters) {
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
std::vector<osg::BoundingBoxd> boxesOf(const LitView& view, const CastingNode& without) {
    std::set<const osg::Drawable*> own;
    for (const auto& piece : without.pieces) own.insert(piece->drawable);
    const osg::Matrixd groupFromEye = osg::Matrixd::inverse(view.eyeFromGroup);
    std::vector<osg::BoundingBoxd> boxes;
    for (const osgUtil::RenderLeaf* leaf : view.receivers) {
        const osg::BoundingBox& box = leaf->_drawable->getBoundingBox();
        if (!box.valid() || own.count(leaf->_drawable)) continue;
        boxes.push_back(placedBox(box, modelviewOf(*leaf) * groupFromEye));
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

/// Whether a node is before the light and about all points.
bool encloses(const CastingNode& node, const std::vector<osg::Vec3d>& points, const osg::Vec4d& light) {
    const osg::ref_ptr<const CasterMesh> mesh = meshOf(node.pieces);
    const SceneFrame frame(toGlm(mesh->origin));
    const std::optional<glm::dvec4> local = localLight(light, frame);
    if (!local) return false;
    const RayScene rays(soupOf(*mesh));
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

std::string find(const LitView& view) {
    const CastingNode node = largestNode(view.casters);
    if (!node.node || node.triangles > mostTriangles) return {};
    const std::vector<osg::Vec3d> points = pointsIn(boxesOf(view, node));
    const auto isInside = [&](const osg::Vec3d& point) { return node.bounds.contains(point); };
    if (points.empty() || !holdsForNearlyAll(points, isInside) || !encloses(node, points, view.light.inGroup))
        return {};
    return "nearly all that light " + std::to_string(view.light.number) +
           " could reach in this view is in the shadow of '" + nameOf(*node.node) +
           "', which stands around it. Take that node out of setCasters() by its node mask, or draw it at the far "
           "plane, "
           "as skies are.";
}

} // namespace

std::string enclosingCause(const LitView& view) {
    try {
        return find(view);
    } catch (const std::runtime_error&) { // no tree for rays: traced tells why
        return {};
    }
}

} // namespace gnomon
