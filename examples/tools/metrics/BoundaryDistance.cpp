// SPDX-License-Identifier: MIT
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <metrics/BoundaryDistance.h>
#include <nanoflann.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::metrics {
namespace {

/// Corners of a square of pixel centres, anticlockwise from the lower left.
constexpr std::array<std::array<int, 2>, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

/// A square of four pixel centres, its values taken relative to the level.
struct Square {
    int x, y;
    std::array<double, 4> value;

    bool below(std::size_t corner) const { return value[corner % 4] < 0.0; }
    glm::dvec2 place(std::size_t corner) const { return {x + corners[corner][0] + 0.5, y + corners[corner][1] + 0.5}; }
    /// Where the level is passed between a corner and the next.
    glm::dvec2 crossing(std::size_t side) const {
        const std::size_t next = (side + 1) % 4;
        const double along = value[side] / (value[side] - value[next]);
        return place(side) + along * (place(next) - place(side));
    }
};

void add(std::vector<Segment>& line, const glm::dvec2& from, const glm::dvec2& to) {
    if (from != to) line.push_back({from, to});
}

/// Sides 0 to 3 are all crossed: corners 0 and 2 are alike, 1 and 3 the others. The mean tells which are joined.
void addSaddle(std::vector<Segment>& line, const Square& square) {
    const double middle = square.value[0] + square.value[1] + square.value[2] + square.value[3];
    const std::size_t first = square.below(0) == (middle < 0.0) ? 0 : 1; // corners 0 and 2 joined: cut 1 and 3 off
    for (const std::size_t side : {first, first + 2}) add(line, square.crossing(side), square.crossing((side + 1) % 4));
}

void addPieces(std::vector<Segment>& line, const Square& square) {
    std::array<std::size_t, 4> crossed{};
    std::size_t sides = 0;
    for (std::size_t side = 0; side < 4; ++side)
        if (square.below(side) != square.below(side + 1)) crossed[sides++] = side;
    if (sides == 2) add(line, square.crossing(crossed[0]), square.crossing(crossed[1]));
    if (sides == 4) addSaddle(line, square);
}

bool allWithin(const Mask& within, int x, int y) {
    return within.at(x, y) && within.at(x + 1, y) && within.at(x, y + 1) && within.at(x + 1, y + 1);
}

Square squareAt(const Picture& picture, double level, int x, int y) {
    return {x,
            y,
            {picture.at(x, y) - level, picture.at(x + 1, y) - level, picture.at(x + 1, y + 1) - level,
             picture.at(x, y + 1) - level}};
}

/// Half the diagonal of a pixel: how far a segment reaches from its middle.
constexpr double reach = 0.70710678118654757;

/// What nanoflann asks of a set of points: here the segments' middles.
struct Middles {
    const std::vector<Segment>& segments;

    std::size_t kdtree_get_point_count() const { return segments.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const {
        const int a = static_cast<int>(axis);
        return 0.5 * (segments[i].from[a] + segments[i].to[a]);
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

/// What nanoflann asks of a result: the nearest segment so far, to whose distance `reach` must be added before a middle
/// is too far away to matter.
struct Nearest {
    using DistanceType = double;

    const std::vector<Segment>& segments;
    const glm::dvec2& point;
    double best = std::numeric_limits<double>::infinity();

    std::size_t size() const { return 1; }
    bool full() const { return best < std::numeric_limits<double>::infinity(); }
    double worstDist() const { return (best + reach) * (best + reach); }
    bool addPoint(double, std::size_t i) {
        best = std::min(best, distance(segments[i], point));
        return true;
    }
    void sort() {} // there is one; nanoflann asks since 1.5
};

using Index =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Middles>, Middles, 2, std::size_t>;

} // namespace

double length(const Segment& segment) { return glm::distance(segment.from, segment.to); }

double distance(const Segment& segment, const glm::dvec2& point) {
    const glm::dvec2 along = segment.to - segment.from;
    const double share = glm::dot(point - segment.from, along) / glm::dot(along, along);
    return glm::distance(point, segment.from + std::clamp(share, 0.0, 1.0) * along);
}

std::vector<Segment> isoLine(const Picture& picture, double level, const Mask& within) {
    std::vector<Segment> line;
    for (int y = 0; y + 1 < picture.height; ++y)
        for (int x = 0; x + 1 < picture.width; ++x)
            if (allWithin(within, x, y)) addPieces(line, squareAt(picture, level, x, y));
    return line;
}

struct NearestSegment::Tree {
    explicit Tree(const std::vector<Segment>& all) : segments(all), middles{segments}, index(2, middles) {}
    const std::vector<Segment>& segments;
    Middles middles;
    Index index;
};

NearestSegment::NearestSegment(const std::vector<Segment>& segments) : _tree(std::make_unique<Tree>(segments)) {}
NearestSegment::~NearestSegment() = default;

double NearestSegment::distance(const glm::dvec2& point) const {
    Nearest nearest{_tree->segments, point};
    if (!_tree->segments.empty()) _tree->index.findNeighbors(nearest, glm::value_ptr(point), {});
    return nearest.best;
}

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
