// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/VertexTraverser.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/geometry/TerminatorOffset.h>

#include <osg/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

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
    Collector(CasterExtraction& result, const osg::Matrixd& rootFromLocal, const osg::Drawable& drawable,
              const Casting& casting)
        : TriangleDecoder(rootFromLocal), _result(result), _mirrored(mirrors(rootFromLocal)), _casting(casting) {
        setRestart(casting.restart);
        if (casting.test) _clear.emplace(*casting.test, drawable);
        _keepsCoordinates = casting.test && casting.test->isSampled();
        _mixed = casting.selfDrawn;
        if (!casting.offsetsTerminator || casting.test || (casting.selfDrawn && !casting.moved)) return;
        _normals = normalsOf(drawable);
        if (!_normals.empty()) _localFromRoot = osg::Matrixd::inverse(rootFromLocal);
    }

    /// Half a step of a float of the size of the largest coordinates, carried to the root's frame.
    double rounding() const {
        const osg::Vec3d step = _reach * (std::numeric_limits<float>::epsilon() / 2.0);
        osg::Vec3d inRoot;
        for (int i = 0; i < 3; ++i) inRoot += absolute(row(rootFromLocal(), i)) * step[i];
        return inRoot.length();
    }

    bool isMixed() const { return _mixed; }
    std::vector<osg::Vec3>& coordinates() { return _coordinates; }
    /// One for each vertex that was added, root frame; none if the drawable has none.
    const std::vector<glm::vec3>& normals() const { return _normalsInRoot; }

protected:
    void start(unsigned count) override {
        ++_result._array;
        if (_result._slots.size() < count) _result._slots.resize(count);
        std::vector<osg::Vec3d>& vertices = _result._vertices;
        if (vertices.capacity() - vertices.size() < count) // of many arrays, room for as many again
            vertices.reserve(std::max(vertices.size() + count, 2 * vertices.capacity()));
    }

    void triangle(unsigned a, unsigned b, unsigned c) override {
        const bool isThere = isInArray(a) && isInArray(b) && isInArray(c);
        const ClearParts::Part part = _clear && isThere ? _clear->of(a, b, c) : ClearParts::Solid;
        if (part == ClearParts::Clear) {
            ++_result._clearTriangles;
            return;
        }
        const unsigned places[] = {place(a), place(_mirrored ? c : b), place(_mirrored ? b : c)};
        if (std::count(std::begin(places), std::end(places), nowhere) > 0) {
            ++_result._invalidTriangles;
            return;
        }
        _mixed = _mixed || part == ClearParts::Mixed;
        if (_casting.clips.empty())
            _result._triangles.insert(_result._triangles.end(), std::begin(places), std::end(places));
        else
            cut(places);
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
        if (!_normals.empty())
            _normalsInRoot.push_back(index < _normals.size() ? normalInRoot(_normals[index]) : glm::vec3(0.0f));
        return add(inRoots, _keepsCoordinates ? _clear->coordinates()[index] : osg::Vec3());
    }

    glm::vec3 normalInRoot(const osg::Vec4& local) const {
        const osg::Vec3d turned =
            osg::Matrixd::transform3x3(_localFromRoot, osg::Vec3d(local.x(), local.y(), local.z()));
        return glm::vec3(turned.x(), turned.y(), turned.z());
    }

    unsigned add(const osg::Vec3d& inRoots, const osg::Vec3& coordinate) {
        _result._vertices.push_back(inRoots);
        if (_keepsCoordinates) _coordinates.push_back(coordinate);
        return static_cast<unsigned>(_result._vertices.size() - 1);
    }

    /// Adds what the planes leave of a triangle, as a fan.
    void cut(const unsigned (&places)[3]) {
        std::vector<unsigned> polygon(std::begin(places), std::end(places)), kept;
        for (const auto& [number, plane] : _casting.clips) {
            kept.clear();
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const unsigned from = polygon[i], to = polygon[(i + 1) % polygon.size()];
                const double start = distance(plane, from), end = distance(plane, to);
                if (!(start < 0.0)) kept.push_back(from);
                if ((start < 0.0) != (end < 0.0)) kept.push_back(between(from, to, start, end));
            }
            polygon = kept;
        }
        for (std::size_t i = 2; i < polygon.size(); ++i)
            for (const unsigned corner : {polygon[0], polygon[i - 1], polygon[i]}) _result._triangles.push_back(corner);
    }

    double distance(const osg::Vec4d& plane, unsigned place) const {
        const osg::Vec3d& at = _result._vertices[place];
        return plane.x() * at.x() + plane.y() * at.y() + plane.z() * at.z() + plane.w();
    }

    /// The same, to the bit, from either end, so that what shares an edge goes on doing so.
    unsigned between(unsigned from, unsigned to, double start, double end) {
        if (_result._vertices[to] < _result._vertices[from]) {
            std::swap(from, to);
            std::swap(start, end);
        }
        const double share = start / (start - end);
        const osg::Vec3d a = _result._vertices[from], b = _result._vertices[to];
        const auto of = [this](unsigned at) { return osg::Vec3d(_coordinates[at - _firstVertex]); };
        osg::Vec3d coordinate;
        if (_keepsCoordinates) coordinate = of(from) + (of(to) - of(from)) * share;
        if (!_normals.empty()) {
            const glm::vec3 first = _normalsInRoot[from - _firstVertex], last = _normalsInRoot[to - _firstVertex];
            _normalsInRoot.push_back(first + (last - first) * static_cast<float>(share));
        }
        return add(a + (b - a) * share, osg::Vec3(coordinate));
    }

    CasterExtraction& _result;
    const bool _mirrored;
    const Casting& _casting;
    std::optional<ClearParts> _clear;
    bool _keepsCoordinates = false, _mixed = false;
    const unsigned _firstVertex = static_cast<unsigned>(_result._vertices.size());
    std::vector<osg::Vec3> _coordinates; ///< of the vertices that were added.
    std::vector<osg::Vec4> _normals;     ///< of the drawable; none if nobody needs them.
    std::vector<glm::vec3> _normalsInRoot;
    osg::Matrixd _localFromRoot;
    osg::Vec3d _reach; ///< largest size of each coordinate of the float vertices used.
};

