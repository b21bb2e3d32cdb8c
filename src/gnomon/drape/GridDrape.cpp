// SPDX-License-Identifier: MIT
#include <gnomon/drape/GridDrape.h>
#include <gnomon/simd/ShadowKernel.h>

#include <algorithm>

namespace gnomon {
namespace {

constexpr unsigned none = ~0u;
constexpr std::size_t expectedCuts = 64;
constexpr int mostBlocks = 128; // along a side: beyond, a way down the pyramid is as quick

} // namespace

const DrapeMesh* GridDrape::drape(const HeightPyramid& ground, const Planes& planes, const glm::dvec2& low,
                                  const glm::dvec2& high, double error, double tangent, const ShadowKernel& kernel) {
    _mesh.corners.clear();
    _mesh.indices.clear();
    const HeightField& field = ground.field();
    const glm::dvec2 anchor(planes.anchor);
    const auto cells = ground.cells(field.cellOf(anchor.x + low.x, anchor.y + low.y),
                                    field.cellOf(anchor.x + high.x, anchor.y + high.y));
    if (!cells) return &_mesh; // beside the ground
    if (cells->right - cells->left > mostBlocks || cells->high - cells->low > mostBlocks) return nullptr;
    if (planes.about.size() > mostKernelPlanes) return nullptr;
    _ground = &ground;
    _planes = &planes;
    _cells = *cells;
    _off = heightError(error, tangent, ground.steepest(*cells));
    askPlanes(kernel);
    int level = 0;
    while ((cells->right >> level) - (cells->left >> level) > 1 || (cells->high >> level) - (cells->low >> level) > 1)
        ++level;
    for (int y = cells->low >> level; y <= cells->high >> level; ++y)
        for (int x = cells->left >> level; x <= cells->right >> level; ++x) visit(level, x, y);
    return &_mesh;
}

/// A block whose triangles stand for it, or what it is made of.
void GridDrape::visit(int level, int x, int y) {
    const int left = x << level, low = y << level, side = 1 << level;
    if (_ground->isHole(level, x, y)) return;
    const bool isIn =
        left >= _cells.left && low >= _cells.low && left + side <= _cells.right + 1 && low + side <= _cells.high + 1;
    if (level == 0 || (isIn && _ground->off(level, x, y) <= _off)) {
        take(left, low, side, level == 0 && _ground->field().cut(x, y) == CellCut::falling);
        return;
    }
    const int lower = level - 1;
    for (int j = std::max(2 * y, _cells.low >> lower); j <= std::min(2 * y + 1, _cells.high >> lower); ++j)
        for (int i = std::max(2 * x, _cells.left >> lower); i <= std::min(2 * x + 1, _cells.right >> lower); ++i)
            visit(lower, i, j);
}

void GridDrape::take(int left, int low, int side, bool falls) {
    const auto stride = std::size_t(_cells.right - _cells.left + 2);
    const std::size_t a = std::size_t(low - _cells.low) * stride + std::size_t(left - _cells.left),
                      b = a + std::size_t(side), d = a + std::size_t(side) * stride, c = d + std::size_t(side);
    add(a, b, falls ? d : c);
    add(falls ? b : a, c, d);
}

void GridDrape::askPlanes(const ShadowKernel& kernel) {
    const HeightField& field = _ground->field();
    const std::size_t count = std::size_t(_cells.right - _cells.left + 2) * std::size_t(_cells.high - _cells.low + 2);
    if (_x.size() < count + kernelPad)
        for (std::vector<double>* lane : {&_x, &_y, &_z, &_sides}) lane->resize(2 * count + kernelPad);
    _postNumbers.assign(count, none);
    _cuts.clear(expectedCuts);
    _cutNumbers.clear();
    std::size_t at = 0;
    for (int y = _cells.low; y <= _cells.high + 1; ++y) {
        const glm::dvec3 first = field.post(_cells.left, y) - _planes->anchor;
        const double left = field.origin().x - _planes->anchor.x, base = field.base() - _planes->anchor.z;
        const float* heights = field.heights() + std::size_t(y) * std::size_t(field.columns());
        for (int x = _cells.left; x <= _cells.right + 1; ++x, ++at) {
            _x[at] = left + x * field.step().x;
            _y[at] = first.y;
            _z[at] = base + double(heights[x]);
        }
    }
    kernel.sides({count, _x.data(), _y.data(), _z.data(), _sides.data()}, &_planes->about.front().x,
                 _planes->about.size());
}

/// A triangle of posts, or what of it is in the shadow.
void GridDrape::add(std::size_t a, std::size_t b, std::size_t c) {
    const auto outside = [&](std::size_t i) { return std::uint64_t(std::int64_t(_sides[i])); };
    if (outside(a) & outside(b) & outside(c)) return;
    const std::uint64_t any = outside(a) | outside(b) | outside(c);
    if (any == 0) {
        for (const std::size_t i : {a, b, c}) _mesh.indices.push_back(numberOfPost(i));
        return;
    }
    const Clipper::Polygon polygon = _clipper.clip({post(a), post(b), post(c)}, _planes->about, ~any);
    if (polygon.size < 3) return;
    _corners.clear();
    for (std::size_t i = 0; i < polygon.size; ++i) _corners.push_back(numberOf(polygon.corners[i], {a, b, c}));
    for (std::size_t i = 2; i < _corners.size(); ++i)
        for (const unsigned corner : {_corners[0], _corners[i - 1], _corners[i]}) _mesh.indices.push_back(corner);
}

unsigned GridDrape::newNumber(const glm::dvec3& place) {
    _mesh.corners.push_back(place);
    return unsigned(_mesh.corners.size() - 1);
}

unsigned GridDrape::numberOfPost(std::size_t at) {
    if (_postNumbers[at] == none) _postNumbers[at] = newNumber(post(at));
    return _postNumbers[at];
}

/// @param posts  the triangle's.
unsigned GridDrape::numberOf(const Clipper::Corner& corner, const std::array<std::size_t, 3>& posts) {
    if (corner.plane < 0) return numberOfPost(posts[std::size_t(corner.from)]);
    if (corner.from == Clipper::none) return newNumber(corner.place);
    const std::size_t a = posts[std::size_t(corner.from)], b = posts[std::size_t(corner.from + 1) % 3];
    const unsigned cut = _cuts.of((std::uint64_t(std::min(a, b)) << 32 | std::max(a, b)) << 6 | unsigned(corner.plane));
    if (cut == _cutNumbers.size()) _cutNumbers.push_back(newNumber(corner.place));
    return _cutNumbers[cut];
}

} // namespace gnomon
