// SPDX-License-Identifier: MIT
// The ground: heights and rays. No include guard: ShadowKernel.cpp compiles it once for each set of instructions.
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
HWY_INLINE M none() { return hn::Lt(hn::Zero(D()), hn::Zero(D())); } // no lane

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
        HWY_ALIGN std::uint64_t places[HWY_MAX_BYTES / 8];
        hn::Store(placeOf(cell.number), Bits(), places);
        const Pair below = pairAt(_view.heights, places), above = pairAt(_view.heights + _view.columns, places);
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

/// Of a ray over a triangle: down to its plane.
HWY_INLINE V nextDescent(V descent, V gap, const Plane& plane, V du, V dv) {
    const V slope = hn::Add(hn::Mul(plane.alongU, du), hn::Mul(plane.alongV, dv));
    return hn::Add(descent, hn::Div(gap, hn::Add(set(1.0), slope)));
}

/// The first step of all rays, from where they start. @return how many go on: their numbers are in `rays.order`.
std::size_t startAll(const Grid& grid, const KernelRays& rays) {
    const D d;
    std::size_t left = 0;
    HWY_ALIGN double goesOn[HWY_MAX_BYTES / 8];
    for (std::size_t at = 0; at < rays.count; at += hn::Lanes(d)) {
        const V u = hn::LoadU(d, rays.u + at), v = hn::LoadU(d, rays.v + at), z = hn::LoadU(d, rays.z + at);
        const Plane plane = grid.plane(grid.cell(u, v));
        const V height = hn::IfThenElse(grid.holds(u, v), plane.height, set(std::nan("")));
        const V gap = hn::Sub(z, height);
        const M isBelow = hn::Le(gap, hn::Zero(d));
        const V next = nextDescent(hn::Zero(d), gap, plane, hn::LoadU(d, rays.du + at), hn::LoadU(d, rays.dv + at));
        const V descent = hn::IfThenElse(isBelow, hn::Zero(d), next);
        hn::StoreU(descent, d, rays.descent + at);
        hn::StoreU(height, d, rays.height + at);
        hn::Store(hn::IfThenElseZero(hn::Gt(descent, hn::Zero(d)), set(1.0)), d, goesOn);
        for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
            rays.order[left] = unsigned(at + i);
            left += at + i < rays.count && goesOn[i] > 0.0;
        }
    }
    return left;
}

/// A ray on its way down, from triangle to triangle.
struct Ray {
    V u, v, z, du, dv, descent, number;
    M right, done;
};

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
    ray.descent = hn::IfThenElse(ray.done, ray.descent, nextDescent(ray.descent, gap, plane, ray.du, ray.dv));
    ray.number = cell.number;
    ray.right = cell.right;
}

/// Those that go on, side by side.
HWY_INLINE void gather(const KernelRays& rays, std::size_t left, std::size_t room) {
    const double* const from[] = {rays.u, rays.v, rays.z, rays.du, rays.dv, rays.descent};
    for (std::size_t k = 0; k < 6; ++k)
        for (std::size_t i = 0; i < left; ++i) rays.work[k * room + i] = from[k][rays.order[i]];
}

void cast(const GridView& view, const KernelRays& rays) {
    const D d;
    const Grid grid(view);
    const std::size_t lanes = hn::Lanes(d), left = startAll(grid, rays), room = rays.count + kernelPad;
    gather(rays, left, room);
    for (std::size_t at = 0; at < left; at += wide * lanes) {
        Ray group[wide];
        for (std::size_t k = 0; k < wide; ++k) {
            const double* from = rays.work + at + k * lanes;
            group[k] = {hn::LoadU(d, from),
                        hn::LoadU(d, from + room),
                        hn::LoadU(d, from + 2 * room),
                        hn::LoadU(d, from + 3 * room),
                        hn::LoadU(d, from + 4 * room),
                        hn::LoadU(d, from + 5 * room),
                        set(-1.0),
                        none(),
                        none()};
        }
        for (int i = 0; i < mostSteps; ++i) {
            for (std::size_t k = 0; k < wide; ++k) step(group[k], grid);
            if (hn::AllTrue(d, hn::And(group[0].done, group[1].done))) break;
        }
        for (std::size_t k = 0; k < wide; ++k)
            hn::StoreU(hn::IfThenElse(group[k].done, group[k].descent, set(std::nan(""))), d,
                       rays.work + 5 * room + at + k * lanes);
    }
    for (std::size_t i = 0; i < left; ++i) rays.descent[rays.order[i]] = rays.work[5 * room + i];
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

} // namespace HWY_NAMESPACE
} // namespace gnomon
HWY_AFTER_NAMESPACE();
