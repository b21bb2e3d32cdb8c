// SPDX-License-Identifier: MIT
// The ground: heights and rays. No include guard: ShadowKernel.cpp compiles it once for each set of instructions.
#include <gnomon/simd/ShadowKernel.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace gnomon {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<double, kernelLanes>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;
using Half = hn::Rebind<float, D>;
using Bits = hn::Rebind<std::uint64_t, D>;

constexpr int mostSteps = 16; // of a ray from triangle to triangle: then it is left to others

HWY_INLINE V set(double value) { return hn::Set(D(), value); }
HWY_INLINE V load(const KernelRow& row, std::size_t lane) { return hn::LoadU(D(), row.data() + lane); }
HWY_INLINE void store(V value, KernelRow& row, std::size_t lane) { hn::StoreU(value, D(), row.data() + lane); }
HWY_INLINE M none() { return hn::Lt(hn::Zero(D()), hn::Zero(D())); } // no lane

template <class Number>
HWY_INLINE V at(const double* from, const Number* order) {
#if HWY_TARGET == HWY_AVX2
    return V{_mm256_set_pd(from[order[3]], from[order[2]], from[order[1]], from[order[0]])};
#else
    HWY_ALIGN double one[HWY_MAX_BYTES / 8];
    for (std::size_t i = 0; i < hn::Lanes(D()); ++i) one[i] = from[order[i]];
    return hn::Load(D(), one);
#endif
}

/// A bit a lane.
HWY_INLINE std::size_t bitsOf(M mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(D(), mask, bits);
    return bits[0];
}

/// Two posts side by side, of each lane.
struct Pair {
    V left, right;
};

/// AVX2's gathers are slower than loads one by one, on AMD's Zen 3 by half.
HWY_INLINE Pair pairAt(const float* heights, const std::uint64_t* places) {
#if HWY_TARGET == HWY_AVX2
    const auto two = [&](std::size_t i) {
        const __m128 first = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(heights + places[i])));
        return _mm_loadh_pi(first, reinterpret_cast<const __m64*>(heights + places[i + 1]));
    };
    const __m128 low = two(0), high = two(2);
    return {V{_mm256_cvtps_pd(_mm_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)))},
            V{_mm256_cvtps_pd(_mm_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1)))}};
