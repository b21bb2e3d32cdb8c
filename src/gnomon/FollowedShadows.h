// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/PackedShadows.h>

#include <glm/vec2.hpp>

namespace gnomon {

/// Shadows that are kept while the sun moves on, and how far each may be off by then. Where the bound says too little, that
/// shadow alone is found again and compared with the one that is kept.
class FollowedShadows {
public:
    void clear() { _parts.clear(); }
    bool empty() const { return _parts.empty(); } ///< nothing is followed.
    /// @param motions  of shadows that were just found. @param sun  that they were found with.
    void begin(const std::vector<ShadowMotion>& motions, const glm::dvec4& sun);
    /// By how much in plan any of them may be off at most, infinite if that is not known. @param sun  over the horizon.
    double offBy(const glm::dvec4& sun) const;
    /// Finds those again that may be off by more than `most`; from then on offBy() knows by how much they are off. Nothing
    /// where that is more than half of all: then all are to be found anew.
    /// @param shown  which begin() was told of, of `parts`; found by this ground, method and error.
    void look(const Ground& ground, const PackedParts& parts, const PackedShadows& shown, const glm::dvec4& sun,
              TerrainMethod method, double error, double most);

private:
    struct Part {
        ShadowMotion motion; ///< from where it was when it was found last.
        glm::dvec2 way{0.0}; ///< of the light then, see wayOf().
        double off = 0.0;    ///< then, of the one that is shown.
        double offBy(const glm::dvec2& now) const { return off + movedAtMost(motion, way, now); }
    };
    std::vector<Part> _parts;
};

} // namespace gnomon
