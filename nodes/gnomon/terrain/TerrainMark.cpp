// SPDX-License-Identifier: MIT
#include <gnomon/gl/ScreenPass.h>
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/silhouette/StencilBatches.h>
#include <gnomon/terrain/TerrainMark.h>

#include <algorithm>
#include <cmath>

namespace gnomon {
namespace {

using Ranges = std::vector<VolumeGeometry::Range>;

/// Of layers, the ends of which are at these places. @param begin  of the first layer of all.
void append(const std::vector<unsigned>& ends, unsigned begin, const LayerSlice& slice, Ranges& ranges) {
    const unsigned first = slice.first > 0 ? ends[slice.first - 1] : begin,
                   count = ends[slice.first + slice.count - 1] - first;
    if (!ranges.empty() && ranges.back().first + ranges.back().count == first)
        ranges.back().count += count;
    else
        ranges.push_back({first, count});
}

} // namespace

/// Solids go up and down far enough: what is beside them in plan is out of their reach.
MarkJob::BoxTest TerrainMark::boxTest(const osg::Matrixd& eyeFromBox) const {
    if (!testsBoxes) return {};
    return [this, toScene = eyeFromBox * sceneFromEye](const osg::BoundingBox& box) {
        const osg::Vec3d middle = osg::Vec3d(box.center()) * toScene,
                         half = (osg::Vec3d(box._max) - osg::Vec3d(box._min)) / 2.0;
        glm::dvec2 reach(0.0);
        for (int row = 0; row < 3; ++row)
            reach += half[row] * glm::dvec2(std::abs(toScene(row, 0)), std::abs(toScene(row, 1)));
        const glm::dvec2 low = glm::dvec2(middle.x(), middle.y()) - reach, high = low + 2.0 * reach;
        return std::any_of(tiles.begin(), tiles.end(), [&](const Tile& tile) {
            const HullSolids& solids = tile.shadows->solids;
            return low.x <= solids.high.x && solids.low.x <= high.x && low.y <= solids.high.y && solids.low.y <= high.y;
        });
    };
}

/// One bit tells odd from even. From above, and from before all of a tile's solids, no line of sight to the ground meets their
/// ends, which are in the ground: then what is before it is counted, else what is behind it.
std::string TerrainMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    const unsigned counters = pass.counters();
    std::vector<PrismLayers> layers;
    for (const Tile& tile : tiles) {
        const HullSolids& solids = tile.shadows->solids;
        layers.push_back(
            {glm::dvec2(solids.low), glm::dvec2(solids.high), unsigned(solids.sides.size()), solids.mostOver});
    }
    const auto rounds = stencilBatches(layers, counters & 1u ? counters : 1u);
    if (!counters && rounds.size() > 1) return noCounter;
    for (const std::vector<LayerSlice>& round : rounds) {
        state.apply(program.get());
        if (!hasProgram(state)) return noProgram;
        for (const LayerSlice& slice : round) {
            const Tile& tile = tiles[slice.tile];
            const HullSolids& solids = tile.shadows->solids;
            Ranges ranges;
            append(solids.sides, 0, slice, ranges);
            placeVolumes(state, clipFromScene, tile.light);
            if (tile.endsAreUnseen)
                pass.countEntered(counters ? counters : bit);
            else {
                append(solids.ends, solids.sides.back(), slice, ranges);
                pass.countHolding(counters ? counters : bit);
            }
            tile.shadows->geometry->draw(renderInfo, ranges);
        }
        glFrontFace(GL_CCW);
        state.apply();
        if (counters) pass.takeCount(counters, bit);
    }
    return "";
}

} // namespace gnomon
