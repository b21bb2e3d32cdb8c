// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Array>
#include <osg/Drawable>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/PrimitiveSet>
#include <osg/Vec3d>
#include <osg/Vec4>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace gnomon {

/// Along which diagonal the driver cuts GL_QUADS. OpenGL leaves it open, and a quad that is not flat shows it: NVIDIA's (580)
/// cuts from the first corner to the third, Mesa's from the second to the fourth, in lists, by indices and in buffers alike.
/// Both cut those of a strip from the first corner to the fourth. A process has one driver.
bool cutsQuadsFromFirst();
/// Learns it from the name of the driver whose context is current.
void learnQuadCut();

/// Reads a drawable's primitives, of every mode, as triangles, and its vertices in the root's frame.
///
/// Quads are cut as the driver cuts them, and those of a strip from the first corner to the fourth.
class TriangleDecoder : public osg::PrimitiveFunctor {
public:
    explicit TriangleDecoder(const osg::Matrixd& rootFromLocal)
        : _rootFromLocal(rootFromLocal),
          _affine(rootFromLocal(0, 3) == 0.0 && rootFromLocal(1, 3) == 0.0 && rootFromLocal(2, 3) == 0.0 &&
                  rootFromLocal(3, 3) == 1.0) {}

    void setVertexArray(unsigned count, const osg::Vec2* array) override { begin(count, 2, array, nullptr); }
    void setVertexArray(unsigned count, const osg::Vec3* array) override { begin(count, 3, array, nullptr); }
    void setVertexArray(unsigned count, const osg::Vec4* array) override { begin(count, 4, array, nullptr); }
    void setVertexArray(unsigned count, const osg::Vec2d* array) override { begin(count, 2, nullptr, array); }
    void setVertexArray(unsigned count, const osg::Vec3d* array) override { begin(count, 3, nullptr, array); }
    void setVertexArray(unsigned count, const osg::Vec4d* array) override { begin(count, 4, nullptr, array); }

    void drawArrays(GLenum mode, GLint first, GLsizei count) override {
        decode(mode, count, [first](unsigned i) { return static_cast<unsigned>(first) + i; });
    }
    void drawElements(GLenum mode, GLsizei count, const GLubyte* list) override { decodeList(mode, count, list); }
    void drawElements(GLenum mode, GLsizei count, const GLushort* list) override { decodeList(mode, count, list); }
    void drawElements(GLenum mode, GLsizei count, const GLuint* list) override { decodeList(mode, count, list); }

    /// Index that ends a primitive in lists: see Casting::restart. Default: none.
    void setRestart(const std::optional<unsigned>& index) { _restart = index; }
    /// Indices by a function of the corner's number, as a list has them.
    /// @param largest  index of their type.
    /// @param base     is added to each.
    template <class Index>
    void drawIndexed(GLenum mode, unsigned count, Index index, unsigned largest, unsigned base = 0) {
        const unsigned restart = _restart && *_restart == ~0u ? largest : _restart.value_or(0);
        for (unsigned first = 0, end = 0; first <= count; first = end + 1) {
            for (end = _restart ? first : count; end < count && index(end) != restart;) ++end;
            decode(mode, static_cast<GLsizei>(end - first), [=](unsigned i) { return index(first + i) + base; });
        }
    }

protected:
    ~TriangleDecoder() override = default;

    /// The vertices that follow are those of another array. @param count  how many there are.
    virtual void start(unsigned count) = 0;
    /// No two of the indices are equal; any may be out of the array.
    virtual void triangle(unsigned a, unsigned b, unsigned c) = 0;
    /// Of a point or line.
    virtual void point(unsigned index) = 0;

    bool isInArray(unsigned index) const { return index < _count; }
    bool isOfFloats() const { return _floats; }
    double weight(unsigned index) const { return _components == 4 ? coordinate(index, 3) : 1.0; }
    osg::Vec3d local(unsigned index) const {
        const osg::Vec3d place(coordinate(index, 0), coordinate(index, 1), coordinate(index, 2));
        return _components == 4 ? place / coordinate(index, 3) : place;
    }
    /// The same as place * rootFromLocal(), to the bit.
    osg::Vec3d inRoot(const osg::Vec3d& place) const {
        if (!_affine) return place * _rootFromLocal;
        const auto along = [&](int i) {
            return _rootFromLocal(0, i) * place.x() + _rootFromLocal(1, i) * place.y() +
                   _rootFromLocal(2, i) * place.z() + _rootFromLocal(3, i);
        };
        return {along(0), along(1), along(2)};
    }
    const osg::Matrixd& rootFromLocal() const { return _rootFromLocal; }

