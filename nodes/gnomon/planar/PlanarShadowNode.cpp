// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/PlanarShadow.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/Plane.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/group/ShadowProbe.h>
#include <gnomon/planar/PlanarCasters.h>
#include <gnomon/planar/PlanarMark.h>

#include <glm/matrix.hpp>
#include <osg/io_utils>
#include <osgUtil/RenderLeaf>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace gnomon {
namespace {

std::string sentence(const char* start, const osg::Vec4d& what, const char* rest) {
    std::ostringstream text;
    text << start << " (" << what << ") " << rest;
    return text.str();
}

bool isFinite(const glm::dvec4& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && std::isfinite(v.w);
}

/// The plane as a function on the screen, z = x·a + y·b + c in normalised device coordinates; nullopt if it is seen
/// edge on.
std::optional<glm::dvec3> depthOnScreen(const glm::dvec4& plane, const glm::dmat4& clipFromFrame) {
    const glm::dvec4 onScreen = glm::transpose(glm::inverse(clipFromFrame)) * plane;
    const glm::dvec3 depth = glm::dvec3(onScreen.x, onScreen.y, onScreen.w) / -onScreen.z;
    if (!(std::isfinite(depth.x) && std::isfinite(depth.y) && std::isfinite(depth.z))) return std::nullopt;
    return depth;
}

/// True if all of a leaf lies in the plane by flatness, as its bounding box tells: exact for a box that is flat in its own frame.
bool liesIn(const osgUtil::RenderLeaf& leaf, const glm::dvec4& eyePlane) {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    const auto plane = normalizedPlane(glm::transpose(toGlm(modelviewOf(leaf))) * eyePlane);
    if (!box.valid() || !plane) return false;
    for (unsigned i = 0; i < 8; ++i) {
        const glm::dvec3 corner = toGlm(osg::Vec3d(box.corner(i)));
        const double rounding =
            4.0 * std::numeric_limits<float>::epsilon() * (glm::length(corner) + std::abs(plane->w)) / 2.0;
        if (!(std::abs(distance(*plane, corner)) <= std::max(rounding, flatness * double(box.radius())))) return false;
    }
    return true;
}

/// Heights of a drawable's surface over a plane, both in the drawable's frame.
class SurfaceHeights : public TriangleDecoder {
public:
    /// @param vertices  at most so many are looked at.
    SurfaceHeights(const osg::Drawable& drawable, const glm::dvec4& plane, unsigned vertices)
        : TriangleDecoder({}), _plane(plane), _most(vertices) {
        const osg::Geometry* geometry = drawable.asGeometry();
        const osg::Array* array = geometry ? geometry->getVertexArray() : nullptr;
        if (!array || array->getNumElements() <= vertices) readTriangles(drawable, *this);
    }
    ~SurfaceHeights() override = default;

    double top = -std::numeric_limits<double>::infinity();
    double farthest = 0.0; ///< of points, lines, and triangles that face the plane's lit side.
    bool anyTriangle = false;

protected:
    void start(unsigned count) override { _looks = count <= _most; }
    void point(unsigned index) override { take(index, true); }
    void triangle(unsigned a, unsigned b, unsigned c) override {
        anyTriangle = true;
        if (!_looks || !isInArray(a) || !isInArray(b) || !isInArray(c)) return;
        const glm::dvec3 from = toGlm(local(a)), across = glm::cross(toGlm(local(b)) - from, toGlm(local(c)) - from);
        const bool faces = glm::dot(across, glm::dvec3(_plane)) > 0.5 * glm::length(across); // not the sides of a slab
        for (const unsigned corner : {a, b, c}) take(corner, faces);
    }

private:
    void take(unsigned index, bool faces) {
        if (!_looks || !isInArray(index)) return;
        const double height = distance(_plane, toGlm(local(index)));
        top = std::max(top, height);
        if (faces && std::abs(height) > std::abs(farthest)) farthest = height;
    }

