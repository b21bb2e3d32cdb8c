// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/compositor/ReplaySelection.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/LocalLight.h>
#include <gnomon/group/ShadowProbe.h>
#include <gnomon/terrain/LoneObjectShadow.h>
#include <gnomon/terrain/PlanCoverage.h>
#include <gnomon/terrain/TerrainMark.h>
#include <gnomon/terrain/TerrainShadowCache.h>
#include <gnomon/terrain/TileVisibility.h>

#include <glm/common.hpp>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/Notify>
#include <osg/PolygonOffset>
#include <osg/io_utils>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>
#include <ostream>

namespace gnomon {
namespace {

const char* nameOf(TerrainShadowGeode::Method method) {
    return method == TerrainShadowGeode::BOX ? "BOX" : method == TerrainShadowGeode::DRAPE ? "DRAPE" : "HULL";
}

/// Adds those tiles that can be seen. @return where they are.
std::optional<ScreenRect> addSeen(const TerrainFrame& frame, const TileVisibility& view, TerrainMark& mark) {
    std::optional<ScreenRect> all;
    const auto add = [&](const TileShadows& tile, const TileMesh& mesh, const auto& take) {
        const auto seen = view.seen(mesh, tile);
        if (!seen) return;
        take();
        if (mark.tiles.empty() || mark.tiles.back() != &tile) mark.tiles.push_back(&tile);
        all = all ? united(*all, *seen) : *seen;
    };
    for (std::size_t i = 0; i < frame.tiles.size(); ++i) {
        const TileShadows& tile = *frame.tiles[i];
        add(tile, *tile.decals, [&] { mark.decals.push_back({tile.decals, frame.bitmaps[i]}); });
        add(tile, *tile.prisms, [&] { mark.prisms.push_back(tile.prisms); });
    }
    return all;
}

std::shared_ptr<const PlanCoverage> coverageOf(const TerrainMark& mark) {
    std::vector<PlanCoverage::Rect> rectangles;
    std::vector<const TileMesh*> meshes = mark.prisms;
    for (const SeenDecals& seen : mark.decals) meshes.push_back(seen.mesh);
    for (const TileMesh* mesh : meshes) {
        const glm::dvec2 low(mesh->low), high(mesh->high);
        const glm::dvec2 rounding = 1e-6 * glm::max(glm::abs(low), glm::abs(high)); // of prisms in single precision
        rectangles.push_back({low - rounding, high + rounding});
    }
    return std::make_shared<PlanCoverage>(rectangles);
}

/// How much of the depth in clip space takes a point a pixel's length nearer to the eye, on the same pixel: far more than
/// what floats leave of places, and so little that of what a crest hides not half a pixel is taken for the crest.
double aPixelNearer(const osg::Matrixd& projection, const osg::Vec2d& pixels) {
    const glm::dmat4 clipFromEye = toGlm(projection);
    const glm::dvec4 eye = eyeIn(clipFromEye); // adding it to a point takes 1 off the depth and nothing off the rest
    double pixel = 0.0;                        // its length where w is 1
    for (int i = 0; i < 2; ++i)
        pixel = std::max(pixel, 2.0 / (pixels[i] * glm::length(glm::dvec3(glm::row(clipFromEye, i)))));
    return pixel / (eye.w != 0.0 ? std::abs(eye.w) : glm::length(glm::dvec3(eye)));
}

/// Black of half opacity, as published; drawn before the ground that it lies on.
osg::ref_ptr<osg::Geometry> transparent(const std::vector<osg::Vec3d>& triangles) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    for (const osg::Vec3d& corner : triangles) vertices->push_back(osg::Vec3(corner));
    geometry->setVertexArray(vertices);
    osg::ref_ptr<osg::Vec3Array> normal = new osg::Vec3Array;
    normal->push_back({0.0f, 0.0f, 1.0f});
    geometry->setNormalArray(normal, osg::Array::BIND_OVERALL);
    osg::ref_ptr<osg::Vec4Array> colour = new osg::Vec4Array;
    colour->push_back({0.0f, 0.0f, 0.0f, 0.5f});
    geometry->setColorArray(colour, osg::Array::BIND_OVERALL);
    geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices->size())));
    osg::StateSet& state = *geometry->getOrCreateStateSet();
    state.setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED);
    state.setMode(GL_BLEND, osg::StateAttribute::ON);
    state.setTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::OFF | osg::StateAttribute::PROTECTED);
    state.setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
    state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    return geometry;
}

} // namespace

struct TerrainShadowGeode::Request {
    std::string refusal; ///< why there can be no shadow; empty: the rest holds.
    glm::dvec4 light{0.0};
    TerrainSettings settings;
    std::uint64_t object = 0; ///< revision of the placed object.
};

TerrainShadowGeode::TerrainShadowGeode()
    : _program(shaderProgram()), _bitmapProgram(TileBitmap::program()), _cache(new TerrainShadowCache) {}

