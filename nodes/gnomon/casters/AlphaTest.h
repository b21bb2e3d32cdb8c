// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/Fingerprint.h>

#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Texture2D>
#include <osg/Vec3>

#include <optional>
#include <vector>

namespace gnomon {

/// The alpha test of a drawable, such as leaves or a fence: which texels of its texture are opaque.
///
/// Limits
/// - It knows the 2D texture on unit 0 at its coordinates by vertex. Alpha of vertices and materials counts as 1.
struct AlphaTest {
    int passing = 0;        ///< Bits: 1 passes alpha below the reference, 2 equal alpha, 4 alpha above it.
    float reference = 0.0f; ///< Reference, 0 … 1.
    osg::ref_ptr<osg::Texture2D> texture; ///< Null if alpha comes from elsewhere, for example from a shader.
    osg::Matrixd matrix;                  ///< Transforms the texture coordinates.

    /// Finds the test of the drawable at the end of a path, by the states along it and above it (by first parents).
    /// @return nullopt if there is no test, or if it passes everything.
    static std::optional<AlphaTest> of(const osg::NodePath& path);
    /// True if a node's own state switches a test on.
    static bool isOn(const osg::Node& node);

    /// Texture coordinates (s, t, q) of each vertex of a drawable. Empty if it has none.
    std::vector<osg::Vec3> coordinatesOf(const osg::Drawable& drawable) const;
    /// Mixes in everything that decides what the test leaves of a drawable.
    void mix(const osg::Drawable& drawable, Fingerprint& into) const;
    /// Adds the objects that mix() identifies by address.
    void hold(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) const;
};

} // namespace gnomon
