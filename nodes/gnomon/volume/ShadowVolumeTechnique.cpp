// SPDX-License-Identifier: MIT
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/GlState.h>
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/volume/VolumeCache.h>

#include <glm/common.hpp>

namespace gnomon {
namespace {

/// Marks of one light in one view: what is in a volume.
class VolumeMark : public Mark {
public:
    std::shared_ptr<const SeenVolumes> volumes; ///< never null.
    osg::ref_ptr<const osg::StateSet> program;
    osg::ref_ptr<const MarkEdges> smooth; ///< null: edges are hard.
    glm::dvec2 pushedBack{0.0};           ///< see ViewFrame.

    Kind kind() const override { return Kind::Counts; }
    std::string draw(ScreenPass& pass) const override;
    const MarkEdges* edges() const override { return smooth.get(); }
    void drawEdges(ScreenPass& pass) const override;
    void drawDebugView(ScreenPass& pass, int before) const override;

protected:
    ~VolumeMark() override = default;

private:
    void count(ScreenPass& pass, unsigned counters, const MeshInView& mesh, const VolumeRound::Share& share) const;
    void uncountBacks(ScreenPass& pass, unsigned counters, const MeshInView& mesh,
                      const VolumeRound::Share& share) const;
};

void place(const osg::State& state, const MeshInView& mesh) {
    placeVolumes(state, mesh.clipFromMesh, mesh.volumes->volumes().light);
}

/// Of a light cap from its surface, which OpenGL draws by other numbers: pixels of the slope, and steps of the depth buffer.
/// Drivers snap vertices to a 256th of a pixel. A larger part of it would reach what is close on either side of a surface: the
/// ground behind a culled face, the outer face of a wall, or the lit side of a ridge.
constexpr glm::dvec2 apart(1.0 / 64.0, 8.0);

/// A side in the plane of a face that the light grazes may lie in another body's wall, too. It is behind that as a whole, for rays
/// that begin before the wall do not meet it; and so are the sides that end in the wall. No other sides are: where a wall is turned
/// away by a degree, they are close before it. By no more than rounding, for shadows' edges move with them.
constexpr glm::dvec2 grazed(1.0 / 64.0, 2.0);

/// @param by  pixels of the slope, and steps of the depth buffer.
void drawOffset(osg::RenderInfo& renderInfo, const VolumeGeometry& geometry,
                const std::vector<VolumeGeometry::Range>& ranges, const glm::dvec2& by) {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(static_cast<GLfloat>(by.x), static_cast<GLfloat>(by.y));
    geometry.draw(renderInfo, ranges);
    glPolygonOffset(0.0f, 0.0f);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

void drawSides(osg::RenderInfo& renderInfo, const VolumeGeometry& sides, const VolumeRound::Sides& ranges) {
    sides.draw(renderInfo, ranges.usual);
    if (!ranges.grazed.empty()) drawOffset(renderInfo, sides, ranges.grazed, grazed);
}

/// Where nothing stands.
void unmarkFar(ScreenPass& pass, unsigned bit) {
    pass.stencilEqual(0, 0, bit);
    pass.testDepth(GL_LEQUAL);
    pass.drawQuad(1.0);
}

constexpr const char* overflow =
    "a connected caster may lie over itself more often than the stencil bits can count, so its shadow may have holes. "
    "Leave more bits out of CompositorOptions::reservedStencilBits, or use map for that caster.";

/// A light cap lies in the surface that casts, which is as lit as its light's side: so it is behind that from there, and
/// before it from the other side. A dark cap is where it is, close before the lowest surface for an eye below all. A rim is
/// behind the surface that casts, but may be seen beside it.
void VolumeMark::count(ScreenPass& pass, unsigned counters, const MeshInView& mesh,
                       const VolumeRound::Share& share) const {
    place(pass.state(), mesh);
    const glm::dvec2 back = glm::max(pushedBack, 0.0) + apart, forward = glm::min(pushedBack, 0.0) - apart;
    pass.countEntered(counters);
    drawSides(pass.renderInfo(), mesh.volumes->sides(), share.entered);
    if (!share.rims.empty()) {
        glEnable(GL_CULL_FACE);
        drawOffset(pass.renderInfo(), *mesh.caps, share.rims, back);
        glDisable(GL_CULL_FACE);
    }
    if (share.lightCaps.empty() && share.bothCaps.empty()) return;
    pass.countHolding(counters);
    drawSides(pass.renderInfo(), mesh.volumes->sides(), share.left);
    mesh.caps->draw(pass.renderInfo(), share.darkCaps);
    if (!share.lightCaps.empty()) drawOffset(pass.renderInfo(), *mesh.caps, share.lightCaps, back);
    if (share.bothCaps.empty()) return;
    glEnable(GL_CULL_FACE);
    drawOffset(pass.renderInfo(), *mesh.caps, share.bothCaps, back);
    glCullFace(GL_FRONT);
    drawOffset(pass.renderInfo(), *mesh.caps, share.bothCaps, forward);
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
}

/// A sheet does not shadow its own back, which OpenGL lights as its front: where that is seen, its volume does not count.
void VolumeMark::uncountBacks(ScreenPass& pass, unsigned counters, const MeshInView& mesh,
                              const VolumeRound::Share& share) const {
    if (share.backs.empty()) return;
    place(pass.state(), mesh);
    pass.uncount(counters);
    glDisable(depthClamp); // what is cut away before the near plane is not seen
    glEnable(GL_CULL_FACE);
    glCullFace(GL_FRONT);
    drawOffset(pass.renderInfo(), *mesh.caps, share.backs, glm::min(pushedBack, 0.0) - apart);
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
    glEnable(depthClamp);
}

/// One bit tells odd from even.
unsigned capacityOf(const ScreenPass& pass) { return pass.counters() & 1u ? pass.counters() : 1u; }

std::string VolumeMark::draw(ScreenPass& pass) const {
    osg::State& state = pass.state();
    const unsigned bit = pass.bit();
    const unsigned counters = pass.counters() ? pass.counters() : bit;
    const std::shared_ptr<const SeenVolumes::Counted> counted = volumes->countedBy(capacityOf(pass));
    if (!pass.counters() && counted->rounds.size() > 1) return noCounter;
    for (const VolumeRound& round : counted->rounds) {
        if (round.holding) { // what all pixels begin with
            glDisable(GL_DEPTH_TEST);
            pass.stencilEqual(static_cast<unsigned>(round.holding), 0, counters);
            pass.drawQuad();
        }
        state.apply(program.get());
        if (!hasProgram(state)) return noProgram;
        for (const auto& [mesh, share] : round.shares) count(pass, counters, volumes->meshes[mesh], share);
        for (const auto& [mesh, share] : round.shares) uncountBacks(pass, counters, volumes->meshes[mesh], share);
        glFrontFace(GL_CCW);
        state.apply();
        if (pass.counters())
            pass.takeCount(counters, bit);
        else
            unmarkFar(pass, bit);
    }
    return counted->overflow ? overflow : "";
}

void VolumeMark::drawEdges(ScreenPass& pass) const {
    for (const VolumeRound& round : volumes->countedBy(capacityOf(pass))->rounds)
        for (const auto& [mesh, share] : round.shares) {
            const MeshInView& seen = volumes->meshes[mesh];
            place(pass.state(), seen);
            for (const VolumeRound::Sides* sides : {&share.entered, &share.left}) {
                seen.volumes->sides().draw(pass.renderInfo(), sides->usual);
                seen.volumes->sides().draw(pass.renderInfo(), sides->grazed);
            }
        }
}

void VolumeMark::drawDebugView(ScreenPass& pass, int) const {
    osg::State& state = pass.state();
    state.apply(program.get());
    if (!hasProgram(state)) return;
    pass.beginReplace();
    pass.testDepth(GL_LEQUAL, false);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    for (const VolumeRound& round : volumes->rounds(~0u))
        for (const auto& [mesh, share] : round.shares) {
            place(state, volumes->meshes[mesh]);
            setUniform(state, "wire", glm::dvec4(1.0, 0.85, 0.0, 1.0));
            drawSides(pass.renderInfo(), volumes->meshes[mesh].volumes->sides(), share.entered);
            setUniform(state, "wire", glm::dvec4(1.0, 0.2, 0.1, 1.0));
            drawSides(pass.renderInfo(), volumes->meshes[mesh].volumes->sides(), share.left);
        }
    glFrontFace(GL_CCW);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    state.apply();
}

constexpr double mostOff = 1.0; // pixels
constexpr const char* coarse = "casters are so far from one another, or so far from the origin of their vertices, that "
                               "floats place those near the eye only to "
                               "more than a pixel. Leave what is far away out of the casters, give it a group of its "
                               "own, or put the offset into a transform.";

} // namespace

ShadowVolumeOptions ShadowVolumeOptions::usable() const {
    ShadowVolumeOptions usable;
    if (edges == SMOOTH) usable.edges = SMOOTH;
    if (view == VOLUMES) usable.view = VOLUMES;
    return usable;
}

ShadowVolumeTechnique::ShadowVolumeTechnique() : _cache(std::make_unique<VolumeCache>()) {}

ShadowVolumeTechnique::ShadowVolumeTechnique(const ShadowVolumeTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), _options(other._options), _cache(std::make_unique<VolumeCache>()) {}

ShadowVolumeTechnique::~ShadowVolumeTechnique() = default;

unsigned ShadowVolumeTechnique::builds() const { return _cache->builds(); }

std::vector<osg::ref_ptr<Mark>> ShadowVolumeTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                               const Casters& casters) const {
    const CasterLayers& layers = casters.layers();
    const SceneFrame scene(layers.origin);
    const auto usable = lightInScene(light.inGroup, scene);
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    const std::shared_ptr<const SeenVolumes> volumes = _cache->see(layers, view, light.number, *usable, scene);
    if (!volumes) return {}; // out of sight: nothing to say
    if (volumes->vertexStep * view.pixels.x() > mostOff) report(view.frameNumber, coarse);
    osg::ref_ptr<VolumeMark> mark = new VolumeMark;
    mark->volumes = volumes;
    mark->screenBounds = volumes->bounds;
    mark->program = _cache->program;
    if (_options.edges == SMOOTH) mark->smooth = _cache->edges;
    mark->pushedBack = {view.pushedBack.x(), view.pushedBack.y()};
    mark->hasDebugView = _options.view == VOLUMES;
    return {mark};
}

void ShadowVolumeTechnique::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _cache->resizeGLObjectBuffers(maxSize);
}

void ShadowVolumeTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _cache->release(state);
}

} // namespace gnomon
