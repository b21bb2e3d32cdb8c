// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

namespace gnomon {

/// Settings of a ShadowVolumeTechnique, with their defaults.
///
///     gnomon::ShadowVolumeOptions options;
///     options.edges = gnomon::ShadowVolumeOptions::SMOOTH;
///     shadow->setOptions(options);
struct GNOMON_EXPORT ShadowVolumeOptions {
    /// What a pixel at the edge of a shadow gets.
    enum Edges : int {
        HARD, ///< All of the light or nothing, as its middle.
        SMOOTH ///< The share that reaches it, where the frame has one sample a pixel. Else edges are as smooth as samples are.
    };
    /// Debug views, drawn over the finished picture.
    enum View : int {
        NOTHING, ///< No debug view.
        VOLUMES  ///< The volumes' sides as wires: yellow those counted from the eye, red those counted from behind.
    };

    /// Edges of shadows. Default HARD.
    Edges edges = HARD;
    /// Debug view. Default NOTHING.
    View view = NOTHING;

    /// True if a pixel may get a part of the light.
    bool fades() const { return edges == SMOOTH; }
    /// Options that can be used. What is unknown becomes the default.
    ShadowVolumeOptions usable() const;
};

} // namespace gnomon
