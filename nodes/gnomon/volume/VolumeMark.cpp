// SPDX-License-Identifier: MIT
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/volume/VolumeMark.h>

#include <glm/gtc/matrix_access.hpp>
#include <glm/matrix.hpp>

#include <algorithm>

namespace gnomon {
namespace {

/// Where lines of sight are parallel, a triangle at infinity is beside all of them. A lamp's then ends far beyond all that
/// is seen: 10^7 times as far from it as the caster, which floats still hold.
double endlessIn(const glm::dmat4& clipFromMesh, const glm::dvec4& light) {
    const bool parallel = glm::dvec3(glm::row(clipFromMesh, 3)) == glm::dvec3(0.0);
    return parallel && light.w != 0.0 ? 1e7 : -1.0;
}

void place(osg::State& state, const glm::dmat4& clipFromMesh, const glm::dvec4& light) {
    setUniform(state, "clipFromVertex", clipFromMesh);
    setUniform(state, "light", light);
    setUniform(state, "endless", endlessIn(clipFromMesh, light));
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

} // namespace

/// A cap lies in the surface that casts, which is as lit as its light's side: so it is behind that, from wherever it is
/// seen. A whole pixel's slope, for OpenGL draws the two by different numbers.
void VolumeMark::drawCaps(osg::RenderInfo& renderInfo, const VolumeGeometry& caps,
                          const std::vector<VolumeGeometry::Range>& ranges) const {
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(static_cast<GLfloat>(1.0 + std::max(0.0, pushedBack.x())),
                    static_cast<GLfloat>(8.0 + std::max(0.0, pushedBack.y())));
    caps.draw(renderInfo, ranges);
    glPolygonOffset(0.0f, 0.0f);
    glDisable(GL_POLYGON_OFFSET_FILL);
}

void VolumeMark::count(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned counters, const MeshInView& mesh,
                       const VolumeRound::Share& share) const {
    osg::State& state = *renderInfo.getState();
    const glm::dvec4& light = mesh.volumes->volumes().light;
    glFrontFace(glm::determinant(mesh.clipFromMesh) > 0.0 ? GL_CW : GL_CCW); // clip space is left-handed
    place(state, mesh.clipFromMesh, light);
    if (!share.entered.empty()) {
        pass.countEntered(counters);
        mesh.volumes->sides().draw(renderInfo, share.entered);
    }
    if (!share.caps.empty()) {
        pass.countHolding(counters);
        mesh.volumes->sides().draw(renderInfo, share.left);
        drawCaps(renderInfo, *mesh.caps, share.caps);
    }
    glFrontFace(GL_CCW);
}

std::string VolumeMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    const unsigned counters = pass.counters() ? pass.counters() : bit;
    const unsigned capacity = counters & 1u ? counters : 1u; // one bit tells odd from even
    const std::vector<VolumeRound> rounds = seen.rounds(capacity);
    if (!pass.counters() && rounds.size() > 1) return noCounter;
    for (const VolumeRound& round : rounds) {
        if (round.holding) pass.setCount(counters, static_cast<unsigned>(round.holding));
        state.apply(program.get());
        if (!hasProgram(state)) return noProgram;
        for (const auto& [mesh, share] : round.shares) count(renderInfo, pass, counters, seen.meshes[mesh], share);
        state.apply();
        if (pass.counters())
            pass.takeCount(counters, bit);
        else
            unmarkFar(pass, bit);
    }
    return seen.overflow(capacity) ? overflow : "";
}

void VolumeMark::drawView(osg::RenderInfo& renderInfo, ScreenPass& pass, int) const {
    osg::State& state = *renderInfo.getState();
    state.apply(program.get());
    if (!hasProgram(state)) return;
    pass.beginReplace();
    pass.testDepth(GL_LEQUAL, false);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    for (const VolumeRound& round : seen.rounds(~0u))
        for (const auto& [mesh, share] : round.shares) {
            place(state, seen.meshes[mesh].clipFromMesh, seen.meshes[mesh].volumes->volumes().light);
            setUniform(state, "wire", glm::dvec4(1.0, 0.85, 0.0, 1.0));
            seen.meshes[mesh].volumes->sides().draw(renderInfo, share.entered);
            setUniform(state, "wire", glm::dvec4(1.0, 0.2, 0.1, 1.0));
            seen.meshes[mesh].volumes->sides().draw(renderInfo, share.left);
        }
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    state.apply();
}

} // namespace gnomon
