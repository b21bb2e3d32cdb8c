// SPDX-License-Identifier: MIT
#include "support/TerrainTrial.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <ostream>
#include <random>

namespace test {
namespace {

double across(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

std::vector<glm::dvec2> placed(std::vector<glm::dvec2> outline, const glm::dvec2& middle, double turn) {
    const double c = std::cos(turn), s = std::sin(turn);
    for (glm::dvec2& p : outline) p = middle + glm::dvec2(p.x * c - p.y * s, p.x * s + p.y * c);
    return outline;
}

/// The corner at the origin is the inner one: all others can be seen from it.
std::vector<glm::dvec2> lShape(const glm::dvec2& half, const glm::dvec2& cut) {
    return {{0.0, 0.0}, {0.0, cut.y}, {-half.x, cut.y}, {-half.x, -half.y}, {cut.x, -half.y}, {cut.x, 0.0}};
}

std::vector<glm::dvec2> circle(int sides, double radius) {
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < sides; ++i)
        outline.emplace_back(radius * std::cos(360.0 * degree * i / sides),
                             radius * std::sin(360.0 * degree * i / sides));
    return outline;
}

std::vector<glm::dvec2> rectangle(const glm::dvec2& half) {
    return {{-half.x, -half.y}, {half.x, -half.y}, {half.x, half.y}, {-half.x, half.y}};
}

/// A part of the plan, along the light's azimuth and across it.
struct Region {
    glm::dvec2 origin, away; ///< away from the light, length 1.
    glm::dvec2 low{std::numeric_limits<double>::infinity()}, high{-low};

    void add(const glm::dvec2& place) {
        const glm::dvec2 local(glm::dot(place - origin, away), across(away, place - origin));
        low = glm::min(low, local);
        high = glm::max(high, local);
    }
    void widen(double by) { low -= by, high += by; }
    glm::dvec2 at(double u, double v) const {
        const glm::dvec2 local = low + glm::dvec2(u, v) * (high - low);
        return origin + local.x * away + local.y * glm::dvec2(-away.y, away.x);
    }
    /// Calls take(place) once in each cell of a grid of about `points` cells, somewhere in the cell.
    template <class Take>
    void spread(int points, const Take& take) const {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> unit;
        const glm::dvec2 size = high - low;
        const int columns = std::max(1, int(std::sqrt(points * size.x / size.y))), rows = std::max(1, points / columns);
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) {
                const glm::dvec2 place = (glm::dvec2(i, j) + drawn(unit, random)) / glm::dvec2(columns, rows);
                take(at(place.x, place.y));
            }
    }
};

/// Around what a caster may shade, by rays alone.
Region reachOf(const gnomon::Ground& ground, const Prism& prism, const glm::dvec4& light) {
    const glm::dvec2 middle = prism.middle(), towards = glm::dvec2(light) - light.w * middle;
    const double length = glm::length(towards);
    Region wide{middle, length > 1e-9 ? -towards / length : glm::dvec2(1.0, 0.0)};
    for (const glm::dvec2& corner : prism.outline) wide.add(corner);
    const double height = prism.roof - ground.height(middle.x, middle.y).value_or(prism.base);
    Region tight = wide;
    const double rise = light.z - light.w * prism.roof;
    wide.high.x += std::min(2000.0, 3.0 * std::max(10.0, height) * length / rise);
    wide.widen(5.0);
    wide.spread(1500, [&](const glm::dvec2& p) {
        const auto z = ground.height(p.x, p.y);
        if (z && prism.blocks({p.x, p.y, *z}, light)) tight.add(p);
    });
    tight.widen(0.05 * glm::length(tight.high - tight.low)); // about a cell of the search
    return tight;
}

using PlanTriangle = std::array<glm::dvec2, 3>;

/// On its edges, too.
bool holds(const PlanTriangle& t, const glm::dvec2& p) {
    for (std::size_t i = 0; i < 3; ++i)
        if (across(t[(i + 1) % 3] - t[i], p - t[i]) < 0.0) return false;
    return true;
}

bool isBehindGround(const gnomon::Ground& ground, const glm::dvec2& p, const glm::dvec4& light) {
    const auto height = ground.height(p.x, p.y);
    const glm::dvec3 start(p, height.value_or(0.0) + 0.01); // not the ground that it stands on
    return height && ground.hit(start, glm::dvec3(light) - light.w * start);
}

} // namespace

