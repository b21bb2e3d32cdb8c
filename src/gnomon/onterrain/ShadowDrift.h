// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/drape/Drape.h>
#include <gnomon/onterrain/PackedShadows.h>

#include <glm/vec2.hpp>

namespace gnomon {

/// Shadows that are kept while the sun moves on, and how far each may be off by then. Where the bound says too little of one
/// of those that move most, that shadow alone is found again and compared with the one that is kept.
///
/// Cost  40 bytes for one in two parts.
class ShadowDrift {
public:
    void clear() { _fastest.clear(); }
    bool empty() const { return _fastest.empty(); } ///< nothing is followed.
    /// @param shown  of `parts` on this ground. @param sun  over the horizon, that they were found with.
    void begin(const Ground& ground, const PackedParts& parts, const PackedShadows& shown, const glm::dvec4& sun);
    /// By how much in plan any of them may be off at most, infinite if that is not known. @param sun  over the horizon.
    double offBy(const glm::dvec4& sun) const;
    /// The same, once those that may be off by more than enough are found again: from then on it is known by how much they
    /// are off. Nothing is where too little is known of others, too: then all are to be found anew.
    /// @param shown  which begin() was told of, of `parts`; found by this ground, method and error.
    /// @param late   enough; once one is known to be off by more, `most` is.
    double look(const Ground& ground, const PackedParts& parts, const PackedShadows& shown, const glm::dvec4& sun,
                TerrainMethod method, double error, double late, double most);

private:
    struct Part {
        glm::dvec2 way;              ///< of the light when it was found last, see wayOf().
        float height, along, across; ///< its motion from there.
        float off;                   ///< then, of the one that is shown.
        unsigned place;              ///< among the parts.
        ShadowMotion motion() const { return {double(height), double(along), double(across)}; }
    };
    template <class Take>
    void eachOff(const glm::dvec2& now, const Take& take) const;
    static Part partOf(unsigned place, const ShadowMotion& motion, const glm::dvec2& way, double off);

    std::vector<Part> _fastest;
    ShadowRates _others;
    glm::dvec2 _way{0.0}; ///< of the light when all were found.
};

} // namespace gnomon
