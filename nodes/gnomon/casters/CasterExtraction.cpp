// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/DrawableTriangles.h>

#include <osg/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace gnomon {
namespace {

constexpr unsigned nowhere = std::numeric_limits<unsigned>::max();

osg::Vec3d row(const osg::Matrixd& matrix, int i) { return {matrix(i, 0), matrix(i, 1), matrix(i, 2)}; }

osg::Vec3d absolute(const osg::Vec3d& v) { return {std::abs(v.x()), std::abs(v.y()), std::abs(v.z())}; }

osg::Vec3d larger(const osg::Vec3d& a, const osg::Vec3d& b) {
    return {std::max(a.x(), b.x()), std::max(a.y(), b.y()), std::max(a.z(), b.z())};
}

} // namespace

/// Turns the primitives of one drawable into triangles of the root's frame.
class CasterExtraction::Collector : public TriangleDecoder {
public:
    /// @param cutout  gets the coordinates of each vertex that is used, in place of those of all; may be null.
    Collector(CasterExtraction& result, const osg::Matrixd& rootFromLocal, Cutout* cutout)
        : TriangleDecoder(rootFromLocal, result.quads()),
          _result(result),
          _mirrored(mirrors(rootFromLocal)),
          _cutout(cutout) {
        if (_cutout) _coordinates.swap(_cutout->coordinates);
    }

    /// Half a step of a float of the size of the largest coordinates, carried to the root's frame.
    double rounding() const {
        const osg::Vec3d step = _reach * (std::numeric_limits<float>::epsilon() / 2.0);
        osg::Vec3d inRoot;
        for (int i = 0; i < 3; ++i) inRoot += absolute(row(rootFromLocal(), i)) * step[i];
        return inRoot.length();
    }

protected:
    void start(unsigned count) override {
        ++_result._array;
        if (_result._slots.size() < count) _result._slots.resize(count);
        std::vector<osg::Vec3d>& vertices = _result._vertices;
        if (vertices.capacity() - vertices.size() < count) // of many arrays, room for as many again
            vertices.reserve(std::max(vertices.size() + count, 2 * vertices.capacity()));
    }

    void triangle(unsigned a, unsigned b, unsigned c) override {
        const unsigned places[] = {place(a), place(_mirrored ? c : b), place(_mirrored ? b : c)};
        if (std::count(std::begin(places), std::end(places), nowhere) > 0)
            ++_result._invalidTriangles;
        else
            _result._triangles.insert(_result._triangles.end(), std::begin(places), std::end(places));
    }

    void point(unsigned index) override { place(index); }

private:
    unsigned place(unsigned index) {
        if (!isInArray(index)) return nowhere;
        Slot& slot = _result._slots[index];
        if (slot.array != _result._array) slot = {_result._array, add(index)};
        return slot.place;
    }

    unsigned add(unsigned index) {
        const osg::Vec3d place = local(index), inRoots = inRoot(place);
        if (!isUsable(inRoots)) return nowhere;
        if (isOfFloats())
            _reach = larger(_reach, absolute(place) * (weight(index) == 1.0 ? 1.0 : 2.0)); // w is rounded as well
        _result._vertices.push_back(inRoots);
        if (_cutout) _cutout->coordinates.push_back(_coordinates[index]);
        return static_cast<unsigned>(_result._vertices.size() - 1);
    }

    CasterExtraction& _result;
    bool _mirrored;
    Cutout* _cutout;
    std::vector<osg::Vec3> _coordinates; ///< of all vertices in the array.
    osg::Vec3d _reach;                   ///< largest size of each coordinate of the float vertices used.
};

CasterExtraction::CasterExtraction(const Selection& selection) : CasterVisitor(selection) {}

void CasterExtraction::reset() {
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

void CasterExtraction::applyCaster(osg::Drawable& drawable) {
    const unsigned invalidBefore = _invalidTriangles;
    _drawn.push_back({&drawable, _triangles.size(), hiding()});
    Collector collector(*this, rootFromLocal(), startCutout(drawable));
    readTriangles(drawable, collector);
    _rounding = std::max(_rounding, collector.rounding());
    if (invalidBefore == 0 && _invalidTriangles > 0) _invalidNode = nameHere(drawable);
    holdSources(drawable, _sources);
}

void CasterExtraction::append(const CasterExtraction& other) {
    const auto firstVertex = static_cast<unsigned>(_vertices.size());
    const std::size_t firstCorner = _triangles.size(), firstDrawn = _drawn.size();
    _vertices.insert(_vertices.end(), other._vertices.begin(), other._vertices.end());
    for (const unsigned index : other._triangles) _triangles.push_back(index + firstVertex);
    for (const Drawn& drawn : other._drawn) _drawn.push_back({drawn.drawable, drawn.first + firstCorner, drawn.hiding});
    for (const Cutout& cutout : other._cutouts) {
        _cutouts.push_back(cutout);
        _cutouts.back().drawn += firstDrawn;
        _cutouts.back().firstVertex += firstVertex;
    }
    _sources.insert(_sources.end(), other._sources.begin(), other._sources.end());
    _rounding = std::max(_rounding, other._rounding);
    if (_invalidTriangles == 0) _invalidNode = other._invalidNode;
    _invalidTriangles += other._invalidTriangles;
    if (_unknownTests == 0) _unknownNode = other._unknownNode;
    _unknownTests += other._unknownTests;
}

void CasterExtraction::trim() {
    while (!getNodePath().empty()) popFromNodePath(); // whose nodes nobody holds
    _slots = {};
    _vertices.shrink_to_fit();
    _triangles.shrink_to_fit();
}

CasterExtraction::Cutout* CasterExtraction::startCutout(const osg::Drawable& drawable) {
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

std::string CasterExtraction::nameHere(const osg::Drawable& drawable) const {
    return getNodePath().empty() ? drawable.className() : nameAlong(getNodePath());
}

} // namespace gnomon
