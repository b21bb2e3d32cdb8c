// SPDX-License-Identifier: MIT
// Faces of hulls, and of many hulls those of one silhouette. No include guard: ShadowKernel.cpp compiles it once for each set
// of instructions.
#include <gnomon/simd/ShadowKernelGrid-inl.h>

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

/// Four numbers of four parts turned into four parts of each number.
HWY_INLINE void turnFour(const float* const* from, std::size_t k, float* to) {
#if HWY_TARGET == HWY_AVX2
    __m128 rows[4];
    for (int i = 0; i < 4; ++i) rows[i] = _mm_loadu_ps(from[i] + k);
    _MM_TRANSPOSE4_PS(rows[0], rows[1], rows[2], rows[3]);
    for (std::size_t i = 0; i < 4; ++i) _mm_storeu_ps(to + i * kernelLanes, rows[i]);
#else
    for (std::size_t i = 0; i < 4; ++i)
        for (std::size_t lane = 0; lane < 4; ++lane) to[i * kernelLanes + lane] = from[lane][k + i];
#endif
}

void pack(const std::array<const float*, kernelLanes>& from, std::size_t numbers, float* to) {
    for (std::size_t i = 0; i < 3 * kernelLanes; ++i) to[i] = 0.0f;
    to += 3 * kernelLanes;
    std::size_t k = 0;
    for (; k + 4 <= numbers; k += 4, to += 4 * kernelLanes)
        for (std::size_t lane = 0; lane < kernelLanes; lane += 4) turnFour(from.data() + lane, k, to + lane);
    for (; k < numbers; ++k, to += kernelLanes)
        for (std::size_t lane = 0; lane < kernelLanes; ++lane) to[lane] = from[lane][k];
}

/// Some lanes of a block of parts.
struct HullLanes {
    const KernelHulls& all;
    std::size_t block, lane;

    /// Of the k-th of a part's n numbers.
    std::size_t at(std::size_t n, std::size_t k) const { return (n * block + k) * kernelLanes + lane; }
    HWY_INLINE V3 corner(std::size_t c) const {
        const float* from = all.places + at(3 * all.corners, 3 * c);
        const auto load = [&](std::size_t k) { return hn::PromoteTo(D(), hn::LoadU(Half(), from + k * kernelLanes)); };
        return {load(0), load(1), load(2)};
    }
    HWY_INLINE V3 towardsLight(const V3& a) const {
        if (all.lightW == 0.0) return {set(all.lightX), set(all.lightY), set(all.lightZ)};
        const double* from = all.lights + at(3, 0);
        const V w = set(all.lightW);
        return minus({hn::LoadU(D(), from), hn::LoadU(D(), from + kernelLanes), hn::LoadU(D(), from + 2 * kernelLanes)},
                     {hn::Mul(w, a.x), hn::Mul(w, a.y), hn::Mul(w, a.z)});
    }
};

/// @return its bit where the light meets it.
HWY_INLINE V faceOf(const HullLanes& of, std::size_t f) {
    const D d;
    const std::array<unsigned, 3>& triple = of.all.triples[f];
    const V3 a = of.corner(triple[0]);
    const V3 normal = cross(minus(of.corner(triple[1]), a), minus(of.corner(triple[2]), a));
    double* to = of.all.planes + of.at(4 * of.all.faces, 4 * f);
    hn::StoreU(hn::Neg(normal.x), d, to);
    hn::StoreU(hn::Neg(normal.y), d, to + kernelLanes);
    hn::StoreU(hn::Neg(normal.z), d, to + 2 * kernelLanes);
    hn::StoreU(dot(normal, a), d, to + 3 * kernelLanes);
    const V bit = hn::BitCast(d, hn::Set(Bits(), std::uint64_t(1) << f % 64));
    return hn::IfThenElseZero(hn::Gt(dot(normal, of.towardsLight(a)), hn::Zero(d)), bit);
}

HWY_INLINE void facesOf(const HullLanes& of) {
    const std::size_t words = of.all.faces / 64 + 1;
    for (std::size_t word = 0; word < words; ++word) {
        V lit = hn::Zero(D());
        for (std::size_t f = 64 * word; f < 64 * word + 64 && f < of.all.faces; ++f) lit = hn::Or(lit, faceOf(of, f));
        hn::StoreU(hn::BitCast(Bits(), lit), Bits(), of.all.lit + of.at(words, word));
    }
}

HWY_INLINE void sizeOf(const HullLanes& of) {
    const D d;
    V size = hn::Zero(d);
    for (std::size_t c = 1; c < of.all.corners; ++c) {
        const V3 corner = of.corner(c);
        size = hn::Max(size, dot(corner, corner));
    }
    hn::StoreU(hn::Sqrt(size), d, of.all.sizes + of.at(1, 0));
}

void face(const KernelHulls& all) {
    for (std::size_t block = 0; block < all.blocks; ++block)
        for (std::size_t lane = 0; lane < kernelLanes; lane += hn::Lanes(D())) {
            sizeOf({all, block, lane});
            facesOf({all, block, lane});
        }
}

HWY_INLINE V promoted(const float* from, const std::size_t* places) {
#if HWY_TARGET == HWY_AVX2
    return V{_mm256_cvtps_pd(_mm_set_ps(from[places[3]], from[places[2]], from[places[1]], from[places[0]]))};
#else
    HWY_ALIGN double one[HWY_MAX_BYTES / 8];
    for (std::size_t i = 0; i < hn::Lanes(D()); ++i) one[i] = double(from[places[i]]);
    return hn::Load(D(), one);
#endif
}

void choose(const KernelHulls& hulls, const KernelChoice& choice, const KernelFans& all, std::size_t number) {
    const KernelFan& fan = all.fans[number];
    std::array<std::size_t, kernelLanes> corners, planes;
    for (std::size_t i = 0; i < kernelLanes; ++i) {
        const std::size_t block = choice.parts[i] / kernelLanes * kernelLanes, lane = choice.parts[i] % kernelLanes;
        corners[i] = 3 * hulls.corners * block + lane;
        planes[i] = 4 * hulls.faces * block + lane;
    }
    for (std::size_t lane = 0; lane < fan.parts; lane += hn::Lanes(D())) {
        for (std::size_t e = 0; e < fan.edges; ++e) {
            KernelEdge& to = all.edges[fan.edge + e];
            const float* from = hulls.places + 3 * choice.corners[e] * kernelLanes;
            store(promoted(from, corners.data() + lane), to.x, lane);
            store(promoted(from + kernelLanes, corners.data() + lane), to.y, lane);
            store(promoted(from + 2 * kernelLanes, corners.data() + lane), to.z, lane);
        }
        for (std::size_t f = 0; f < fan.faces; ++f) {
            KernelFace& to = all.faces[fan.face + f];
            const double* from = hulls.planes + 4 * choice.faces[f] * kernelLanes;
            store(at(from, planes.data() + lane), to.x, lane);
            store(at(from + kernelLanes, planes.data() + lane), to.y, lane);
            store(at(from + 2 * kernelLanes, planes.data() + lane), to.z, lane);
            store(at(from + 3 * kernelLanes, planes.data() + lane), to.w, lane);
        }
    }
}

} // namespace HWY_NAMESPACE
} // namespace gnomon
HWY_AFTER_NAMESPACE();
