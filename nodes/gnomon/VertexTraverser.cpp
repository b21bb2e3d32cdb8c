// SPDX-License-Identifier: MIT
#include <gnomon/VertexTraverser.h>

#include <osg/Geometry>
#include <osg/PrimitiveSet>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr unsigned nowhere = std::numeric_limits<unsigned>::max();

/// False for NaN too. Beyond 10¹⁸ a float's square overflows, and one such vertex would take all others' precision
/// away.
bool isUsable(const osg::Vec3d& v) {
    constexpr double most = 1e18;
    return std::abs(v.x()) <= most && std::abs(v.y()) <= most && std::abs(v.z()) <= most;
}

osg::Vec3d row(const osg::Matrixd& matrix, int i) { return {matrix(i, 0), matrix(i, 1), matrix(i, 2)}; }

osg::Vec3d absolute(const osg::Vec3d& v) { return {std::abs(v.x()), std::abs(v.y()), std::abs(v.z())}; }

osg::Vec3d larger(const osg::Vec3d& a, const osg::Vec3d& b) {
    return {std::max(a.x(), b.x()), std::max(a.y(), b.y()), std::max(a.z(), b.z())};
}

bool mirrors(const osg::Matrixd& matrix) { return (row(matrix, 0) ^ row(matrix, 1)) * row(matrix, 2) < 0.0; }

} // namespace

/// Turns the primitives of one drawable into triangles of the root's frame.
class VertexTraverser::Collector : public osg::PrimitiveFunctor {
public:
    /// @param cutout  gets the coordinates of each vertex that is used, in place of those of all; may be null.
    Collector(VertexTraverser& result, const osg::Matrixd& rootFromLocal, Cutout* cutout)
        : _result(result), _rootFromLocal(rootFromLocal), _mirrored(mirrors(rootFromLocal)), _cutout(cutout) {
        if (_cutout) _coordinates.swap(_cutout->coordinates);
    }

    void setVertexArray(unsigned count, const osg::Vec2* array) override { start(count, 2, array, nullptr); }
    void setVertexArray(unsigned count, const osg::Vec3* array) override { start(count, 3, array, nullptr); }
    void setVertexArray(unsigned count, const osg::Vec4* array) override { start(count, 4, array, nullptr); }
    void setVertexArray(unsigned count, const osg::Vec2d* array) override { start(count, 2, nullptr, array); }
    void setVertexArray(unsigned count, const osg::Vec3d* array) override { start(count, 3, nullptr, array); }
    void setVertexArray(unsigned count, const osg::Vec4d* array) override { start(count, 4, nullptr, array); }

    void drawArrays(GLenum mode, GLint first, GLsizei count) override {
        decode(mode, count, [first](unsigned i) { return static_cast<unsigned>(first) + i; });
    }
    void drawElements(GLenum mode, GLsizei count, const GLubyte* list) override { decodeList(mode, count, list); }
    void drawElements(GLenum mode, GLsizei count, const GLushort* list) override { decodeList(mode, count, list); }
    void drawElements(GLenum mode, GLsizei count, const GLuint* list) override { decodeList(mode, count, list); }

    /// Half a step of a float of the size of the largest coordinates, carried to the root's frame.
    double rounding() const {
        const osg::Vec3d step = _reach * (std::numeric_limits<float>::epsilon() / 2.0);
        osg::Vec3d inRoot;
        for (int i = 0; i < 3; ++i) inRoot += absolute(row(_rootFromLocal, i)) * step[i];
        return inRoot.length();
    }

private:
    void start(unsigned count, unsigned components, const void* floats, const void* doubles) {
        _floats = static_cast<const float*>(floats);
        _doubles = static_cast<const double*>(doubles);
        _components = components;
        _count = count;
        ++_result._array;
        if (_result._slots.size() < count) _result._slots.resize(count);
    }

    template <class Index>
    void decodeList(GLenum mode, GLsizei count, const Index* list) {
        decode(mode, count, [list](unsigned i) -> unsigned { return list[i]; });
    }

    /// `index(i)` is the vertex that the i-th of `count` corners of these primitives uses.
    template <class Index>
    void decode(GLenum mode, GLsizei count, Index index) {
        using Set = osg::PrimitiveSet;
        const bool adjacency = mode == Set::TRIANGLES_ADJACENCY || mode == Set::TRIANGLE_STRIP_ADJACENCY;
        const unsigned step = adjacency ? 2 : 1; // every second corner is a neighbour's
        const unsigned n = static_cast<unsigned>(std::max(count, 0)) / step;
        const auto at = [index, step](unsigned i) { return index(i * step); };
        switch (mode) {
        case Set::TRIANGLES:
        case Set::TRIANGLES_ADJACENCY:
            for (unsigned i = 2; i < n; i += 3) triangle(at(i - 2), at(i - 1), at(i));
            break;
        case Set::TRIANGLE_STRIP:
        case Set::TRIANGLE_STRIP_ADJACENCY:
            for (unsigned i = 2; i < n; ++i) triangle(at(i - 2 + i % 2), at(i - 1 - i % 2), at(i));
            break;
        case Set::TRIANGLE_FAN:
        case Set::POLYGON:
            for (unsigned i = 2; i < n; ++i) triangle(at(0), at(i - 1), at(i));
            break;
        case Set::QUADS:
            for (unsigned i = 3; i < n; i += 4) quad(at(i - 3), at(i - 2), at(i - 1), at(i));
            break;
        case Set::QUAD_STRIP:
            for (unsigned i = 3; i < n; i += 2) quad(at(i - 3), at(i - 2), at(i), at(i - 1));
            break;
        default:
            for (unsigned i = 0; i < n; ++i) place(at(i));
        }
    }

