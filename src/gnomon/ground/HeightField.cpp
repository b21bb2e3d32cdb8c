// SPDX-License-Identifier: MIT
#include <gnomon/ground/GroundSearch.h>
#include <gnomon/ground/HeightField.h>

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gnomon {

HeightField::HeightField(const GridPosts& posts, std::vector<float> heights, std::vector<CellCut> cuts)
    : _posts(posts), _heights(std::move(heights)), _cuts(std::move(cuts)) {
    if (columns() < 2 || rows() < 2)
        throw std::invalid_argument("a height field needs at least 2 posts along each side.");
    if (_heights.size() != std::size_t(columns()) * std::size_t(rows()))
        throw std::invalid_argument("a height field needs one height for each post.");
    if (!_cuts.empty() && _cuts.size() != std::size_t(columns() - 1) * std::size_t(rows() - 1))
        throw std::invalid_argument("a height field needs one cut for each cell, or none at all.");
    const glm::dvec2 ends = origin() + step();
    if (!(step().x > 0.0) || !(step().y > 0.0) || !std::isfinite(ends.x + ends.y + posts.base))
        throw std::invalid_argument("a height field needs a finite step above 0 and a finite origin.");
}

bool HeightField::isHole(int x, int y) const {
    if (cut(x, y) == CellCut::hole) return true;
    const double sum = post(x, y).z + post(x + 1, y).z + post(x, y + 1).z + post(x + 1, y + 1).z;
    return !std::isfinite(sum);
}

std::array<GroundTriangle, 2> HeightField::triangles(int x, int y) const {
    const glm::dvec3 a = post(x, y), b = post(x + 1, y), c = post(x + 1, y + 1), d = post(x, y + 1);
    if (cut(x, y) == CellCut::falling) return {GroundTriangle{a, b, d}, GroundTriangle{b, c, d}};
    return {GroundTriangle{a, b, c}, GroundTriangle{a, c, d}};
}

std::array<double, 2> HeightField::planesOver(int x, int y, double u, double v) const {
    const double a = post(x, y).z, b = post(x + 1, y).z, c = post(x + 1, y + 1).z, d = post(x, y + 1).z;
    if (cut(x, y) == CellCut::falling)
        return {a + u * (b - a) + v * (d - a), c + (1.0 - u) * (d - c) + (1.0 - v) * (b - c)};
    return {a + u * (b - a) + v * (c - b), a + v * (d - a) + u * (c - d)};
}

std::optional<double> HeightField::height(double x, double y) const {
    const glm::dvec2 at = cellOf(x, y);
    if (!(at.x >= 0.0 && at.y >= 0.0 && at.x <= columns() - 1 && at.y <= rows() - 1)) return std::nullopt;
    const int i = std::min(static_cast<int>(at.x), columns() - 2), j = std::min(static_cast<int>(at.y), rows() - 2);
    if (isHole(i, j)) return std::nullopt;
    const double u = at.x - i, v = at.y - j;
    const auto [lower, upper] = planesOver(i, j, u, v);
    return (cut(i, j) == CellCut::falling ? u + v <= 1.0 : u >= v) ? lower : upper;
}

namespace {

/// Of a cell's corners: lower left, lower right, upper right, upper left.
enum Corner : unsigned char { a = 1, b = 2, c = 4, d = 8 };
constexpr unsigned char allCorners = a | b | c | d;

struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-low};
    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    glm::dvec3 size() const { return high - low; }
};

Bounds boundsOf(const GroundTriangle& triangle) {
    Bounds result;
    for (const glm::dvec3& corner : triangle) result.add(corner);
    return result;
}

double planArea(const GroundTriangle& t) { return doubleArea(t[0], t[1], t[2]); }

struct Soup {
    const std::vector<glm::dvec3>& vertices;
    const std::vector<unsigned>& indices;

    std::size_t count() const { return indices.size() / 3; }
    GroundTriangle operator[](std::size_t i) const {
        return {vertices[indices[3 * i]], vertices[indices[3 * i + 1]], vertices[indices[3 * i + 2]]};
    }
    Bounds bounds() const {
        Bounds result;
        for (const unsigned index : indices) result.add(vertices[index]);
        return result;
    }
};

using Post = glm::ivec2;

/// Gathers triangles into cells, and says where they do not fit.
class Gatherer {
public:
    Gatherer(const Bounds& all, const glm::dvec2& step, double tolerance)
        : _columns(posts(all.size().x / step.x)),
          _rows(posts(all.size().y / step.y)),
          _origin(all.low),
          _step(glm::dvec2(all.size()) / glm::dvec2(_columns - 1, _rows - 1)),
          _tolerance(std::min(tolerance, 1e-3 * std::min(step.x, step.y))),
          _base((all.low.z + all.high.z) / 2.0) {}

