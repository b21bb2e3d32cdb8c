// SPDX-License-Identifier: MIT
#include <gnomon/ground/GroundIntersection.h>
#include <gnomon/overlay/ShadowBitmap.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace gnomon {
namespace {

using Cells = HeightPyramid::Cells;

Cells united(const Cells& a, const Cells& b) {
    return {std::min(a.left, b.left), std::min(a.low, b.low), std::max(a.right, b.right), std::max(a.high, b.high)};
}

/// Which cells of the ground are under shadows, of a block of them.
class UsedCells {
public:
    void begin(const Cells& all) {
        _all = all;
        _used.assign(std::size_t(columns()) * std::size_t(all.high - all.low + 1), 0);
        _numbers.assign((std::size_t(columns()) + 1) * std::size_t(all.high - all.low + 2), none);
    }
    void take(const Cells& cells) {
        for (int y = cells.low; y <= cells.high; ++y)
            std::fill_n(_used.begin() + std::ptrdiff_t(place(cells.left, y)), cells.right - cells.left + 1, char(1));
    }
    template <class Take>
    void each(const Take& take) const {
        for (int y = _all.low; y <= _all.high; ++y)
            for (int x = _all.left; x <= _all.right; ++x)
                if (_used[place(x, y)]) take(x, y);
    }

    /// Of a post of them among `vertices`, where it is put if it is not there yet.
    unsigned numberOf(int x, int y, const HeightField& field, const glm::dvec3& origin,
                      std::vector<glm::vec3>& vertices) {
        unsigned& number =
            _numbers[std::size_t(y - _all.low) * (std::size_t(columns()) + 1) + std::size_t(x - _all.left)];
        if (number == none) {
            number = unsigned(vertices.size());
            vertices.emplace_back(field.post(x, y) - origin);
        }
        return number;
    }

private:
    static constexpr unsigned none = ~0u;
    int columns() const { return _all.right - _all.left + 1; }
    std::size_t place(int x, int y) const {
        return std::size_t(y - _all.low) * std::size_t(columns()) + std::size_t(x - _all.left);
    }
    Cells _all{};
    std::vector<char> _used;
    std::vector<unsigned> _numbers; ///< of posts.
};

/// Two triangles for each cell that is no hole, cut as the ground is.
void addGround(const HeightField& field, UsedCells& cells, const glm::dvec3& origin, ShadowBitmap& into) {
    cells.each([&](int x, int y) {
        if (field.isHole(x, y)) return;
        const auto number = [&](int right, int up) {
            return cells.numberOf(x + right, y + up, field, origin, into.vertices);
        };
        const unsigned a = number(0, 0), b = number(1, 0), c = number(1, 1), d = number(0, 1);
        if (field.cut(x, y) == CellCut::falling)
            into.triangles.insert(into.triangles.end(), {a, b, d, b, c, d});
        else
            into.triangles.insert(into.triangles.end(), {a, b, c, a, c, d});
    });
}

/// Sets the bits of polygons.
class Raster {
public:
    explicit Raster(ShadowBitmap& into) : _into(into), _height(into.rows * ShadowBitmap::high) {
        _spans.assign(std::size_t(_height), none);
    }
    void begin() { _polygon.clear(); }
    void add(const glm::vec3& corner) {
        _polygon.push_back((glm::dvec2(corner) - _into.low) / _into.texel - glm::dvec2(0.5));
    }
    /// Convex, all of it within the bitmap.
    void fill() {
        _first = _height;
        _last = -1;
        for (std::size_t i = 0; i < _polygon.size(); ++i) takeEdge(_polygon[i], _polygon[(i + 1) % _polygon.size()]);
        for (int y = _first; y <= _last; ++y) {
            Span& span = _spans[std::size_t(y)];
            setBits(int(std::ceil(span.from)), int(std::floor(span.to)), y);
            span = none;
        }
    }

private:
    struct Span {
        double from, to;
    };
    static constexpr Span none{1e9, -1e9};

