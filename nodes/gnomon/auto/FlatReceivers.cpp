// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/Plane.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/auto/FlatReceivers.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/geometry/Across.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/planar/PlanarMark.h>
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <osg/Geometry>
#include <osg/TriangleIndexFunctor>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon {
namespace {

constexpr std::size_t mostPlanes = 8;   // each is one more draw of all casters
constexpr std::size_t mostBodies = 128; // that are compared with one another: a millisecond
constexpr std::size_t fewPlanes =
    64; // of a body whose planes may part it from others; of more, the sphere about it tells as much
constexpr double touching = 1e-6; // of the smaller body's size: so close counts as beside it
constexpr double infinity = std::numeric_limits<double>::infinity();

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

/// What floats make of a place in a drawable, in its group: a ground of kilometres is known less well than a thing upon it.
double roundingOf(const osg::BoundingBox& box, const glm::dmat4& groupFromLocal) {
    constexpr double steps = 4.0;
    const auto longer = [](float a, float b) { return double(std::max(std::abs(a), std::abs(b))); };
    const glm::dvec3 reach(longer(box.xMin(), box.xMax()), longer(box.yMin(), box.yMax()),
                           longer(box.zMin(), box.zMax()));
    const double stretch =
        std::max({glm::length(glm::dvec3(groupFromLocal[0])), glm::length(glm::dvec3(groupFromLocal[1])),
                  glm::length(glm::dvec3(groupFromLocal[2]))});
    return steps * (std::numeric_limits<float>::epsilon() * stretch * glm::length(reach) +
                    std::numeric_limits<double>::epsilon() * glm::length(glm::dvec3(groupFromLocal[3])));
}

void measure(ConvexBody& body) {
    glm::dvec3 low(infinity), high(-infinity);
    for (const glm::dvec3& corner : body.corners) low = glm::min(low, corner), high = glm::max(high, corner);
    body.middle = (low + high) / 2.0;
    for (const glm::dvec3& corner : body.corners)
        body.radius = std::max(body.radius, glm::distance(corner, body.middle));
}

/// @param groupFromBox  without shear, if planes are asked for.
ConvexBody boxOf(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& groupFromBox, bool withPlanes) {
    ConvexBody body;
    for (const glm::dvec4& corner : boxCorners(low, high, groupFromBox)) body.corners.emplace_back(corner);
    for (int axis = 0; withPlanes && axis < 3; ++axis)
        for (const double side : {1.0, -1.0}) {
            glm::dvec4 plane(0.0);
            plane[axis] = side;
            plane.w = -side * (side > 0.0 ? high : low)[axis];
            body.planes.push_back(plane);
        }
    measure(body);
    return body;
}

glm::dvec4 planeAt(const SilhouetteMesh& mesh, unsigned triangle) {
    return {mesh.planeX[triangle], mesh.planeY[triangle], mesh.planeZ[triangle], mesh.planeD[triangle]};
}

/// One connected part of a mesh. Closed parts whose edges are all convex are convex as wholes; so are flat ones, and those whose
/// openings are all at their feet, as of houses without a floor.
std::optional<ConvexBody> convexPart(const SilhouetteMesh& mesh, const SilhouetteMesh::Part& part,
                                     const glm::dvec3& origin) {
    constexpr double flatness = 1e-6; // of its size
    const double tolerance = flatness * glm::distance(glm::dvec3(part.low), glm::dvec3(part.high));
    const auto vertex = [&](unsigned corner) { return glm::dvec3(mesh.vertices[corner]); };
    const auto isBehind = [&](unsigned triangle, const glm::dvec4& plane) {
        return std::all_of(&mesh.corners[3 * triangle], &mesh.corners[3 * triangle] + 3,
                           [&](unsigned corner) { return distance(plane, vertex(corner)) <= tolerance; });
    };
    ConvexBody body;
    std::vector<unsigned> corners;
    for (unsigned i = part.firstTriangle; i < part.firstTriangle + part.triangles; ++i) {
        corners.insert(corners.end(), &mesh.corners[3 * i], &mesh.corners[3 * i] + 3);
        glm::dvec4 plane = planeAt(mesh, i);
        if (glm::dvec3(plane) == glm::dvec3(0.0)) continue;
        plane.w -= glm::dot(glm::dvec3(plane), origin);
        const auto same = [&](const glm::dvec4& other) { return glm::distance(other, plane) <= tolerance; };
        if (body.planes.empty() || !same(body.planes.back())) body.planes.push_back(plane);
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (body.planes.empty() || part.inward) return std::nullopt;
    for (const unsigned corner : corners) body.corners.push_back(vertex(corner) + origin);
    measure(body);
    const auto inPlane = [&](const glm::dvec3& corner) {
        return std::abs(distance(body.planes.front(), corner)) <= tolerance;
    };
    body.isPlate = std::all_of(body.corners.begin(), body.corners.end(), inPlane);
    if (body.isPlate) return body;
    const unsigned none = unsigned(mesh.triangles());
    for (unsigned i = part.firstEdge; i < part.firstEdge + part.edges; ++i) {
        const SilhouetteMesh::Edge& edge = mesh.edges[i];
        if (edge.left == none || edge.right == none) {
            if (std::max(vertex(edge.from).z, vertex(edge.to).z) > part.low.z + tolerance) return std::nullopt;
        } else if (!isBehind(edge.right, planeAt(mesh, edge.left)) || !isBehind(edge.left, planeAt(mesh, edge.right))) {
            return std::nullopt;
        }
    }
    return body;
}

/// Compares the normals at a drawable's vertices with those of its faces.
struct FaceNormals {
    void operator()(unsigned a, unsigned b, unsigned c) {
        constexpr double alike = 1.0 - 3e-5; // 0.4 degrees: less than two of 255 steps of light
        const osg::Vec3 face = ((*places)[b] - (*places)[a]) ^ ((*places)[c] - (*places)[a]);
        const double size = face.length();
        for (const unsigned corner : {a, b, c}) {
            const osg::Vec3& normal = (*normals)[normals->size() == 1 ? 0 : corner];
            flat = flat && (size == 0.0 || double(normal * face) >= alike * size * double(normal.length()));
        }
    }
    const osg::Vec3Array *places = nullptr, *normals = nullptr;
    bool flat = true;
};

bool isFlatShaded(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    osg::TriangleIndexFunctor<FaceNormals> faces;
    faces.places = geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getVertexArray()) : nullptr;
    faces.normals = geometry ? dynamic_cast<const osg::Vec3Array*>(geometry->getNormalArray()) : nullptr;
    if (!faces.places || !faces.normals) return false;
    const bool overall = faces.normals->getBinding() == osg::Array::BIND_OVERALL && !faces.normals->empty();
    const bool each = faces.normals->getBinding() == osg::Array::BIND_PER_VERTEX &&
                      faces.normals->size() >= faces.places->size() && faces.normals->size() > 1;
    if (!overall && !each) return false;
    geometry->accept(faces);
    return faces.flat;
}

DrawableBodies look(const Caster& piece) {
    DrawableBodies result;
    result.convex = piece.triangles <= CasterShapes::mostTriangles;
    if (result.convex) {
        const osg::ref_ptr<const CasterMesh> casters = meshOf({&piece});
        const unsigned* corners = casters->triangles->empty() ? nullptr : &casters->triangles->front();
        const SilhouetteMesh mesh(positionsOf(*casters), casters->vertices->size(), corners,
                                  casters->triangles->size());
        for (const SilhouetteMesh::Part& part : mesh.parts) {
            const auto body = convexPart(mesh, part, toGlm(casters->origin));
            result.convex = result.convex && body;
            if (body) result.bodies.push_back(*body);
        }
        result.flatShaded = result.convex && isFlatShaded(*piece.drawable);
    }
    if (!result.convex)
        result.bodies = {boxOf(toGlm(piece.bounds._min), toGlm(piece.bounds._max), glm::dmat4(1.0), true)};
    return result;
}

/// True if all of the body is on the outer side of the plane, or in it.
bool isOutside(const ConvexBody& body, const glm::dvec4& plane, double tolerance) {
    return std::all_of(body.corners.begin(), body.corners.end(),
                       [&](const glm::dvec3& corner) { return distance(plane, corner) >= -tolerance; });
}

/// How far along a way a body reaches.
struct Reach {
    Reach(const ConvexBody& body, const glm::dvec3& way) {
        for (const glm::dvec3& corner : body.corners) {
            low = std::min(low, glm::dot(corner, way));
            high = std::max(high, glm::dot(corner, way));
        }
    }
    double low = infinity, high = -infinity;
};

bool missSun(const ConvexBody& caster, const ConvexBody& body, const glm::dvec3& sun, double tolerance) {
    if (Reach(caster, sun).high <= Reach(body, sun).low + tolerance) return true; // all of it is behind the body
    const auto [u, v] = across(sun);
    for (const glm::dvec3& way : {u, v, (u + v) * std::sqrt(0.5), (u - v) * std::sqrt(0.5)}) {
        const Reach a(caster, way), b(body, way);
        if (a.high <= b.low + tolerance || b.high <= a.low + tolerance) return true;
    }
    return false;
}

/// By the spheres about both.
bool areFarApart(const ConvexBody& caster, const ConvexBody& body, const glm::dvec4& light) {
    const glm::dvec3 from(light);
    if (light.w == 0.0) {
        const glm::dvec3 way = caster.middle - body.middle;
        return glm::length(way - glm::dot(way, from) * from) >= caster.radius + body.radius;
    }
    const glm::dvec3 a = caster.middle - from, b = body.middle - from;
    const double farA = glm::length(a), farB = glm::length(b);
    if (!(farA > caster.radius && farB > body.radius)) return false;
    const double angle = std::acos(glm::clamp(glm::dot(a, b) / (farA * farB), -1.0, 1.0));
    return angle >= std::asin(caster.radius / farA) + std::asin(body.radius / farB);
}

/// Collects the receivers of one view.
class Finder {
public:
    Finder(const AutoView& view, CasterShapes& shapes) : _view(view), _shapes(shapes) {
        for (const auto& piece : view.casters.list) _pieces.emplace(piece->drawable.get(), piece.get());
        _groupFromEye = glm::inverse(toGlm(view.frame.eyeFromGroup));
        _eye = eyeIn(toGlm(view.frame.eyeFromGroup * view.frame.projection));
        _blends = view.frame.group->getComposite() == ShadowCasterGroup::BLEND;
    }