#else
    HWY_ALIGN double left[HWY_MAX_BYTES / 8], right[HWY_MAX_BYTES / 8];
    for (std::size_t i = 0; i < hn::Lanes(D()); ++i) {
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

/// @tparam plain  all cells are rising, none is a hole.
template <bool plain>
class Grid {
public:
    explicit Grid(const GridView& view)
        : _view(view),
          _mostU(set(view.columns - 2)),
          _mostV(set(view.rows - 2)),
          _endU(set(view.columns - 1)),
          _endV(set(view.rows - 1)),
          _stride(set(view.columns)) {}

    /// Of the nearest cell, for a place that is beside the grid.
    HWY_INLINE Cell cell(V u, V v) const {
        const V i = within(hn::Floor(u), _mostU), j = within(hn::Floor(v), _mostV);
        Cell cell{hn::Add(hn::Mul(j, _stride), i), hn::Sub(u, i), hn::Sub(v, j), {}};
        cell.right = hn::Ge(cell.u, cell.v);
        if (!plain && _view.cuts) {
            const M falling = cutIs(cell.number, j, CellCut::falling);
            cell.right =
                hn::Or(hn::AndNot(falling, cell.right), hn::And(falling, hn::Le(hn::Add(cell.u, cell.v), set(1.0))));
        }
        return cell;
    }

    HWY_INLINE Plane plane(const Cell& cell) const {
        HWY_ALIGN std::uint64_t places[HWY_MAX_BYTES / 8];
        hn::Store(placeOf(cell.number), Bits(), places);
        const Pair below = pairAt(_view.heights, places), above = pairAt(_view.heights + _view.columns, places);
        const V a = below.left, b = below.right, d = above.left, c = above.right;
        const V ba = hn::Sub(b, a), cd = hn::Sub(c, d), cb = hn::Sub(c, b), da = hn::Sub(d, a);
        Plane plane{a, hn::IfThenElse(cell.right, ba, cd), hn::IfThenElse(cell.right, cb, da)};
        if (!plain && _view.cuts) {
            const V j = hn::Floor(hn::Div(cell.number, _stride));
            const M falling = cutIs(cell.number, j, CellCut::falling);
            plane.alongV = hn::IfThenElse(falling, hn::IfThenElse(cell.right, da, cb), plane.alongV);
            plane.height = hn::IfThenElse(hn::AndNot(cell.right, falling), hn::Sub(hn::Add(b, d), c), a);
            plane.height = hn::IfThenElse(cutIs(cell.number, j, CellCut::hole), set(std::nan("")), plane.height);
        }
        // A corner without a height makes a hole of all of the cell.
        const V none = plain ? hn::Zero(D()) : hn::Mul(hn::Add(hn::Add(ba, cd), hn::Add(cb, da)), hn::Zero(D()));
        const V rise = hn::Add(hn::Mul(cell.u, plane.alongU), hn::Mul(cell.v, plane.alongV));
        plane.height = hn::Add(plain ? plane.height : hn::Add(plane.height, none), rise);
        return plane;
    }

    HWY_INLINE M holds(V u, V v) const {
        const V zero = hn::Zero(D());
        return hn::And(hn::And(hn::Ge(u, zero), hn::Ge(v, zero)), hn::And(hn::Le(u, _endU), hn::Le(v, _endV)));
    }

private:
    /// 0 for what is not a number.
    HWY_INLINE static V within(V value, V most) {
        return hn::IfThenElseZero(hn::Gt(value, hn::Zero(D())), hn::Min(value, most));
    }
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

    const GridView _view;
    const V _mostU, _mostV, _endU, _endV, _stride;
};

HWY_INLINE M isSame(const Cell& a, const Cell& b) {
    return hn::AndNot(hn::Xor(a.right, b.right), hn::Eq(a.number, b.number));
}

struct Ray {
    V u, v, z, du, dv;
};

/// From a place on a ray down, or up, to the plane of the triangle under it.
struct Step {
    V descent; ///< of the ray where it meets the plane; NaN where that is beside the grid.
    M done;    ///< that is in the triangle.
};

template <bool plain>
HWY_INLINE Step step(const Grid<plain>& grid, const Ray& ray, const Cell& cell, const Plane& plane, V descent) {
    const V gap = hn::Sub(hn::Sub(ray.z, descent), plane.height);
    const V slope = hn::Add(hn::Mul(plane.alongU, ray.du), hn::Mul(plane.alongV, ray.dv));
    const V next = hn::Add(descent, hn::Div(gap, hn::Add(set(1.0), slope)));
    const V u = hn::Add(ray.u, hn::Mul(next, ray.du)), v = hn::Add(ray.v, hn::Mul(next, ray.dv));
    const M done = isSame(cell, grid.cell(u, v));
    return {hn::IfThenElse(hn::AndNot(grid.holds(u, v), done), set(std::nan("")), next), done};
}

constexpr std::size_t rayRows = sizeof(KernelRay) / sizeof(KernelRow);

/// The first step of all rays, from where they start. @return how many go on: their numbers are in `order`, as places in the
/// rays' first rows.
template <bool plain>
std::size_t startAll(const Grid<plain>& grid, const KernelFans& all) {
    const D d;
    std::size_t left = 0;
    Ray ray{{}, {}, {}, set(all.wayX * all.scaleX), set(all.wayY * all.scaleY)};
    for (std::size_t at = 0; at < all.rayCount * kernelLanes; at += hn::Lanes(d)) {
        KernelRay& block = all.rays[at / kernelLanes];
        const std::size_t lane = at % kernelLanes;
        ray.z = load(block.z, lane);
        store(hn::Zero(d), block.descent, lane);
        if (hn::AllTrue(d, hn::Eq(ray.z, set(-HUGE_VAL)))) continue;
        ray.u = load(block.u, lane);
        ray.v = load(block.v, lane);
        const Cell cell = grid.cell(ray.u, ray.v);
        const Plane plane = grid.plane(cell);
        const V height = hn::IfThenElse(grid.holds(ray.u, ray.v), plane.height, set(std::nan("")));
        store(height, block.height, lane);
        const M isBelow = hn::Le(ray.z, height);
        if (hn::AllTrue(d, isBelow)) continue;
        if (all.lightW != 0.0) ray.du = load(block.du, lane), ray.dv = load(block.dv, lane);
        const Step first = step(grid, ray, cell, plane, hn::Zero(d));
        const V descent = hn::IfThenElse(hn::IsNaN(height), height, first.descent);
        store(hn::IfThenZeroElse(isBelow, descent), block.descent, lane);
        const M isKnown = hn::Or(isBelow, hn::Or(first.done, hn::IsNaN(height)));
        const std::size_t goOn = bitsOf(hn::Not(isKnown)), number = (at / kernelLanes) * rayRows * kernelLanes + lane;
        for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
            all.order[left] = unsigned(number + i);
            left += goOn >> i & 1u;
        }
    }
    return left;
}

