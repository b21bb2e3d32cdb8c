// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// Size and buffers of a HeadlessContext.
struct HeadlessOptions {
    int width = 800;         ///< Pixels, 1 … 16384, or up to the driver's limit if lower.
    int height = 600;        ///< Pixels, same range.
    int depthBits = 24;      ///< 16, 24 or 32.
    int stencilBits = 8;     ///< 0 or 8. Shadows take less time with 8.
    bool floatColor = false; ///< True: 32-bit float colour. False: 8-bit colour.
};

} // namespace gnomon
