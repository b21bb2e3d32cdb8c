// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/base/Fingerprint.h>

#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Texture2D>
#include <osg/Vec3>

#include <optional>
#include <vector>

namespace gnomon {

/// What of a drawable an alpha test leaves, as leaves and fences are made: by the alpha of a texture.
///
/// Limits  that of the 2D texture on unit 0, at coordinates given a vertex; alpha of vertices and materials counts as 1.
struct GNOMON_EXPORT AlphaTest {
    int passing = 0;        ///< bits: 1 where alpha is less than the reference, 2 equal to, 4 greater than it.
    float reference = 0.0f; ///< 0 … 1.
    osg::ref_ptr<osg::Texture2D> texture; ///< null if something decides that is not known here, as a shader.
    osg::Matrixd matrix;                  ///< of the texture's coordinates.

    /// Of the drawable at the end of a path, by the states along it and above it (there by the first parents).
    /// @return nullopt if there is none, or nothing can be missing.
    static std::optional<AlphaTest> of(const osg::NodePath& path);
    /// True if a node's own state switches a test on.
    static bool isOn(const osg::Node& node);

    /// The texture's coordinates, s, t and q, of each of a drawable's vertices; empty if it has none.
    std::vector<osg::Vec3> coordinatesOf(const osg::Drawable& drawable) const;
    /// All that coordinatesOf() and a picture of the texture depend on.
    void mix(const osg::Drawable& drawable, Fingerprint& into) const;
    /// Adds what mix() tells apart by its address.
    void hold(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) const;
};

} // namespace gnomon