    /// Where it meets the rows of texels' middles.
    void takeEdge(const glm::dvec2& a, const glm::dvec2& b) {
        const glm::dvec2 &low = a.y <= b.y ? a : b, &high = a.y <= b.y ? b : a;
        const int first = std::max(int(std::ceil(low.y)), 0), last = std::min(int(std::floor(high.y)), _height - 1);
        if (last < first) return;
        _first = std::min(_first, first);
        _last = std::max(_last, last);
        const double slope = high.y > low.y ? (high.x - low.x) / (high.y - low.y) : 0.0;
        for (int y = first; y <= last; ++y) take(low.x + slope * (y - low.y), y);
        if (high.y == low.y) take(high.x, first);
    }
    void take(double x, int y) {
        Span& span = _spans[std::size_t(y)];
        span.from = std::min(span.from, x);
        span.to = std::max(span.to, x);
    }
    void setBits(int from, int to, int y) {
        constexpr int wide = ShadowBitmap::wide;
        for (int column = from / wide; column <= to / wide && from <= to; ++column) {
            const unsigned first = unsigned(std::max(from - column * wide, 0)),
                           last = unsigned(std::min(to - column * wide, wide - 1));
            std::uint8_t& byte = _into.bytes[_into.place(column * wide, y)];
            byte = std::uint8_t(byte | ((0xFFu << first) & (0xFFu >> (unsigned(wide - 1) - last))));
        }
    }

    ShadowBitmap& _into;
    const int _height; ///< texels.
    int _first = 0, _last = -1;
    std::vector<glm::dvec2> _polygon; ///< in texels from the middle of the first one.
    std::vector<Span> _spans;         ///< of each row, between the polygon's edges.
};

void fill(const PackedShadow& shadow, Raster& raster) {
    const glm::vec3* corners = shadow.corners;
    const auto fillTriangle = [&](std::size_t a, std::size_t b, std::size_t c) {
        raster.begin();
        for (const std::size_t corner : {a, b, c}) raster.add(corners[corner]);
        raster.fill();
    };
    if (shadow.isFan() && isConvex(corners, shadow.cornerCount)) {
        raster.begin();
        std::for_each(corners, corners + shadow.cornerCount, [&](const glm::vec3& corner) { raster.add(corner); });
        raster.fill();
    } else if (shadow.isFan())
        for (std::size_t i = 2; i < shadow.cornerCount; ++i) fillTriangle(0, i - 1, i);
    for (std::size_t i = 0; i + 2 < shadow.indexCount; i += 3)
        fillTriangle(shadow.indices[i], shadow.indices[i + 1], shadow.indices[i + 2]);
}

/// An empty texel or more all around.
void placeTexels(const glm::dvec2& low, const glm::dvec2& high, ShadowBitmap& into) {
    into.low = low - into.texel;
    const glm::dvec2 texels = glm::floor((high - into.low) / into.texel) + 2.0;
    into.columns = int(std::ceil(texels.x / ShadowBitmap::wide));
    into.rows = int(std::ceil(texels.y / ShadowBitmap::high));
    into.bytes.assign(std::size_t(into.columns) * std::size_t(into.rows) * ShadowBitmap::high, 0);
}

} // namespace

std::size_t ShadowBitmap::place(int x, int y) const {
    return (std::size_t(y / high) * std::size_t(columns) + std::size_t(x / wide)) * high + std::size_t(y % high);
}

bool ShadowBitmap::isSet(int x, int y) const { return bytes[place(x, y)] >> x % wide & 1u; }

void shadowBitmap(const HeightPyramid& ground, const PackedShadows& shadows, double texel, ShadowBitmap& into) {
    thread_local std::vector<std::pair<std::size_t, Cells>> decals;
    decals.clear();
    std::optional<Cells> all;
    glm::vec2 low(std::numeric_limits<float>::infinity()), high(-low);
    for (std::size_t i = 0; i < shadows.size(); ++i) {
        const auto cells = decalCells(ground, shadows[i], shadows.origin);
        if (!cells) continue;
        decals.emplace_back(i, *cells);
        all = all ? united(*all, *cells) : *cells;
        for (std::size_t k = 0; k < shadows[i].cornerCount; ++k) {
            low = glm::min(low, glm::vec2(shadows[i].corners[k]));
            high = glm::max(high, glm::vec2(shadows[i].corners[k]));
        }
    }
    into = {{}, texel, 0, 0, std::move(into.bytes), std::move(into.vertices), std::move(into.triangles)};
    into.bytes.clear();
    into.vertices.clear();
    into.triangles.clear();
    if (!all) return;
    thread_local UsedCells used;
    used.begin(*all);
    placeTexels(glm::dvec2(low), glm::dvec2(high), into);
    Raster raster(into);
    for (const auto& [i, cells] : decals) {
        used.take(cells);
        fill(shadows[i], raster);
    }
    addGround(ground.field(), used, shadows.origin, into);
}

} // namespace gnomon
