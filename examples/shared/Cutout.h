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

/// What an alpha test leaves of a textured surface; or, asked for, what blending leaves: all of an alpha of one half and more.
///
/// Limits  alpha is that of the 2D texture on unit 0 at full size, its image still in memory, and of what blends that of its
///         material or one colour, too; that of vertices counts as 1, texture matrices and combiners as none.
class Cutout {
public:
    /// Of the surface at the end of a path, its own state included; nullopt if no texel can be missing from it.
    static std::optional<Cutout> of(const osg::NodePath& path, const osg::Drawable& drawable);
    /// The same of a surface that blends, without a test; nullopt if it does not blend.
    static std::optional<Cutout> blended(const osg::NodePath& path, const osg::Drawable& drawable);

    /// Whether polygon modes let no side of a surface be filled: lines and points block no ray.
    static bool isUnfilled(const osg::NodePath& path, const osg::Drawable& drawable);

    /// Whether the surface is there. @param texcoord  of unit 0.
    bool keeps(const osg::Vec2d& texcoord) const;

private:
    Cutout(const osg::AlphaFunc& test, const osg::Texture2D* texture, double alpha = 1.0);
    double alphaOf(int column, int row) const;
    double alphaAt(const osg::Vec2d& texcoord) const;

    osg::ref_ptr<const osg::AlphaFunc> _test;
    osg::ref_ptr<const osg::Texture2D> _texture;
    osg::ref_ptr<const osg::Image> _image; ///< null: none.
    double _alpha;                         ///< besides the texture's.
};

} // namespace gnomon::examples
