// SPDX-License-Identifier: MIT
#pragma once
#include <ChartResults.h>

#include <filesystem>

namespace test {

/// Results as a run of gnomonchart might give them, made up: five scenes, techniques of both kits in several settings,
/// with failures, catastrophes, numbers that are missing and names that try to be markup. The same every time.
gnomon::examples::ChartResults syntheticChart();

/// One name of them, `<script>` and all.
extern const char* const hostileTitle;

/// The pictures that they name, 120 × 80: the truth green, pictures red and overlays blue all over.
void writePictures(const gnomon::examples::ChartResults& results, const std::filesystem::path& folder);

/// A point as few words: where it is on a chart, nothing else.
gnomon::examples::ChartPoint chartPoint(const char* kit, const char* technique, const char* setting, double ms,
                                        double error);

} // namespace test
