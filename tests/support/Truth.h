// SPDX-License-Identifier: MIT
#pragma once
#include <support/Mesh.h>
#include <support/Picture.h>

#include <gnomon/ShadowTruth.h>
#include <metrics/BoundaryDistance.h>
#include <osg/Vec4d>

#include <vector>

namespace test {

/// The truth image of what `node(mesh)` draws of these, each of which casts and receives.
/// @param sunAngle  degrees; 0: a sun without extent.
gnomon::TruthImage truthOf(const std::vector<Mesh>& meshes, const osg::Vec4d& light, const View& view,
                           double sunAngle = 0.0);

/// A picture against the truth, over pixels in which nothing but one plane is seen, in them and beside them, and which
/// face the light by more than a cosine of 0.05.
struct TruthComparison {
    int pixels = 0, shadowed = 0, edges = 0;
    int wrong = 0;   ///< on the other side of T_a = 1/2.
    int floor = 0;   ///< centre rays that are.
    int certain = 0; ///< of `wrong`, those that are no edge pixels.
    int neither = 0; ///< neither the lit nor the dark colour: must be 0.

    /// Misclassified <= 1.05 × floor + 0.01 %.
    bool good() const { return neither == 0 && wrong <= 1.05 * floor + 0.0001 * pixels; }
};
std::ostream& operator<<(std::ostream& out, const TruthComparison& result);

/// @param lit,dark  the same frame without shadows, and without the light's diffuse and specular.
TruthComparison compare(const Picture& actual, const Picture& lit, const Picture& dark,
                        const gnomon::TruthImage& truth);

/// How far shadows' edges are from the true ones, pixels, over the same pixels.
/// @throws std::bad_optional_access if the picture or the truth has no edge.
gnomon::metrics::BoundaryDistance edgesOff(const Picture& actual, const Picture& lit, const Picture& dark,
                                           const gnomon::TruthImage& truth);

/// How far the share of the light that arrives is from the true one, root of the mean square over the same pixels.
double shareOff(const Picture& actual, const Picture& lit, const Picture& dark, const gnomon::TruthImage& truth);

} // namespace test
