// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ground/HeightField.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace gnomon {

/// A HeightField as the kernel reads it. Places are in cells from its first post, heights over its base.
struct GridView {
    const float* heights;
    const CellCut* cuts; ///< nullptr: all cells are rising, none is a hole.
    int columns, rows;   ///< posts.
    bool isWhole;        ///< every post has a height.
};

constexpr std::size_t kernelPad = 16;  ///< doubles that may be read and written beyond the end of an array.
constexpr std::size_t kernelLanes = 8; ///< parts side by side in a block, a lane each; vectors have so many at most.
using KernelRow = std::array<double, kernelLanes>;

/// Parts of the same topology, in blocks: the k-th of a part's n numbers is at (n block + k) kernelLanes + lane.
struct KernelHulls {
    std::size_t blocks, corners, faces;
    float* places;                          ///< of the corners, about their parts' anchors: 3 corners; the first are 0.
    const std::array<unsigned, 3>* triples; ///< see HullTopology::faces.
    const double* lights;                   ///< of lamps, about each part's anchor: 3.
    double lightX, lightY, lightZ, lightW;  ///< of suns.
    double* planes;                         ///< inwards: 4 faces.
    std::uint64_t* lit;                     ///< a bit a face that the light meets: faces / 64 + 1.
    double* sizes;                          ///< from its anchor to its farthest corner: 1.
};

// Blocks of parts whose shadows are found as polygons; all about their own anchors.

struct alignas(64) KernelPart {
    KernelRow lightX, lightY, lightZ; ///< of lamps.
    KernelRow u, v, z, margin;        ///< of the anchor on the grid; that is in the ground.
    KernelRow corners;                ///< of the polygon that are left.
    KernelRow isOut, isUnknown;       ///< 1 if some corner is over the ground; if some ray's end is not known.
    KernelRow lenses, area, under; ///< twice: between edges and parabolas, of the polygon, of the silhouette in plan.
    KernelRow least, most;         ///< twice the triangles' areas.
    KernelRow lit;                 ///< twice the area in plan that holds no shadow.
};

/// From a corner of the silhouette to the next one.
struct alignas(64) KernelEdge {
    KernelRow x, y, z;                        ///< corner.
    KernelRow planeX, planeY, planeZ, planeW; ///< through the edge and the light, inwards.
    KernelRow along;                          ///< 1 where that stands upright.
    KernelRow endX, endY, endZ;               ///< the polygon's corner.
    KernelRow middleX, middleY;               ///< where the middle of the edge falls.
};

/// The plane of a face, inwards.
struct alignas(64) KernelFace {
    KernelRow x, y, z, w;
};

/// A ray downwards, and where it meets the ground. Places are on the grid.
struct alignas(64) KernelRay {
    KernelRow u, v, z; ///< start; where z is minus infinity nothing is asked.
    KernelRow du, dv;  ///< way in plan a unit of descent; of lamps alone.
    KernelRow descent,
        height; ///< down to the ground, 0 from below it, NaN where not known; of the ground at the start.
};

/// A place in a triangle; on the grid; the ground's height there.
struct alignas(64) KernelPlace {
    KernelRow x, y, u, v, z;
};

/// A block of parts of one topology, of which the light meets the same faces: where the block's own are.
struct KernelFan {
    std::size_t parts;       ///< that are there.
    std::size_t edge, edges; ///< of the silhouette, and of the polygon.
    std::size_t face, faces; ///< that the light meets.
    std::size_t ray;         ///< of the corners, then of the edges' middles.
    std::size_t place;       ///< one a triangle.
};

struct KernelFans {
    std::size_t count;
    const KernelFan* fans;
    KernelPart* parts; ///< one a fan.
    KernelEdge* edges;
    KernelFace* faces;
    KernelRay* rays;
    std::size_t rayCount;
    unsigned* order; ///< as many as rays and kernelPad, for the kernel's own use; numbers of rays or 0.
    KernelPlace* places;
    double lightX, lightY, lightZ, lightW; ///< of suns.
    double scaleX, scaleY, wayX, wayY;     ///< cells a unit; a sun's way in plan a unit of descent.
};

/// Parts of KernelHulls that become a block: what of them is its silhouette, and its faces.
struct KernelChoice {
    std::array<std::size_t, kernelLanes> parts;
    const unsigned *corners, *faces;
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
    void (*cast)(const GridView& grid, const KernelFans& fans);
    /// @param lanes  of each place that are asked.
    void (*heights)(const GridView& grid, KernelPlace* places, std::size_t count, std::size_t lanes);
    /// Corners of a block's parts but for the first ones, which are 0, side by side. @param from  of each.
    void (*pack)(const std::array<const float*, kernelLanes>& from, std::size_t numbers, float* to);
    void (*face)(const KernelHulls& hulls);
    void (*choose)(const KernelHulls& hulls, const KernelChoice& choice, const KernelFans& fans, std::size_t fan);
    void (*edges)(const KernelFans& fans); ///< their planes.
    void (*rays)(const KernelFans& fans);
    void (*land)(const KernelFans& fans);    ///< where the rays end.
    void (*measure)(const KernelFans& fans); ///< the polygons.
    void (*places)(const KernelFans& fans);
    void (*judge)(const KernelFans& fans);
    /// @param planes  x, y, z, w of each, `mostKernelPlanes` at most.
    void (*sides)(const KernelPoints& points, const double* planes, std::size_t count);
};

/// All that this machine can run, one a set of instructions: the first without SIMD, the last the best.
const std::vector<ShadowKernel>& shadowKernels();
/// The best of them.
inline const ShadowKernel& bestShadowKernel() { return shadowKernels().back(); }

} // namespace gnomon