    /// No more than eight cells a triangle: else most would be holes.
    bool fits(std::size_t triangles) const { return _columns >= 2 && _rows >= 2 && cells() <= 8.0 * double(triangles); }
    void start() {
        _heights.assign(std::size_t(_columns) * std::size_t(_rows), std::numeric_limits<double>::quiet_NaN());
        _missing.assign(std::size_t(cells()), 0);
    }
    /// Corners at posts make half of a cell or no area.
    bool isWall(const GroundTriangle& t) const { return std::abs(planArea(t)) <= 0.1 * _step.x * _step.y; }
    bool add(const GroundTriangle& triangle);
    bool hangs(const GroundTriangle& wall) const;
    std::optional<HeightField> field() const;

private:
    static int posts(double steps) { return steps < 1e9 ? static_cast<int>(std::lround(steps)) + 1 : 0; }
    double cells() const { return double(_columns - 1) * double(_rows - 1); }
    std::size_t placeOf(const Post& post) const {
        return std::size_t(post.y) * std::size_t(_columns) + std::size_t(post.x);
    }
    /// The post that a corner is at.
    std::optional<Post> postOf(const glm::dvec3& corner) const;
    /// Whether a post has this height, or none yet.
    bool agrees(const Post& post, double height);
    bool addHalf(const std::array<Post, 3>& posts);

    int _columns, _rows;
    glm::dvec2 _origin, _step;
    double _tolerance, _base;
    std::vector<double> _heights;
    std::vector<unsigned char> _missing; ///< of each cell, the corners that its triangles do not have.
};

std::optional<Post> Gatherer::postOf(const glm::dvec3& corner) const {
    const glm::dvec2 post = glm::round((glm::dvec2(corner) - _origin) / _step);
    const glm::dvec2 off = glm::abs(_origin + post * _step - glm::dvec2(corner));
    return off.x <= _tolerance && off.y <= _tolerance ? std::optional<Post>(post) : std::nullopt;
}

bool Gatherer::agrees(const Post& post, double height) {
    double& known = _heights[placeOf(post)];
    if (std::isnan(known)) known = height;
    return std::abs(known - height) <= _tolerance;
}

bool Gatherer::addHalf(const std::array<Post, 3>& posts) {
    const Post low = glm::min(posts[0], glm::min(posts[1], posts[2]));
    unsigned char has = 0;
    for (const Post& post : posts) {
        const Post way = post - low;
        if (way.x > 1 || way.y > 1) return false;
        constexpr Corner corners[2][2] = {{a, b}, {d, c}};
        has |= corners[way.y][way.x];
    }
    unsigned char& missing = _missing[std::size_t(low.y) * std::size_t(_columns - 1) + std::size_t(low.x)];
    const auto lacks = static_cast<unsigned char>(allCorners & ~has);
    if ((missing & lacks) != 0) return false; // this half was there
    missing |= lacks;
    return true;
}

bool Gatherer::add(const GroundTriangle& triangle) {
    std::array<Post, 3> posts;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto post = postOf(triangle[i]);
        if (!post || !agrees(*post, triangle[i].z)) return false;
        posts[i] = *post;
    }
    return addHalf(posts);
}

bool Gatherer::hangs(const GroundTriangle& wall) const {
    return std::all_of(wall.begin(), wall.end(), [this](const glm::dvec3& corner) {
        const auto post = postOf(corner);
        return post && corner.z <= _heights[placeOf(*post)] + _tolerance;
    });
}

std::optional<HeightField> Gatherer::field() const {
    std::vector<CellCut> cuts;
    for (const unsigned char missing : _missing) {
        if (missing != 0 && missing != (b | d) && missing != (a | c)) return std::nullopt;
        cuts.push_back(missing == 0 ? CellCut::hole : missing == (b | d) ? CellCut::rising : CellCut::falling);
    }
    if (std::all_of(cuts.begin(), cuts.end(), [](CellCut cut) { return cut == CellCut::rising; })) cuts.clear();
    std::vector<float> heights;
    for (const double height : _heights) heights.push_back(static_cast<float>(height - _base));
    return HeightField({_columns, _rows, _origin, _step, _base}, std::move(heights), std::move(cuts));
}

/// Of a grid, each triangle that is no wall is half of its bounds, which are a cell.
std::optional<glm::dvec2> stepOf(const Soup& soup) {
    for (std::size_t i = 0; i < soup.count(); ++i) {
        const glm::dvec2 size(boundsOf(soup[i]).size());
        if (std::abs(planArea(soup[i])) > 0.9 * size.x * size.y && size.x * size.y > 0.0) return size;
    }
    return std::nullopt;
}

} // namespace

std::optional<HeightField> gridOf(const std::vector<glm::dvec3>& vertices, const std::vector<unsigned>& indices,
                                  double tolerance) {
    const auto isIn = [&](unsigned index) { return index < vertices.size(); };
    if (indices.size() % 3 != 0 || !std::all_of(indices.begin(), indices.end(), isIn)) return std::nullopt;
    const Soup soup{vertices, indices};
    const auto step = stepOf(soup);
    if (!step) return std::nullopt;
    Gatherer gatherer(soup.bounds(), *step, tolerance);
    if (!gatherer.fits(soup.count())) return std::nullopt;
    gatherer.start();
    for (std::size_t i = 0; i < soup.count(); ++i)
        if (!gatherer.isWall(soup[i]) && !gatherer.add(soup[i])) return std::nullopt;
    for (std::size_t i = 0; i < soup.count(); ++i)
        if (gatherer.isWall(soup[i]) && !gatherer.hangs(soup[i])) return std::nullopt;
    return gatherer.field();
}

} // namespace gnomon
