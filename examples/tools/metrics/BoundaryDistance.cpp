// SPDX-License-Identifier: MIT
#include <metrics/BoundaryDistance.h>
#include <metrics/NearestSegment.h>

#include <algorithm>
#include <cmath>

namespace gnomon::metrics {
namespace {

constexpr double level = 0.5;
constexpr double step = 0.5; // px

/// A piece of a boundary.
struct Sample {
    double distance; ///< px, to the other boundary
    double side;     ///< +1 if it tells of dilation, -1 of erosion
    double length;   ///< px
};

/// The picture between pixel centres; `place` lies within a square of them.
double bilinear(const Picture& picture, const glm::dvec2& place) {
    const double u = place.x - 0.5, v = place.y - 0.5;
    const int x = std::clamp(static_cast<int>(u), 0, picture.width - 2);
    const int y = std::clamp(static_cast<int>(v), 0, picture.height - 2);
    const double fx = u - x, fy = v - y;
    const double low = picture.at(x, y) * (1 - fx) + picture.at(x + 1, y) * fx;
    const double high = picture.at(x, y + 1) * (1 - fx) + picture.at(x + 1, y + 1) * fx;
    return low * (1 - fy) + high * fy;
}

/// Samples of `line` against the boundary of `other`; `litSide` is what a place lit in `other` tells.
void addSamples(const std::vector<Segment>& line, const NearestSegment& nearest, const Picture& other, double litSide,
                std::vector<Sample>& samples) {
    for (const Segment& segment : line) {
        const int pieces = static_cast<int>(std::ceil(length(segment) / step));
        for (int i = 0; i < pieces; ++i) {
            const glm::dvec2 middle = segment.from + (segment.to - segment.from) * ((i + 0.5) / pieces);
            const double side = bilinear(other, middle) >= level ? litSide : -litSide;
            samples.push_back({nearest.distance(middle), side, length(segment) / pieces});
        }
    }
}

double totalLength(const std::vector<Segment>& line) {
    double sum = 0.0;
    for (const Segment& segment : line) sum += length(segment);
    return sum;
}

/// The distance below which `share` of the length lies.
double percentile(std::vector<Sample>& samples, double share, double total) {
    std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.distance < b.distance; });
    double sum = 0.0;
    for (const Sample& sample : samples)
        if ((sum += sample.length) >= share * total) return sample.distance;
    return samples.back().distance;
}

BoundaryDistance summary(std::vector<Sample>& samples, double drawnLength, double trueLength) {
    BoundaryDistance result;
    result.drawnLength = drawnLength;
    result.trueLength = trueLength;
    const double total = drawnLength + trueLength;
    result.p95 = percentile(samples, 0.95, total);
    result.max = samples.back().distance;
    for (const Sample& sample : samples) {
        result.mean += sample.distance * sample.length / total;
        result.signedMean += sample.side * sample.distance * sample.length / total;
    }
    return result;
}

} // namespace

std::optional<BoundaryDistance> boundaryDistance(const Picture& visibility, const Picture& lit, const Mask& within) {
    const std::vector<Segment> drawn = isoLine(visibility, level, within), truth = isoLine(lit, level, within);
    if (drawn.empty() || truth.empty()) return std::nullopt;
    std::vector<Sample> samples;
    addSamples(drawn, NearestSegment(truth), lit, 1.0, samples);         // drawn where it is lit: dilated
    addSamples(truth, NearestSegment(drawn), visibility, -1.0, samples); // true where it is drawn lit: eroded
    return summary(samples, totalLength(drawn), totalLength(truth));
}

} // namespace gnomon::metrics
