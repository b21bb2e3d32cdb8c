// SPDX-License-Identifier: MIT
#pragma once
#include <support/Mesh.h>
#include <support/Picture.h>

#include <osg/Vec4d>

#include <vector>

namespace test {

/// What a ray through a pixel's centre says, in double and without any of Gnomon's code.
enum class Seen { Nothing, Caster, LitReceiver, ShadowedReceiver };

struct Mask {
    int width = 0, height = 0;
    std::vector<Seen> pixels;

    Seen at(int x, int y) const { return pixels[static_cast<std::size_t>(y * width + x)]; }
    int count(Seen what) const;
    /// True if a pixel up to `reach` from this one, along either axis, says something else: sampling may decide either way
    /// there.
    bool atEdge(int x, int y, int reach = 1) const;
};

/// Casts a ray a pixel against all triangles and, where it meets the receiver first, one towards the light against the
/// casters.
/// @param clear  casters that one looks through.
Mask castRays(const Mesh& receiver, const std::vector<Mesh>& casters, const osg::Vec4d& light, const View& view,
              const std::vector<Mesh>& clear = {});

/// Share of a pixel beyond a line, by 64 × 64 places in it. @param across  unit. @param middle  how far its middle is beyond, pixels.
double coverage(const glm::dvec3& across, double middle);

/// The picture that ought to be: `lit`, but `dark` where the mask says shadow. Neither is drawn with Gnomon.
struct Comparison {
    int wrongInside = 0; ///< pixels away from edges that are not the expected colour: must be 0.
    int wrongAtEdge = 0; ///< pixels at edges that are neither the lit nor the dark colour: must be 0.
    int flipped = 0;     ///< pixels at edges where the rasteriser decided otherwise than the ray through the centre.
    int edges = 0;
};
/// @param reach  see Mask::atEdge().
Comparison compare(const Picture& actual, const Picture& lit, const Picture& dark, const Mask& mask, int reach = 1);

} // namespace test
