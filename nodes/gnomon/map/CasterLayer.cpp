// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/TriangleDistance.h>
#include <gnomon/map/CasterLayer.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

/// As it is drawn.
CasterLayer::Box boxOf(const CasterMesh& mesh, std::size_t first, std::size_t end) {
    CasterLayer::Box box{glm::dvec3(std::numeric_limits<double>::infinity()), {}};
    box.high = -box.low;
    for (std::size_t i = first; i < end; ++i) {
        const glm::dvec3 vertex = toGlm(osg::Vec3d((*mesh.vertices)[(*mesh.triangles)[i]]));
        box.low = glm::min(box.low, vertex);
        box.high = glm::max(box.high, vertex);
    }
    return box;
}

bool isFlat(const CasterLayer::Box& box) {
    const glm::dvec3 size = box.high - box.low;
    return std::min({size.x, size.y, size.z}) == 0.0;
}

void sortBySize(std::vector<CasterLayer::Box>& boxes) {
    std::sort(boxes.begin(), boxes.end(),
              [](const auto& a, const auto& b) { return glm::distance(a.low, a.high) > glm::distance(b.low, b.high); });
}

constexpr double inPlane = 1.0 / (1 << 20); // of the coordinates, as RayScene has it

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double distance(const CasterLayer::Box& box, const glm::dvec3& place) {
    return glm::distance(place, glm::clamp(place, box.low, box.high));
}

/// A drawable's part of the mesh's triangles.
struct Span {
    const GLuint* corners;
    std::size_t count;
};

void append(osg::DrawElementsUInt& to, const Span& span) {
    to.insert(to.end(), span.corners, span.corners + span.count);
}

/// Drawables that share a texture and a test, one after another.
class CutoutBuilder {
public:
    void add(const CasterMesh& mesh, const CasterExtraction::Cutout& cutout, const Span& span) {
        const auto own = mesh.vertices->begin() + static_cast<std::ptrdiff_t>(cutout.firstVertex);
        const auto places = static_cast<GLuint>(_vertices->size());
        for (std::size_t i = 0; i < span.count; ++i)
            _triangles->push_back(span.corners[i] - cutout.firstVertex + places);
        _vertices->insert(_vertices->end(), own, own + static_cast<std::ptrdiff_t>(cutout.coordinates.size()));
        _coordinates->insert(_coordinates->end(), cutout.coordinates.begin(), cutout.coordinates.end());
    }

    osg::ref_ptr<osg::Geometry> geometry() const {
        osg::ref_ptr<osg::Geometry> result = new osg::Geometry;
        result->setUseDisplayList(false);
        result->setUseVertexBufferObjects(true);
        result->setVertexArray(_vertices);
        result->setTexCoordArray(0, _coordinates, osg::Array::BIND_PER_VERTEX);
        result->addPrimitiveSet(_triangles);
        return result;
    }

private:
    osg::ref_ptr<osg::Vec3Array> _vertices = new osg::Vec3Array, _coordinates = new osg::Vec3Array;
    osg::ref_ptr<osg::DrawElementsUInt> _triangles = noTriangles();
};

} // namespace

/// The triangles by how they are drawn.
struct CasterLayer::Sorted {
    osg::ref_ptr<osg::DrawElementsUInt> whole = noTriangles(), wholeBodies = noTriangles();
    std::map<std::tuple<osg::Texture2D*, int, float, bool>, CutoutBuilder> builders;

    void add(const Span& span, bool flat) {
        append(*whole, span);
        if (!flat) append(*wholeBodies, span);
    }
    void add(const CasterMesh& mesh, const CasterExtraction::Cutout& cutout, const Span& span, bool flat) {
        const AlphaTest& test = cutout.test;
        builders[{test.texture.get(), test.passing, test.reference, flat}].add(mesh, cutout, span);
    }
    std::vector<Cutout> cutouts() const {
        std::vector<Cutout> result;
        for (const auto& [key, builder] : builders) {
            const auto& [texture, passing, reference, flat] = key;
            result.push_back({builder.geometry(), texture, passing, reference, flat});
        }
        return result;
    }
};

