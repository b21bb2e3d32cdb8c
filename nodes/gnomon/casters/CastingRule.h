// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Drawable>
#include <osg/Node>

namespace gnomon {

/// Which drawables cast nothing, though they have triangles, by the state that they are drawn with.
///
/// - What is drawn at the far plane, by the range of osg::Depth, as skies are: nothing lies behind it.
/// - What blends with a constant alpha below a threshold: of its material, its overall colour or osg::BlendColor; and
///   what only adds to the colours behind it.
///
/// Limits
/// - Alpha of vertices, textures and programs is not known: what has one casts.
struct CastingRule {
    float opaqueFrom = 0.0f; ///< Alpha from which on a blending drawable casts, 0 … 1. 0: all cast.

    /// True if a node's own state may keep what is below it from casting.
    static bool mayMatter(const osg::Node& node);
    /// True if the drawable at the end of a path casts, by the states along it and above it (by first parents).
    bool lets(const osg::NodePath& path, const osg::Drawable& drawable) const;
};

} // namespace gnomon
