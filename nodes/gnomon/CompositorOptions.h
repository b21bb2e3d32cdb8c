// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// What the compositor of a view may use, and what it may leave out.
///
/// All groups and effects of a view share one compositor. It keeps away from the bits that any of them reserves, and
/// filters only if all of them do.
struct CompositorOptions {
    /// Stencil bits (of 8) that belong to the application: never touched. Default none.
    unsigned reservedStencilBits = 0;
    /// Leaves that marks cannot touch are not drawn again, tiles of terrain out of sight not marked. False is for
    /// comparison: the picture is the same. Default true.
    bool filter = true;
    /// How many triangles of decals a view draws as they are, the nearest, which are exact; tiles farther away are drawn as
    /// bitmaps. Default 10000.
    unsigned mostDecals = 10000;

    bool operator==(const CompositorOptions& other) const {
        return reservedStencilBits == other.reservedStencilBits && filter == other.filter &&
               mostDecals == other.mostDecals;
    }
    bool operator!=(const CompositorOptions& other) const { return !(*this == other); }

    /// Those that suit both; mostDecals stays as it is.
    CompositorOptions with(const CompositorOptions& other) const {
        return {reservedStencilBits | other.reservedStencilBits, filter && other.filter, mostDecals};
    }
};

} // namespace gnomon
