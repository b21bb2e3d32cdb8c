// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/MapLayer.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

namespace gnomon {
namespace {

constexpr std::size_t mostSearched = 30000; // triangles a picture: ten milliseconds

bool isDrawn(const CullableFaces* faces) { return faces && faces->referenceCount() > 1; }

/// From the origin to the segment between two points.
inline double segmentDistance(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 way = b - a;
    const double square = glm::dot(way, way);
    const double at = square > 0.0 ? glm::clamp(-glm::dot(a, way) / square, 0.0, 1.0) : 0.0;
    return glm::length(a + at * way);
}

/// From the origin to a triangle.
inline double triangleDistance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const auto within = [&normal](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::dot(glm::cross(to - from, -from), normal) >= 0.0;
    };
    const double area = glm::length(normal);
    if (area > 0.0 && within(a, b) && within(b, c) && within(c, a)) return std::abs(glm::dot(a, normal)) / area;
    return std::min({segmentDistance(a, b), segmentDistance(b, c), segmentDistance(c, a)});
}

/// As it is drawn.
MapLayer::Box boxOf(const CasterMesh& mesh, std::size_t first, std::size_t end) {
    MapLayer::Box box{glm::dvec3(std::numeric_limits<double>::infinity()), {}};
    box.high = -box.low;
    for (std::size_t i = first; i < end; ++i) {
        const glm::dvec3 vertex = toGlm(osg::Vec3d((*mesh.vertices)[(*mesh.triangles)[i]]));
        box.low = glm::min(box.low, vertex);
        box.high = glm::max(box.high, vertex);
    }
    return box;
}

/// In floats, as what is drawn: what is flat is so whatever its transform makes of the last bits.
MapLayer::Box boxOf(const PlacedMesh& placed, const osg::Vec3d& origin) {
    const auto rounded = [](const osg::Vec3d& v) { return toGlm(osg::Vec3d(osg::Vec3(v))); };
    return {rounded(placed.bounds._min - origin), rounded(placed.bounds._max - origin)};
}

bool isFlat(const MapLayer::Box& box) {
    const glm::dvec3 size = box.high - box.low;
    return std::min({size.x, size.y, size.z}) == 0.0;
}

void sortBySize(std::vector<MapLayer::Box>& boxes) {
    std::sort(boxes.begin(), boxes.end(),
              [](const auto& a, const auto& b) { return glm::distance(a.low, a.high) > glm::distance(b.low, b.high); });
}

constexpr double inPlane = 1.0 / (1 << 20); // of the coordinates, as RayScene has it

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double distance(const MapLayer::Box& box, const glm::dvec3& place) {
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

osg::ref_ptr<const CullableFaces> MapBodies::of(const CasterMesh& mesh, bool moving) {
    Entry& entry = _known[&mesh];
    const bool again = entry.whole || entry.solids;
    if (moving && again && (entry.solids || _searched < mostSearched)) return solidsOf(mesh);
    entry.mesh = &mesh;
    if (!entry.whole) entry.whole = new CullableFaces(mesh, mesh.triangles, false);
    return entry.whole;
}

osg::ref_ptr<const CullableFaces> MapBodies::solidsOf(const CasterMesh& mesh) {
    Entry& entry = _known[&mesh];
    entry.mesh = &mesh;
    if (!entry.solids) {
        entry.solids = new CullableFaces(mesh, mesh.triangles, true);
        _searched += mesh.triangles->size() / 3;
    }
    return entry.solids;
}

/// Pictures hold what is drawn.
void MapBodies::prune() {
    for (auto entry = _known.begin(); entry != _known.end();) {
        const bool drawn = isDrawn(entry->second.whole) || isDrawn(entry->second.solids);
        entry = drawn ? std::next(entry) : _known.erase(entry);
    }
}

void MapBodies::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& entry : _known)
        for (const auto& faces : {entry.second.whole, entry.second.solids})
            if (faces) faces->resizeGLObjectBuffers(maxSize);
}

void MapBodies::releaseGLObjects(osg::State* state) const {
    for (const auto& entry : _known)
        for (const auto& faces : {entry.second.whole, entry.second.solids})
            if (faces) faces->releaseGLObjects(state);
}

/// What is drawn of a joined mesh.
struct MapLayer::Joined {
    struct Part {
        osg::ref_ptr<osg::DrawElementsUInt> triangles; ///< may be empty.
        osg::ref_ptr<const CullableFaces> faces;
        bool knowsSolids = false;
    };