TerrainShadowGeode::TerrainShadowGeode(const TerrainShadowGeode& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), // its geometry, too
      _options(other._options),
      _object(other._object),
      _position(other._position),
      _heading(other._heading),
      _bounds(other._bounds),
      _triangles(other._triangles),
      _program(shaderProgram()),
      _bitmapProgram(TileBitmap::program()),
      _cache(new TerrainShadowCache) {}

TerrainShadowGeode::~TerrainShadowGeode() = default;

void TerrainShadowGeode::setOptions(const TerrainShadowOptions& options) {
    setMethod(options.method);
    setError(options.error);
}

void TerrainShadowGeode::setMethod(Method method) {
    _options.method = method >= BOX && method <= DRAPE ? method : TerrainShadowOptions().method;
}

void TerrainShadowGeode::setError(double error) {
    if (error >= 0.0 && std::isfinite(error))
        _options.error = error;
    else
        OSG_WARN << "gnomon: " << describe() << ": an error of " << error
                 << " is refused. Give a length of 0 or more, in the scene's unit." << std::endl;
}

std::string TerrainShadowGeode::whyUnavailable() const {
    return getMethod() == BOX ? "" : whyMissing(OptionalPart::Terrain);
}

unsigned TerrainShadowGeode::builds() const { return _foundAlone + _cache->found(); }

std::vector<osg::ref_ptr<MarkJob>> TerrainShadowGeode::prepare(const ViewFrame& view, const ShadowLight& light,
                                                               const FrameCasters& casters) const {
    const auto refuse = [&](const std::string& cause) {
        report(view.frameNumber, cause);
        return std::vector<osg::ref_ptr<MarkJob>>();
    };
    if (!hasReceiver()) return refuse("no terrain is named, so there is no shadow. Name it with setReceiver().");
    const auto usable = localLight(light.inGroup, SceneFrame(osg::Vec3d()));
    if (!usable) return refuse("the light has no finite position or direction. Set the light's position.");
    const TerrainFrame frame =
        _cache->frame(view, casters.drawables(), TerrainPlace::inFrameOf(*view.group, getReceiver()), light.number,
                      *usable, _options);
    const auto inFront = [](const osgUtil::RenderLeaf* leaf) { return isPulledForward(leaf->_parent); };
    if (std::any_of(view.seen.begin(), view.seen.end(), inFront))
        report(view.frameNumber, "a polygon offset pulls the terrain in front of its shadow. Give a positive offset to "
                                 "what lies under it instead.");
    const TileVisibility seen(view, frame.origin);
    for (const std::string& cause : frame.causes) report(view.frameNumber, cause);
    osg::ref_ptr<TerrainMark> mark = new TerrainMark;
    mark->program = _program;
    mark->bitmapProgram = _bitmapProgram;
    mark->clipFromScene = seen.clipFromScene();
    mark->decalsNearer = aPixelNearer(view.projection, view.pixels);
    mark->fromAbove = frame.fromAbove && view.options.filter;
    mark->sceneFromEye = SceneFrame(frame.origin).sceneFromEye(view);
    const auto bounds = addSeen(frame, seen, *mark);
    if (!bounds) return {}; // out of sight: nothing to say
    mark->screenBounds = *bounds;
    mark->coverage = view.options.filter ? coverageOf(*mark) : nullptr;
    return {mark};
}

osg::ref_ptr<const osg::Referenced> TerrainShadowGeode::answersFor(const ShadowProbe& probe) const {
    if (!hasReceiver()) return nullptr;
    const glm::dvec4 light(glm::dvec3(probe.light) + probe.light.w * toGlm(probe.origin), probe.light.w);
    return _cache->answer(probe.group, *probe.group.drawables(), TerrainPlace::inFrameOf(probe.group, getReceiver()),
                          light, _options);
}

bool TerrainShadowGeode::isLit(const ShadowProbe& probe, const glm::dvec3& point) const {
    const auto* answer = static_cast<const TerrainAnswer*>(probe.answers.get());
    if (!answer) return true;
    const glm::dvec3 place = point + toGlm(probe.origin);
    const auto height = answer->drawn->ground->height(place.x, place.y);
    if (!height || !(std::abs(place.z - *height) <= 1e-5 * probe.casters.reach())) return true;
    return !answer->covers(glm::dvec2(place));
}

/// With no group above it is what it holds: plain geometry.
void TerrainShadowGeode::traverse(osg::NodeVisitor& visitor) {
    osgUtil::CullVisitor* cull = visitor.asCullVisitor();
    const bool plain = cull && _object && !hasGroupAbove(*cull);
    if (cull && !plain)
        enlist(*cull);
    else
        osg::Geode::traverse(visitor);
}

