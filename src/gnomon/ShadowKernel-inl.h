// SPDX-License-Identifier: MIT
// No include guard: ShadowKernel.cpp compiles it once for each set of instructions.
#include <gnomon/ShadowKernel.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace gnomon {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using Half = hn::Rebind<float, D>;
using Bits = hn::Rebind<std::uint64_t, D>;

constexpr int mostSteps = 16;   // of a ray from triangle to triangle: then it is left to others
constexpr std::size_t wide = 2; // vectors at once, so that one computes while another waits for memory

HWY_INLINE V set(double value) { return hn::Set(D(), value); }

/// Two posts side by side, of each lane.
struct Pair {
    V left, right;
};

HWY_INLINE Pair pairAt(const float* heights, hn::Vec<Bits> place) {
    const Bits bits;
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
    const hn::RebindToSigned<Bits> ints;
    const auto both = hn::GatherOffset(bits, reinterpret_cast<const std::uint64_t*>(heights),
                                       hn::BitCast(ints, hn::ShiftLeft<2>(place)));
    const auto low = hn::TruncateTo(hn::Rebind<std::uint32_t, D>(), both),
               high = hn::TruncateTo(hn::Rebind<std::uint32_t, D>(), hn::ShiftRight<32>(both));
    return {hn::PromoteTo(D(), hn::BitCast(Half(), low)), hn::PromoteTo(D(), hn::BitCast(Half(), high))};
#else
    HWY_ALIGN std::uint64_t places[HWY_MAX_BYTES / 8];
    HWY_ALIGN double left[HWY_MAX_BYTES / 8], right[HWY_MAX_BYTES / 8];
    hn::Store(place, bits, places);
    for (std::size_t i = 0; i < hn::Lanes(bits); ++i) {
        left[i] = double(heights[places[i]]);
        right[i] = double(heights[places[i] + 1]);
    }
    return {hn::Load(D(), left), hn::Load(D(), right)};
#endif
}

/// A triangle of the grid.
struct Cell {
    V number, u, v; ///< of the cell; place in it.
    M right;        ///< in its lower right triangle, or its lower left one.
};

struct Plane {
    V height, alongU, alongV; ///< at the place; slopes.
};

class Grid {
public:
    explicit Grid(const GridView& view)
        : _view(view), _mostU(set(view.columns - 2)), _mostV(set(view.rows - 2)), _stride(set(view.columns)) {}

    /// Of the nearest cell, for a place that is beside the grid.
    HWY_INLINE Cell cell(V u, V v) const {
        const V zero = hn::Zero(D());
        const V i = hn::Min(hn::Max(hn::Floor(u), zero), _mostU), j = hn::Min(hn::Max(hn::Floor(v), zero), _mostV);
        Cell cell{hn::Add(hn::Mul(j, _stride), i), hn::Sub(u, i), hn::Sub(v, j), {}};
        cell.right = hn::Ge(cell.u, cell.v);
        if (_view.cuts) {
            const M falling = cutIs(cell.number, j, CellCut::falling);
            cell.right =
                hn::Or(hn::AndNot(falling, cell.right), hn::And(falling, hn::Le(hn::Add(cell.u, cell.v), set(1.0))));
        }
        return cell;
    }

    HWY_INLINE Plane plane(const Cell& cell) const {
        const auto place = placeOf(cell.number);
        const Pair below = pairAt(_view.heights, place), above = pairAt(_view.heights + _view.columns, place);
        const V a = below.left, b = below.right, d = above.left, c = above.right;
        const V ba = hn::Sub(b, a), cd = hn::Sub(c, d), cb = hn::Sub(c, b), da = hn::Sub(d, a);
        Plane plane{a, hn::IfThenElse(cell.right, ba, cd), hn::IfThenElse(cell.right, cb, da)};
        if (_view.cuts) {
            const V j = hn::Floor(hn::Div(cell.number, _stride));
            const M falling = cutIs(cell.number, j, CellCut::falling);
            plane.alongV = hn::IfThenElse(falling, hn::IfThenElse(cell.right, da, cb), plane.alongV);
            plane.height = hn::IfThenElse(hn::AndNot(cell.right, falling), hn::Sub(hn::Add(b, d), c), a);
            plane.height = hn::IfThenElse(cutIs(cell.number, j, CellCut::hole), set(std::nan("")), plane.height);
        }
        // A corner without a height makes a hole of all of the cell.
        const V none = hn::Mul(hn::Add(hn::Add(ba, cd), hn::Add(cb, da)), hn::Zero(D()));
        plane.height =
            hn::Add(hn::Add(plane.height, none), hn::Add(hn::Mul(cell.u, plane.alongU), hn::Mul(cell.v, plane.alongV)));
        return plane;
    }

