// SPDX-License-Identifier: MIT
#include "Curves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon::examples {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

AddedTime timeOf(const ChartPoint& point, LightMotion light) {
    if (!point.cost) return {nan, nan, nan};
    return light == LightMotion::Still ? point.cost->steadyWall : point.cost->movingWall;
}

double errorOf(const ChartPoint& point) {
    const bool known = point.failure.empty() && point.errors && point.errors->boundary;
    return known ? point.errors->boundary->p95 : infinity;
}

CurvePoint curvePoint(const ChartPoint& point, LightMotion light) {
    return {point.setting, timeOf(point, light), errorOf(point), point.catastrophic(), 1};
}

/// The curve of this technique; a new one if there is none yet.
Curve& curveOf(std::vector<Curve>& curves, const ChartPoint& point) {
    const auto same = [&](const Curve& c) { return c.kit == point.kit && c.technique == point.technique; };
    const auto found = std::find_if(curves.begin(), curves.end(), same);
    if (found != curves.end()) return *found;
    return curves.emplace_back(Curve{point.kit, point.technique, {}});
}

/// All points of one technique at one setting.
using Group = std::vector<CurvePoint>;

double medianOf(const Group& group, double (*value)(const CurvePoint&)) {
    std::vector<double> values;
    for (const CurvePoint& point : group) values.push_back(value(point));
    return median(values);
}

AddedTime medianTime(Group group) {
    const auto untimed = [](const CurvePoint& p) { return !std::isfinite(p.time.median); };
    group.erase(std::remove_if(group.begin(), group.end(), untimed), group.end());
    return {medianOf(group, [](const CurvePoint& p) { return p.time.q1; }),
            medianOf(group, [](const CurvePoint& p) { return p.time.median; }),
            medianOf(group, [](const CurvePoint& p) { return p.time.q3; })};
}

CurvePoint pooled(const Group& group) {
    const bool anyBad = std::any_of(group.begin(), group.end(), [](const CurvePoint& p) { return p.catastrophic; });
    const double error = medianOf(group, [](const CurvePoint& p) { return p.error; });
    return {group.front().setting, medianTime(group), error, anyBad, group.size()};
}

/// Points of the same setting become one, in the order of their first.
Curve pooled(const Curve& all) {
    std::vector<Group> groups;
    for (const CurvePoint& point : all.points) {
        const auto same = [&](const Group& g) { return g.front().setting == point.setting; };
        const auto found = std::find_if(groups.begin(), groups.end(), same);
        (found != groups.end() ? *found : groups.emplace_back()).push_back(point);
    }
    Curve curve{all.kit, all.technique, {}};
    for (const Group& group : groups) curve.points.push_back(pooled(group));
    return curve;
}

} // namespace

bool CurvePoint::shown() const { return std::isfinite(time.median) && std::isfinite(error); }

double median(std::vector<double> values) {
    if (values.empty()) return nan;
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<Curve> sceneCurves(const ChartResults& results, const std::string& scene, LightMotion light) {
    std::vector<Curve> curves;
    for (const ChartPoint& point : results.points)
        if (point.scene == scene) curveOf(curves, point).points.push_back(curvePoint(point, light));
    return curves;
}

std::vector<Curve> pooledCurves(const ChartResults& results, LightMotion light) {
    std::vector<Curve> all;
    for (const ChartPoint& point : results.points) curveOf(all, point).points.push_back(curvePoint(point, light));
    std::transform(all.begin(), all.end(), all.begin(), [](const Curve& curve) { return pooled(curve); });
    return all;
}

std::vector<BestPoint> soundPoints(const std::vector<Curve>& curves) {
    std::vector<BestPoint> sound;
    for (const Curve& curve : curves)
        for (const CurvePoint& point : curve.points)
            if (point.shown() && !point.catastrophic) sound.push_back({&curve, &point});
    return sound;
}

std::vector<BestPoint> staircase(const std::vector<Curve>& curves) {
    std::vector<BestPoint> all = soundPoints(curves), best;
    std::stable_sort(all.begin(), all.end(), [](const BestPoint& a, const BestPoint& b) {
        return std::pair(a.point->time.median, a.point->error) < std::pair(b.point->time.median, b.point->error);
    });
    for (const BestPoint& next : all)
        if (best.empty() || next.point->error < best.back().point->error) best.push_back(next);
    return best;
}

std::optional<double> boundaryFloor(const ChartResults& results, const std::string& scene) {
    std::vector<double> floors;
    for (const ChartSceneResult& each : results.scenes)
        if ((scene.empty() || each.name == scene) && each.boundaryFloor) floors.push_back(*each.boundaryFloor);
    if (floors.empty()) return std::nullopt;
    return median(floors);
}

} // namespace gnomon::examples
