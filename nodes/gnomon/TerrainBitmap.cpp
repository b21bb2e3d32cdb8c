// SPDX-License-Identifier: MIT
#include <gnomon/MarkProgram.h>
#include <gnomon/TerrainBitmap.h>

#include <algorithm>
#include <atomic>

namespace gnomon {
namespace {

std::atomic<unsigned> mostPolygons{10000};

osg::ref_ptr<osg::Geometry> geometryOf(const ShadowBitmap& bitmap) {
    static_assert(sizeof(glm::vec3) == sizeof(osg::Vec3));
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    const auto* places = reinterpret_cast<const osg::Vec3*>(bitmap.vertices.data());
    geometry->setVertexArray(new osg::Vec3Array(places, places + bitmap.vertices.size()));
    geometry->addPrimitiveSet(
        new osg::DrawElementsUInt(GL_TRIANGLES, bitmap.triangles.begin(), bitmap.triangles.end()));
    return geometry;
}

osg::ref_ptr<osg::Texture2D> textureOf(const ShadowBitmap& bitmap) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(bitmap.columns, bitmap.rows, 1, GL_RED_INTEGER_EXT, GL_UNSIGNED_INT);
    std::copy(bitmap.words.begin(), bitmap.words.end(), reinterpret_cast<std::uint32_t*>(image->data()));
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setInternalFormat(GL_R32UI);
    for (const auto use : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(use, osg::Texture::NEAREST);
    texture->setResizeNonPowerOfTwoHint(false);
    return texture;
}

} // namespace

TerrainBitmap::TerrainBitmap(const ShadowBitmap& bitmap, int level)
    : _place(bitmap.low, glm::dvec2(1.0 / bitmap.texel)),
      _last(bitmap.columns * ShadowBitmap::wide - 1, bitmap.rows * ShadowBitmap::high - 1),
      _level(level),
      _triangles(unsigned(bitmap.triangles.size() / 3)),
      _geometry(geometryOf(bitmap)),
      _texture(textureOf(bitmap)) {}

void TerrainBitmap::draw(osg::RenderInfo& renderInfo) const {
    osg::State& state = *renderInfo.getState();
    state.applyTextureAttribute(0, _texture.get());
    setUniform(state, "texels", _place);
    setUniform(state, "lastTexel", _last);
    _geometry->draw(renderInfo);
}

void TerrainBitmap::resizeGLObjectBuffers(unsigned maxSize) {
    _geometry->resizeGLObjectBuffers(maxSize);
    _texture->resizeGLObjectBuffers(maxSize);
}

void TerrainBitmap::releaseGLObjects(osg::State* state) const {
    _geometry->releaseGLObjects(state);
    _texture->releaseGLObjects(state);
}

void TerrainBitmap::setMostPolygons(unsigned triangles) { mostPolygons = triangles; }
unsigned TerrainBitmap::getMostPolygons() { return mostPolygons; }

} // namespace gnomon
