// SPDX-License-Identifier: MIT
#pragma once
#include "ChartOptions.h"

namespace gnomon::examples {

/// Judges techniques on the files, which are one model, under two suns: as a user sees them, with their own materials, against
/// rays that pass texels that blend with an alpha below one half. Prints a line of JSON for each sun and technique: pixels
/// wrong away from edges, pixels truly in shadow, pixels judged, and what diagnose() says.
///
/// Limits  pixels that the light meets at less than 3 degrees, or that are hardly darker in shadow, are not judged.
/// @throws std::runtime_error, one sentence, for a file that cannot be read.
void judgeModel(const ChartOptions& options);

} // namespace gnomon::examples