    const glm::dvec4 _plane; ///< unit normal.
    const unsigned _most;
    bool _looks = false;
};

constexpr unsigned mostOfAFloor = 1000; // vertices: floors have few

/// What PlanarMark takes for the plane at the far plane: 32 steps of 24 bits of depth, where the near plane is at 0.0005 of the
/// distance, as OpenSceneGraph computes it. A surface as large as its distance may be off by so much.
constexpr double unevenness = PlanarMark::tolerance.y / (1 << 24) / 0.0005;

/// How high over a plane a leaf ends, as its bounding box tells, or its vertices: the box of a slanted floor is not flat.
double topOver(const glm::dvec4& plane, const osgUtil::RenderLeaf& leaf, double ofVertices) {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    double highest = -std::numeric_limits<double>::infinity();
    for (unsigned i = 0; i < 8; ++i) highest = std::max(highest, distance(plane, toGlm(osg::Vec3d(box.corner(i)))));
    return std::abs(ofVertices) < std::abs(highest) ? ofVertices : highest;
}

/// True if a leaf ends in the plane, or close to it: a floor, or the top of a slab.
bool endsIn(const osgUtil::RenderLeaf& leaf, const glm::dvec4& eyePlane) {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    const auto plane = normalizedPlane(glm::transpose(toGlm(modelviewOf(leaf))) * eyePlane);
    if (!box.valid() || !plane) return false;
    const double top = topOver(*plane, leaf, SurfaceHeights(*leaf._drawable, *plane, mostOfAFloor).top);
    return std::abs(top) <= unevenness * 2.0 * box.radius();
}

/// Leaves of one state follow each other.
bool hasOffsets(const std::vector<const osgUtil::RenderLeaf*>& leaves) {
    const osgUtil::StateGraph* known = nullptr;
    return std::any_of(leaves.begin(), leaves.end(), [&](const osgUtil::RenderLeaf* leaf) {
        return leaf->_parent != known && polygonOffsetOf(known = leaf->_parent) != osg::Vec2d();
    });
}

/// What lies in the plane is looked for where polygon offsets move it to.
void followOffsets(PlanarMark& mark, const ViewFrame& view) {
    if (!hasOffsets(view.seen)) return;
    bool found = false;
    for (const osgUtil::RenderLeaf* leaf : view.seen) {
        if (!liesIn(*leaf, mark.eyePlane)) continue;
        const osg::Vec2d given = polygonOffsetOf(leaf->_parent);
        const glm::dvec2 offset(given.x(), given.y());
        mark.nearestOffset = found ? glm::min(mark.nearestOffset, offset) : offset;
        mark.farthestOffset = found ? glm::max(mark.farthestOffset, offset) : offset;
        found = true;
    }
}

/// True if the view turns round the sense in which a triangle's corners follow each other on the screen.
bool isMirrored(const ViewFrame& view) {
    return glm::determinant(glm::dmat3(toGlm(view.eyeFromGroup))) * view.projection(0, 0) * view.projection(1, 1) < 0.0;
}

bool receiverLiesIn(const ViewFrame& view, const glm::dvec4& eyePlane) {
    if (!view.receivers) return false;
    return std::all_of(view.receivers->begin(), view.receivers->end(),
                       [&](const osgUtil::RenderLeaf* leaf) { return liesIn(*leaf, eyePlane); });
}

/// Height above the plane from which on PlanarClipPlanes::belowLight cuts; infinite for a sun.
double heightLimit(const PlanarClipPlanes& clip, const glm::dvec4& plane) {
    const glm::dvec3 normal(plane);
    const double fall = -glm::dot(glm::dvec3(clip.belowLight), normal);
    const double onPlane = glm::dot(clip.belowLight, glm::dvec4(-plane.w * normal, 1.0));
    return fall > 0.0 ? onPlane / fall : std::numeric_limits<double>::infinity();
}

/// Where on the screen the flattened casters can lie.
std::optional<ScreenRect> screenBoundsOf(const PlanarMark& mark) {
    std::vector<glm::dvec4> halfSpaces;
    if (mark.casters->crosses) halfSpaces.push_back(mark.abovePlane);
    if (mark.reachesLight) halfSpaces.push_back(mark.belowLight);
    std::vector<glm::dvec4> corners;
    for (const glm::dvec3& corner : cutBox(mark.casters->low, mark.casters->high, halfSpaces))
        corners.push_back(mark.clipFromScene * glm::dvec4(corner, 1.0));
    return screenBounds(corners);
}

} // namespace

PlanarShadowNode::PlanarShadowNode() : _programs(new PlanarPrograms), _casters(new PlanarCasterCache) {}

PlanarShadowNode::PlanarShadowNode(const osg::Vec4d& plane) : PlanarShadowNode() { addPlane(plane); }