CasterExtraction::CasterExtraction(const Selection& selection) : CasterVisitor(selection) {}

void CasterExtraction::reset() {
    CasterVisitor::reset();
    _vertices.clear();
    _triangles.clear();
    _offsets.clear();
    _sources.clear();
    _drawn.clear();
    _cutouts.clear();
    _slots.clear();
    _array = 0;
    _rounding = 0.0;
    _invalidTriangles = 0;
    _invalidNode.clear();
    _cutoutNode.clear();
    _clearTriangles = 0;
}

void CasterExtraction::applyCaster(osg::Drawable& drawable, const Casting& casting) {
    const unsigned invalidBefore = _invalidTriangles;
    const auto firstVertex = static_cast<unsigned>(_vertices.size());
    const std::size_t firstCorner = _triangles.size();
    _drawn.push_back({&drawable, firstCorner, hiding()});
    Collector collector(*this, rootFromLocal(), drawable, casting);
    readTriangles(drawable, collector);
    _rounding = std::max(_rounding, collector.rounding());
    if (!collector.normals().empty()) addOffsets(collector, firstVertex, firstCorner);
    if (!_offsets.empty()) _offsets.resize(_vertices.size());
    if (invalidBefore == 0 && _invalidTriangles > 0) _invalidNode = nameHere(drawable);
    holdSources(drawable, _sources);
    casting.hold(drawable, _sources);
    if (!collector.isMixed() || _triangles.size() == firstCorner) return;
    if (_cutouts.empty()) _cutoutNode = nameHere(drawable);
    const bool sampled = !casting.selfDrawn && casting.test->isSampled();
    _cutouts.push_back({_drawn.size() - 1, !sampled, sampled ? *casting.test : AlphaTest(), firstVertex,
                        std::move(collector.coordinates())});
}

