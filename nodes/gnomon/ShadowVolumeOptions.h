// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

namespace gnomon {

/// Settings of a ShadowVolumeTechnique, with their defaults.
///
///     gnomon::ShadowVolumeOptions options;
///     options.view = gnomon::ShadowVolumeOptions::VOLUMES;
///     shadow->setOptions(options);
struct GNOMON_EXPORT ShadowVolumeOptions {
    /// Debug views, drawn over the finished picture.
    enum View : int {
        NOTHING, ///< No debug view.
        VOLUMES  ///< The volumes' sides as wires: yellow those counted from the eye, red those counted from behind.
    };

    /// Debug view. Default NOTHING.
    View view = NOTHING;

    /// Options that can be used. An unknown view becomes the default.
    ShadowVolumeOptions usable() const;
};

} // namespace gnomon