osg::ref_ptr<osg::Node> TerrainShadowGeode::placedObject() const {
    osg::ref_ptr<osg::MatrixTransform> placed = new osg::MatrixTransform(
        osg::Matrixd::rotate(osg::DegreesToRadians(_heading), osg::Z_AXIS) * osg::Matrixd::translate(_position));
    if (_object) placed->addChild(_object);
    return placed;
}

/// In its own frame, with no group above.
TerrainPlace TerrainShadowGeode::terrain() const {
    return {*getReceiver().node, {nullptr, getReceiver().mask}, osg::Matrixd::identity()};
}

/// What compute() finds its shadow from, or why that cannot be.
TerrainShadowGeode::Request TerrainShadowGeode::requestFor(const osg::Vec4d& light) const {
    Request result;
    const auto usable = localLight(light, SceneFrame(osg::Vec3d()));
    if (!_object) result.refusal = "no object is set, so there is no shadow. Set one with setObjectGraphic().";
    if (!getReceiver().node) result.refusal = "no terrain is named, so there is no shadow. Name it with setReceiver().";
    if (isReceiverGone())
        result.refusal = "the terrain given to setReceiver() is gone, because nothing else kept it. Add it to the "
                         "scene, and name it anew.";
    if (!usable) result.refusal = "the light has no finite position or direction. Give one of them.";
    if (const std::string why = whyUnavailable(); !why.empty()) result.refusal = "there is no shadow. " + why;
    if (!result.refusal.empty()) return result;
    osg::BoundingBoxd box = _bounds;
    if (box.valid()) box._min += _position, box._max += _position;
    const osg::ref_ptr<osg::Node> object = placedObject();
    result.light = *usable;
    result.settings = TerrainSettings(_options, box);
    result.object = TerrainPlace{*object, Selection(), osg::Matrixd::identity()}.revision();
    return result;
}

bool TerrainShadowGeode::compute(const osg::Vec4d& light) { return compute(requestFor(light)); }

bool TerrainShadowGeode::compute(const Request& with) {
    beginFrame(0, 0.0, this);
    _triangles.clear();
    removeDrawables(0, getNumDrawables());
    if (!with.refusal.empty()) {
        report(0, with.refusal);
        return false;
    }
    const auto shadows = TerrainShadows::of(*meshOf(with.object), terrain(), with.light, with.settings, _shown);
    _foundAlone += shadows == _shown ? 0 : 1;
    _shown = shadows;
    _shownObject = with.object;
    for (const std::string& cause : _shown->causes) report(0, cause);
    show();
    if (_triangles.empty() && _shown->causes.empty())
        report(0, "there is no shadow, because the object lies in the ground or the light meets it edge on. Raise the "
                  "object, or move the light.");
    return !_triangles.empty();
}

/// The one it has, while the object is as it was.
osg::ref_ptr<const CasterMesh> TerrainShadowGeode::meshOf(std::uint64_t object) const {
    if (_shown && _shownObject == object) return _shown->scene->mesh;
    CasterExtraction traverser;
    placedObject()->accept(traverser);
    return new CasterMesh(traverser);
}

bool TerrainShadowGeode::update(const osg::Vec4d& light) {
    const Request with = requestFor(light);
    const bool same = with.refusal.empty() && _shown && getNumDrawables() > 0 && _shown->light == with.light &&
                      _shown->settings == with.settings && _shownObject == with.object &&
                      _shown->scene->drawn->revision == terrain().revision();
    return same || compute(with);
}

void TerrainShadowGeode::show() {
    for (const Drape& shadow : _shown->shadows)
        for (const glm::dvec3& corner : shadow) _triangles.emplace_back(corner.x, corner.y, corner.z);
    if (!_triangles.empty()) addDrawable(transparent(_triangles));
}

void TerrainShadowGeode::print(std::ostream& out) const {
    out << describe() << ": " << nameOf(_options.method) << ", error " << _options.error << "\n";
    out << "  object at " << _position << ", heading " << _heading << " degrees\n";
    if (_shown)
        out << "  light " << osg::Vec4d(_shown->light.x, _shown->light.y, _shown->light.z, _shown->light.w) << "\n";
    out << "  " << _triangles.size() / 3 << " triangles\n";
    for (std::size_t i = 0; i + 2 < _triangles.size(); i += 3)
        out << "    (" << _triangles[i] << ") (" << _triangles[i + 1] << ") (" << _triangles[i + 2] << ")\n";
}

void TerrainShadowGeode::letGo() const { _cache->letGo(); }

void TerrainShadowGeode::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _program->resizeGLObjectBuffers(maxSize);
    _bitmapProgram->resizeGLObjectBuffers(maxSize);
    _cache->resizeGLObjectBuffers(maxSize);
}

void TerrainShadowGeode::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _program->releaseGLObjects(state);
    _bitmapProgram->releaseGLObjects(state);
    _cache->releaseGLObjects(state);
}

} // namespace gnomon
