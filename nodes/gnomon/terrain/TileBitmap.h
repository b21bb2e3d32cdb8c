// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/overlay/ShadowBitmap.h>
#include <gnomon/terrain/BitmapAtlas.h>

#include <osg/Geometry>

#include <memory>
#include <vector>

namespace gnomon {

/// A tile's decals as a bitmap on the ground's own triangles, ready to be drawn.
class TileBitmap : public osg::Referenced {
public:
    /// @param level   of its texels' size, see TileVisibility::bitmapLevel().
    /// @param sheets  where its texels are to be; must outlive this constructor alone.
    TileBitmap(const ShadowBitmap& bitmap, int level, BitmapAtlases& sheets);

    int level() const { return _level; }
    unsigned triangles() const { return _triangles; }
    /// shaderProgram()'s that draws them.
    static osg::ref_ptr<osg::StateSet> program();
    /// @param renderInfo  with that program; uses texture unit 0 and the current texture coordinates
    ///                    of units 0 and 1.
    static void draw(osg::RenderInfo& renderInfo, std::vector<const TileBitmap*> bitmaps);
    /// Of all but the sheets.
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

protected:
    ~TileBitmap() override = default;

private:
    void upload(osg::State& state) const;

    const osg::Vec4 _place; ///< where its texels begin, and how many there are to a length of 1.
    const int _level;
    const unsigned _triangles;
    const std::unique_ptr<const AtlasRows> _rows;
    const osg::Vec4 _texels;          ///< the last one, bytes in a row of blocks, the first byte in the sheet.
    std::vector<std::uint8_t> _bytes; ///< in whole rows of the sheet.
    mutable osg::buffered_value<unsigned> _uploaded; ///< into which making of the sheet.
    osg::ref_ptr<osg::Geometry> _geometry;
};

} // namespace gnomon
