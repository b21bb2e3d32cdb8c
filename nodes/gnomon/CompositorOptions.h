// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// Settings of a view's compositor: what it may use and what it may leave out.
///
/// Use it to keep stencil bits for the application. All groups and effects of a view share one compositor. It avoids
/// every bit that one of them reserves, and skips only if all of them do.
struct CompositorOptions {
    /// Stencil bits (of 8) that belong to the application. The compositor never touches them. Default 0: none.
    unsigned reservedStencilBits = 0;
    /// True: draws again only the drawables that a shadow can touch, and marks only the terrain tiles in sight.
    /// False, for comparison, gives the same picture more slowly. Default true.
    bool skipsUntouched = true;

    /// True if all options are equal.
    bool operator==(const CompositorOptions& other) const {
        return reservedStencilBits == other.reservedStencilBits && skipsUntouched == other.skipsUntouched;
    }
    /// True if any option differs.
    bool operator!=(const CompositorOptions& other) const { return !(*this == other); }

    /// Options that suit both nodes.
    CompositorOptions with(const CompositorOptions& other) const {
        return {reservedStencilBits | other.reservedStencilBits, skipsUntouched && other.skipsUntouched};
    }
};

} // namespace gnomon
