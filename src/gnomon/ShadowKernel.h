// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/HeightField.h>

#include <array>
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

constexpr std::size_t kernelPad = 16; ///< doubles that may be read and written beyond the end of an array.

/// Parts of the same topology, side by side: the k-th coordinate of corner c of part i is at (3 c + k) stride + i.
struct KernelHulls {
    std::size_t count, stride, corners, faces;
    const float* places;                    ///< of the corners, about their parts' anchors.
    const std::array<unsigned, 3>* triples; ///< see HullTopology::faces.
    const double *lightX, *lightY, *lightZ; ///< of each part, about its anchor.
    double lightW;
    double* planes;            ///< inwards: the k-th number of face f of part i at (4 f + k) stride + i.
    double* facing;            ///< above 0 if the light meets face f of part i, at f stride + i.
    double *size, *low, *high; ///< of each part: the square from its anchor to its farthest corner; its heights.
};

/// Rays downwards, and where they meet the ground. Places are on the grid.
struct KernelRays {
    std::size_t count;
    const double *u, *v, *z;  ///< start.
    const double *du, *dv;    ///< way in plan a unit of descent.
    double *descent, *height; ///< down to the ground, 0 from below it, NaN where not known; of the ground at the start.
    double* work;             ///< 6 (count + kernelPad) for the kernel's own use.
    unsigned* order;          ///< count + kernelPad, as well.
};

/// A part's shadow as a polygon: ranges of the arrays of KernelFans.
struct KernelFan {
    std::size_t edge, edges;    ///< of the silhouette, and of the polygon; one more is there: the first corner again.
    std::size_t face, faces;    ///< that the light meets.
    std::size_t query;          ///< rays of the corners, then of the edges' middles.
    std::size_t corners;        ///< of the polygon that are left, from `edge` on.
    std::size_t place;          ///< first of a place a triangle.
    double light[4];            ///< about the part's anchor.
    double u, v, z;             ///< of the anchor on the grid.
    double margin;              ///< that is in the ground.
    bool isOut, isKnown;        ///< some corner is over the ground; all of the rays' ends are known.
    double lenses, area, under; ///< twice: between edges and parabolas, of the polygon, of the silhouette in plan.
    double least, most;         ///< twice the triangles' areas.
    double lit;                 ///< twice the area in plan that holds no shadow.
};

/// Arrays of many fans, all about their own anchors. What is of edges has the places of the silhouette.
struct KernelFans {
    std::size_t count;
    KernelFan* fans;
    const double *sx, *sy, *sz;        ///< silhouette.
    double *ex, *ey, *ez, *ew, *along; ///< planes through its edges and the light; 1 where that stands upright.
    const double *fx, *fy, *fz, *fw;   ///< faces' planes, inwards.
    double scaleX, scaleY, wayX, wayY; ///< cells a unit; a sun's way in plan a unit of descent.
    KernelRays rays;                   ///< of the corners, and the middles of edges.
    double *u, *v, *z, *du, *dv;       ///< theirs, to be written.
    double *cx, *cy, *cz;              ///< the polygon.
    double *mx, *my;                   ///< where the middles of edges fall.
    double *px, *py, *pu, *pv, *pz;    ///< places in triangles; on the grid; the ground's height there.
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
    void (*face)(const KernelHulls& hulls);
    void (*edges)(const KernelFans& fans);   ///< their planes, and rays.
    void (*land)(const KernelFans& fans);    ///< where the rays end.
    void (*measure)(const KernelFans& fans); ///< the polygons.
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
