// SPDX-License-Identifier: MIT
#pragma once
#include <osg/State>
#include <osg/Texture2D>
#include <osg/buffered_value>

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace gnomon {

/// A texture of bytes that several bitmaps share, row by row: to bind one for each of them costs more than to draw many.
class BitmapAtlas : public osg::Referenced {
public:
    static constexpr int bits = 10, width = 1 << bits, height = width; ///< bytes; OpenGL 3 promises no larger texture.

    BitmapAtlas();
    /// The first of so many rows that were nobody's; -1 if there are none. Any thread.
    int take(int rows);
    void give(int first, int rows);

    /// Binds it to unit 0. @return of which making the texture is in this context: another one holds no bytes yet.
    unsigned apply(osg::State& state) const;
    /// What is bound takes these bytes, of whole rows.
    static void write(osg::State& state, int firstRow, const std::vector<std::uint8_t>& bytes);
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const { _texture->releaseGLObjects(state); }

protected:
    ~BitmapAtlas() override = default;

private:
    osg::ref_ptr<osg::Texture2D> _texture;
    mutable osg::buffered_value<unsigned> _makings;
    std::mutex _mutex;
    std::vector<bool> _taken; ///< rows.
};

/// Rows of a sheet, as long as this lives.
class AtlasRows {
public:
    AtlasRows(BitmapAtlas* of, int from, int rows) : sheet(of), first(from), count(rows) {}
    ~AtlasRows() { sheet->give(first, count); }
    AtlasRows(const AtlasRows&) = delete;
    AtlasRows& operator=(const AtlasRows&) = delete;

    const osg::ref_ptr<BitmapAtlas> sheet;
    const int first, count;
};

/// As many sheets as are needed.
class BitmapAtlases {
public:
    /// Rows for so many bytes, of a sheet at most. Any thread.
    std::unique_ptr<const AtlasRows> take(std::size_t bytes);
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    mutable std::mutex _mutex;
    std::vector<osg::ref_ptr<BitmapAtlas>> _sheets;
};

} // namespace gnomon