    HWY_INLINE M holds(V u, V v) const {
        const V zero = hn::Zero(D()), one = set(1.0);
        return hn::And(hn::And(hn::Ge(u, zero), hn::Ge(v, zero)),
                       hn::And(hn::Le(u, hn::Add(_mostU, one)), hn::Le(v, hn::Add(_mostV, one))));
    }

private:
    /// A whole number from 0 to 2^52 as an integer.
    HWY_INLINE hn::Vec<Bits> placeOf(V number) const {
        const V magic = set(4503599627370496.0);
        return hn::Xor(hn::BitCast(Bits(), hn::Add(number, magic)), hn::BitCast(Bits(), magic));
    }
    HWY_INLINE M cutIs(V number, V row, CellCut cut) const {
        HWY_ALIGN std::uint64_t places[HWY_MAX_BYTES / 8];
        HWY_ALIGN double is[HWY_MAX_BYTES / 8];
        hn::Store(placeOf(hn::Sub(number, row)), Bits(), places); // a row has a cell less than it has posts
        for (std::size_t i = 0; i < hn::Lanes(D()); ++i) is[i] = _view.cuts[places[i]] == cut ? 1.0 : 0.0;
        return hn::Gt(hn::Load(D(), is), hn::Zero(D()));
    }

    const GridView& _view;
    const V _mostU, _mostV, _stride;
};

/// A ray on its way down, from triangle to triangle.
struct Ray {
    V u, v, z, du, dv, descent, height, number;
    M right, done;
};

HWY_INLINE void start(Ray& ray, const Grid& grid, const KernelRays& rays, std::size_t at) {
    const D d;
    ray.u = hn::LoadU(d, rays.u + at);
    ray.v = hn::LoadU(d, rays.v + at);
    ray.z = hn::LoadU(d, rays.z + at);
    ray.du = hn::LoadU(d, rays.du + at);
    ray.dv = hn::LoadU(d, rays.dv + at);
    const Cell cell = grid.cell(ray.u, ray.v);
    const Plane plane = grid.plane(cell);
    const V none = set(std::nan(""));
    ray.height = hn::IfThenElse(grid.holds(ray.u, ray.v), plane.height, none);
    const V gap = hn::Sub(ray.z, ray.height);
    const V slope = hn::Add(hn::Mul(plane.alongU, ray.du), hn::Mul(plane.alongV, ray.dv));
    const M isBelow = hn::Le(gap, hn::Zero(d));
    ray.descent = hn::IfThenElse(isBelow, hn::Zero(d), hn::Div(gap, hn::Add(set(1.0), slope)));
    ray.done = hn::Or(isBelow, hn::IsNaN(ray.descent));
    ray.number = cell.number;
    ray.right = cell.right;
}

/// To where it meets the plane of the triangle that it is over: the last step is the one that stays in its triangle.
HWY_INLINE void step(Ray& ray, const Grid& grid) {
    const V u = hn::Add(ray.u, hn::Mul(ray.descent, ray.du)), v = hn::Add(ray.v, hn::Mul(ray.descent, ray.dv));
    const Cell cell = grid.cell(u, v);
    const M same = hn::And(hn::Eq(cell.number, ray.number), hn::Not(hn::Xor(cell.right, ray.right)));
    const V beside = hn::IfThenElse(grid.holds(u, v), ray.descent, set(std::nan("")));
    ray.descent = hn::IfThenElse(hn::AndNot(ray.done, same), beside, ray.descent);
    ray.done = hn::Or(ray.done, same);
    const Plane plane = grid.plane(cell);
    const V gap = hn::Sub(hn::Sub(ray.z, ray.descent), plane.height);
    const V slope = hn::Add(hn::Mul(plane.alongU, ray.du), hn::Mul(plane.alongV, ray.dv));
    const V next = hn::Add(ray.descent, hn::Div(gap, hn::Add(set(1.0), slope)));
    ray.descent = hn::IfThenElse(ray.done, ray.descent, next);
    ray.number = cell.number;
    ray.right = cell.right;
}

