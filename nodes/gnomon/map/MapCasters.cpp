// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/StageLeaves.h>
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
#include <utility>

namespace gnomon {
namespace {

constexpr std::size_t mostSearched = 30000; // triangles a picture: ten milliseconds
constexpr double inPlane = 1.0 / (1 << 20); // of the coordinates, as RayScene has it
constexpr double infinity = std::numeric_limits<double>::infinity();

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

double distance(const AlignedBox& box, const glm::dvec3& place) {
    return glm::distance(place, glm::clamp(place, box.low, box.high));
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

/// To the nearest of its triangles that cast.
double distanceOfTriangles(const MapPiece& piece, const glm::dvec3& lamp) {
    const CasterMesh& mesh = *piece.placed->mesh;
    const double size = std::max({largest(lamp), largest(piece.low), largest(piece.high)});
    const auto from = [&](std::size_t i) {
        const osg::Vec3& vertex = (*mesh.vertices)[(*mesh.triangles)[i]];
        return glm::dvec3(piece.placed->sceneFromMesh * glm::dvec4(vertex.x(), vertex.y(), vertex.z(), 1.0)) - lamp;
    };
    double nearest = infinity;
    for (std::size_t i = piece.first; i + 2 < piece.end; i += 3) {
        const glm::dvec3 a = from(i), b = from(i + 1), c = from(i + 2), normal = glm::cross(b - a, c - a);
        if (std::abs(glm::dot(a, normal)) > inPlane * size * glm::length(normal))
            nearest = std::min(nearest, triangleDistance(a, b, c));
    }
    return nearest;
}

/// As it is drawn.
MapPiece pieceOf(const CasterMesh& mesh, std::size_t first, std::size_t end) {
    MapPiece piece{{glm::dvec3(infinity), glm::dvec3(-infinity)}, nullptr, first, end};
    for (std::size_t i = first; i < end; ++i) {
        const glm::dvec3 vertex = toGlm(osg::Vec3d((*mesh.vertices)[(*mesh.triangles)[i]]));
        piece.low = glm::min(piece.low, vertex);
        piece.high = glm::max(piece.high, vertex);
    }
    return piece;
}

/// Drawables that share a texture and a test, one after another.
class CutoutBuilder {
public:
    void add(const CasterMesh& mesh, const CasterExtraction::Cutout& cutout, const MapPiece& piece) {
        const auto first = mesh.vertices->begin() + static_cast<std::ptrdiff_t>(cutout.firstVertex);
        const auto places = static_cast<GLuint>(_vertices->size());
        for (std::size_t i = piece.first; i < piece.end; ++i)
            _triangles->push_back((*mesh.triangles)[i] - cutout.firstVertex + places);
        _vertices->insert(_vertices->end(), first, first + static_cast<std::ptrdiff_t>(cutout.coordinates.size()));
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

std::vector<SelfDrawnCaster> selfDrawnCastersOf(const Casters& casters) {
    const CasterLayers& layers = casters.layers();
    std::vector<SelfDrawnCaster> result;
    const glm::dmat4 sceneFromGroup = glm::translate(glm::dmat4(1.0), -toGlm(layers.origin));
    for (const auto& drawing : casters.selfDrawings) {
        const osg::BoundingBoxd& bounds = drawing->bounds;
        if (!bounds.valid()) continue;
        result.push_back({drawing,
                          sceneFromGroup * toGlm(drawing->groupFromLocal),
                          {toGlm(bounds._min - layers.origin), toGlm(bounds._max - layers.origin)}});
    }
    return result;
}

} // namespace

bool isInMap(const AlignedBox& box, const glm::dmat4& clipFromScene) {
    const auto corners = boxCorners(box.low, box.high, clipFromScene);
    const auto allBeyond = [&](int axis, double sign) {
        return std::all_of(corners.begin(), corners.end(),
                           [&](const glm::dvec4& corner) { return sign * corner[axis] > 1.01 * corner.w; });
    };
    return !(allBeyond(0, 1.0) || allBeyond(0, -1.0) || allBeyond(1, 1.0) || allBeyond(1, -1.0));
}

bool isFlat(const AlignedBox& box) {
    const glm::dvec3 size = box.high - box.low;
    return std::min({size.x, size.y, size.z}) == 0.0;
}

AlignedBox boxOf(const PlacedMesh& placed, const osg::Vec3d& origin) {
    const auto rounded = [](const osg::Vec3d& v) { return toGlm(osg::Vec3d(osg::Vec3(v))); };
    return {rounded(placed.bounds._min - origin), rounded(placed.bounds._max - origin)};
}

/// Sorts what is joined by how it is drawn.
MapMesh::MapMesh(const PlacedMesh& placed)
    : mesh(placed.mesh), isBody(placed.isBody), all{noTriangles()}, unflat{noTriangles()} {
    std::map<std::tuple<osg::Texture2D*, int, float, bool>, CutoutBuilder> builders;
    auto cutout = mesh->cutouts.begin();
    bool anyFlat = false;
    for (std::size_t i = 0; i < mesh->drawn.size() && !isBody; ++i) {
        const std::size_t first = mesh->drawn[i].first,
                          end = i + 1 < mesh->drawn.size() ? mesh->drawn[i + 1].first : mesh->triangles->size();
        if (first == end) continue;
        pieces.push_back(pieceOf(*mesh, first, end));
        const bool flat = isFlat(pieces.back());
        anyFlat = anyFlat || flat;
        const GLuint *begin = &mesh->triangles->front() + first, *behind = &mesh->triangles->front() + end;
        if (cutout != mesh->cutouts.end() && cutout->drawn == i) {
            const AlphaTest& test = cutout->test;
            if (!cutout->selfDrawn)
                builders[{test.texture.get(), test.passing, test.sampledReference(), flat}].add(*mesh, *cutout,
                                                                                                pieces.back());
            ++cutout;
        } else {
            all.corners->insert(all.corners->end(), begin, behind);
            if (!flat) unflat.corners->insert(unflat.corners->end(), begin, behind);
        }
    }
    for (const auto& [key, builder] : builders) {
        const auto& [texture, passing, reference, flat] = key;
        cutouts.push_back({builder.geometry(), texture, passing, reference, flat});
    }
    if (isBody || mesh->cutouts.empty()) all.corners = mesh->triangles;
    if (!anyFlat) unflat.corners = all.corners;
}

osg::ref_ptr<MapMesh> MapMeshes::of(const PlacedMesh& placed) {
    osg::ref_ptr<MapMesh>& known = _known[placed.mesh.get()];
    if (!known) known = new MapMesh(placed);
    return known;
}

osg::ref_ptr<const CullableFaces> MapMeshes::trianglesOf(MapMesh& mesh, bool flats, bool again, bool moving) {
    MapMesh::Triangles& triangles = flats && mesh.all.corners != mesh.unflat.corners ? mesh.all : mesh.unflat;
    if (triangles.corners->empty()) return nullptr;
    const bool solids = again || (moving && mesh.isBody && triangles.drawn && _searched < mostSearched);
    if (triangles.drawn && (triangles.solids || !solids)) return triangles.drawn;
    if (solids && mesh.isBody) _searched += triangles.corners->size() / 3;
    triangles.drawn = new CullableFaces(*mesh.mesh, triangles.corners, solids);
    triangles.solids = solids;
    return triangles.drawn;
}

void MapMeshes::prune() {
    for (auto entry = _known.begin(); entry != _known.end();)
        entry = entry->second->referenceCount() > 1 ? std::next(entry) : _known.erase(entry);
}

template <class Act>
void MapMeshes::forAll(const Act& act) const {
    for (const auto& [address, mesh] : _known) {
        for (const auto& triangles : {mesh->all.drawn, mesh->unflat.drawn})
            if (triangles) act(*triangles);
        for (const MapCutout& cutout : mesh->cutouts) act(*cutout.geometry);
    }
}

void MapMeshes::resizeGLObjectBuffers(unsigned maxSize) const {
    forAll([maxSize](auto& drawn) { drawn.resizeGLObjectBuffers(maxSize); });
}

void MapMeshes::releaseGLObjects(osg::State* state) const {
    forAll([state](auto& drawn) { drawn.releaseGLObjects(state); });
}

MapLayer::MapLayer(const CasterLayer& given, MapMeshes* known) : casters(&given) {
    const auto add = [this](const MapPiece& piece) { (isFlat(piece) ? flats : unflats).push_back(piece); };
    if (!known)
        for (const auto& piece : casters->pieces)
            if (piece->bounds.valid())
                add({{toGlm(piece->bounds._min - casters->origin), toGlm(piece->bounds._max - casters->origin)}});
    for (std::size_t i = 0; known && i < casters->meshes.size(); ++i) {
        const PlacedMesh& placed = casters->meshes[i];
        meshes.push_back(known->of(placed));
        if (placed.isBody) add({boxOf(placed, casters->origin), &placed, 0, placed.mesh->triangles->size()});
        for (const MapPiece& piece : meshes.back()->pieces) add({piece, &placed, piece.first, piece.end});
    }
    for (auto* pieces : {&unflats, &flats})
        std::sort(pieces->begin(), pieces->end(), [](const auto& a, const auto& b) {
            return glm::distance(a.low, a.high) > glm::distance(b.low, b.high);
        });
}

double MapLayer::clearanceOf(const glm::dvec3& lamp) const {
    std::vector<std::pair<double, const MapPiece*>> nearestFirst;
    for (const auto* pieces : {&unflats, &flats})
        for (const MapPiece& piece : *pieces) nearestFirst.emplace_back(distance(piece, lamp), &piece);
    std::sort(nearestFirst.begin(), nearestFirst.end());
    double nearest = infinity;
    for (const auto& [atLeast, piece] : nearestFirst) {
        if (!(atLeast < nearest)) break;
        nearest = std::min(nearest, piece->placed ? distanceOfTriangles(*piece, lamp) : atLeast);
    }
    return nearest;
}

/// osgUtil::SceneView's set has the time and the view's matrices, and is at the root of all leaves.
SelfDrawnCasters::SelfDrawnCasters(const std::vector<SelfDrawnCaster>& all, const glm::dmat4& matrix,
                                   const ViewFrame& view)
    : casters(all), eyeFromScene(matrix), matrices(view.group->getMatrixUniforms()) {
    if (view.drawn) eyeFromWorld = toGlm(view.drawn->eyeFromWorld());
    if (casters.empty() || view.seen.empty()) return;
    for (const osgUtil::StateGraph* graph = view.seen.front()->_parent; graph; graph = graph->_parent)
        if (graph->getStateSet() && graph->getStateSet()->getNumParents() == 0)
            states.insert(states.begin(), graph->getStateSet());
}

bool SelfDrawnCasters::areSame(const SelfDrawnCasters& other) const {
    const bool sameView = eyeFromScene == other.eyeFromScene && eyeFromWorld == other.eyeFromWorld;
    return matrices == other.matrices &&
           std::equal(casters.begin(), casters.end(), other.casters.begin(), other.casters.end(),
                      [sameView](const SelfDrawnCaster& a, const SelfDrawnCaster& b) {
                          return a.drawing == b.drawing && a.sceneFromLocal == b.sceneFromLocal &&
                                 !a.drawing->mayChange && (sameView || !a.drawing->byProgram);
                      });
}

MapCasters::MapCasters(const Casters& casters, const osg::ref_ptr<const MapLayer>& standing,
                       const osg::ref_ptr<const MapLayer>& others)
    : of(&casters), layers(casters.layers()), still(standing), moving(others), selfDrawn(selfDrawnCastersOf(casters)) {}

double MapCasters::clearanceOfMoving(const glm::dvec3& lamp) const {
    double nearest = moving->clearanceOf(lamp);
    for (const SelfDrawnCaster& caster : selfDrawn)
        if (!caster.drawing->hasPiece || caster.drawing->casting.moved)
            nearest = std::min(nearest, distance(caster.box, lamp));
    return nearest;
}

} // namespace gnomon
