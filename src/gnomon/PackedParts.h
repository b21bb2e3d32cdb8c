// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ConvexParts.h>

#include <cstddef>

namespace gnomon {

/// Many convex parts in a few blocks of memory, for packedShadows(): a tile of a town, say. Independent of the light; changed
/// only where casters do.
///
/// Threads any number may read.
class PackedParts {
public:
    PackedParts() = default;
    explicit PackedParts(const std::vector<ConvexPart>& parts);

    std::size_t size() const { return _parts.size(); }
    /// At the end.
    void add(const ConvexPart& part);
    /// A part that moved, or another in its place. @param at  below size().
    void replace(std::size_t at, const ConvexPart& part);
    /// The last part takes its place. @param at  below size().
    void remove(std::size_t at);
    ConvexPart part(std::size_t at) const;
    std::size_t bytes() const; ///< that are kept.

private:
    std::vector<ConvexPart> _parts;
};

} // namespace gnomon