    explicit Joined(const CasterMesh& of);
    osg::ref_ptr<const CullableFaces> faces(bool flats, bool again);

    /// Its part of the mesh's triangles.
    struct Drawable {
        Box box;
        std::size_t first, end; ///< corners.
    };

    const osg::ref_ptr<const CasterMesh> mesh;
    std::vector<Drawable> drawables;
    Part all, bodies;
    std::vector<Cutout> cutouts;
    std::vector<Box> bodyBoxes, flatBoxes;

private:
    using Builders = std::map<std::tuple<osg::Texture2D*, int, float, bool>, CutoutBuilder>;
    void sort(Builders& builders);
};

MapLayer::Joined::Joined(const CasterMesh& of) : mesh(&of) {
    all.triangles = noTriangles();
    bodies.triangles = noTriangles();
    Builders builders;
    sort(builders);
    for (const auto& [key, builder] : builders) {
        const auto& [texture, passing, reference, flat] = key;
        cutouts.push_back({builder.geometry(), texture, passing, reference, flat});
    }
    if (mesh->cutouts.empty()) all.triangles = mesh->triangles;
    if (flatBoxes.empty()) bodies.triangles = all.triangles;
}

/// The triangles by how they are drawn.
void MapLayer::Joined::sort(Builders& builders) {
    auto cutout = mesh->cutouts.begin();
    for (std::size_t i = 0; i < mesh->drawn.size(); ++i) {
        const std::size_t first = mesh->drawn[i].first,
                          end = i + 1 < mesh->drawn.size() ? mesh->drawn[i + 1].first : mesh->triangles->size();
        if (first == end) continue;
        const Box box = boxOf(*mesh, first, end);
        const bool flat = isFlat(box);
        (flat ? flatBoxes : bodyBoxes).push_back(box);
        drawables.push_back({box, first, end});
        const Span span{&(*mesh->triangles)[first], end - first};
        if (cutout != mesh->cutouts.end() && cutout->drawn == i) {
            const AlphaTest& test = cutout->test;
            if (!cutout->ownDrawn)
                builders[{test.texture.get(), test.passing, test.sampledReference(), flat}].add(*mesh, *cutout, span);
            ++cutout;
        } else {
            append(*all.triangles, span);
            if (!flat) append(*bodies.triangles, span);
        }
    }
}

osg::ref_ptr<const CullableFaces> MapLayer::Joined::faces(bool flats, bool again) {
    Part& part = flats && !flatBoxes.empty() ? all : bodies;
    if (part.triangles->empty()) return nullptr;
    const bool known = part.faces && (part.knowsSolids || !again);
    if (!known) part.faces = new CullableFaces(*mesh, part.triangles, again);
    part.knowsSolids = part.knowsSolids || again;
    return part.faces;
}

MapLayer::MapLayer(const CasterLayer& given, const std::vector<osg::ref_ptr<const MapLayer>>& before)
    : casters(&given) {
    for (const auto& layer : before)
        if (layer->_joined && layer->_joined->mesh == casters->loose) _joined = layer->_joined;
    if (!_joined && casters->loose) _joined = std::make_shared<Joined>(*casters->loose);
    if (_joined) {
        cutouts = _joined->cutouts;
        bodyBoxes = _joined->bodyBoxes;
        flatBoxes = _joined->flatBoxes;
    }
    for (const PlacedMesh& placed : casters->meshes)
        if (placed.isBody) {
            const Box box = boxOf(placed, casters->origin);
            (isFlat(box) ? flatBoxes : bodyBoxes).push_back(box);
        }
    sortBySize(bodyBoxes);
    sortBySize(flatBoxes);
}

osg::ref_ptr<const MapLayer> MapLayer::boxesOf(const CasterLayer& casters) {
    osg::ref_ptr<MapLayer> layer = new MapLayer(casters);
    for (const auto& piece : casters.pieces) {
        if (!piece->bounds.valid()) continue;
        const Box box{toGlm(piece->bounds._min - casters.origin), toGlm(piece->bounds._max - casters.origin)};
        (isFlat(box) ? layer->flatBoxes : layer->bodyBoxes).push_back(box);
    }
    sortBySize(layer->bodyBoxes);
    sortBySize(layer->flatBoxes);
    return layer;
}