CasterLayer::CasterLayer(CasterDrawables::List given, const osg::Vec3d& origin) : pieces(std::move(given)) {
    if (pieces.empty()) return;
    _mesh = meshOf(pieces, origin);
    const CasterMesh& mesh = *_mesh;
    triangles = mesh.triangles->size() / 3;
    Sorted sorted;
    auto cutout = mesh.cutouts.begin();
    for (std::size_t i = 0; i < mesh.drawn.size(); ++i) {
        const std::size_t first = mesh.drawn[i].first,
                          end = i + 1 < mesh.drawn.size() ? mesh.drawn[i + 1].first : mesh.triangles->size();
        if (first == end) continue;
        const Box box = boxOf(mesh, first, end);
        (isFlat(box) ? flatBoxes : bodyBoxes).push_back(box);
        _parts.push_back({box, first, end});
        const Span span{&(*mesh.triangles)[first], end - first};
        if (cutout != mesh.cutouts.end() && cutout->drawn == i)
            sorted.add(mesh, *cutout++, span, isFlat(box));
        else
            sorted.add(span, isFlat(box));
    }
    sortBySize(bodyBoxes);
    sortBySize(flatBoxes);
    take(sorted);
}

void CasterLayer::take(const Sorted& sorted) {
    _all.triangles = sorted.builders.empty() ? _mesh->triangles : sorted.whole;
    _bodies.triangles = flatBoxes.empty() ? _all.triangles : sorted.wholeBodies;
    cutouts = sorted.cutouts();
}

osg::ref_ptr<const CullableFaces> CasterLayer::faces(bool flats, bool again) const {
    Drawn& drawn = flats && !flatBoxes.empty() ? _all : _bodies;
    if (!drawn.triangles || drawn.triangles->empty()) return nullptr;
    const bool known = drawn.faces && (drawn.knowsSolids || !again);
    if (!known) drawn.faces = new CullableFaces(*_mesh, drawn.triangles, again);
    drawn.knowsSolids = drawn.knowsSolids || again;
    return drawn.faces;
}

double CasterLayer::clearanceOf(const glm::dvec3& lamp) const {
    std::vector<std::pair<double, const Part*>> nearestFirst;
    for (const Part& part : _parts) nearestFirst.emplace_back(distance(part.box, lamp), &part);
    std::sort(nearestFirst.begin(), nearestFirst.end());
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [atLeast, part] : nearestFirst) {
        if (!(atLeast < nearest)) break;
        nearest = std::min(nearest, clearanceOf(lamp, *part));
    }
    return nearest;
}

double CasterLayer::clearanceOf(const glm::dvec3& lamp, const Part& part) const {
    const double size = std::max({largest(lamp), largest(part.box.low), largest(part.box.high)});
    const auto from = [&](std::size_t i) {
        return toGlm(osg::Vec3d((*_mesh->vertices)[(*_mesh->triangles)[i]])) - lamp;
    };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = part.first; i + 2 < part.end; i += 3) {
        const glm::dvec3 a = from(i), b = from(i + 1), c = from(i + 2), normal = glm::cross(b - a, c - a);
        if (std::abs(glm::dot(a, normal)) > inPlane * size * glm::length(normal))
            nearest = std::min(nearest, triangleDistance(a, b, c));
    }
    return nearest;
}

void CasterLayer::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const Drawn* drawn : {&_all, &_bodies})
        if (drawn->faces) drawn->faces->resizeGLObjectBuffers(maxSize);
    for (const Cutout& cutout : cutouts) cutout.geometry->resizeGLObjectBuffers(maxSize);
}

void CasterLayer::releaseGLObjects(osg::State* state) const {
    for (const Drawn* drawn : {&_all, &_bodies})
        if (drawn->faces) drawn->faces->releaseGLObjects(state);
    for (const Cutout& cutout : cutouts) cutout.geometry->releaseGLObjects(state);
}

} // namespace gnomon
