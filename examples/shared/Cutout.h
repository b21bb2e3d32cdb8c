// SPDX-License-Identifier: MIT
#pragma once
#include <osg/AlphaFunc>
#include <osg/Drawable>
#include <osg/Image>
#include <osg/Texture2D>
#include <osg/Vec2d>
#include <osg/ref_ptr>

#include <optional>

namespace gnomon::examples {

/// What an alpha test leaves of a textured surface.
///
/// Limits  alpha is that of the 2D texture on unit 0 at full size, its image still in memory; that of vertices and
///         materials counts as 1, texture matrices and combiners as none.
class Cutout {
public:
    /// Of the surface at the end of a path, its own state included; nullopt if no texel can be missing from it.
    static std::optional<Cutout> of(const osg::NodePath& path, const osg::Drawable& drawable);

    /// Whether the surface is there. @param texcoord  of unit 0.
    bool keeps(const osg::Vec2d& texcoord) const;

private:
    Cutout(const osg::AlphaFunc& test, const osg::Texture2D& texture);
    double alphaOf(int column, int row) const;
    double alphaAt(const osg::Vec2d& texcoord) const;

    osg::ref_ptr<const osg::AlphaFunc> _test;
    osg::ref_ptr<const osg::Texture2D> _texture;
    osg::ref_ptr<const osg::Image> _image;
};

} // namespace gnomon::examples
