// SPDX-License-Identifier: MIT
#include <gnomon/onterrain/ShadowDrift.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

namespace gnomon {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// By how much in plan one has to be moved to be the other, corner by corner, and with it all that is between them: infinite
/// where they are not made of the same triangles.
double apart(const PackedShadow& a, const PackedShadow& b) {
    if (a.isFan() != b.isFan() || a.cornerCount != b.cornerCount || a.indexCount != b.indexCount) return infinite;
    if (!std::equal(a.indices, a.indices + a.indexCount, b.indices)) return infinite;
    double most = 0.0;
    for (std::size_t i = 0; i < a.cornerCount; ++i)
        most = std::max(most, glm::length(glm::dvec2(a.corners[i]) - glm::dvec2(b.corners[i])));
    return most;
}

/// How far it moves for a small turn, whichever way.
double paceOf(const ShadowMotion& motion, double way) {
    ShadowRates rates;
    rates.take(motion, way);
    return rates.ofSmallTurns();
}

} // namespace

void ShadowDrift::begin(const Ground& ground, const PackedParts& parts, const PackedShadows& shown,
                        const glm::dvec4& sun) {
    constexpr std::size_t oneIn = 2;                // of those on one hill or brink the others say more than they do
    thread_local std::vector<ShadowMotion> motions; // memory that is used again
    thread_local std::vector<std::pair<double, unsigned>> paces;
    findMotions(ground, parts, shown, sun, motions);
    _way = wayOf(sun);
    const double way = glm::length(_way);
    paces.clear();
    for (const ShadowMotion& motion : motions) paces.emplace_back(paceOf(motion, way), unsigned(paces.size()));
    const auto others = paces.begin() + std::ptrdiff_t((paces.size() + oneIn - 1) / oneIn);
    std::nth_element(paces.begin(), others, paces.end(), std::greater<>());
    _others = {};
    for (auto it = others; it != paces.end(); ++it) _others.take(motions[it->second], way);
    _fastest.clear();
    _fastest.reserve(std::size_t(others - paces.begin()));
    for (auto it = paces.begin(); it != others; ++it)
        _fastest.push_back(partOf(it->second, motions[it->second], _way, 0.0));
}

/// By how much each may be off. @param take  is told the part's place among the fastest, too.
template <class Take>
void ShadowDrift::eachOff(const glm::dvec2& now, const Take& take) const {
    glm::dvec2 then = _way;
    SunTurn turn(then, now);
    for (std::size_t i = 0; i < _fastest.size(); ++i) {
        const Part& part = _fastest[i];
        if (part.way != then) turn = SunTurn(then = part.way, now); // many were looked at together
        take(i, double(part.off) + movedAtMost(part.motion(), turn));
    }
}

double ShadowDrift::offBy(const glm::dvec4& sun) const {
    double most = _others.movedAtMost(glm::length(wayOf(sun) - _way));
    eachOff(wayOf(sun), [&](std::size_t, double off) { most = std::max(most, off); });
    return most;
}

double ShadowDrift::look(const Ground& ground, const PackedParts& parts, const PackedShadows& shown,
                         const glm::dvec4& sun, TerrainMethod method, double error, double late, double most) {
    thread_local std::vector<double> offs; // memory that is used again
    thread_local PackedShadows found;
    thread_local std::vector<ShadowMotion> motions;
    const glm::dvec2 way = wayOf(sun);
    const double others = _others.movedAtMost(glm::length(way - _way));
    const bool isLate =
        std::any_of(_fastest.begin(), _fastest.end(), [&](const Part& part) { return part.off > late; });
    const double enough = isLate ? most : late;
    offs.resize(_fastest.size());
    eachOff(way, [&](std::size_t i, double off) { offs[i] = off; });
    PackedParts again;
    for (std::size_t i = 0; i < offs.size() && others <= enough; ++i)
        if (!(offs[i] <= enough)) again.add(parts, _fastest[i].place);
    if (again.size() > 0) {
        packedShadows(ground, again, sun, method, error, shown.origin, found);
        findMotions(ground, again, found, sun, motions);
    }
    for (std::size_t i = 0, k = 0; k < again.size(); ++i) {
        if (offs[i] <= enough) continue;
        offs[i] = apart(shown[_fastest[i].place], found[k]);
        _fastest[i] = partOf(_fastest[i].place, motions[k++], way, offs[i]);
    }
    return std::accumulate(offs.begin(), offs.end(), others, [](double a, double b) { return std::max(a, b); });
}

/// In single precision, as the shadows are.
ShadowDrift::Part ShadowDrift::partOf(unsigned place, const ShadowMotion& motion, const glm::dvec2& way, double off) {
    return {way, float(motion.height), float(motion.along), float(motion.across), float(off), place};
}

} // namespace gnomon