PlanarShadowNode::PlanarShadowNode(const PlanarShadowNode& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp),
      _planes(other._planes),
      _options(other._options),
      _programs(new PlanarPrograms),
      _casters(new PlanarCasterCache) {}

PlanarShadowNode::~PlanarShadowNode() = default;

void PlanarShadowNode::addPlane(const osg::Vec4d& plane) { _planes.push_back(plane); }

void PlanarShadowNode::setPlanes(const std::vector<osg::Vec4d>& planes) { _planes = planes; }

std::vector<osg::ref_ptr<Mark>> PlanarShadowNode::prepare(const ViewFrame& view, const ShadowLight& light,
                                                          const Casters& casters) const {
    std::vector<osg::ref_ptr<Mark>> marks;
    std::vector<osg::Vec4d> idle;                // planes that no caster is above
    const std::size_t most = 4 * _planes.size(); // meshes: of two groups, or of views of different levels of detail
    if (_planes.empty()) report(view.frameNumber, "no plane is set, so there is no shadow. Set one with addPlane().");
    for (unsigned i = 0; i < _planes.size(); ++i) {
        const auto plane = transformedPlane(toGlm(view.groupFromTechnique), toGlm(_planes[i]));
        if (!plane) {
            report(view.frameNumber,
                   sentence("the normal of the plane", _planes[i],
                            "is zero or not a number. Give (a, b, c, d) of the plane a x + b y + c z + d = 0."));
            continue;
        }
        const osg::ref_ptr<PlanarCasters> above = _casters->of(casters, *plane, view.frameNumber, most);
        if (above->parts.empty())
            idle.push_back(_planes[i]);
        else if (osg::ref_ptr<Mark> mark = prepareOne(view, light, *above, i, *plane))
            marks.push_back(mark);
    }
    if (idle.size() < _planes.size()) return marks; // as of the sides of a floor that is a box
    for (const osg::Vec4d& plane : idle)
        report(view.frameNumber, sentence("no caster is above the plane", plane,
                                          "on the side of its normal. Check where the plane lies and which way its "
                                          "normal points."));
    return marks;
}

osg::ref_ptr<Mark> PlanarShadowNode::prepareOne(const ViewFrame& view, const ShadowLight& light,
                                                const PlanarCasters& casters, unsigned index,
                                                const glm::dvec4& groupPlane) const {
    const auto refuse = [&](const char* start, const osg::Vec4d& what, const char* rest) {
        report(view.frameNumber, sentence(start, what, rest));
        return nullptr;
    };
    if (!isFinite(toGlm(light.inGroup)))
        return refuse("the light at", light.inGroup, "has a coordinate that is not finite. Set the light's position.");
    const SceneFrame scene(casters.origin);
    const glm::dvec4 lightHere(glm::dvec3(toGlm(light.inGroup)) - light.inGroup.w() * scene.origin, light.inGroup.w());
    const auto flatten = planarShadowMatrix(casters.plane, lightHere);
    if (!flatten)
        return refuse("the light at", light.inGroup,
                      "lies in the plane or behind it, so there is no shadow. Move the light to the side that the "
                      "plane's normal points to.");
    const glm::dmat4 clipFromScene = scene.clipFromScene(view);
    if (!(glm::dot(casters.plane, eyeIn(clipFromScene)) > 0.0))
        return refuse("the camera is behind the plane", _planes[index],
                      "and sees the side that the light does not reach. If that side is the lit one, reverse the "
                      "plane's normal.");

    osg::ref_ptr<PlanarMark> mark = new PlanarMark;
    const PlanarClipPlanes clip = planarClipPlanes(casters.plane, lightHere);
    mark->casters = &casters;
    mark->programs = _programs;
    mark->isSmooth = _options.edges == SMOOTH;
    mark->clipFromScene = clipFromScene * *flatten;
    mark->abovePlane = clip.abovePlane;
    mark->belowLight = clip.belowLight;
    mark->reachesLight = heightLimit(clip, casters.plane) < casters.highest;
    mark->mirrored = isMirrored(view);
    const auto eyePlane = transformedPlane(toGlm(view.eyeFromGroup), groupPlane);
    const auto bounds = screenBoundsOf(*mark);
    const auto depthAt = [&](double height) {
        return depthOnScreen(casters.plane - glm::dvec4(0.0, 0.0, 0.0, height), clipFromScene);
    };
    const auto depth = depthAt(0.0);
    if (!bounds || !depth || !eyePlane) return nullptr; // out of sight: nothing to say
    mark->eyePlane = *eyePlane;
    mark->cutToPlane = !receiverLiesIn(view, *eyePlane);
    mark->depthSteps = mark->cutToPlane ? PlanarMark::tolerance.y : 0.0; // so far off the plane is what may lie in it
    if (mark->cutToPlane) followOffsets(*mark, view);
    mark->screenBounds = *bounds;
    mark->depth = *depth;
    mark->nearest = depthAt(casters.lying.y).value_or(*depth);
    mark->farthest = depthAt(casters.lying.x).value_or(*depth);
    return mark;
}

