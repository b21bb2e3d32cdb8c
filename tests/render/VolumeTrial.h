// SPDX-License-Identifier: MIT
#pragma once
#include "TracedCases.h"

namespace test {

CaseTrial drawVolume(const TracedCase& given);

/// As good as one ray a pixel can be, but for a few pixels that the rasteriser decides; and nothing is complained of.
/// @param least  pixels that are in shadow, or this shows nothing.
void expectFloor(const TracedCase& given, int least = 300);

/// The same case in a picture of this size.
TracedCase sized(TracedCase given, int width, int height);

} // namespace test
