// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>
#include <metrics/Grid.h>

#include <memory>
#include <optional>
#include <vector>

namespace gnomon::metrics {

/// A straight piece of a line in a picture, at most √2 px long.
struct Segment {
    glm::dvec2 from; ///< Start, px.
    glm::dvec2 to;   ///< End, px.
};

/// Length of a segment, px.
double length(const Segment& segment);
/// Distance from a point to the nearest point of a segment, px.
double distance(const Segment& segment, const glm::dvec2& point);

/// Finds the line where a picture crosses `level`, by marching squares between pixel centres.
///
/// The line is exact for a picture that is linear in x and y. Saddles are cut by the mean of their corners. Pieces
/// without length are left out.
///
/// @param picture  values at pixel centres.
/// @param level    a pixel is below if its value < level.
/// @param within   only squares whose four corners are in this set count.
///
/// Source
/// - W. Lorensen and H. Cline, "Marching Cubes", SIGGRAPH 1987, in two dimensions.
std::vector<Segment> isoLine(const Picture& picture, double level, const Mask& within);

/// Finds the exact distance from a point to the nearest of many short segments.
///
/// Cost
/// - A k-d tree over the segments' midpoints; a search in it for each point.
/// Threads
/// - Any number may ask one object.
class NearestSegment {
public:
    /// Builds the tree.
    /// @param segments  each at most √2 px long, as isoLine() makes them. They must outlive this object.
    explicit NearestSegment(const std::vector<Segment>& segments);
    ~NearestSegment();
    NearestSegment(const NearestSegment&) = delete;
    NearestSegment& operator=(const NearestSegment&) = delete;

    /// Distance from a point to the nearest segment, px. Infinity if there is no segment.
    double distance(const glm::dvec2& point) const;

private:
    struct Tree;
    std::unique_ptr<Tree> _tree;
};

/// M4: distance between the drawn boundary of a shadow (V = 0.5) and the true one (T_a = 0.5), px.
///
/// Both boundaries are cut into pieces of at most 0.5 px. Each piece gives the distance from its midpoint to the
/// nearest point of the other boundary, weighted by its length.
/// For metres, use an orthographic camera that looks straight down: pixels of a perspective view are not metres.
struct BoundaryDistance {
    double mean = 0.0;        ///< Mean distance.
    double p95 = 0.0;         ///< 95th percentile of the distances: the headline of accuracy.
    double max = 0.0;         ///< Greatest (Hausdorff) distance. A single pixel of acne sets it: a flag of stability.
    double signedMean = 0.0;  ///< Mean with a sign: + if the drawn shadow is too large, - if it is too small.
    double drawnLength = 0.0; ///< Length of the drawn boundary.
    double trueLength = 0.0;  ///< Length of the true boundary.
};

/// Measures M4.
///
/// @param visibility  V, finite in `within`.
/// @param lit         T_a, finite in `within`. All three have one size.
/// @param within      R+. Only squares of four such pixel centres count.
/// @return            nullopt unless both boundaries exist.
///
/// If V is hard, 0 or 1 at pixel centres, each place of its boundary is known to half a pixel. The mean over a slanting
/// edge is much more precise.
///
/// Source
/// - D. Huttenlocher et al., "Comparing images using the Hausdorff distance", PAMI 1993.
std::optional<BoundaryDistance> boundaryDistance(const Picture& visibility, const Picture& lit, const Mask& within);

} // namespace gnomon::metrics