/// A step of each of the rays that are left. @return how many go on.
template <bool plain>
std::size_t stepAll(const Grid<plain>& grid, const KernelFans& all, std::size_t left) {
    const D d;
    std::size_t on = 0;
    HWY_ALIGN double descents[HWY_MAX_BYTES / 8];
    KernelRay& rays = *all.rays;
    Ray ray{{}, {}, {}, set(all.wayX * all.scaleX), set(all.wayY * all.scaleY)};
    for (std::size_t first = 0; first < left; first += hn::Lanes(d)) {
        const unsigned* order = all.order + first;
        ray.u = at(rays.u.data(), order);
        ray.v = at(rays.v.data(), order);
        ray.z = at(rays.z.data(), order);
        if (all.lightW != 0.0) ray.du = at(rays.du.data(), order), ray.dv = at(rays.dv.data(), order);
        const V descent = at(rays.descent.data(), order);
        const V u = hn::Add(ray.u, hn::Mul(descent, ray.du)), v = hn::Add(ray.v, hn::Mul(descent, ray.dv));
        const Cell cell = grid.cell(u, v);
        const Step one = step(grid, ray, cell, grid.plane(cell), descent);
        hn::Store(one.descent, d, descents);
        const std::size_t goOn = bitsOf(hn::Not(hn::Or(one.done, hn::IsNaN(one.descent))));
        const std::size_t end = left - first < hn::Lanes(d) ? left - first : hn::Lanes(d);
        for (std::size_t i = 0; i < end; ++i) {
            const unsigned number = order[i];
            rays.descent.data()[number] = descents[i];
            all.order[on] = number;
            on += goOn >> i & 1u;
        }
    }
    return on;
}

template <bool plain>
HWY_INLINE void castOn(const Grid<plain>& grid, const KernelFans& all) {
    std::size_t left = startAll(grid, all);
    for (int i = 0; i < mostSteps && left > 0; ++i) left = stepAll(grid, all, left);
    for (std::size_t i = 0; i < left; ++i) all.rays->descent.data()[all.order[i]] = std::nan("");
}

HWY_INLINE bool isPlain(const GridView& view) { return !view.cuts && view.isWhole; }

void cast(const GridView& view, const KernelFans& all) {
    if (isPlain(view))
        castOn(Grid<true>(view), all);
    else
        castOn(Grid<false>(view), all);
}

template <bool plain>
HWY_INLINE void heightsOn(const Grid<plain>& grid, KernelPlace* places, std::size_t count, std::size_t lanes) {
    for (KernelPlace* place = places; place < places + count; ++place)
        for (std::size_t lane = 0; lane < lanes; lane += hn::Lanes(D())) {
            const V u = load(place->u, lane), v = load(place->v, lane);
            const Plane plane = grid.plane(grid.cell(u, v));
            store(hn::IfThenElse(grid.holds(u, v), plane.height, set(std::nan(""))), place->z, lane);
        }
}

void heights(const GridView& view, KernelPlace* places, std::size_t count, std::size_t lanes) {
    if (isPlain(view))
        heightsOn(Grid<true>(view), places, count, lanes);
    else
        heightsOn(Grid<false>(view), places, count, lanes);
}

} // namespace HWY_NAMESPACE
} // namespace gnomon
HWY_AFTER_NAMESPACE();
