// SPDX-License-Identifier: MIT
// Silhouettes and polygons. No include guard: ShadowKernel.cpp compiles it once for each set of instructions.
#include <gnomon/ShadowKernelGrid-inl.h>

HWY_BEFORE_NAMESPACE();
namespace gnomon {
namespace HWY_NAMESPACE {

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

HWY_INLINE V3 cornerOf(const KernelHulls& all, std::size_t corner, std::size_t at) {
    const D d;
    const float* from = all.places + 3 * corner * all.stride + at;
    const auto load = [&](std::size_t k) { return hn::PromoteTo(d, hn::LoadU(Half(), from + k * all.stride)); };
    return {load(0), load(1), load(2)};
}

HWY_INLINE void faceOf(const KernelHulls& all, std::size_t f, std::size_t at) {
    const D d;
    const V3 a = cornerOf(all, all.triples[f][0], at);
    const V3 normal =
        cross(minus(cornerOf(all, all.triples[f][1], at), a), minus(cornerOf(all, all.triples[f][2], at), a));
    const V w = set(all.lightW);
    const V3 towards =
        minus({hn::LoadU(d, all.lightX + at), hn::LoadU(d, all.lightY + at), hn::LoadU(d, all.lightZ + at)},
              {hn::Mul(w, a.x), hn::Mul(w, a.y), hn::Mul(w, a.z)});
    double* to = all.planes + 4 * f * all.stride + at;
    hn::StoreU(hn::Neg(normal.x), d, to);
    hn::StoreU(hn::Neg(normal.y), d, to + all.stride);
    hn::StoreU(hn::Neg(normal.z), d, to + 2 * all.stride);
    hn::StoreU(dot(normal, a), d, to + 3 * all.stride);
    hn::StoreU(dot(normal, towards), d, all.facing + f * all.stride + at);
}

void face(const KernelHulls& all) {
    const D d;
    for (std::size_t at = 0; at < all.count; at += hn::Lanes(d)) {
        V size = hn::Zero(d), low = size, high = size;
        for (std::size_t c = 1; c < all.corners; ++c) {
            const V3 corner = cornerOf(all, c, at);
            size = hn::Max(size, dot(corner, corner));
            low = hn::Min(low, corner.z);
            high = hn::Max(high, corner.z);
        }
        hn::StoreU(size, d, all.size + at);
        hn::StoreU(low, d, all.low + at);
        hn::StoreU(high, d, all.high + at);
        for (std::size_t f = 0; f < all.faces; ++f) faceOf(all, f, at);
    }
}

HWY_INLINE V3 silhouetteAt(const KernelFans& all, std::size_t i) {
    const D d;
    return {hn::LoadU(d, all.sx + i), hn::LoadU(d, all.sy + i), hn::LoadU(d, all.sz + i)};
}

HWY_INLINE V3 towardsLight(const KernelFan& fan, const V3& a) {
    const V w = set(fan.light[3]);
    return minus({set(fan.light[0]), set(fan.light[1]), set(fan.light[2])},
                 {hn::Mul(w, a.x), hn::Mul(w, a.y), hn::Mul(w, a.z)});
}

/// An edge that points at the light has no plane.
HWY_INLINE void planeOf(const KernelFans& all, const KernelFan& fan, std::size_t i) {
    const D d;
    const V3 a = silhouetteAt(all, i), edge = minus(silhouetteAt(all, i + 1), a), towards = towardsLight(fan, a);
    const V3 normal = cross(towards, edge);
    const V size = dot(normal, normal), whole = hn::Mul(dot(towards, towards), dot(edge, edge));
    const M isPlane = hn::Gt(size, hn::Mul(set(1e-28), whole));
    const M leans = hn::Gt(hn::Mul(normal.z, normal.z), hn::Mul(set(1e-18), size));
    hn::StoreU(hn::IfThenElseZero(isPlane, normal.x), d, all.ex + i);
    hn::StoreU(hn::IfThenElseZero(isPlane, normal.y), d, all.ey + i);
    hn::StoreU(hn::IfThenElseZero(isPlane, normal.z), d, all.ez + i);
    hn::StoreU(hn::IfThenElseZero(isPlane, hn::Neg(dot(normal, a))), d, all.ew + i);
    hn::StoreU(hn::IfThenElse(leans, hn::Zero(d), set(1.0)), d, all.along + i);
}

/// The way in plan of rays through points, a unit of descent; NaN if the light is not above them.
HWY_INLINE void wayOf(const KernelFans& all, const KernelFan& fan, const V3& p, V& x, V& y) {
    x = set(all.wayX);
    y = set(all.wayY);
    if (fan.light[3] == 0.0) return;
    const V3 towards = towardsLight(fan, p);
    const V down = hn::Neg(hn::IfThenElse(hn::Gt(towards.z, hn::Zero(D())), towards.z, set(std::nan(""))));
    x = hn::Div(towards.x, down);
    y = hn::Div(towards.y, down);
}

HWY_INLINE void ask(const KernelFans& all, const KernelFan& fan, const V3& p, std::size_t at) {
    const D d;
    V x, y;
    wayOf(all, fan, p, x, y);
    hn::StoreU(hn::Add(set(fan.u), hn::Mul(p.x, set(all.scaleX))), d, all.u + at);
    hn::StoreU(hn::Add(set(fan.v), hn::Mul(p.y, set(all.scaleY))), d, all.v + at);
    hn::StoreU(hn::Add(set(fan.z), p.z), d, all.z + at);
    hn::StoreU(hn::Mul(x, set(all.scaleX)), d, all.du + at);
    hn::StoreU(hn::Mul(y, set(all.scaleY)), d, all.dv + at);
}

HWY_INLINE V3 middleOf(const KernelFans& all, std::size_t i) {
    const V3 a = silhouetteAt(all, i), b = silhouetteAt(all, i + 1);
    const V half = set(0.5);
    return {hn::Mul(half, hn::Add(a.x, b.x)), hn::Mul(half, hn::Add(a.y, b.y)), hn::Mul(half, hn::Add(a.z, b.z))};
}

/// Vectors end in what comes after and is written later. Of edges whose shadow is straight whatever the ground nothing is
/// asked: as if they were below it.
void edges(const KernelFans& all) {
    const D d;
    for (std::size_t k = 0; k < all.count; ++k) {
        const KernelFan& fan = all.fans[k];
        for (std::size_t i = 0; i < fan.edges; i += hn::Lanes(d)) {
            planeOf(all, fan, fan.edge + i);
            ask(all, fan, silhouetteAt(all, fan.edge + i), fan.query + i);
        }
        for (std::size_t i = 0; i < fan.edges; i += hn::Lanes(d)) {
            V3 middle = middleOf(all, fan.edge + i);
            const M isAlong = hn::Gt(hn::LoadU(d, all.along + fan.edge + i), hn::Zero(d));
            middle.z = hn::IfThenElse(isAlong, set(-HUGE_VAL), middle.z);
            ask(all, fan, middle, fan.query + fan.edges + i);
        }
    }
}

/// Where rays end, about the anchor.
HWY_INLINE V3 endOf(const KernelFans& all, const KernelFan& fan, const V3& start, std::size_t query) {
    const D d;
    const V descent = hn::LoadU(d, all.rays.descent + query), ground = hn::LoadU(d, all.rays.height + query);
    V x, y;
    wayOf(all, fan, start, x, y);
    const M isBelow = hn::Eq(descent, hn::Zero(d));
    return {hn::IfThenElse(isBelow, start.x, hn::Add(start.x, hn::Mul(descent, x))),
            hn::IfThenElse(isBelow, start.y, hn::Add(start.y, hn::Mul(descent, y))),
            hn::IfThenElse(isBelow, hn::Sub(ground, set(fan.z)), hn::Sub(start.z, descent))};
}

HWY_INLINE void landOf(const KernelFans& all, KernelFan& fan) {
    const D d;
    M isOut = none(), isUnknown = isOut;
    for (std::size_t i = 0; i < fan.edges; i += hn::Lanes(d)) {
        const M isOne = hn::FirstN(d, fan.edges - i);
        const V3 start = silhouetteAt(all, fan.edge + i), end = endOf(all, fan, start, fan.query + i);
        hn::StoreU(end.x, d, all.cx + fan.edge + i);
        hn::StoreU(end.y, d, all.cy + fan.edge + i);
        hn::StoreU(end.z, d, all.cz + fan.edge + i);
        const V top = hn::Add(hn::LoadU(d, all.rays.height + fan.query + i), set(fan.margin));
        isOut = hn::Or(isOut, hn::AndNot(hn::Le(hn::Add(set(fan.z), start.z), top), isOne));
        isUnknown = hn::Or(isUnknown, hn::And(hn::IsNaN(end.x), isOne));
    }
    for (std::size_t i = 0; i < fan.edges; i += hn::Lanes(d)) {
        const V3 end = endOf(all, fan, middleOf(all, fan.edge + i), fan.query + fan.edges + i);
        hn::StoreU(end.x, d, all.mx + fan.edge + i);
        hn::StoreU(end.y, d, all.my + fan.edge + i);
        const M asks = hn::Eq(hn::LoadU(d, all.along + fan.edge + i), hn::Zero(d));
        isUnknown = hn::Or(isUnknown, hn::And(hn::And(hn::IsNaN(end.x), asks), hn::FirstN(d, fan.edges - i)));
    }
    fan.isOut = !hn::AllFalse(d, isOut);
    fan.isKnown = hn::AllFalse(d, isUnknown);
}

void land(const KernelFans& all) {
    for (std::size_t i = 0; i < all.count; ++i) landOf(all, all.fans[i]);
}

/// Twice the area of a triangle in plan.
HWY_INLINE V areaOf(V ax, V ay, V bx, V by, V cx, V cy) {
    return hn::Sub(hn::Mul(hn::Sub(bx, ax), hn::Sub(cy, ay)), hn::Mul(hn::Sub(by, ay), hn::Sub(cx, ax)));
}

/// Adds up in order, whatever the lanes.
template <class Take>
HWY_INLINE void each(V values, std::size_t count, const Take& take) {
    HWY_ALIGN double one[HWY_MAX_BYTES / 8];
    hn::Store(values, D(), one);
    for (std::size_t i = 0; i < hn::Lanes(D()) && i < count; ++i) take(one[i]);
}

HWY_INLINE void measureOf(const KernelFans& all, KernelFan& fan) {
    const D d;
    const std::size_t n = fan.edges;
    const double *sx = all.sx + fan.edge, *sy = all.sy + fan.edge;
    double *cx = all.cx + fan.edge, *cy = all.cy + fan.edge;
    cx[n] = cx[0];
    cy[n] = cy[0];
    fan.lenses = fan.area = fan.under = fan.most = 0.0;
    fan.least = HUGE_VAL;
    const auto load = [&](const double* from) { return hn::LoadU(d, from); };
    for (std::size_t i = 0; i < n; i += hn::Lanes(d)) {
        const V lens = areaOf(load(cx + i), load(cy + i), load(cx + i + 1), load(cy + i + 1),
                              load(all.mx + fan.edge + i), load(all.my + fan.edge + i));
        const M asks = hn::Eq(load(all.along + fan.edge + i), hn::Zero(d));
        each(hn::IfThenElseZero(asks, hn::Abs(lens)), n - i, [&](double one) { fan.lenses += 4.0 / 3.0 * one; });
    }
    for (std::size_t i = 1; i + 1 < n; i += hn::Lanes(d)) {
        each(areaOf(set(cx[0]), set(cy[0]), load(cx + i), load(cy + i), load(cx + i + 1), load(cy + i + 1)), n - 1 - i,
             [&](double one) {
                 fan.area += one;
                 fan.least = one < fan.least ? one : fan.least;
                 fan.most = one > fan.most ? one : fan.most;
             });
        each(areaOf(set(sx[0]), set(sy[0]), load(sx + i), load(sy + i), load(sx + i + 1), load(sy + i + 1)), n - 1 - i,
             [&](double one) { fan.under += one; });
    }
}

void measure(const KernelFans& all) {
    for (std::size_t i = 0; i < all.count; ++i) measureOf(all, all.fans[i]);
}

/// The middles of triangles. Vectors end in what comes after and is written later.
HWY_INLINE void placesOf(const KernelFans& all, const KernelFan& fan) {
    const D d;
    const std::size_t triangles = fan.corners - 2;
    const V ax = set(all.cx[fan.edge]), ay = set(all.cy[fan.edge]), third = set(1.0 / 3.0);
    for (std::size_t t = 0; t < triangles; t += hn::Lanes(d)) {
        const std::size_t at = fan.place + t, b = fan.edge + t + 1, c = b + 1;
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
    const double *cx = all.cx + fan.edge, *cy = all.cy + fan.edge;
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
    for (std::size_t i = 0; i < all.count; ++i) all.fans[i].lit = litOf(all, all.fans[i]);
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

ShadowKernel kernel() {
    return {hwy::TargetName(HWY_TARGET), cast, heights, face, edges, land, measure, places, judge, sides};
}

} // namespace HWY_NAMESPACE
} // namespace gnomon
HWY_AFTER_NAMESPACE();
