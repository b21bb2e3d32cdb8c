// SPDX-License-Identifier: MIT
#pragma once
#include "TracedCases.h"

namespace test {

/// What a volume draws, beside the truth.
struct VolumeTrial {
    Picture lit, dark, cast;
    TruthComparison comparison;
    std::vector<std::string> causes;
};

VolumeTrial drawVolume(const TracedCase& given);

/// As good as one ray a pixel can be, but for a few pixels that the rasteriser decides; and nothing is complained of.
/// @param least  pixels that are in shadow, or this shows nothing.
void expectFloor(const TracedCase& given, int least = 300);

/// The same case in a picture of this size.
TracedCase sized(TracedCase given, int width, int height);

} // namespace test
