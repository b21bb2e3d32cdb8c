// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/Fingerprint.h>

#include <osg/Drawable>
#include <osg/Image>
#include <osg/Matrixd>
#include <osg/Referenced>
#include <osg/Texture2D>
#include <osg/Vec2d>
#include <osg/Vec3>
#include <osg/observer_ptr>

#include <cstdint>
#include <vector>

namespace gnomon {

/// Bounds of an alpha.
struct AlphaRange {
    float least = 0.0f, most = 1.0f;
};

/// The alpha of a 2D texture's largest level, texel by texel, and in cells: bounds for any part of it.
///
/// Cost
/// - One pass over the image; a byte a texel, unless all have one alpha, and 128 KiB at most.
/// Threads
/// - Any number. It never changes.
class TextureAlpha : public osg::Referenced {
public:
    /// Of an image that is not there, or compressed with an alpha, nothing is known.
    static osg::ref_ptr<const TextureAlpha> of(const osg::Texture2D& texture);
    /// True until the texture has got another image. One that it has let go, once drawn, counts as it was.
    bool isOf(const osg::Texture2D& texture) const;
    /// True if the alpha of each texel is known.
    bool isKnown() const { return !_texels.empty() || _all.least == _all.most; }
    /// Bounds of what a box of texture coordinates shows, its filter included.
    AlphaRange over(const osg::Vec2d& low, const osg::Vec2d& high) const;
    /// The alpha at a place in texture coordinates, as OpenGL magnifies the largest level: 0 … 1. Of one that isKnown().
    float at(const osg::Vec2d& place) const;

protected:
    ~TextureAlpha() override = default;

private:
    explicit TextureAlpha(const osg::Texture2D& of);
    /// Bounds as bytes, rounded outwards.
    struct Cell {
        std::uint8_t least = 255, most = 0;
        void add(const Cell& other);
    };
    /// Cells along an axis that a footprint covers: at most two spans.
    struct Covered {
        int first[2], end[2], spans = 1;
        bool border = false;
    };
    Covered coveredAlong(unsigned axis, double low, double high) const;
    void read(const osg::Image& image);
    int texelAlong(unsigned axis, double at) const;
    int texel(int column, int row) const;

    const osg::Texture2D* const _texture; ///< Identifies it while somebody holds it. Do not dereference it.
    const osg::observer_ptr<const osg::Image> _image;
    const unsigned _count;                                ///< of the image's changes.
    const std::uint64_t _sampling;                        ///< see mixTexture().
    int _size[2] = {0, 0}, _cells[2] = {0, 0}, _step = 1; ///< texels, cells, texels in a cell's side.
    osg::Texture::WrapMode _wrap[2] = {};
    bool _mixes = true;  ///< texels where it magnifies.
    double _reach = 0.5; ///< texels by which the filter looks beyond a coordinate.
    Cell _border, _all{0, 255};
    std::vector<Cell> _grid;
    std::vector<std::uint8_t> _texels; ///< of all rows; none if all have the same alpha.
};

/// Which parts of a drawable an alpha lets cast: that of its surface times that of a texture.
struct AlphaTest {
    int passing = 0;          ///< Bits: 1 passes alpha below the reference, 2 equal alpha, 4 alpha above it.
    float reference = 0.0f;   ///< Reference, 0 … 1.
    float surfaceFrom = 0.0f; ///< Where the surface's own alpha is less, it casts nothing.
    float evenFrom = 0.0f;    ///< Where the drawable has one alpha all over, and it is less, all of it is clear.
    float surface = 1.0f;     ///< Alpha of the surface.
    bool byVertex = false;    ///< Colours of vertices have it instead.
    osg::ref_ptr<osg::Texture2D> texture;    ///< On unit 0; null if no texture has any.
    osg::Matrixd matrix;                     ///< Transforms the texture coordinates.
    osg::ref_ptr<const TextureAlpha> alphas; ///< Of the texture; null where they are not known.

    /// True if it can be sampled by the texture alone. Then sampledReference() takes the place of the reference.
    bool isSampled() const { return texture && !byVertex; }
    float sampledReference() const { return reference / surface; }
    /// True if sampled() can tell.
    bool isKnown() const { return isSampled() && alphas && alphas->isKnown(); }
    /// True if there is something of it at texture coordinates (s, t, q). Of one that isKnown().
    bool sampled(const osg::Vec3d& coordinate) const;
    /// Texture coordinates (s, t, q) of each vertex of a drawable. Empty if it has none.
    static std::vector<osg::Vec3> coordinatesOf(const osg::Drawable& drawable, const osg::Matrixd& matrix);
    /// True if coordinatesOf() has any.
    static bool hasCoordinates(const osg::Drawable& drawable);
    /// See Casting.
    void mix(const osg::Drawable& drawable, Fingerprint& into) const;
    void hold(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) const;
};

/// The alpha of a drawable's vertices by their colours, 0 … 1. Empty if that cannot be read.
std::vector<float> vertexAlphas(const osg::Drawable& drawable);

/// Tells a drawable's clear triangles from others.
class ClearParts {
public:
    enum Part { Clear, Mixed, Solid };

    ClearParts(const AlphaTest& test, const osg::Drawable& drawable);
    /// Of the triangle of three vertices that are in the array.
    Part of(unsigned a, unsigned b, unsigned c) const;
    /// See AlphaTest::coordinatesOf().
    const std::vector<osg::Vec3>& coordinates() const { return _coordinates; }

private:
    AlphaRange textureOver(unsigned a, unsigned b, unsigned c) const;

    const AlphaTest& _test;
    std::vector<osg::Vec3> _coordinates;
    std::vector<float> _vertices; ///< alphas.
    bool _lightPasses = false;    ///< everywhere: see AlphaTest::evenFrom.
};

} // namespace gnomon
