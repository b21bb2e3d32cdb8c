// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ShadowBitmap.h>

#include <osg/Geometry>
#include <osg/Texture2D>

namespace gnomon {

/// A tile's decals as a bitmap on the ground's own triangles, ready to be drawn.
class GNOMON_EXPORT TerrainBitmap : public osg::Referenced {
public:
    /// @param level  of its texels' size, see TerrainView::bitmapLevel().
    TerrainBitmap(const ShadowBitmap& bitmap, int level);

    int level() const { return _level; }
    unsigned triangles() const { return _triangles; }
    /// @param renderInfo  the program is markProgram()'s with BITMAP; uses texture unit 0.
    void draw(osg::RenderInfo& renderInfo) const;
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

    /// How many triangles of decals a view draws as they are, the nearest, which are exact; farther tiles are drawn by bitmaps.
    /// Default 10000, some 1.5 ms of processor time where a processor draws them. For tests and comparison.
    static void setMostPolygons(unsigned triangles);
    static unsigned getMostPolygons();

protected:
    ~TerrainBitmap() override = default;

private:
    const glm::dvec4 _place; ///< where its texels begin, and how many there are to a length of 1.
    const glm::dvec2 _last;  ///< texel.
    const int _level;
    const unsigned _triangles;
    osg::ref_ptr<osg::Geometry> _geometry;
    osg::ref_ptr<osg::Texture2D> _texture;
};

} // namespace gnomon
