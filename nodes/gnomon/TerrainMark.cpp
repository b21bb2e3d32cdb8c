// SPDX-License-Identifier: MIT
#include <gnomon/IndexClusters.h>
#include <gnomon/MarkProgram.h>
#include <gnomon/PlanCoverage.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowPrisms.h>
#include <gnomon/StencilRounds.h>
#include <gnomon/TerrainMark.h>
#include <gnomon/TerrainTiles.h>

#include <cmath>

namespace gnomon {

TerrainPrisms::TerrainPrisms() : _geometry(new osg::Geometry) {
    _geometry->setUseDisplayList(false);
    _geometry->setUseVertexBufferObjects(true);
    _geometry->setVertexArray(new osg::Vec3Array);
    _geometry->addPrimitiveSet(new osg::DrawElementsUInt(GL_TRIANGLES));
}

void TerrainPrisms::set(const ShadowPrisms& prisms) {
    static_assert(sizeof(glm::vec3) == sizeof(osg::Vec3));
    auto& vertices = static_cast<osg::Vec3Array&>(*_geometry->getVertexArray());
    auto& corners = static_cast<osg::DrawElementsUInt&>(*_geometry->getPrimitiveSet(0));
    const auto* places = reinterpret_cast<const osg::Vec3*>(prisms.vertices.data());
    vertices.assign(places, places + prisms.vertices.size());
    corners.clear();
    _ends.clear();
    for (const std::vector<unsigned>& layer : prisms.layers) {
        corners.insert(corners.end(), layer.begin(), layer.end());
        _ends.push_back(static_cast<unsigned>(corners.size()));
    }
    vertices.dirty();
    corners.dirty();
    low = prisms.low;
    high = prisms.high;
    mostOver = prisms.mostOver;
}

void TerrainPrisms::draw(osg::RenderInfo& renderInfo, unsigned firstLayer, unsigned count) const {
    const unsigned first = firstLayer ? _ends[firstLayer - 1] : 0, end = _ends[firstLayer + count - 1];
    if (first == 0 && end == _ends.back())
        _geometry->draw(renderInfo);
    else
        IndexClusters::draw(renderInfo, *_geometry, {{0, first, end - first}});
}

/// One bit tells odd from even.
std::vector<std::vector<LayerSlice>> TerrainMark::roundsOf(unsigned counters) const {
    std::vector<PrismLayers> layers;
    for (const auto& tile : tiles) {
        const TerrainPrisms& prisms = *tile->prisms;
        layers.push_back({glm::dvec2(prisms.low), glm::dvec2(prisms.high), prisms.layers(), prisms.mostOver});
    }
    return stencilRounds(layers, counters & 1u ? counters : 1u);
}

/// Prisms go up and down far enough: what is beside them in plan is out of their reach.
MarkJob::BoxTest TerrainMark::boxTest(const osg::Matrixd& eyeFromBox) const {
    if (!coverage) return {};
    return [cover = coverage, toPlan = eyeFromBox * prismsFromEye](const osg::BoundingBox& box) {
        const osg::Vec3d middle = osg::Vec3d(box.center()) * toPlan,
                         half = (osg::Vec3d(box._max) - osg::Vec3d(box._min)) / 2.0;
        glm::dvec2 reach(0.0);
        for (int row = 0; row < 3; ++row)
            reach += half[row] * glm::dvec2(std::abs(toPlan(row, 0)), std::abs(toPlan(row, 1)));
        const glm::dvec2 at(middle.x(), middle.y());
        return cover->touches({at - reach, at + reach});
    };
}

std::string TerrainMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    const unsigned counters = pass.counters();
    const auto rounds = roundsOf(counters);
    if (!counters && rounds.size() > 1)
        return "needs another stencil bit where shadows lie over one another: take one from ShadowBin::reserve().";
    for (const std::vector<LayerSlice>& round : rounds) {
        state.apply(program.get());
        if (!hasProgram(state)) return noProgram;
        setUniform(state, "clipFromCaster", clipFromPrisms);
        pass.countHolding(counters ? counters : bit);
        for (const LayerSlice& slice : round) tiles[slice.tile]->prisms->draw(renderInfo, slice.first, slice.count);
        state.apply();
        if (counters) pass.takeCount(counters, bit);
    }
    return "";
}

} // namespace gnomon
