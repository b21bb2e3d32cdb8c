// SPDX-License-Identifier: MIT
#include <gnomon/gl/SavedFramebuffers.h>
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/overlay/StencilBatches.h>
#include <gnomon/terrain/PlanCoverage.h>
#include <gnomon/terrain/TerrainMark.h>

#include <algorithm>
#include <cmath>

namespace gnomon {

namespace {

/// A bitmap says one thing for all samples of a pixel, where polygons have smooth edges.
bool onePixelIsOneSample() { return glInteger(GL_SAMPLES) <= 1; }

} // namespace

/// One bit tells odd from even.
std::vector<std::vector<LayerSlice>> TerrainMark::roundsOf(unsigned counters) const {
    std::vector<PrismLayers> layers;
    for (const TileMesh* mesh : prisms)
        layers.push_back({glm::dvec2(mesh->low), glm::dvec2(mesh->high), mesh->layers(), mesh->mostOver});
    return stencilBatches(layers, counters & 1u ? counters : 1u);
}

/// Prisms go up and down far enough: what is beside them in plan is out of their reach.
MarkJob::BoxTest TerrainMark::boxTest(const osg::Matrixd& eyeFromBox) const {
    if (!coverage) return {};
    return [cover = coverage, toPlan = eyeFromBox * sceneFromEye](const osg::BoundingBox& box) {
        const osg::Vec3d middle = osg::Vec3d(box.center()) * toPlan,
                         half = (osg::Vec3d(box._max) - osg::Vec3d(box._min)) / 2.0;
        glm::dvec2 reach(0.0);
        for (int row = 0; row < 3; ++row)
            reach += half[row] * glm::dvec2(std::abs(toPlan(row, 0)), std::abs(toPlan(row, 1)));
        const glm::dvec2 at(middle.x(), middle.y());
        return cover->touches({at - reach, at + reach});
    };
}

/// Nearer by `decalsNearer`, and by some steps of the depth buffer, of which there are few to far distances.
glm::dmat4 TerrainMark::clipFromNearerScene() const {
    constexpr double steps = 4.0; // the ground's own depth, rounded, and what interpolation leaves of both
    GLint bits = 24;
    glGetIntegerv(GL_DEPTH_BITS, &bits);
    glm::dmat4 result = clipFromScene;
    result[3][2] -= decalsNearer;
    for (int column = 0; column < 4; ++column) result[column][2] -= steps * std::ldexp(2.0, -bits) * result[column][3];
    return result;
}

/// False without a program.
bool TerrainMark::drawBitmaps(osg::RenderInfo& renderInfo) const {
    std::vector<const TileBitmap*> bitmaps;
    for (const SeenDecals& seen : decals)
        if (seen.bitmap) bitmaps.push_back(seen.bitmap.get());
    if (bitmaps.empty()) return true;
    osg::State& state = *renderInfo.getState();
    state.apply(bitmapProgram.get());
    if (!hasProgram(state)) return false;
    setUniform(state, "clipFromVertex", clipFromNearerScene());
    setUniform(state, "sheet", 0);
    TileBitmap::draw(renderInfo, std::move(bitmaps));
    return true;
}

/// What lies on the ground is as deep as the ground is: so it is seen where the ground is, and hidden where the ground is.
/// What is cut off with the ground in front of the near plane must not be seen through the hole.
std::string TerrainMark::markDecals(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    state.apply(program.get());
    if (!hasProgram(state)) return noProgram;
    setUniform(state, "clipFromVertex", clipFromNearerScene());
    pass.testDepth(GL_LEQUAL, false);
    pass.stencilEqual(bit, 0, bit);
    if (fromAbove) glEnable(GL_CULL_FACE);
    const bool byBitmaps = onePixelIsOneSample();
    for (const SeenDecals& seen : decals)
        if (!(byBitmaps && seen.bitmap)) seen.mesh->draw(renderInfo, 0, 1);
    const bool isDrawn = !byBitmaps || drawBitmaps(renderInfo);
    glDisable(GL_CULL_FACE);
    state.apply();
    return isDrawn ? "" : noProgram;
}

std::string TerrainMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    const unsigned counters = pass.counters();
    const auto rounds = roundsOf(counters);
    if (!counters && rounds.size() > 1) return noCounter;
    for (const std::vector<LayerSlice>& round : rounds) {
        state.apply(program.get());
        if (!hasProgram(state)) return noProgram;
        setUniform(state, "clipFromVertex", clipFromScene);
        pass.countHolding(counters ? counters : bit);
        for (const LayerSlice& slice : round) prisms[slice.tile]->draw(renderInfo, slice.first, slice.count);
        state.apply();
        if (counters) pass.takeCount(counters, bit);
    }
    return decals.empty() ? "" : markDecals(renderInfo, pass, bit);
}

} // namespace gnomon