    void quad(unsigned a, unsigned b, unsigned c, unsigned d) {
        triangle(a, b, c);
        triangle(a, c, d);
    }

    void triangle(unsigned a, unsigned b, unsigned c) {
        if (a == b || b == c || c == a) return;
        const unsigned places[] = {place(a), place(_mirrored ? c : b), place(_mirrored ? b : c)};
        if (std::count(std::begin(places), std::end(places), nowhere) > 0)
            ++_result._invalidTriangles;
        else
            _result._triangles.insert(_result._triangles.end(), std::begin(places), std::end(places));
    }

    unsigned place(unsigned index) {
        if (index >= _count) return nowhere;
        Slot& slot = _result._slots[index];
        if (slot.array != _result._array) slot = {_result._array, add(index)};
        return slot.place;
    }

    unsigned add(unsigned index) {
        const double w = _components == 4 ? coordinate(index, 3) : 1.0;
        const osg::Vec3d local = osg::Vec3d(coordinate(index, 0), coordinate(index, 1), coordinate(index, 2)) / w;
        const osg::Vec3d inRoot = local * _rootFromLocal;
        if (!isUsable(inRoot)) return nowhere;
        if (_floats) _reach = larger(_reach, absolute(local) * (w == 1.0 ? 1.0 : 2.0)); // w is rounded as well
        _result._vertices.push_back(inRoot);
        if (_cutout) _cutout->coordinates.push_back(_coordinates[index]);
        return static_cast<unsigned>(_result._vertices.size() - 1);
    }

    double coordinate(unsigned index, unsigned axis) const {
        if (axis >= _components) return 0.0;
        const std::size_t at = std::size_t{index} * _components + axis;
        return _floats ? static_cast<double>(_floats[at]) : _doubles[at];
    }

    VertexTraverser& _result;
    const osg::Matrixd& _rootFromLocal;
    bool _mirrored;
    Cutout* _cutout;
    std::vector<osg::Vec3> _coordinates; ///< of all vertices in the array.
    const float* _floats = nullptr;
    const double* _doubles = nullptr;
    unsigned _components = 0;
    unsigned _count = 0;
    osg::Vec3d _reach; ///< largest size of each coordinate of the float vertices used.
};

VertexTraverser::VertexTraverser(const Selection& selection) : CasterVisitor(selection) {}

void VertexTraverser::reset() {
    CasterVisitor::reset();
    _vertices.clear();
    _triangles.clear();
    _sources.clear();
    _drawn.clear();
    _cutouts.clear();
    _slots.clear();
    _array = 0;
    _rounding = 0.0;
    _invalidTriangles = 0;
    _invalidNode.clear();
    _unknownTests = 0;
    _unknownNode.clear();
}

void VertexTraverser::applyCaster(osg::Drawable& drawable) {
    const unsigned invalidBefore = _invalidTriangles;
    _drawn.push_back({&drawable, _triangles.size()});
    Collector collector(*this, rootFromLocal(), startCutout(drawable));
    drawable.accept(collector);
    _rounding = std::max(_rounding, collector.rounding());
    if (invalidBefore == 0 && _invalidTriangles > 0) _invalidNode = nameHere(drawable);
    holdSources(drawable, _sources);
}

VertexTraverser::Cutout* VertexTraverser::startCutout(const osg::Drawable& drawable) {
    const std::optional<AlphaTest> test = alphaTest();
    if (!test) return nullptr;
    test->hold(drawable, _sources);
    std::vector<osg::Vec3> coordinates = test->texture ? test->coordinatesOf(drawable) : std::vector<osg::Vec3>();
    if (coordinates.empty()) {
        if (_unknownTests++ == 0) _unknownNode = nameHere(drawable);
        return nullptr;
    }
    _cutouts.push_back({_drawn.size() - 1, *test, static_cast<unsigned>(_vertices.size()), std::move(coordinates)});
    return &_cutouts.back();
}

std::string VertexTraverser::nameHere(const osg::Drawable& drawable) const {
    const osg::NodePath& path = getNodePath();
    const auto named =
        std::find_if(path.rbegin(), path.rend(), [](const osg::Node* n) { return !n->getName().empty(); });
    return named != path.rend() ? (*named)->getName() : drawable.className();
}

namespace {

template <class Distance>
std::optional<osg::Vec3d> nearest(const std::vector<osg::Vec3d>& vertices, Distance squaredDistance) {
    std::optional<osg::Vec3d> best;
    double least = std::numeric_limits<double>::infinity();
    for (const osg::Vec3d& vertex : vertices) {
        const double distance = squaredDistance(vertex);
        if (!(distance < least)) continue;
        least = distance;
        best = vertex;
    }
    return best;
}

} // namespace

std::optional<osg::Vec3d> VertexTraverser::nearestVertex(const osg::Vec3d& point) const {
    return nearest(_vertices, [&](const osg::Vec3d& v) { return (v - point).length2(); });
}

std::optional<osg::Vec3d> VertexTraverser::nearestVertexInPlan(double x, double y) const {
    return nearest(_vertices, [=](const osg::Vec3d& v) { return osg::Vec2d(v.x() - x, v.y() - y).length2(); });
}

} // namespace gnomon