glm::dvec3 sunAt(double azimuth, double elevation) {
    const double a = azimuth * degree, e = elevation * degree;
    return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

double hills(double x, double y) {
    return 40.0 * std::sin(x * 0.0031) * std::cos(y * 0.0037) + 10.0 * std::sin(x * 0.011 + 1.0) * std::cos(y * 0.013) +
           2.0 * std::sin(x * 0.04 + y * 0.03);
}

gnomon::HeightPyramid groundOf(const std::function<double(double, double)>& height, int posts, double base,
                               const glm::dvec2& corner) {
    std::vector<float> heights;
    for (int j = 0; j < posts; ++j)
        for (int i = 0; i < posts; ++i) heights.push_back(static_cast<float>(height(i * pitch, j * pitch)));
    return gnomon::HeightPyramid({{posts, posts, corner, {pitch, pitch}, base}, heights});
}

int over(const gnomon::BoxTriangles& drape, const glm::dvec2& place) {
    int count = 0;
    for (std::size_t i = 0; i + 2 < drape.size(); i += 3)
        count += holds({glm::dvec2(drape[i]), glm::dvec2(drape[i + 1]), glm::dvec2(drape[i + 2])}, place);
    return count;
}

bool Prism::isUnder(const glm::dvec2& place) const {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
        if ((a.y > place.y) != (b.y > place.y) && place.x < a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x))
            inside = !inside;
    }
    return inside;
}

bool Prism::blocks(const glm::dvec3& point, const glm::dvec4& light) const {
    const glm::dvec3 way = glm::dvec3(light) - light.w * point;
    const double last = light.w > 0.0 ? 1.0 / light.w : std::numeric_limits<double>::infinity();
    const double from = std::max(0.0, (base - point.z) / way.z), to = std::min(last, (roof - point.z) / way.z);
    if (!(from <= to)) return false;
    const glm::dvec2 start = glm::dvec2(point + from * way), step = (to - from) * glm::dvec2(way);
    if (isUnder(start)) return true;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 edge = outline[(i + 1) % outline.size()] - outline[i], arm = outline[i] - start;
        const double both = across(step, edge), along = across(arm, edge) / both, side = across(arm, step) / both;
        if (along >= 0.0 && along <= 1.0 && side >= 0.0 && side <= 1.0) return true;
    }
    return false;
}

glm::dvec2 Prism::middle() const {
    glm::dvec2 sum(0.0);
    for (const glm::dvec2& corner : outline) sum += corner;
    return sum / double(outline.size());
}

std::vector<glm::dvec3> Prism::corners() const {
    std::vector<glm::dvec3> result;
    for (const glm::dvec2& corner : outline)
        for (const double z : {base, roof}) result.emplace_back(corner, z);
    return result;
}

std::vector<gnomon::ConvexPart> Prism::parts() const {
    // Floats about a local origin, as casters come; the parts are moved back.
    const glm::dvec2 origin = outline.front();
    std::vector<glm::vec3> vertices;
    std::vector<unsigned> indices;
    const auto n = static_cast<unsigned>(outline.size());
    for (const glm::dvec3& corner : corners()) vertices.emplace_back(corner - glm::dvec3(origin, roof));
    for (unsigned i = 0; i < n; ++i) {
        const unsigned a = 2 * i, b = 2 * ((i + 1) % n);
        indices.insert(indices.end(), {a, b, b + 1, a, b + 1, a + 1});
        if (i > 0 && i + 1 < n) indices.insert(indices.end(), {1, a + 1, b + 1});
    }
    auto parts = gnomon::convexParts(vertices.data(), vertices.size(), indices.data(), indices.size());
    for (gnomon::ConvexPart& part : parts) {
        for (glm::dvec3& vertex : part.hull.vertices) vertex += glm::dvec3(origin, roof);
        for (gnomon::ConvexHull::Face& face : part.hull.faces)
            face.plane.w -= glm::dot(glm::dvec3(face.plane), glm::dvec3(origin, roof));
    }
    return parts;
}

Prism boxAt(const glm::dvec2& middle, const glm::dvec2& half, double turn, double base, double roof) {
    return {"box", placed(rectangle(half), middle, turn), base, roof};
}