void cast(const GridView& view, const KernelRays& rays) {
    const D d;
    const Grid grid(view);
    const std::size_t lanes = hn::Lanes(d);
    for (std::size_t at = 0; at < rays.count; at += wide * lanes) {
        Ray group[wide];
        for (std::size_t k = 0; k < wide; ++k) start(group[k], grid, rays, at + k * lanes);
        for (int i = 0; i < mostSteps; ++i) {
            if (hn::AllTrue(d, hn::And(group[0].done, group[1].done))) break;
            for (std::size_t k = 0; k < wide; ++k) step(group[k], grid);
        }
        for (std::size_t k = 0; k < wide; ++k) {
            hn::StoreU(hn::IfThenElse(group[k].done, group[k].descent, set(std::nan(""))), d,
                       rays.descent + at + k * lanes);
            hn::StoreU(group[k].height, d, rays.height + at + k * lanes);
        }
    }
}

void heights(const GridView& view, const double* u, const double* v, double* z, std::size_t count) {
    const D d;
    const Grid grid(view);
    for (std::size_t at = 0; at < count; at += hn::Lanes(d)) {
        const V atU = hn::LoadU(d, u + at), atV = hn::LoadU(d, v + at);
        const Plane plane = grid.plane(grid.cell(atU, atV));
        hn::StoreU(hn::IfThenElse(grid.holds(atU, atV), plane.height, set(std::nan(""))), d, z + at);
    }
}

