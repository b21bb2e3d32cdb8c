// SPDX-License-Identifier: MIT
#include <gnomon/terrain/BitmapAtlas.h>

#include <algorithm>

namespace gnomon {

BitmapAtlas::BitmapAtlas() : _texture(new osg::Texture2D), _taken(std::size_t(height), false) {
    _texture->setTextureSize(width, height);
    _texture->setInternalFormat(GL_R8UI);
    _texture->setSourceFormat(GL_RED_INTEGER_EXT);
    _texture->setSourceType(GL_UNSIGNED_BYTE);
    for (const auto use : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        _texture->setFilter(use, osg::Texture::NEAREST);
    for (const auto side : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
        _texture->setWrap(side, osg::Texture::CLAMP_TO_EDGE);
}

int BitmapAtlas::take(int rows) {
    const std::lock_guard<std::mutex> lock(_mutex);
    const auto first = std::search_n(_taken.begin(), _taken.end(), rows, false);
    if (first == _taken.end()) return -1;
    std::fill_n(first, rows, true);
    return int(first - _taken.begin());
}

void BitmapAtlas::give(int first, int rows) {
    const std::lock_guard<std::mutex> lock(_mutex);
    std::fill_n(_taken.begin() + first, rows, false);
}

unsigned BitmapAtlas::apply(osg::State& state) const {
    unsigned& makings = _makings[state.getContextID()];
    if (!_texture->getTextureObject(state.getContextID())) ++makings;
    state.setActiveTextureUnit(0);
    state.applyTextureAttribute(0, _texture.get());
    return makings;
}

void BitmapAtlas::write(osg::State& state, int firstRow, const std::vector<std::uint8_t>& bytes) {
    state.unbindPixelBufferObject();
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, firstRow, width, GLsizei(bytes.size()) / width, GL_RED_INTEGER_EXT,
                    GL_UNSIGNED_BYTE, bytes.data());
}

void BitmapAtlas::resizeGLObjectBuffers(unsigned maxSize) {
    _texture->resizeGLObjectBuffers(maxSize);
    _makings.resize(maxSize);
}

std::unique_ptr<const AtlasRows> BitmapAtlases::take(std::size_t bytes) {
    const int rows = int((bytes + BitmapAtlas::width - 1) / BitmapAtlas::width);
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& sheet : _sheets)
        if (const int first = sheet->take(rows); first >= 0) return std::make_unique<AtlasRows>(sheet, first, rows);
    _sheets.push_back(new BitmapAtlas);
    return std::make_unique<AtlasRows>(_sheets.back(), _sheets.back()->take(rows), rows);
}

void BitmapAtlases::resizeGLObjectBuffers(unsigned maxSize) {
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& sheet : _sheets) sheet->resizeGLObjectBuffers(maxSize);
}

void BitmapAtlases::releaseGLObjects(osg::State* state) const {
    const std::lock_guard<std::mutex> lock(_mutex);
    for (const auto& sheet : _sheets) sheet->releaseGLObjects(state);
}

} // namespace gnomon