bool PlanarShadowNode::shadowsSurface(const ViewFrame& view, const osgUtil::RenderLeaf& leaf) const {
    return std::any_of(_planes.begin(), _planes.end(), [&](const osg::Vec4d& given) {
        const auto plane = transformedPlane(toGlm(view.eyeFromGroup) * toGlm(view.groupFromTechnique), toGlm(given));
        return plane && endsIn(leaf, *plane);
    });
}

/// Of a named receiver all that faces the light's side is looked at; else what ends close to the plane.
std::string PlanarShadowNode::flawOn(const ViewFrame& view, const osgUtil::RenderLeaf& leaf) const {
    const osg::BoundingBox& box = leaf._drawable->getBoundingBox();
    std::string flaw;
    for (const osg::Vec4d& given : _planes) {
        const auto inEye = transformedPlane(toGlm(view.eyeFromGroup) * toGlm(view.groupFromTechnique), toGlm(given));
        if (!inEye || !box.valid()) continue;
        const glm::dvec4 inLeaf = glm::transpose(toGlm(modelviewOf(leaf))) * *inEye;
        const auto plane = normalizedPlane(inLeaf);
        if (!plane) continue;
        const SurfaceHeights heights(*leaf._drawable, *plane, hasReceiver() ? 100000 : mostOfAFloor);
        const double top = topOver(*plane, leaf, heights.top), most = flatness * box.radius();
        const double farthest = hasReceiver() ? heights.farthest : 0.0;
        const auto say = [&](double height, const char* what) {
            std::ostringstream text;
            text << "'" << nameOf(leaf) << "' is " << std::abs(height) * glm::length(glm::dvec3(inLeaf))
                 << (height > 0.0 ? " above" : " below") << " the plane (" << given << ")" << what;
            return text.str();
        };
        const bool isClose = std::abs(top) <= unevenness * 2.0 * box.radius();
        if (isClose && std::abs(top) <= most && std::abs(farthest) <= most) return {};
        if (isClose && std::abs(top) <= most)
            flaw = say(farthest, " in places, which get no shadow or a wrong one. Use map, volume or traced for it.");
        else if (isClose || (hasReceiver() && !heights.anyTriangle))
            flaw =
                say(top,
                    ", too far to be taken for it, so its shadow is missing or wrong. Give the plane that it lies in.");
    }
    return flaw;
}

/// A ray from the foot of the point in the plane, lifted off it: what lies in the plane never casts.
bool PlanarShadowNode::isLit(const ShadowProbe& probe, const glm::dvec3& point) const {
    const auto shadows = [&](const osg::Vec4d& given) {
        const auto inGroup = transformedPlane(toGlm(probe.groupFromTechnique), toGlm(given));
        if (!inGroup) return false;
        const glm::dvec4 plane = SceneFrame(probe.origin).plane(*inGroup);
        const glm::dvec3 normal(plane);
        const double height = distance(plane, point);
        if (!(std::abs(height) <= 1e-5 * probe.casters.reach())) return false;
        if (!planarShadowMatrix(plane, probe.light)) return false;
        return !probe.reaches(probe.casters.lifted(point - height * normal, normal));
    };
    return std::none_of(_planes.begin(), _planes.end(), shadows);
}

void PlanarShadowNode::letGo() const { _casters->letGo(); }

void PlanarShadowNode::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    for (const auto& program : {_programs->plain, _programs->clipping}) program->resizeGLObjectBuffers(maxSize);
    _programs->edges->resizeGLObjectBuffers(maxSize);
    _casters->resizeGLObjectBuffers(maxSize);
}

void PlanarShadowNode::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    for (const auto& program : {_programs->plain, _programs->clipping}) program->releaseGLObjects(state);
    _programs->edges->releaseGLObjects(state);
    _casters->releaseGLObjects(state);
}

} // namespace gnomon