std::vector<MapLayer::Drawn> MapLayer::faces(bool flats, bool again, bool moving, MapBodies& bodies) const {
    std::vector<Drawn> result;
    for (const PlacedMesh& placed : casters->meshes) {
        const Box box = boxOf(placed, casters->origin);
        if (placed.ownDrawn || (placed.isBody && isFlat(box) && !flats)) continue;
        const auto faces = placed.isBody ? again ? bodies.solidsOf(*placed.mesh) : bodies.of(*placed.mesh, moving)
                                         : _joined->faces(flats, again);
        if (faces) result.push_back({faces, placed.sceneFromMesh, box});
    }
    return result;
}

/// A drawable's part of a mesh's triangles.
struct MapLayer::Part {
    const PlacedMesh* placed;
    Box box;
    std::size_t first, end; ///< corners.

    double clearanceOf(const glm::dvec3& lamp) const;
};

std::vector<MapLayer::Part> MapLayer::parts() const {
    std::vector<Part> parts;
    for (const PlacedMesh& placed : casters->meshes)
        if (placed.isBody)
            parts.push_back({&placed, boxOf(placed, casters->origin), 0, placed.mesh->triangles->size()});
        else
            for (const Joined::Drawable& part : _joined->drawables)
                parts.push_back({&placed, part.box, part.first, part.end});
    return parts;
}

double MapLayer::clearanceOf(const glm::dvec3& lamp) const {
    if (_boxesOnly) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const std::vector<Box>* boxes : {&bodyBoxes, &flatBoxes})
            for (const Box& box : *boxes) nearest = std::min(nearest, distance(box, lamp));
        return nearest;
    }
    const std::vector<Part> all = parts();
    std::vector<std::pair<double, const Part*>> nearestFirst;
    for (const Part& part : all) nearestFirst.emplace_back(distance(part.box, lamp), &part);
    std::sort(nearestFirst.begin(), nearestFirst.end());
    double nearest = std::numeric_limits<double>::infinity();
    for (const auto& [atLeast, part] : nearestFirst) {
        if (!(atLeast < nearest)) break;
        nearest = std::min(nearest, part->clearanceOf(lamp));
    }
    return nearest;
}

double MapLayer::Part::clearanceOf(const glm::dvec3& lamp) const {
    const double size = std::max({largest(lamp), largest(box.low), largest(box.high)});
    const auto from = [&](std::size_t i) {
        const osg::Vec3& vertex = (*placed->mesh->vertices)[(*placed->mesh->triangles)[i]];
        return glm::dvec3(placed->sceneFromMesh * glm::dvec4(vertex.x(), vertex.y(), vertex.z(), 1.0)) - lamp;
    };
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i + 2 < end; i += 3) {
        const glm::dvec3 a = from(i), b = from(i + 1), c = from(i + 2), normal = glm::cross(b - a, c - a);
        if (std::abs(glm::dot(a, normal)) > inPlane * size * glm::length(normal))
            nearest = std::min(nearest, triangleDistance(a, b, c));
    }
    return nearest;
}

bool isInMap(const MapLayer::Box& box, const glm::dmat4& clipFromScene) {
    const auto corners = boxCorners(box.low, box.high, clipFromScene);
    const auto allBeyond = [&](int axis, double sign) {
        return std::all_of(corners.begin(), corners.end(),
                           [&](const glm::dvec4& corner) { return sign * corner[axis] > 1.01 * corner.w; });
    };
    return !(allBeyond(0, 1.0) || allBeyond(0, -1.0) || allBeyond(1, 1.0) || allBeyond(1, -1.0));
}

void MapLayer::resizeGLObjectBuffers(unsigned maxSize) const {
    if (!_joined) return;
    for (const auto& part : {_joined->all, _joined->bodies})
        if (part.faces) part.faces->resizeGLObjectBuffers(maxSize);
    for (const Cutout& cutout : cutouts) cutout.geometry->resizeGLObjectBuffers(maxSize);
}

void MapLayer::releaseGLObjects(osg::State* state) const {
    if (!_joined) return;
    for (const auto& part : {_joined->all, _joined->bodies})
        if (part.faces) part.faces->releaseGLObjects(state);
    for (const Cutout& cutout : cutouts) cutout.geometry->releaseGLObjects(state);
}

} // namespace gnomon
