// SPDX-License-Identifier: MIT
#include "PointNumbers.h"

namespace gnomon::examples {
namespace {

using Number = std::optional<double>;

template <auto Part>
Number ofCost(const ChartPoint& point) {
    if (!point.cost) return std::nullopt;
    return static_cast<double>((*point.cost).*Part);
}

template <auto Times, auto Part>
Number ofTime(const ChartPoint& point) {
    if (!point.cost) return std::nullopt;
    return (*point.cost).*Times.*Part;
}

template <auto Part>
Number ofBoundary(const ChartPoint& point) {
    if (!point.errors || !point.errors->boundary) return std::nullopt;
    return (*point.errors->boundary).*Part;
}

Number percent(const Number& share) {
    if (!share) return std::nullopt;
    return 100.0 * *share;
}

template <auto Set, auto Share>
Number ofConfusion(const ChartPoint& point) {
    if (!point.errors) return std::nullopt;
    return percent(((*point.errors).*Set.*Share)());
}

Number predictedError(const ChartPoint& point) {
    if (!point.prediction) return std::nullopt;
    return point.prediction->error;
}

template <auto Motion>
Number predictedTime(const ChartPoint& point) {
    if (!point.prediction) return std::nullopt;
    return ((*point.prediction).*Motion).time;
}

Number intersectionOverUnion(const ChartPoint& point) {
    if (!point.errors) return std::nullopt;
    return point.errors->headline.intersectionOverUnion();
}

template <auto Cause>
Number ofCause(const ChartPoint& point) {
    if (!point.errors) return std::nullopt;
    return static_cast<double>(point.errors->causes.*Cause);
}

Number gap(const ChartPoint& point) { return point.errors ? point.errors->causes.gap : std::nullopt; }

template <auto Light, auto Pixels>
Number ofIntensity(const ChartPoint& point) {
    if (!point.errors) return std::nullopt;
    return (*point.errors).*Light.*Pixels;
}

Number dropped(const ChartPoint& point) {
    if (!point.errors) return std::nullopt;
    return 100.0 * point.errors->droppedShare;
}

Number flickerShare(const ChartPoint& point) { return percent(point.flickerShare); }

template <auto Part>
Number ofPoint(const ChartPoint& point) {
    return point.*Part;
}

using Cost = ChartCost;
using Time = AddedTime;
using Metrics = metrics::ShadowMetrics;
using metrics::BoundaryDistance;
using metrics::CauseSplit;
using metrics::Confusion;
using metrics::IntensityError;

} // namespace

const std::vector<PointNumber>& pointNumbers() {
    constexpr auto steady = &Cost::steadyWall, moving = &Cost::movingWall;
    constexpr auto steadyCpu = &Cost::steadyProcessor, movingCpu = &Cost::movingProcessor;
    constexpr auto away = &Metrics::headline, raw = &Metrics::raw;
    // clang-format off
    static const std::vector<PointNumber> numbers = {
        {"added_steady_wall_ms", "added, still light", "ms", "cost", true, ofTime<steady, &Time::median>},
        {"added_steady_wall_q1_ms", "added, still light, lower quartile", "ms", "cost", false, ofTime<steady, &Time::q1>},
        {"added_steady_wall_q3_ms", "added, still light, upper quartile", "ms", "cost", false, ofTime<steady, &Time::q3>},
        {"added_moving_wall_ms", "added, moving light", "ms", "cost", true, ofTime<moving, &Time::median>},
        {"added_moving_wall_q1_ms", "added, moving light, lower quartile", "ms", "cost", false, ofTime<moving, &Time::q1>},
        {"added_moving_wall_q3_ms", "added, moving light, upper quartile", "ms", "cost", false, ofTime<moving, &Time::q3>},
        {"added_first_ms", "added to the first frame", "ms", "cost", true, ofCost<&Cost::first>},
        {"added_steady_processor_ms", "processor time added, still light", "ms", "cost", true, ofTime<steadyCpu, &Time::median>},
        {"added_steady_processor_q1_ms", "processor time added, still light, lower quartile", "ms", "cost", false, ofTime<steadyCpu, &Time::q1>},
        {"added_steady_processor_q3_ms", "processor time added, still light, upper quartile", "ms", "cost", false, ofTime<steadyCpu, &Time::q3>},
        {"added_moving_processor_ms", "processor time added, moving light", "ms", "cost", false, ofTime<movingCpu, &Time::median>},
        {"added_moving_processor_q1_ms", "processor time added, moving light, lower quartile", "ms", "cost", false, ofTime<movingCpu, &Time::q1>},
        {"added_moving_processor_q3_ms", "processor time added, moving light, upper quartile", "ms", "cost", false, ofTime<movingCpu, &Time::q3>},
        {"memory_mib", "memory added", "MiB", "cost", true, ofCost<&Cost::memory>},
        {"draws", "draw calls in a frame", "", "cost", false, ofCost<&Cost::draws>},
        {"passes", "render passes in a frame", "", "cost", false, ofCost<&Cost::passes>},
        {"triangles", "triangles drawn in a frame", "", "cost", false, ofCost<&Cost::triangles>},

        {"boundary_p95_px", "boundary error, 95th percentile", "px", "accuracy", true, ofBoundary<&BoundaryDistance::p95>},
        {"boundary_mean_px", "boundary error, mean", "px", "accuracy", false, ofBoundary<&BoundaryDistance::mean>},
        {"boundary_max_px", "boundary error, maximum", "px", "accuracy", false, ofBoundary<&BoundaryDistance::max>},
        {"boundary_outwards_px", "boundary offset, mean, positive outwards", "px", "accuracy", false, ofBoundary<&BoundaryDistance::signedMean>},
        {"misclassified_percent", "misclassified pixels", "%", "accuracy", true, ofConfusion<away, &Confusion::misclassified>},
        {"false_shadow_percent", "false shadow, of lit pixels", "%", "accuracy", false, ofConfusion<away, &Confusion::falseShadowShare>},
        {"missed_shadow_percent", "missed shadow, of shadowed pixels", "%", "accuracy", false, ofConfusion<away, &Confusion::falseLitShare>},
        {"balanced_error_percent", "balanced error", "%", "accuracy", false, ofConfusion<away, &Confusion::balancedError>},
        {"misclassified_raw_percent", "misclassified pixels, with edges", "%", "accuracy", false, ofConfusion<raw, &Confusion::misclassified>},
        {"iou", "intersection over union", "", "accuracy", true, intersectionOverUnion},
        {"rmse_point_sun", "RMSE of the visibility, point sun", "", "accuracy", false, ofIntensity<&Metrics::pointSun, &IntensityError::all>},
        {"rmse_disc_sun", "RMSE of the visibility, sun's disc", "", "accuracy", false, ofIntensity<&Metrics::discSun, &IntensityError::all>},
        {"rmse_disc_sun_penumbra", "RMSE in penumbrae, sun's disc", "", "accuracy", false, ofIntensity<&Metrics::discSun, &IntensityError::penumbra>},
        {"rmse_thin", "RMSE, filtered by 4 × 4 px", "", "accuracy", false, ofIntensity<&Metrics::thin, &IntensityError::all>},
        {"shaded_rmse", "RMSE of the shaded picture", "", "accuracy", true, ofPoint<&ChartPoint::shadedRmse>},
        {"dropped_percent", "surface not judged", "%", "accuracy", false, dropped},

        {"acne_px", "acne", "px", "causes", false, ofCause<&CauseSplit::acne>},
        {"halo_px", "halo", "px", "causes", false, ofCause<&CauseSplit::halo>},
        {"peter_panning_px", "peter-panning", "px", "causes", false, ofCause<&CauseSplit::peterPanning>},
        {"leak_px", "leak", "px", "causes", false, ofCause<&CauseSplit::leak>},
        {"erosion_px", "erosion", "px", "causes", false, ofCause<&CauseSplit::erosion>},
        {"over_dark_px", "over-dark", "px", "causes", false, ofCause<&CauseSplit::overDark>},
        {"over_bright_px", "over-bright", "px", "causes", false, ofCause<&CauseSplit::overBright>},
        {"contact_gap_m", "gap at contact", "m", "causes", false, gap},

        {"predicted_boundary_p95_px", "boundary error that auto predicts", "px", "prediction", false, predictedError},
        {"predicted_steady_processor_ms", "processor time that auto predicts, still light", "ms", "prediction", false, predictedTime<&ChartPrediction::steady>},
        {"predicted_moving_processor_ms", "processor time that auto predicts, moving light", "ms", "prediction", false, predictedTime<&ChartPrediction::moving>},

        {"flicker_energy", "flicker energy", "", "stability", true, ofPoint<&ChartPoint::flickerEnergy>},
        {"flicker_share_percent", "pixels that flicker", "%", "stability", false, flickerShare},
        {"crawl_px", "edge crawl", "px", "stability", true, ofPoint<&ChartPoint::crawl>},
    };
    // clang-format on
    return numbers;
}

} // namespace gnomon::examples
