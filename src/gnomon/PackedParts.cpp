// SPDX-License-Identifier: MIT
#include <gnomon/PackedParts.h>

#include <utility>

namespace gnomon {

PackedParts::PackedParts(const std::vector<ConvexPart>& parts) : _parts(parts) {}

void PackedParts::add(const ConvexPart& part) { _parts.push_back(part); }

void PackedParts::replace(std::size_t at, const ConvexPart& part) { _parts[at] = part; }

void PackedParts::remove(std::size_t at) {
    if (at + 1 < _parts.size()) _parts[at] = std::move(_parts.back());
    _parts.pop_back();
}

ConvexPart PackedParts::part(std::size_t at) const { return _parts[at]; }

std::size_t PackedParts::bytes() const { return _parts.size() * sizeof(ConvexPart); }

} // namespace gnomon