void CasterExtraction::addOffsets(const Collector& of, std::size_t firstVertex, std::size_t firstCorner) {
    std::vector<glm::dvec3> positions;
    positions.reserve(of.normals().size());
    for (std::size_t i = firstVertex; i < _vertices.size(); ++i) positions.push_back(toGlm(_vertices[i]));
    std::vector<unsigned> corners(_triangles.begin() + static_cast<std::ptrdiff_t>(firstCorner), _triangles.end());
    for (unsigned& corner : corners) corner -= static_cast<unsigned>(firstVertex);
    const std::vector<glm::vec4> offsets = terminatorOffsets(positions, of.normals(), corners);
    if (offsets.empty()) return;
    _offsets.resize(firstVertex);
    _offsets.insert(_offsets.end(), offsets.begin(), offsets.end());
}

void CasterExtraction::append(const CasterExtraction& other) {
    const auto firstVertex = static_cast<unsigned>(_vertices.size());
    const std::size_t firstCorner = _triangles.size(), firstDrawn = _drawn.size();
    _vertices.insert(_vertices.end(), other._vertices.begin(), other._vertices.end());
    if (!other._offsets.empty()) _offsets.resize(firstVertex);
    _offsets.insert(_offsets.end(), other._offsets.begin(), other._offsets.end());
    if (!_offsets.empty()) _offsets.resize(_vertices.size());
    for (const unsigned index : other._triangles) _triangles.push_back(index + firstVertex);
    for (const Drawn& drawn : other._drawn) _drawn.push_back({drawn.drawable, drawn.first + firstCorner, drawn.hiding});
    if (_cutouts.empty()) _cutoutNode = other._cutoutNode;
    _clearTriangles += other._clearTriangles;
    for (const Cutout& cutout : other._cutouts) {
        _cutouts.push_back(cutout);
        _cutouts.back().drawn += firstDrawn;
        _cutouts.back().firstVertex += firstVertex;
    }
    _sources.insert(_sources.end(), other._sources.begin(), other._sources.end());
    _rounding = std::max(_rounding, other._rounding);
    if (_invalidTriangles == 0) _invalidNode = other._invalidNode;
    _invalidTriangles += other._invalidTriangles;
}

void CasterExtraction::trim() {
    while (!getNodePath().empty()) popFromNodePath(); // whose nodes nobody holds
    _slots = {};
    _vertices.shrink_to_fit();
    _triangles.shrink_to_fit();
    _offsets.shrink_to_fit();
}

std::string CasterExtraction::nameHere(const osg::Drawable& drawable) const {
    return getNodePath().empty() ? drawable.className() : nameAlong(getNodePath());
}

VertexTraverser::VertexTraverser(const Selection& selection)
    : osg::NodeVisitor(NODE_VISITOR, TRAVERSE_ACTIVE_CHILDREN), _found(new CasterExtraction(selection)) {
    setTraversalMask(selection.mask);
}

VertexTraverser::~VertexTraverser() = default;

void VertexTraverser::reset() { _found->reset(); }

/// Of the root alone: the extraction goes down itself. It knows what is above the root on the way that led here.
void VertexTraverser::apply(osg::Node& root) {
    const osg::NodePath& way = getNodePath();
    for (std::size_t i = 0; i + 1 < way.size(); ++i) _found->pushOntoNodePath(way[i]);
    _found->setFrameStamp(const_cast<osg::FrameStamp*>(getFrameStamp())); // which only hands it on
    _found->setTraversalMask(getTraversalMask());
    _found->setNodeMaskOverride(getNodeMaskOverride());
    _found->setTraversalMode(getTraversalMode());
    root.accept(*_found);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) _found->popFromNodePath();
}

const std::vector<osg::Vec3d>& VertexTraverser::getVertices() const { return _found->getVertices(); }
const std::vector<unsigned>& VertexTraverser::getTriangles() const { return _found->getTriangles(); }
double VertexTraverser::getRounding() const { return _found->getRounding(); }
unsigned VertexTraverser::getInvalidTriangles() const { return _found->getInvalidTriangles(); }
const std::string& VertexTraverser::getInvalidNode() const { return _found->getInvalidNode(); }

std::optional<osg::Vec3d> VertexTraverser::nearestVertex(const osg::Vec3d& point) const {
    std::optional<osg::Vec3d> best;
    double least = std::numeric_limits<double>::infinity();
    for (const osg::Vec3d& vertex : getVertices()) {
        const double distance = (vertex - point).length2();
        if (!(distance < least)) continue;
        least = distance;
        best = vertex;
    }
    return best;
}

} // namespace gnomon
