// SPDX-License-Identifier: MIT
#include <gnomon/gl/ShaderProgram.h>
#include <gnomon/terrain/TileBitmap.h>

#include <osg/GLExtensions>

#include <algorithm>
#include <functional>
#include <string>

namespace gnomon {
namespace {

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

osg::Vec4 placeOf(const ShadowBitmap& bitmap) {
    return osg::Vec4(osg::Vec4d(bitmap.low.x, bitmap.low.y, 1.0 / bitmap.texel, 0.0));
}

osg::Vec4 texelsOf(const ShadowBitmap& bitmap, const AtlasRows& rows) {
    return osg::Vec4(osg::Vec4d(bitmap.columns * ShadowBitmap::wide - 1, bitmap.rows * ShadowBitmap::high - 1,
                                bitmap.columns * ShadowBitmap::high, rows.first * BitmapAtlas::width));
}

/// Current texture coordinates of a unit: unlike uniforms, they cost next to nothing to set.
class CurrentCoordinates {
public:
    CurrentCoordinates(osg::State& state, GLenum unit) : _gl(*state.get<osg::GLExtensions>()), _unit(unit) {
        state.setActiveTextureUnit(unit - GL_TEXTURE0);
        glGetFloatv(GL_CURRENT_TEXTURE_COORDS, _before);
    }
    ~CurrentCoordinates() { _gl.glMultiTexCoord4fv(_unit, _before); }
    CurrentCoordinates(const CurrentCoordinates&) = delete;
    CurrentCoordinates& operator=(const CurrentCoordinates&) = delete;
    void set(const osg::Vec4& value) const { _gl.glMultiTexCoord4fv(_unit, value.ptr()); }

private:
    const osg::GLExtensions& _gl;
    const GLenum _unit;
    GLfloat _before[4];
};

} // namespace

TileBitmap::TileBitmap(const ShadowBitmap& bitmap, int level, BitmapAtlases& sheets)
    : _place(placeOf(bitmap)),
      _level(level),
      _triangles(unsigned(bitmap.triangles.size() / 3)),
      _rows(sheets.take(bitmap.bytes.size())),
      _texels(texelsOf(bitmap, *_rows)),
      _bytes(bitmap.bytes),
      _geometry(geometryOf(bitmap)) {
    _bytes.resize(std::size_t(_rows->count) * BitmapAtlas::width);
}

osg::ref_ptr<osg::StateSet> TileBitmap::program() {
    return shaderProgram("#define BITMAP " + std::to_string(BitmapAtlas::bits) + "\n");
}

/// All are written before any is drawn: what is written to a texture that is being drawn from has to wait.
void TileBitmap::draw(osg::RenderInfo& renderInfo, std::vector<const TileBitmap*> bitmaps) {
    const auto sheetOf = [](const TileBitmap* bitmap) { return bitmap->_rows->sheet.get(); };
    std::stable_sort(bitmaps.begin(), bitmaps.end(),
                     [&](const auto* a, const auto* b) { return std::less<>()(sheetOf(a), sheetOf(b)); });
    osg::State& state = *renderInfo.getState();
    for (const TileBitmap* bitmap : bitmaps) bitmap->upload(state);
    const CurrentCoordinates texels(state, GL_TEXTURE1), place(state, GL_TEXTURE0);
    for (const TileBitmap* bitmap : bitmaps) {
        sheetOf(bitmap)->apply(state);
        place.set(bitmap->_place);
        texels.set(bitmap->_texels);
        bitmap->_geometry->draw(renderInfo);
    }
}

void TileBitmap::upload(osg::State& state) const {
    const unsigned making = _rows->sheet->apply(state);
    unsigned& uploaded = _uploaded[state.getContextID()];
    if (uploaded == making) return;
    BitmapAtlas::write(state, _rows->first, _bytes);
    uploaded = making;
}

void TileBitmap::resizeGLObjectBuffers(unsigned maxSize) {
    _geometry->resizeGLObjectBuffers(maxSize);
    _uploaded.resize(maxSize);
}

void TileBitmap::releaseGLObjects(osg::State* state) const { _geometry->releaseGLObjects(state); }

} // namespace gnomon
