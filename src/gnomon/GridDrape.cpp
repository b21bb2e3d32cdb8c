// SPDX-License-Identifier: MIT
#include <gnomon/GridDrape.h>
#include <gnomon/ShadowKernel.h>

namespace gnomon {
namespace {

constexpr int mostBlocks = 128; // along a side: beyond, a way down the pyramid is as quick

} // namespace

const Drape* GridDrape::drape(const HeightPyramid& ground, const Planes& planes, const glm::dvec2& low,
                              const glm::dvec2& high, double error, double tangent) {
    _triangles.clear();
    const HeightField& field = ground.field();
    const glm::dvec2 anchor(planes.anchor);
    const auto cells = ground.cells(field.cellOf(anchor.x + low.x, anchor.y + low.y),
                                    field.cellOf(anchor.x + high.x, anchor.y + high.y));
    if (!cells) return &_triangles; // beside the ground
    if (cells->right - cells->left > mostBlocks || cells->high - cells->low > mostBlocks) return nullptr;
    if (planes.about.size() > mostKernelPlanes) return nullptr;
    _ground = &ground;
    _planes = &planes;
    _cells = *cells;
    _off = error > 0.0 ? heightError(error, tangent, ground.steepest(*cells)) : 0.0;
    askPlanes();
    int level = 0;
    while ((cells->right >> level) - (cells->left >> level) > 1 || (cells->high >> level) - (cells->low >> level) > 1)
        ++level;
    for (int y = cells->low >> level; y <= cells->high >> level; ++y)
        for (int x = cells->left >> level; x <= cells->right >> level; ++x) visit(level, x, y);
    return &_triangles;
}

/// A block whose triangles stand for it, or what it is made of.
void GridDrape::visit(int level, int x, int y) {
    const int left = x << level, low = y << level, side = 1 << level;
    if (left > _cells.right || low > _cells.high || left + side <= _cells.left || low + side <= _cells.low) return;
    if (_ground->isHole(level, x, y)) return;
    const bool isIn =
        left >= _cells.left && low >= _cells.low && left + side <= _cells.right + 1 && low + side <= _cells.high + 1;
    if (level == 0 || (isIn && _ground->off(level, x, y) <= _off)) {
        take(left, low, side, level == 0 && _ground->field().cut(x, y) == CellCut::falling);
        return;
    }
    for (int j = 2 * y; j < 2 * y + 2; ++j)
        for (int i = 2 * x; i < 2 * x + 2; ++i) visit(level - 1, i, j);
}

void GridDrape::take(int left, int low, int side, bool falls) {
    const auto stride = std::size_t(_cells.right - _cells.left + 2);
    const std::size_t a = std::size_t(low - _cells.low) * stride + std::size_t(left - _cells.left),
                      b = a + std::size_t(side), d = a + std::size_t(side) * stride, c = d + std::size_t(side);
    add(a, b, falls ? d : c);
    add(falls ? b : a, c, d);
}

void GridDrape::askPlanes() {
    const HeightField& field = _ground->field();
    const std::size_t count = std::size_t(_cells.right - _cells.left + 2) * std::size_t(_cells.high - _cells.low + 2);
    if (_x.size() < count + kernelPad)
        for (std::vector<double>* lane : {&_x, &_y, &_z, &_sides}) lane->resize(2 * count + kernelPad);
    std::size_t at = 0;
    for (int y = _cells.low; y <= _cells.high + 1; ++y)
        for (int x = _cells.left; x <= _cells.right + 1; ++x, ++at) {
            const glm::dvec3 p = field.post(x, y) - _planes->anchor;
            _x[at] = p.x;
            _y[at] = p.y;
            _z[at] = p.z;
        }
    shadowKernel().sides({count, _x.data(), _y.data(), _z.data(), _sides.data()}, &_planes->about.front().x,
                         _planes->about.size());
}

/// A triangle of posts, or what of it is in the shadow.
void GridDrape::add(std::size_t a, std::size_t b, std::size_t c) {
    const auto outside = [&](std::size_t i) { return std::uint64_t(std::int64_t(_sides[i])); };
    if (outside(a) & outside(b) & outside(c)) return;
    const std::uint64_t any = outside(a) | outside(b) | outside(c);
    if (any == 0) {
        for (const std::size_t i : {a, b, c}) _triangles.push_back(post(i));
        return;
    }
    const std::vector<glm::dvec3>& polygon = _clipper.clip({post(a), post(b), post(c)}, _planes->about, ~any);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        for (const glm::dvec3& corner : {polygon[0], polygon[i - 1], polygon[i]}) _triangles.push_back(corner);
}

} // namespace gnomon
