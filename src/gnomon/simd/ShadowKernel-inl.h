// SPDX-License-Identifier: MIT
// Silhouettes and polygons. No include guard: ShadowKernel.cpp compiles it once for each set of instructions.
#include <gnomon/simd/ShadowKernelHull-inl.h>

HWY_BEFORE_NAMESPACE();
namespace gnomon {
namespace HWY_NAMESPACE {

/// Some lanes of a block of parts.
struct Lanes {
    const KernelFans& all;
    const KernelFan& fan;
    KernelPart& part;
    std::size_t lane;

    KernelEdge& edge(std::size_t e) const { return all.edges[fan.edge + e]; }
    KernelRay& ray(std::size_t r) const { return all.rays[fan.ray + r]; }
    KernelPlace& place(std::size_t t) const { return all.places[fan.place + t]; }
    HWY_INLINE V get(const KernelRow& row) const { return load(row, lane); }
    HWY_INLINE void put(V value, KernelRow& row) const { store(value, row, lane); }

    HWY_INLINE V3 silhouette(std::size_t e) const {
        const KernelEdge& at = edge(e < fan.edges ? e : 0);
        return {get(at.x), get(at.y), get(at.z)};
    }
    HWY_INLINE M isAlong(const KernelEdge& edge) const { return hn::Gt(get(edge.along), hn::Zero(D())); }
    HWY_INLINE V3 towardsLight(const V3& a) const {
        if (all.lightW == 0.0) return {set(all.lightX), set(all.lightY), set(all.lightZ)};
        const V w = set(all.lightW);
        return minus({get(part.lightX), get(part.lightY), get(part.lightZ)},
                     {hn::Mul(w, a.x), hn::Mul(w, a.y), hn::Mul(w, a.z)});
    }
};

HWY_INLINE V3 middleOf(const V3& a, const V3& b) {
    const V half = set(0.5);
    return {hn::Mul(half, hn::Add(a.x, b.x)), hn::Mul(half, hn::Add(a.y, b.y)), hn::Mul(half, hn::Add(a.z, b.z))};
}

template <class Do>
HWY_INLINE void eachLanes(const KernelFans& all, const Do& what) {
    for (std::size_t i = 0; i < all.count; ++i)
        for (std::size_t lane = 0; lane < all.fans[i].parts; lane += hn::Lanes(D()))
            what(Lanes{all, all.fans[i], all.parts[i], lane});
}

/// An edge that points at the light has no plane.
HWY_INLINE void planeOf(const Lanes& of, KernelEdge& to, const V3& a, const V3& b) {
    const V3 edge = minus(b, a), towards = of.towardsLight(a), normal = cross(towards, edge);
    const V size = dot(normal, normal), whole = hn::Mul(dot(towards, towards), dot(edge, edge));
    const M isPlane = hn::Gt(size, hn::Mul(set(1e-28), whole));
    const M leans = hn::Gt(hn::Mul(normal.z, normal.z), hn::Mul(set(1e-18), size));
    of.put(hn::IfThenElseZero(isPlane, normal.x), to.planeX);
    of.put(hn::IfThenElseZero(isPlane, normal.y), to.planeY);
    of.put(hn::IfThenElseZero(isPlane, normal.z), to.planeZ);
    of.put(hn::IfThenElseZero(isPlane, hn::Neg(dot(normal, a))), to.planeW);
    of.put(hn::IfThenZeroElse(leans, set(1.0)), to.along);
}

void edges(const KernelFans& all) {
    eachLanes(all, [](const Lanes& of) {
        V3 a = of.silhouette(0);
        for (std::size_t e = 0; e < of.fan.edges; ++e) {
            const V3 b = of.silhouette(e + 1);
            planeOf(of, of.edge(e), a, b);
            a = b;
        }
    });
}

/// The way in plan of rays through points, a unit of descent; NaN if the light is not above them.
HWY_INLINE void wayOf(const Lanes& of, const V3& p, V& x, V& y) {
    x = set(of.all.wayX);
    y = set(of.all.wayY);
    if (of.all.lightW == 0.0) return;
    const V3 towards = of.towardsLight(p);
    const V down = hn::Neg(hn::IfThenElse(hn::Gt(towards.z, hn::Zero(D())), towards.z, set(std::nan(""))));
    x = hn::Div(towards.x, down);
    y = hn::Div(towards.y, down);
}

HWY_INLINE void ask(const Lanes& of, const V3& p, M isAsked, KernelRay& to) {
    const KernelFans& all = of.all;
    of.put(hn::Add(of.get(of.part.u), hn::Mul(p.x, set(all.scaleX))), to.u);
    of.put(hn::Add(of.get(of.part.v), hn::Mul(p.y, set(all.scaleY))), to.v);
    of.put(hn::IfThenElse(isAsked, hn::Add(of.get(of.part.z), p.z), set(-HUGE_VAL)), to.z);
    if (all.lightW == 0.0) return;
    V x, y;
    wayOf(of, p, x, y);
    of.put(hn::Mul(x, set(all.scaleX)), to.du);
    of.put(hn::Mul(y, set(all.scaleY)), to.dv);
}

/// Nothing is asked of edges whose shadow is straight whatever the ground, and of lanes without a part.
void rays(const KernelFans& all) {
    for (std::size_t i = 0; i < all.rayCount; ++i) all.rays[i].z.fill(-HUGE_VAL);
    eachLanes(all, [](const Lanes& of) {
        const M isPart = hn::FirstN(D(), of.fan.parts - of.lane);
        V3 a = of.silhouette(0);
        for (std::size_t e = 0; e < of.fan.edges; ++e) {
            const V3 b = of.silhouette(e + 1);
            ask(of, a, isPart, of.ray(e));
            ask(of, middleOf(a, b), hn::AndNot(of.isAlong(of.edge(e)), isPart), of.ray(of.fan.edges + e));
            a = b;
        }
    });
}

/// Where rays end, about the anchor.
HWY_INLINE V3 endOf(const Lanes& of, const V3& start, const KernelRay& ray) {
    const V descent = of.get(ray.descent);
    V x, y;
    wayOf(of, start, x, y);
    const M isBelow = hn::Eq(descent, hn::Zero(D()));
    return {hn::IfThenElse(isBelow, start.x, hn::Add(start.x, hn::Mul(descent, x))),
            hn::IfThenElse(isBelow, start.y, hn::Add(start.y, hn::Mul(descent, y))),
            hn::IfThenElse(isBelow, hn::Sub(of.get(ray.height), of.get(of.part.z)), hn::Sub(start.z, descent))};
}

HWY_INLINE void landOf(const Lanes& of) {
    const V z = of.get(of.part.z), margin = of.get(of.part.margin);
    M isOut = none(), isUnknown = isOut;
    V3 a = of.silhouette(0);
    for (std::size_t e = 0; e < of.fan.edges; ++e) {
        const V3 b = of.silhouette(e + 1);
        KernelEdge& to = of.edge(e);
        const V3 end = endOf(of, a, of.ray(e)), middle = endOf(of, middleOf(a, b), of.ray(of.fan.edges + e));
        of.put(end.x, to.endX);
        of.put(end.y, to.endY);
        of.put(end.z, to.endZ);
        of.put(middle.x, to.middleX);
        of.put(middle.y, to.middleY);
        isOut = hn::Or(isOut, hn::Not(hn::Le(hn::Add(z, a.z), hn::Add(of.get(of.ray(e).height), margin))));
        isUnknown = hn::Or(isUnknown, hn::Or(hn::IsNaN(end.x), hn::AndNot(of.isAlong(to), hn::IsNaN(middle.x))));
        a = b;
    }
    of.put(hn::IfThenElseZero(isOut, set(1.0)), of.part.isOut);
    of.put(hn::IfThenElseZero(isUnknown, set(1.0)), of.part.isUnknown);
}

void land(const KernelFans& all) { eachLanes(all, landOf); }

struct V2 {
    V x, y;
};

/// Twice the area of a triangle in plan.
HWY_INLINE V areaOf(const V2& a, const V2& b, const V2& c) {
    return hn::Sub(hn::Mul(hn::Sub(b.x, a.x), hn::Sub(c.y, a.y)), hn::Mul(hn::Sub(b.y, a.y), hn::Sub(c.x, a.x)));
}

HWY_INLINE V2 endAt(const Lanes& of, std::size_t e) {
    const KernelEdge& at = of.edge(e < of.fan.edges ? e : 0);
    return {of.get(at.endX), of.get(at.endY)};
}

/// The area between the straight line from a to b and a parabola through the edge's middle.
HWY_INLINE V lensOf(const Lanes& of, const KernelEdge& edge, const V2& a, const V2& b) {
    const V lens = hn::Abs(areaOf(a, b, {of.get(edge.middleX), of.get(edge.middleY)}));
    return hn::IfThenZeroElse(of.isAlong(edge), hn::Mul(set(4.0 / 3.0), lens));
}

HWY_INLINE void measureOf(const Lanes& of) {
    const V2 first = endAt(of, 0), above{of.get(of.edge(0).x), of.get(of.edge(0).y)};
    V lenses = hn::Zero(D()), area = lenses, under = lenses, least = set(HUGE_VAL), most = lenses;
    V2 a = first, over = above;
    for (std::size_t e = 0; e < of.fan.edges; ++e) {
        const V2 b = endAt(of, e + 1);
        const V3 corner = of.silhouette(e + 1);
        const V2 next{corner.x, corner.y};
        lenses = hn::Add(lenses, lensOf(of, of.edge(e), a, b));
        if (e > 0 && e + 1 < of.fan.edges) {
            const V one = areaOf(first, a, b);
            area = hn::Add(area, one);
            least = hn::IfThenElse(hn::Lt(one, least), one, least);
            most = hn::IfThenElse(hn::Gt(one, most), one, most);
            under = hn::Add(under, areaOf(above, over, next));
        }
        over = next;
        a = b;
    }
    of.put(lenses, of.part.lenses);
    of.put(area, of.part.area);
    of.put(under, of.part.under);
    of.put(least, of.part.least);
    of.put(most, of.part.most);
}

void measure(const KernelFans& all) { eachLanes(all, measureOf); }

/// The middles of triangles, of those that a part has not, too.
HWY_INLINE void placesOf(const Lanes& of) {
    const KernelFans& all = of.all;
    const V third = set(1.0 / 3.0), u = of.get(of.part.u), v = of.get(of.part.v);
    const V2 a = endAt(of, 0);
    V2 b = endAt(of, 1);
    for (std::size_t t = 0; t + 2 < of.fan.edges; ++t) {
        const V2 c = endAt(of, t + 2);
        KernelPlace& to = of.place(t);
        const V x = hn::Mul(hn::Add(hn::Add(a.x, b.x), c.x), third),
                y = hn::Mul(hn::Add(hn::Add(a.y, b.y), c.y), third);
        of.put(x, to.x);
        of.put(y, to.y);
        of.put(hn::Add(u, hn::Mul(x, set(all.scaleX))), to.u);
        of.put(hn::Add(v, hn::Mul(y, set(all.scaleY))), to.v);
        b = c;
    }
}

void places(const KernelFans& all) { eachLanes(all, placesOf); }

/// How far a point is inside of the plane that has it most outside, 0 at most.
HWY_INLINE V inside(const Lanes& of, const V3& p) {
    V least = hn::Zero(D());
    const auto ask = [&](const KernelRow& x, const KernelRow& y, const KernelRow& z, const KernelRow& w) {
        least = hn::Min(least, hn::Add(hn::Add(hn::Mul(of.get(x), p.x), hn::Mul(of.get(y), p.y)),
                                       hn::Add(hn::Mul(of.get(z), p.z), of.get(w))));
    };
    const KernelEdge* edge = &of.edge(0);
    for (std::size_t e = 0; e < of.fan.edges; ++e, ++edge) ask(edge->planeX, edge->planeY, edge->planeZ, edge->planeW);
    const KernelFace* face = of.all.faces + of.fan.face;
    for (std::size_t f = 0; f < of.fan.faces; ++f, ++face) ask(face->x, face->y, face->z, face->w);
    return least;
}

HWY_INLINE void judgeOf(const Lanes& of) {
    const V corners = of.get(of.part.corners);
    const V2 a = endAt(of, 0);
    V2 b = endAt(of, 1);
    V sum = hn::Zero(D());
    for (std::size_t t = 0; t + 2 < of.fan.edges; ++t) {
        const V2 c = endAt(of, t + 2);
        const KernelPlace& at = of.place(t);
        const V3 p{of.get(at.x), of.get(at.y), hn::Sub(of.get(at.z), of.get(of.part.z))};
        const M isLit = hn::Or(hn::Lt(inside(of, p), hn::Zero(D())), hn::IsNaN(p.z));
        const M isThere = hn::Lt(set(double(t + 2)), corners);
        sum = hn::Add(sum, hn::IfThenElseZero(hn::And(isLit, isThere), areaOf(a, b, c)));
        b = c;
    }
    of.put(sum, of.part.lit);
}

void judge(const KernelFans& all) { eachLanes(all, judgeOf); }

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
    return {hwy::TargetName(HWY_TARGET),
            cast,
            heights,
            pack,
            face,
            choose,
            edges,
            rays,
            land,
            measure,
            places,
            judge,
            sides};
}

} // namespace HWY_NAMESPACE
} // namespace gnomon
HWY_AFTER_NAMESPACE();
