// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <string>

namespace gnomon {

/// A part of Gnomon that a build may leave out. Each needs a library of its own.
enum class OptionalPart {
    Traced,  ///< Rays: TracedShadowTechnique, ShadowQuery, RayScene, shadowTruth(). By Embree.
    Terrain, ///< HULL of TerrainShadowGeode. By Qhull.
    Sun,     ///< SunClock, julianDay(), momentOf(). By libnova.
};

/// Says why this build lacks a part, and what to install. Empty if it has the part.
///
/// Ask before you offer a technique in a menu. A class whose part is missing says the same by diagnose(), or throws it as
/// std::runtime_error. CMake refuses a missing part by `find_package(gnomon REQUIRED COMPONENTS traced terrain sun)`.
GNOMON_EXPORT std::string whyMissing(OptionalPart part);

/// True if this build has a part.
inline bool hasPart(OptionalPart part) { return whyMissing(part).empty(); }

} // namespace gnomon