std::vector<Prism> prismsOn(const gnomon::Ground& ground, const glm::dvec2& low, const glm::dvec2& high, int count,
                            unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit;
    std::vector<Prism> prisms;
    while (int(prisms.size()) < count) {
        const glm::dvec2 middle = low + (high - low) * drawn(unit, random);
        const glm::dvec2 half = 4.0 + 8.0 * drawn(unit, random);
        const glm::dvec2 cut = half * (0.2 + 0.6 * drawn(unit, random));
        const double turn = 360.0 * degree * unit(random), above = 5.0 + 25.0 * unit(random);
        const auto height = ground.height(middle.x, middle.y);
        if (!height) continue;
        const int kind = int(prisms.size()) % 4;
        const auto outline = kind < 2 ? rectangle(half) : kind == 2 ? lShape(half, cut) : circle(20, half.x);
        prisms.push_back({kind < 2    ? "box"
                          : kind == 2 ? "L"
                                      : "tank",
                          placed(outline, middle, turn), *height - 40.0, *height + above});
    }
    return prisms;
}

Method boxMethod() {
    return [](const gnomon::Ground& ground, const Prism& prism, const glm::dvec4& light) {
        const auto shadow =
            gnomon::boxShadow(ground, gnomon::boxCaster(prism.corners()), light).value_or(gnomon::BoxTriangles());
        return Found{[shadow](const glm::dvec3& place) { return over(shadow, glm::dvec2(place)) > 0; }, 12};
    };
}

Method hullMethod() {
    return [](const gnomon::Ground& ground, const Prism& prism, const glm::dvec4& light) {
        std::vector<gnomon::HullPart> parts;
        for (const gnomon::ConvexPart& part : prism.parts()) parts.emplace_back(part);
        const gnomon::HullSolids solids =
            hullSolids(gnomon::HullGround(ground), parts, light, glm::dvec3(prism.middle(), prism.roof));
        return Found{[solids](const glm::dvec3& place) { return solids.around(place) != 0; },
                     solids.corners.size() / 3};
    };
}

std::vector<Share> judge(const gnomon::Ground& ground, const Prism& prism, const glm::dvec4& light,
                         const std::vector<Contestant>& contestants, int points, Places places) {
    const Region region = reachOf(ground, prism, light);
    std::vector<Share> shares(contestants.size());
    std::vector<Found> found;
    for (std::size_t i = 0; i < contestants.size(); ++i) {
        found.push_back(contestants[i].method(ground, prism, light));
        shares[i].triangles = found.back().triangles;
    }
    region.spread(points, [&](const glm::dvec2& p) {
        if (prism.isUnder(p) || (places == Places::sunlit && isBehindGround(ground, p, light))) return;
        const auto height = ground.height(p.x, p.y);
        const glm::dvec3 place(p, height.value_or(0.0));
        const bool expected = height && prism.blocks(place, light);
        for (std::size_t i = 0; i < found.size(); ++i) {
            const bool covered = height && found[i].covers(place);
            ++shares[i].rays;
            shares[i].both += expected && covered;
            shares[i].either += expected || covered;
        }
    });
    return shares;
}

Figures tally(const std::vector<Share>& shares) {
    Figures result;
    std::vector<double> overlaps;
    double both = 0.0, either = 0.0;
    for (const Share& share : shares) {
        both += share.both;
        either += share.either;
        overlaps.push_back(share.overlap());
        result.triangles += double(share.triangles) / double(shares.size());
        result.rays += share.rays;
    }
    if (overlaps.empty()) return result;
    std::sort(overlaps.begin(), overlaps.end());
    result.pooled = either > 0.0 ? both / either : 1.0;
    result.fifth = overlaps[overlaps.size() / 20];
    result.least = overlaps.front();
    return result;
}

std::vector<Figures> figures(const gnomon::Ground& ground, const std::vector<Prism>& prisms, double elevation,
                             const std::vector<Contestant>& contestants, int points, Places places) {
    std::vector<std::vector<Share>> shares(contestants.size());
    for (std::size_t i = 0; i < prisms.size(); ++i) {
        const glm::dvec4 sun(sunAt(137.5 * double(i), elevation), 0.0); // by the golden angle: evenly all round
        const auto one = judge(ground, prisms[i], sun, contestants, points, places);
        for (std::size_t c = 0; c < one.size(); ++c) shares[c].push_back(one[c]);
    }
    std::vector<Figures> result;
    for (const std::vector<Share>& of : shares) result.push_back(tally(of));
    return result;
}

void printHead(std::ostream& out) {
    out << "| sun | method | IoU pooled | 5th percentile | triangles |\n| --: | --- | --: | --: | --: |\n";
}

void printRow(std::ostream& out, double elevation, const std::string& method, const Figures& figures) {
    out << "| " << std::defaultfloat << elevation << "° | " << method << " | " << std::fixed << std::setprecision(4)
        << figures.pooled << " | " << figures.fifth << " | " << std::setprecision(1) << figures.triangles << " |\n"
        << std::defaultfloat << std::setprecision(6);
}

} // namespace test
