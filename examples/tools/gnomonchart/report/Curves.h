// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"

namespace gnomon::examples {

/// Which of a point's times is meant.
enum class LightMotion {
    Still, ///< only the camera moves: what a technique keeps, it may use again.
    Moving ///< the light turns with every frame: nothing can be kept.
};

/// One setting of one technique on a chart: in one scene, or over all of them.
struct CurvePoint {
    std::string setting;
    AddedTime time;           ///< ms, wall; NaN if there is none.
    double error = 0.0;       ///< px, 95th percentile of the boundary error; infinity if the picture has no boundary.
    bool catastrophic = true; ///< in any scene.
    std::size_t scenes = 0;   ///< in how many it was tried.

    /// Whether it has a place on a chart.
    bool shown() const;
};

/// One technique, its settings in the order in which they were measured.
struct Curve {
    std::string kit, technique;
    std::vector<CurvePoint> points;

    bool ours() const { return kit == ourKit; }
};

std::vector<Curve> sceneCurves(const ChartResults& results, const std::string& scene, LightMotion light);

/// All scenes as one: of each technique at each setting the median over the scenes in which it was tried, of error and of
/// each quartile of time. Where it failed, or drew no boundary, it counts as infinitely far off.
std::vector<Curve> pooledCurves(const ChartResults& results, LightMotion light);

/// Middle of the values, mean of the two middle ones of an even number; NaN for none.
double median(std::vector<double> values);

/// One step of the staircase of the best, or one that may become it.
struct BestPoint {
    const Curve* curve;
    const CurvePoint* point;
};

/// Those that have a place on a chart and are no catastrophe, in the order of the curves.
std::vector<BestPoint> soundPoints(const std::vector<Curve>& curves);

/// The points for which no other is at most as slow and at most as wrong (and better in one), from the fastest to the
/// most accurate. Catastrophic points are never among the best. Of points alike in both the first is taken.
std::vector<BestPoint> staircase(const std::vector<Curve>& curves);

/// What one perfect ray a pixel is off, px; over all scenes (the median) if `scene` is empty. nullopt if unknown.
std::optional<double> boundaryFloor(const ChartResults& results, const std::string& scene);

} // namespace gnomon::examples
