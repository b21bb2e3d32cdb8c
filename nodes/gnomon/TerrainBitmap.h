// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ShadowBitmap.h>
#include <gnomon/TerrainSheet.h>

#include <osg/Geometry>

#include <memory>
#include <vector>

namespace gnomon {

/// A tile's decals as a bitmap on the ground's own triangles, ready to be drawn.
class GNOMON_EXPORT TerrainBitmap : public osg::Referenced {
public:
    /// @param level   of its texels' size, see TerrainView::bitmapLevel().
    /// @param sheets  where its texels are to be; must outlive this constructor alone.
    TerrainBitmap(const ShadowBitmap& bitmap, int level, TerrainSheets& sheets);

    int level() const { return _level; }
    unsigned triangles() const { return _triangles; }
    /// markProgram()'s that draws them.
    static osg::ref_ptr<osg::StateSet> program();
    /// @param renderInfo  with that program; uses texture unit 0 and the current texture coordinates
    ///                    of units 0 and 1.
    static void draw(osg::RenderInfo& renderInfo, std::vector<const TerrainBitmap*> bitmaps);
    /// Of all but the sheets.
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

protected:
    ~TerrainBitmap() override = default;

private:
    void upload(osg::State& state) const;

    const osg::Vec4 _place; ///< where its texels begin, and how many there are to a length of 1.
    const int _level;
    const unsigned _triangles;
    const std::unique_ptr<const SheetRows> _rows;
    const osg::Vec4 _texels;          ///< the last one, bytes in a row of blocks, the first byte in the sheet.
    std::vector<std::uint8_t> _bytes; ///< in whole rows of the sheet.
    mutable osg::buffered_value<unsigned> _uploaded; ///< into which making of the sheet.
    osg::ref_ptr<osg::Geometry> _geometry;
};

} // namespace gnomon
