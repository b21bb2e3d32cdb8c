// SPDX-License-Identifier: MIT
#include <gnomon/MarkProgram.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowPrisms.h>
#include <gnomon/TerrainMark.h>

namespace gnomon {
namespace {

osg::ref_ptr<osg::Geometry> layerOf(osg::Vec3Array* vertices, const std::vector<unsigned>& triangles) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(vertices);
    geometry->addPrimitiveSet(
        new osg::DrawElementsUInt(GL_TRIANGLES, static_cast<unsigned>(triangles.size()), triangles.data()));
    return geometry;
}

} // namespace

TerrainPrisms::TerrainPrisms(const ShadowPrisms& prisms) : low(prisms.low), high(prisms.high) {
    osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
    vertices->reserve(prisms.vertices.size());
    for (const glm::vec3& v : prisms.vertices) vertices->push_back({v.x, v.y, v.z});
    for (const std::vector<unsigned>& triangles : prisms.layers) layers.push_back(layerOf(vertices, triangles));
}

void TerrainPrisms::resizeGLObjectBuffers(unsigned maxSize) {
    for (const auto& layer : layers) layer->resizeGLObjectBuffers(maxSize);
}

void TerrainPrisms::releaseGLObjects(osg::State* state) const {
    for (const auto& layer : layers) layer->releaseGLObjects(state);
}

/// As many layers at once as the counters can tell apart; a single layer needs no more than the mark's own bit.
std::string TerrainMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    osg::State& state = *renderInfo.getState();
    const unsigned counters = pass.counters();
    if (!counters && prisms->layers.size() > 1)
        return "needs a sixth stencil bit where shadows lie over one another: leave six to ShadowBin::reserve().";
    const std::size_t atOnce = counters & 1u ? counters : 1;
    for (std::size_t from = 0; from < prisms->layers.size(); from += atOnce) {
        state.apply(program.get());
        if (!hasProgram(state)) return noProgram;
        setUniform(state, "clipFromCaster", clipFromPrisms);
        pass.countHolding(counters ? counters : bit);
        for (std::size_t i = from; i < std::min(from + atOnce, prisms->layers.size()); ++i)
            prisms->layers[i]->draw(renderInfo);
        state.apply();
        if (counters) pass.takeCount(counters, bit);
    }
    return "";
}

} // namespace gnomon