    FlatReceivers find() {
        lookAtCasters();
        for (const osgUtil::RenderLeaf* leaf : _view.frame.seen) {
            if (!_result.obstacle.empty()) break;
            if (writesDepth(leaf->_parent)) lookAt(*leaf);
        }
        if (_result.obstacle.empty()) lookForShadowsOnBodies();
        if (_result.obstacle.empty()) keepPlanesInUse();
        const bool cutByDepth = !_view.frame.receivers && !(_result.whole && isRelitAlone(_view, _result));
        if (_result.obstacle.empty() && !_result.planes.empty() && cutByDepth && !_vast.empty())
            refuse("the receiver '" + _vast + "' is so vast that its depths are coarse");
        if (!_result.planes.empty()) refuse(whyCoarse(_view, cutByDepth ? PlanarMark::tolerance.y : 1.0));
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

    void lookAt(const osgUtil::RenderLeaf& leaf) {
        const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
        if (!box.valid()) return refuse("a receiver has no bounds");
        const auto [first, end] = _pieces.equal_range(leaf._drawable.get());
        const auto flat = planeOf(box);
        if (first == end) {
            const glm::dmat4 groupFromLeaf = _groupFromEye * toGlm(modelviewOf(leaf));
            const auto inGroup = flat ? transformedPlane(groupFromLeaf, *flat) : std::nullopt;
            return inGroup ? addPlane(rounded(*inGroup), roundingOf(box, groupFromLeaf), leaf) : addBox(leaf);
        }
        if (flat && std::next(first) != end)
            _result.whole = false; // it stands in several places, the leaf in one of them
        for (auto entry = first; entry != end; ++entry) {
            const glm::dmat4 groupFromLocal = toGlm(entry->second->groupFromLocal);
            const auto inGroup = flat ? transformedPlane(groupFromLocal, *flat) : std::nullopt;
            if (inGroup)
                addPlane(*inGroup, roundingOf(box, groupFromLocal), leaf);
            else
                addPiece(*entry->second, leaf);
        }
    }

    /// The way by the eye is never quite the same. As ViewLights rounds lights.
    glm::dvec4 rounded(const glm::dvec4& plane) const {
        constexpr double places = 40.0;
        const auto step = [](double size) { return std::exp2(std::ceil(std::log2(size)) - places); };
        const double far = step(std::abs(plane.w) + glm::length(glm::dvec3(_groupFromEye[3])) + 1e-300);
        return {glm::round(glm::dvec3(plane) / step(1.0)) * step(1.0), std::round(plane.w / far) * far};
    }

    void addPiece(const Caster& piece, const osgUtil::RenderLeaf& leaf) {
        if (piece.triangles > CasterShapes::mostTriangles)
            return refuse("the receiver '" + nameOf(leaf) + "' has too many triangles to be looked at");
        if (_receiving.size() >= mostBodies)
            return refuse("there are too many receivers to be compared with one another");
        const DrawableBodies& found = _shapes.of(piece);
        if (!found.convex) return refuse("the receiver '" + nameOf(leaf) + "' is not convex");
        const bool unlitIsDark = !_blends && found.flatShaded && isShadedByOpenGl(leaf._parent);
        for (const ConvexBody& body : found.bodies) {
            if (body.isPlate) {
                addPlane(body.planes.front(), touching * body.radius, leaf);
                _result.whole = _result.whole && found.bodies.size() == 1;
            } else if (!unlitIsDark && showsUnlitSide(body))
                return refuse("a side of '" + nameOf(leaf) + "' that is turned away from the light is in sight");
            else {
                _receiving.push_back(&body);
            }
        }
    }

    bool showsUnlitSide(const ConvexBody& body) const {
        return std::any_of(body.planes.begin(), body.planes.end(), [&](const glm::dvec4& plane) {
            const double margin = touching * (_view.towards.w == 0.0 ? 1.0 : body.radius);
            return glm::dot(plane, _view.towards) < -margin && glm::dot(plane, _eye) > 0.0;
        });
    }

    /// Of something that does not cast.
    void addBox(const osgUtil::RenderLeaf& leaf) {
        if (_blends) return refuse("nobody knows which sides of '" + nameOf(leaf) + "' are turned away from the light");
        const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
        _boxes.push_back(boxOf(toGlm(osg::Vec3d(box._min)), toGlm(osg::Vec3d(box._max)),
                               _groupFromEye * toGlm(modelviewOf(leaf)), false));
    }

    /// @param rounding  within which places of the plane are known.
    void addPlane(glm::dvec4 plane, double rounding, const osgUtil::RenderLeaf& leaf) {
        constexpr double grazing = 1e-4; // sine: a sun along a plane gives it no light to take away
        const double towards = glm::dot(plane, _view.towards);
        if (std::abs(towards) <= (_view.towards.w == 0.0 ? grazing : rounding)) return;
        if (towards < 0.0) plane = -plane;
        if (!(glm::dot(plane, _eye) > 0.0)) return refuse("a flat receiver is seen from the side away from the light");
        if (!depthPlacementOf(leaf._parent).isPlain() || isPulledForward(leaf._parent))
            return refuse("a flat receiver has a polygon offset or a depth range");
        if (_vast.empty() && isVast(leaf, plane)) _vast = nameOf(leaf);
        const auto isSame = [&](const osg::Vec4d& other) {
            return glm::distance(glm::dvec3(toGlm(other)), glm::dvec3(plane)) <= touching &&
                   std::abs(other.w() - plane.w) <= rounding;
        };
        const auto known = std::find_if(_result.planes.begin(), _result.planes.end(), isSame);
        _flat.emplace_back(&leaf,
                           known != _result.planes.end() ? *known : osg::Vec4d(plane.x, plane.y, plane.z, plane.w));
        if (known != _result.planes.end()) return;
        _result.planes.push_back(_flat.back().second);
        if (_result.planes.size() > mostPlanes) refuse("there are more than eight flat receivers");
    }

    /// True if depths along it are off by more than PlanarMark lets them be. Rasterisers clip and interpolate in floats, whose steps
    /// grow with what is drawn: llvmpipe is off by up to a half-millionth of a ground's size, measured from 10 m to 100 km.
    bool isVast(const osgUtil::RenderLeaf& leaf, const glm::dvec4& plane) const {
        constexpr double off = 1.0 / (1 << 20);
        const osg::Matrixd& projection = _view.frame.projection;
        if (projection(3, 3) != 0.0 || !(_eye.w > 0.0)) return false; // no perspective: all is as near
        const double height = glm::dot(plane, _eye) / _eye.w;
        const double pixel = 2.0 * height / (std::abs(projection(1, 1)) * _view.frame.pixels.y());
        const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
        double farthest = 0.0;
        for (unsigned i = 0; i < 8; ++i)
            farthest = std::max(farthest, (osg::Vec3d(box.corner(i)) * modelviewOf(leaf)).length());
        return off * farthest > PlanarMark::tolerance.x * pixel;
    }

    void lookForShadowsOnBodies() {
        std::vector<const ConvexBody*> receiving = _receiving;
        for (const ConvexBody& box : _boxes) receiving.push_back(&box);
        if (receiving.empty()) return;
        if (_view.casters.list.size() * receiving.size() > mostBodies * mostBodies)
            return refuse("there are too many casters to be compared with the receivers");
        for (const auto& piece : _view.casters.list) {
            if (!piece->bounds.valid()) continue;
            for (const ConvexBody& caster : _shapes.of(*piece).bodies)
                for (const ConvexBody* body : receiving)
                    if (&caster != body && mayShadow(caster, *body, _view.towards))
                        return refuse("objects shadow one another");
        }
    }

    /// Those that a caster reaches above, and the leaves in them.
    void keepPlanesInUse() {
        const auto reachesAbove = [](const Caster& piece, const osg::Vec4d& given) {
            if (!piece.bounds.valid()) return false;
            const glm::dvec4 plane = toGlm(given);
            const glm::dvec3 middle = toGlm(piece.bounds.center());
            const glm::dvec3 half = toGlm(piece.bounds._max) - middle;
            return distance(plane, middle) + glm::dot(glm::abs(glm::dvec3(plane)), half) >
                   roundingOf(piece.drawable->getBoundingBox(), toGlm(piece.groupFromLocal));
        };
        const auto isBare = [&](const osg::Vec4d& plane) {
            return std::none_of(_view.casters.list.begin(), _view.casters.list.end(),
                                [&](const auto& piece) { return reachesAbove(*piece, plane); });
        };
        auto& planes = _result.planes;
        planes.erase(std::remove_if(planes.begin(), planes.end(), isBare), planes.end());
        for (const auto& [leaf, plane] : _flat)
            if (std::find(planes.begin(), planes.end(), plane) != planes.end()) _result.leaves.insert(leaf);
    }

    const AutoView& _view;
    CasterShapes& _shapes;
    std::unordered_multimap<const osg::Drawable*, const Caster*> _pieces;
    glm::dmat4 _groupFromEye{1.0};
    glm::dvec4 _eye{0.0};
    bool _blends = false;
    std::string _vast;                                                    ///< a receiver that is so.
    std::vector<std::pair<const osgUtil::RenderLeaf*, osg::Vec4d>> _flat; ///< leaves that lie in a plane, and that.
    std::vector<const ConvexBody*> _receiving;
    std::vector<ConvexBody> _boxes;
    FlatReceivers _result;
};

} // namespace

const DrawableBodies& CasterShapes::of(const Caster& piece) {
    Entry& entry = _known[&piece];
    if (!entry.piece.valid()) entry = {&piece, look(piece)};
    return entry.shape;
}

void CasterShapes::prune() {
    for (auto entry = _known.begin(); entry != _known.end();)
        entry = entry->second.piece.valid() ? std::next(entry) : _known.erase(entry);
}

/// A plane between the two that the light is on the right side of tells that no ray meets both.
bool mayShadow(const ConvexBody& caster, const ConvexBody& body, const glm::dvec4& light) {
    if (areFarApart(caster, body, light)) return false;
    const double tolerance = touching * std::min(caster.radius, body.radius);
    if (light.w == 0.0 && missSun(caster, body, glm::dvec3(light), tolerance)) return false;
    const auto parts = [&](const ConvexBody& one, const ConvexBody& other, double side) {
        return one.planes.size() <= fewPlanes &&
               std::any_of(one.planes.begin(), one.planes.end(), [&](const glm::dvec4& plane) {
                   return side * glm::dot(plane, light) >= 0.0 && isOutside(other, plane, tolerance);
               });
    };
    return !parts(caster, body, 1.0) && !parts(body, caster, -1.0);
}

/// Several planes are several marks, none of which knows all; and marks of several lights are relit together.
bool isRelitAlone(const AutoView& view, const FlatReceivers& flat) {
    return view.frame.group->getComposite() == ShadowCasterGroup::RELIGHT && view.frame.lights == 1 &&
           !view.frame.receivers && flat.planes.size() == 1;
}

FlatReceivers findFlatReceivers(const AutoView& view, CasterShapes& shapes) {
    shapes.prune();
    return Finder(view, shapes).find();
}

FlatLeaves::FlatLeaves(const Leaves& seen, const FlatReceivers& flat) : whole(flat.whole) {
    for (std::size_t i = 0; i < seen.size(); ++i)
        if (flat.leaves.count(seen[i])) _places.push_back(i);
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
