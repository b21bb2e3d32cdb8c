// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/map/MapCasters.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>

namespace gnomon {
namespace {

constexpr std::size_t mostSearched = 30000; // triangles a picture: ten milliseconds

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

/// A drawable's part of a mesh's triangles, as a lamp sees it.
struct Part {
    Part(const PlacedMesh& of, const MapLayer::Box& itsBox, std::size_t itsFirst, std::size_t itsEnd,
         const glm::dvec3& lamp)
        : placed(&of), box(itsBox), first(itsFirst), end(itsEnd), atLeast(distance(box, lamp)) {}

    double clearanceOf(const glm::dvec3& lamp) const {
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

    const PlacedMesh* placed;
    MapLayer::Box box;
    std::size_t first, end; ///< corners.
    double atLeast;         ///< distance of the box from the lamp.
};

} // namespace

const osg::ref_ptr<const CullableFaces>& DrawnFaces::get(bool solids) {
    if (!faces || (solids && !knowsSolids)) {
        faces = new CullableFaces(*mesh, triangles, solids);
        knowsSolids = solids;
    }
    return faces;
}

osg::ref_ptr<const CullableFaces> MapBodies::of(const CasterMesh& mesh, bool again, bool moving) {
    DrawnFaces& known = _known[&mesh];
    if (!known.mesh) known = {&mesh, mesh.triangles, nullptr};
    const bool solids = again || (moving && known.faces && _searched < mostSearched);
    if (solids && !known.knowsSolids) _searched += mesh.triangles->size() / 3;
    return known.get(solids);
}

/// Pictures hold what is drawn.
void MapBodies::prune() {
    for (auto entry = _known.begin(); entry != _known.end();)
        entry = entry->second.faces->referenceCount() > 1 ? std::next(entry) : _known.erase(entry);
}

void MapBodies::resizeGLObjectBuffers(unsigned maxSize) const {
    for (const auto& [mesh, known] : _known) known.faces->resizeGLObjectBuffers(maxSize);
}

void MapBodies::releaseGLObjects(osg::State* state) const {
    for (const auto& [mesh, known] : _known) known.faces->releaseGLObjects(state);
}

/// What is drawn of a joined mesh.
struct MapLayer::Joined {
    explicit Joined(const CasterMesh& of);
    osg::ref_ptr<const CullableFaces> faces(bool flats, bool again);

    /// Its part of the mesh's triangles.
    struct Drawable {
        Box box;
        std::size_t first, end; ///< corners.
    };

    const osg::ref_ptr<const CasterMesh> mesh;
    std::vector<Drawable> drawables;
    DrawnFaces all, bodies; ///< triangles may be empty.
    std::vector<Cutout> cutouts;
    std::vector<Box> bodyBoxes, flatBoxes;

private:
    using Builders = std::map<std::tuple<osg::Texture2D*, int, float, bool>, CutoutBuilder>;
    void sort(Builders& builders);
};

MapLayer::Joined::Joined(const CasterMesh& of) : mesh(&of) {
    all = {&of, noTriangles(), nullptr};
    bodies = {&of, noTriangles(), nullptr};
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
    DrawnFaces& drawn = flats && !flatBoxes.empty() ? all : bodies;
    return drawn.triangles->empty() ? nullptr : drawn.get(again);
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
        const auto faces = placed.isBody ? bodies.of(*placed.mesh, again, moving) : _joined->faces(flats, again);
        if (faces) result.push_back({faces, placed.sceneFromMesh, box});
    }
    return result;
}

double MapLayer::clearanceOf(const glm::dvec3& lamp) const {
    double nearest = std::numeric_limits<double>::infinity();
    if (_boxesOnly) {
        for (const std::vector<Box>* boxes : {&bodyBoxes, &flatBoxes})
            for (const Box& box : *boxes) nearest = std::min(nearest, distance(box, lamp));
        return nearest;
    }
    std::vector<Part> nearestFirst;
    for (const PlacedMesh& placed : casters->meshes)
        if (placed.isBody)
            nearestFirst.emplace_back(placed, boxOf(placed, casters->origin), 0, placed.mesh->triangles->size(), lamp);
        else
            for (const Joined::Drawable& part : _joined->drawables)
                nearestFirst.emplace_back(placed, part.box, part.first, part.end, lamp);
    std::sort(nearestFirst.begin(), nearestFirst.end(),
              [](const Part& a, const Part& b) { return a.atLeast < b.atLeast; });
    for (const Part& part : nearestFirst) {
        if (!(part.atLeast < nearest)) break;
        nearest = std::min(nearest, part.clearanceOf(lamp));
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

std::vector<OwnCaster> ownCastersOf(const CasterLayers& layers) {
    std::vector<OwnCaster> result;
    const glm::dmat4 sceneFromGroup = glm::translate(glm::dmat4(1.0), -toGlm(layers.origin));
    for (const auto& drawing : layers.pieces->own) {
        const osg::BoundingBoxd& bounds = drawing->bounds;
        if (!bounds.valid()) continue;
        result.push_back({drawing,
                          sceneFromGroup * toGlm(drawing->groupFromLocal),
                          {toGlm(bounds._min - layers.origin), toGlm(bounds._max - layers.origin)}});
    }
    return result;
}

double clearanceOf(const std::vector<OwnCaster>& casters, const glm::dvec3& lamp) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const OwnCaster& caster : casters)
        if (!caster.drawing->hasPiece)
            nearest = std::min(nearest, glm::distance(lamp, glm::clamp(lamp, caster.box.low, caster.box.high)));
    return nearest;
}

/// osgUtil::SceneView's set has the time and the view's matrices, and is at the root of all leaves.
OwnView::OwnView(const glm::dmat4& matrix, const std::vector<const osgUtil::RenderLeaf*>& seen) : eyeFromScene(matrix) {
    if (seen.empty()) return;
    for (const osgUtil::StateGraph* graph = seen.front()->_parent; graph; graph = graph->_parent)
        if (graph->getStateSet() && graph->getStateSet()->getNumParents() == 0)
            states.insert(states.begin(), graph->getStateSet());
}

bool OwnCasters::areSame(const OwnCasters& other) const {
    const bool sameView = view.eyeFromScene == other.view.eyeFromScene;
    return std::equal(casters.begin(), casters.end(), other.casters.begin(), other.casters.end(),
                      [sameView](const OwnCaster& a, const OwnCaster& b) {
                          return a.drawing == b.drawing && a.sceneFromLocal == b.sceneFromLocal &&
                                 !a.drawing->mayChange && (sameView || !a.drawing->byProgram);
                      });
}

} // namespace gnomon
