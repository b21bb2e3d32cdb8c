// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HeightField.h>

#include <cstddef>
#include <string>
#include <vector>

namespace gnomon {

/// A HeightField as the kernel reads it. Places are in cells from its first post, heights over its base.
struct GridView {
    const float* heights;
    const CellCut* cuts; ///< nullptr: all cells are rising, none is a hole.
    int columns, rows;   ///< posts.
};

/// Rays downwards, and where they meet the ground.
struct KernelRays {
    std::size_t count;
    const double *u, *v, *z;  ///< start.
    const double *du, *dv;    ///< way in plan a unit of descent.
    double *descent, *height; ///< down to the ground, 0 from below it, NaN where not known; of the ground at the start.
};

/// A polygon that is to be judged: its silhouette, the flat faces that the light meets, and where the corners' rays end, as
/// ranges of the arrays of KernelFans.
struct KernelFan {
    std::size_t edge, edges; ///< in the arrays of the silhouette; one more is there: the first corner again.
    std::size_t face, faces;
    std::size_t corner, corners; ///< of the polygon.
    std::size_t place;           ///< first of a place a triangle.
    double light[4];             ///< about the part's anchor.
    double u, v, z;              ///< of the anchor on the grid.
};

constexpr std::size_t kernelPad = 16; ///< doubles that may be read and written beyond the end of an array.

/// Arrays of many fans, all about their own anchors.
struct KernelFans {
    std::size_t count;
    const KernelFan* fans;
    const double *sx, *sy, *sz;        ///< silhouette.
    double *ex, *ey, *ez, *ew, *along; ///< planes through its edges and the light; 1 where that stands upright.
    const double *fx, *fy, *fz, *fw;   ///< faces' planes, inwards.
    const double *cx, *cy;             ///< polygons' corners in plan.
    double scaleX, scaleY;             ///< cells a unit.
    double *px, *py, *pu, *pv, *pz;    ///< places in triangles; on the grid; the ground's height there.
    double* lit;                       ///< twice the area in plan that holds no shadow, a fan.
};

constexpr std::size_t mostKernelPlanes = 48;

/// Points that planes are asked at.
struct KernelPoints {
    std::size_t count;
    const double *x, *y, *z;
    double* outside; ///< the sum of 2^i for each plane i that the point is on the outer side of.
};

/// What runs on as many lanes as there are. Each has the same bits on every set of instructions: products and sums are
/// rounded one by one, and no lane knows of another.
struct ShadowKernel {
    const char* instructions;
    void (*cast)(const GridView& grid, const KernelRays& rays);
    void (*heights)(const GridView& grid, const double* u, const double* v, double* z, std::size_t count);
    void (*edges)(const KernelFans& fans);
    void (*places)(const KernelFans& fans);
    void (*judge)(const KernelFans& fans);
    /// @param planes  x, y, z, w of each, `mostKernelPlanes` at most.
    void (*sides)(const KernelPoints& points, const double* planes, std::size_t count);
};

/// For the best instructions that this machine has, or those chosen.
const ShadowKernel& shadowKernel();
/// For tests and benchmarks; first those without SIMD, last the best. Not thread-safe.
std::vector<std::string> shadowKernels();
void chooseShadowKernel(const std::string& instructions);

} // namespace gnomon