struct V3 {
    V x, y, z;
};
HWY_INLINE V3 minus(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V dot(const V3& a, const V3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

/// An edge that points at the light has no plane.
HWY_INLINE void edgesOf(const KernelFans& all, const KernelFan& fan) {
    const D d;
    for (std::size_t i = fan.edge; i < fan.edge + fan.edges; i += hn::Lanes(d)) {
        const V3 a{hn::LoadU(d, all.sx + i), hn::LoadU(d, all.sy + i), hn::LoadU(d, all.sz + i)};
        const V3 b{hn::LoadU(d, all.sx + i + 1), hn::LoadU(d, all.sy + i + 1), hn::LoadU(d, all.sz + i + 1)};
        const V w = set(fan.light[3]);
        const V3 towards = minus({set(fan.light[0]), set(fan.light[1]), set(fan.light[2])},
                                 {hn::Mul(w, a.x), hn::Mul(w, a.y), hn::Mul(w, a.z)});
        const V3 edge = minus(b, a), normal = cross(towards, edge);
        const V size = dot(normal, normal), whole = hn::Mul(dot(towards, towards), dot(edge, edge));
        const M isPlane = hn::Gt(size, hn::Mul(set(1e-28), whole));
        const M leans = hn::Gt(hn::Mul(normal.z, normal.z), hn::Mul(set(1e-18), size));
        hn::StoreU(hn::IfThenElseZero(isPlane, normal.x), d, all.ex + i);
        hn::StoreU(hn::IfThenElseZero(isPlane, normal.y), d, all.ey + i);
        hn::StoreU(hn::IfThenElseZero(isPlane, normal.z), d, all.ez + i);
        hn::StoreU(hn::IfThenElseZero(isPlane, hn::Neg(dot(normal, a))), d, all.ew + i);
        hn::StoreU(hn::IfThenElse(leans, hn::Zero(d), set(1.0)), d, all.along + i);
    }
}

void edges(const KernelFans& all) {
    for (std::size_t i = 0; i < all.count; ++i) edgesOf(all, all.fans[i]);
}

/// The middles of triangles. Vectors end in what comes after and is written later.
HWY_INLINE void placesOf(const KernelFans& all, const KernelFan& fan) {
    const D d;
    const std::size_t triangles = fan.corners - 2;
    const V ax = set(all.cx[fan.corner]), ay = set(all.cy[fan.corner]), third = set(1.0 / 3.0);
    for (std::size_t t = 0; t < triangles; t += hn::Lanes(d)) {
        const std::size_t at = fan.place + t, b = fan.corner + t + 1, c = b + 1;
        const V px = hn::Mul(hn::Add(hn::Add(ax, hn::LoadU(d, all.cx + b)), hn::LoadU(d, all.cx + c)), third);
        const V py = hn::Mul(hn::Add(hn::Add(ay, hn::LoadU(d, all.cy + b)), hn::LoadU(d, all.cy + c)), third);
        hn::StoreU(px, d, all.px + at);
        hn::StoreU(py, d, all.py + at);
        hn::StoreU(hn::Add(set(fan.u), hn::Mul(px, set(all.scaleX))), d, all.pu + at);
        hn::StoreU(hn::Add(set(fan.v), hn::Mul(py, set(all.scaleY))), d, all.pv + at);
    }
}

void places(const KernelFans& all) {
    for (std::size_t i = 0; i < all.count; ++i) placesOf(all, all.fans[i]);
}

/// The least of how far inside of planes points are.
HWY_INLINE V leastInside(V least, const double* x, const double* y, const double* z, const double* w, std::size_t count,
                         const V3& p) {
    for (std::size_t i = 0; i < count; ++i)
        least = hn::Min(least, hn::Add(hn::Add(hn::Mul(set(x[i]), p.x), hn::Mul(set(y[i]), p.y)),
                                       hn::Add(hn::Mul(set(z[i]), p.z), set(w[i]))));
    return least;
}

/// Summed in the triangles' order, whatever the lanes.
HWY_INLINE double litOf(const KernelFans& all, const KernelFan& fan) {
    const D d;
    const std::size_t triangles = fan.corners - 2, e = fan.edge, f = fan.face;
    const double *cx = all.cx + fan.corner, *cy = all.cy + fan.corner;
    double sum = 0.0;
    HWY_ALIGN double lit[HWY_MAX_BYTES / 8];
    for (std::size_t t = 0; t < triangles; t += hn::Lanes(d)) {
        const std::size_t at = fan.place + t;
        const V3 p{hn::LoadU(d, all.px + at), hn::LoadU(d, all.py + at),
                   hn::Sub(hn::LoadU(d, all.pz + at), set(fan.z))};
        V least = leastInside(hn::Zero(d), all.ex + e, all.ey + e, all.ez + e, all.ew + e, fan.edges, p);
        least = leastInside(least, all.fx + f, all.fy + f, all.fz + f, all.fw + f, fan.faces, p);
        const M isLit = hn::Or(hn::Lt(least, hn::Zero(d)), hn::IsNaN(p.z));
        if (hn::AllFalse(d, isLit)) continue;
        hn::Store(hn::IfThenElseZero(isLit, set(1.0)), d, lit);
        for (std::size_t i = 0; i < hn::Lanes(d) && t + i < triangles; ++i) {
            const std::size_t b = t + i + 1, c = t + i + 2;
            sum += lit[i] * ((cx[b] - cx[0]) * (cy[c] - cy[0]) - (cy[b] - cy[0]) * (cx[c] - cx[0]));
        }
    }
    return sum;
}

void judge(const KernelFans& all) {
    for (std::size_t i = 0; i < all.count; ++i) all.lit[i] = litOf(all, all.fans[i]);
}

void sides(const KernelPoints& points, const double* planes, std::size_t count) {
    const D d;
    for (std::size_t at = 0; at < points.count; at += hn::Lanes(d)) {
        const V x = hn::LoadU(d, points.x + at), y = hn::LoadU(d, points.y + at), z = hn::LoadU(d, points.z + at);
        V outside = hn::Zero(d);
        double bit = 1.0;
        for (const double* p = planes; p < planes + 4 * count; p += 4, bit *= 2.0) {
            const V side = hn::Add(hn::Add(hn::Mul(set(p[0]), x), hn::Mul(set(p[1]), y)),
                                   hn::Add(hn::Mul(set(p[2]), z), set(p[3])));
            outside = hn::Add(outside, hn::IfThenZeroElse(hn::Ge(side, hn::Zero(d)), set(bit)));
        }
        hn::StoreU(outside, d, points.outside + at);
    }
}

ShadowKernel kernel() { return {hwy::TargetName(HWY_TARGET), cast, heights, edges, places, judge, sides}; }

} // namespace HWY_NAMESPACE
} // namespace gnomon
HWY_AFTER_NAMESPACE();