    /// False for NaN too. Beyond 10¹⁸ a float's square overflows, and one such vertex would take all others' precision
    /// away.
    static bool isUsable(const osg::Vec3d& v) {
        constexpr double most = 1e18;
        return std::abs(v.x()) <= most && std::abs(v.y()) <= most && std::abs(v.z()) <= most;
    }

private:
    void begin(unsigned count, unsigned components, const void* floats, const void* doubles) {
        _floats = static_cast<const float*>(floats);
        _doubles = static_cast<const double*>(doubles);
        _components = components;
        _count = count;
        start(count);
    }

    template <class Index>
    void decodeList(GLenum mode, GLsizei count, const Index* list) {
        drawIndexed(
            mode, static_cast<unsigned>(std::max(count, 0)), [list](unsigned i) -> unsigned { return list[i]; },
            std::numeric_limits<Index>::max());
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
            for (unsigned i = 2; i < n; i += 3) corners(at(i - 2), at(i - 1), at(i));
            break;
        case Set::TRIANGLE_STRIP:
        case Set::TRIANGLE_STRIP_ADJACENCY:
            for (unsigned i = 2; i < n; ++i) corners(at(i - 2 + i % 2), at(i - 1 - i % 2), at(i));
            break;
        case Set::TRIANGLE_FAN:
        case Set::POLYGON:
            for (unsigned i = 2; i < n; ++i) corners(at(0), at(i - 1), at(i));
            break;
        case Set::QUADS:
            for (unsigned i = 3; i < n; i += 4) {
                corners(at(i - 3), at(i - 2), at(_quadsFromFirst ? i - 1 : i));
                corners(at(_quadsFromFirst ? i - 3 : i - 2), at(i - 1), at(i));
            }
            break;
        case Set::QUAD_STRIP:
            for (unsigned i = 3; i < n; i += 2) {
                corners(at(i - 3), at(i - 2), at(i));
                corners(at(i - 3), at(i), at(i - 1));
            }
            break;
        default:
            for (unsigned i = 0; i < n; ++i) point(at(i));
        }
    }

    void corners(unsigned a, unsigned b, unsigned c) {
        if (a != b && b != c && c != a) triangle(a, b, c);
    }

    double coordinate(unsigned index, unsigned axis) const {
        if (axis >= _components) return 0.0;
        const std::size_t at = std::size_t{index} * _components + axis;
        return _floats ? static_cast<double>(_floats[at]) : _doubles[at];
    }

    const osg::Matrixd _rootFromLocal;
    std::optional<unsigned> _restart;
    const bool _affine;
    const bool _quadsFromFirst = cutsQuadsFromFirst();
    const float* _floats = nullptr;
    const double* _doubles = nullptr;
    unsigned _components = 0;
    unsigned _count = 0;
};

/// Reads a drawable's triangles, of integer vertex arrays and indirect primitives as well, which OpenSceneGraph's functors
/// leave out.
///
/// An attribute array on place 0 is read as OpenGL reads it: normalised if it says so. So is a vertex array that says so,
/// which holds under vertex attribute aliasing alone.
void readTriangles(const osg::Drawable& drawable, TriangleDecoder& into);

/// The vertices that OpenSceneGraph's functors take of a geometry; null if it has none.
const osg::Array* verticesOf(const osg::Geometry& geometry);

/// A geometry's normals, if it has one a vertex; null otherwise.
const osg::Array* normalArrayOf(const osg::Geometry& geometry);
/// These, of any length, whatever their w; none without an array.
std::vector<osg::Vec4> normalsOf(const osg::Drawable& drawable);

/// True if OpenSceneGraph can hand out the drawable's triangles: not those of particles, for one.
bool hasTriangles(const osg::Drawable& drawable);

/// True if triangles are among its primitives, whether it has vertices for them or a program makes those up.
bool drawsTriangles(const osg::Geometry& geometry);

/// The commands by which a primitive set is drawn indirectly; null for other sets.
const osg::BufferData* indirectCommands(const osg::PrimitiveSet& set);

/// True if a drawable has a shape that it hands out no triangles of: of a class with drawImplementation() alone, of
/// patches, or drawn by indirect commands that draw nothing as they stand in memory, for a program may write them. Text, particles, pixels and compute dispatches do not count: they cast nothing.
bool drawsItself(const osg::Drawable& drawable);

} // namespace gnomon
