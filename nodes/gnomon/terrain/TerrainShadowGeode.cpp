// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/OptionalParts.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/LocalLight.h>
#include <gnomon/group/ShadowProbe.h>
#include <gnomon/terrain/TerrainMark.h>
#include <gnomon/terrain/TerrainShadowCache.h>

#include <osg/Notify>

namespace gnomon {
TerrainShadowGeode::TerrainShadowGeode()
    : _program(shaderProgram("#define EXTRUDE\n")), _cache(new TerrainShadowCache) {}

TerrainShadowGeode::TerrainShadowGeode(const TerrainShadowGeode& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp),
      _options(other._options),
      _program(shaderProgram("#define EXTRUDE\n")),
      _cache(new TerrainShadowCache) {}

TerrainShadowGeode::~TerrainShadowGeode() = default;

void TerrainShadowGeode::setMethod(Method method) {
    const bool isKnown = method == BOX || method == HULL;
    _options.method = isKnown ? method : TerrainShadowOptions().method;
    if (!isKnown)
        OSG_WARN << "gnomon: " << describe()
                 << ": there is no method DRAPE any more, so hull takes its place. Use hull on "
                 << "terrain, or map or traced if other surfaces receive." << std::endl;
}

std::string TerrainShadowGeode::whyUnavailable() const {
    return getMethod() == BOX ? "" : whyMissing(OptionalPart::Terrain);
}

unsigned TerrainShadowGeode::builds() const { return _cache->found(); }

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
                      *usable, getMethod() == BOX);
    for (const std::string& cause : frame.causes) report(view.frameNumber, cause);
    const TileView seen(view, frame.origin);
    osg::ref_ptr<TerrainMark> mark = new TerrainMark;
    mark->program = _program;
    mark->clipFromScene = seen.clipFromScene();
    mark->sceneFromEye = SceneFrame(frame.origin).sceneFromEye(view);
    mark->testsBoxes = view.options.filter;
    for (const auto& shadows : frame.tiles) {
        const TileView::Shown shown = shadows ? seen.shown(shadows->solids) : TileView::Shown();
        if (!shown.bounds) continue;
        mark->screenBounds = mark->tiles.empty() ? *shown.bounds : united(mark->screenBounds, *shown.bounds);
        const bool follows = getMethod() == HULL && usable->w == 0.0;
        mark->tiles.push_back(
            {shadows, follows ? *usable : shadows->solids.light, frame.fromAbove && shown.isBeforeEye});
    }
    if (mark->tiles.empty()) return {}; // out of sight: nothing to say
    return {mark};
}

osg::ref_ptr<const osg::Referenced> TerrainShadowGeode::answersFor(const ShadowProbe& probe) const {
    if (!hasReceiver()) return nullptr;
    const glm::dvec4 light(glm::dvec3(probe.light) + probe.light.w * toGlm(probe.origin), probe.light.w);
    return _cache->answer(probe.group, *probe.group.drawables(), TerrainPlace::inFrameOf(probe.group, getReceiver()),
                          light, getMethod() == BOX);
}

bool TerrainShadowGeode::isLit(const ShadowProbe& probe, const glm::dvec3& point) const {
    const auto* answer = static_cast<const TerrainAnswer*>(probe.answers.get());
    if (!answer) return true;
    const glm::dvec3 place = point + toGlm(probe.origin);
    const double near = 1e-5 * probe.casters.reach();
    const auto under = answer->drawn->ground->hit(place + glm::dvec3(0.0, 0.0, near), {0.0, 0.0, -1.0});
    return !under || place.z - under->z > near || !answer->holds(place);
}

void TerrainShadowGeode::letGo() const { _cache->letGo(); }

void TerrainShadowGeode::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _program->resizeGLObjectBuffers(maxSize);
    _cache->resizeGLObjectBuffers(maxSize);
}

void TerrainShadowGeode::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _program->releaseGLObjects(state);
    _cache->releaseGLObjects(state);
}

} // namespace gnomon
