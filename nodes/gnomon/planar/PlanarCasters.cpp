// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/Plane.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/CullableFaces.h>
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/group/SceneFrame.h>
#include <gnomon/planar/PlanarCasters.h>

#include <OpenThreads/ScopedLock>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace gnomon {
namespace {

glm::dvec3 vertexAt(const CasterMesh& mesh, unsigned index) { return toGlm(osg::Vec3d((*mesh.vertices)[index])); }

/// A vertex this near to the plane lies in it: four steps of the floats it is kept in and of those it came from.
double thicknessAt(double fromOrigin, double rounding) {
    return 4.0 * (fromOrigin * std::numeric_limits<float>::epsilon() / 2.0 + rounding);
}

/// Heights above a plane of a mesh's vertices.
struct Heights {
    Heights(const PlacedMesh& placed, const glm::dvec4& plane)
        : of(placed.mesh->vertices->size()), thickness(of.size()) {
        const glm::dvec4 inMesh = glm::transpose(placed.sceneFromMesh) * plane; // heights in the scene's unit
        for (unsigned i = 0; i < of.size(); ++i) {
            const glm::dvec3 vertex = vertexAt(*placed.mesh, i);
            thickness[i] = thicknessAt(placed.stretched * glm::length(vertex), placed.rounding);
            const double height = distance(inMesh, vertex);
            if (!(std::abs(height) <= thickness[i])) of[i] = height;
        }
    }

    std::vector<double> of, thickness; ///< the former 0 of what lies in the plane.
};

/// The triangles of a mesh that lie in a plane by flatness, drawable by drawable.
struct LevelTriangles {
    LevelTriangles(const PlacedMesh& placed, const glm::dvec4& plane, const Heights& of)
        : has(placed.mesh->triangles->size() / 3) {
        const CasterMesh& mesh = *placed.mesh;
        const osg::DrawElementsUInt& all = *mesh.triangles;
        const glm::dvec3 normal(glm::transpose(placed.sceneFromMesh) * plane);
        for (std::size_t k = 0; k < mesh.drawn.size(); ++k) {
            const auto from = unsigned(mesh.drawn[k].first),
                       end = unsigned(k + 1 < mesh.drawn.size() ? mesh.drawn[k + 1].first : all.size());
            osg::BoundingBox box;
            for (unsigned i = from; i < end; ++i) box.expandBy((*mesh.vertices)[all[i]]);
            const double most = from < end ? flatness * placed.stretched * double(box.radius()) : 0.0;
            for (unsigned i = from; i < end; i += 3) {
                const auto [lowest, top] = std::minmax({of.of[all[i]], of.of[all[i + 1]], of.of[all[i + 2]]});
                if (!(top <= most && lowest >= -most)) continue;
                const glm::dvec3 a = vertexAt(mesh, all[i]);
                const glm::dvec3 across = glm::cross(vertexAt(mesh, all[i + 1]) - a, vertexAt(mesh, all[i + 2]) - a);
                constexpr double steep = 0.7; // of 45°: what stands up casts
                has[i / 3] = std::abs(glm::dot(across, normal)) >= steep * glm::length(across) * glm::length(normal);
                if (has[i / 3]) heights = {std::min(heights.x, lowest), std::max(heights.y, top)};
            }
        }
    }

    std::vector<bool> has;
    glm::dvec2 heights{0.0}; ///< least and greatest; 0 of what lies there but for rounding.
};

/// Whether a body ends in the plane, and has such triangles above it: a floor.
bool hasLevelAbove(const PlacedMesh& placed, const glm::dvec4& plane) {
    const osg::BoundingBoxd& box = placed.mesh->bounds;
    const glm::dvec3 middle = toGlm(placed.mesh->origin);
    const auto corners = boxCorners(toGlm(box._min) - middle, toGlm(box._max) - middle, placed.sceneFromMesh);
    const double most = flatness * placed.stretched * box.radius();
    return std::all_of(corners.begin(), corners.end(), [&](const auto& at) { return glm::dot(plane, at) <= most; }) &&
           LevelTriangles(placed, plane, Heights(placed, plane)).heights.y > 0.0;
}

/// Whether a triangle reaches below the plane or lies in it. @param inMesh  heights in the scene's unit.
bool mustBeCut(const CasterMesh& mesh, const glm::dvec4& inMesh, double thickness) {
    bool touches = false;
    for (unsigned i = 0; i < mesh.vertices->size(); ++i) {
        const double height = distance(inMesh, vertexAt(mesh, i));
        if (!(height >= -thickness)) return true;
        touches = touches || height <= thickness;
    }
    const osg::DrawElementsUInt& all = *mesh.triangles;
    const auto liesIn = [&](unsigned corner) { return distance(inMesh, vertexAt(mesh, all[corner])) <= thickness; };
    for (unsigned i = 0; touches && i + 2 < all.size(); i += 3)
        if (liesIn(i) && liesIn(i + 1) && liesIn(i + 2)) return true;
    return false;
}

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

} // namespace

PlanarMesh::PlanarMesh(const CasterMesh& given, bool findSolids, unsigned frame)
    : mesh(&given), knowsSolids(findSolids), firstFrame(frame) {
    const osg::DrawElementsUInt& all = *mesh->triangles;
    if (!findSolids) {
        parts.push_back({casterGeometry(*mesh, mesh->triangles), false, false});
        return;
    }
    const ClosedParts closed = closedPartsOf(*mesh, all);
    osg::ref_ptr<osg::DrawElementsUInt> lists[2] = {noTriangles(), noTriangles()}; // [solid]
    for (unsigned i = 0; i < all.size(); ++i) lists[closed.closed[i / 3]]->push_back(closed.welded[all[i]]);
    for (const bool solid : {false, true})
        if (!lists[solid]->empty()) parts.push_back({casterGeometry(*mesh, lists[solid]), false, solid});
}

PlanarParts::PlanarParts(const PlacedMesh& placed, const glm::dvec4& plane, bool findSolids, unsigned frame)
    : mesh(placed.mesh),
      sceneFromMesh(placed.sceneFromMesh),
      knowsSolids(findSolids),
      firstFrame(frame),
      low(std::numeric_limits<double>::infinity()),
      high(-low) {
    const Heights heights(placed, plane);
    const LevelTriangles level(placed, plane, heights);
    lying = level.heights;
    const bool seeks = findSolids && !(level.heights.y > 0.0); // a solid without its upper side is none
    const osg::DrawElementsUInt& all = *mesh->triangles;
    const ClosedParts closed = seeks ? closedPartsOf(*mesh, all) : ClosedParts();
    osg::ref_ptr<osg::DrawElementsUInt> lists[2][2]; // [crossing][solid]
    for (auto& row : lists)
        for (auto& list : row) list = noTriangles();
    double thickness = 0.0;
    for (unsigned i = 0; i + 2 < all.size(); i += 3) {
        const auto [lowest, top] = std::minmax({heights.of[all[i]], heights.of[all[i + 1]], heights.of[all[i + 2]]});
        if (!(top > 0.0) || level.has[i / 3]) continue;
        osg::DrawElementsUInt& list = *lists[lowest < 0.0][seeks && closed.closed[i / 3]];
        for (unsigned corner = i; corner < i + 3; ++corner) {
            list.push_back(seeks ? closed.welded[all[corner]] : all[corner]);
            const glm::dvec3 place(sceneFromMesh * glm::dvec4(vertexAt(*mesh, all[corner]), 1.0));
            low = glm::min(low, place);
            high = glm::max(high, place);
            if (lowest < 0.0) thickness = std::max(thickness, heights.thickness[all[corner]]);
        }
        highest = std::max(highest, top);
    }
    for (const bool crossing : {false, true})
        for (const bool solid : {false, true})
            if (!lists[crossing][solid]->empty())
                parts.push_back({casterGeometry(*mesh, lists[crossing][solid]), crossing, solid, sceneFromMesh,
                                 placed.mirrored, crossing ? thickness : 0.0});
}

PlanarParts::PlanarParts(const PlacedMesh& placed, const glm::dvec4& plane, const glm::dvec3& from,
                         const glm::dvec3& to, const PlanarMesh& asWhole)
    : mesh(placed.mesh),
      sceneFromMesh(placed.sceneFromMesh),
      whole(&asWhole),
      knowsSolids(asWhole.knowsSolids),
      firstFrame(asWhole.firstFrame),
      low(from),
      high(to) {
    const osg::BoundingBoxd& box = mesh->bounds;
    const glm::dvec3 middle = toGlm(mesh->origin);
    double lowest = std::numeric_limits<double>::infinity(), reach = 0.0;
    highest = -lowest;
    for (const glm::dvec4& corner : boxCorners(toGlm(box._min) - middle, toGlm(box._max) - middle, sceneFromMesh)) {
        const double height = glm::dot(plane, corner);
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
        reach = std::max(reach, glm::distance(glm::dvec3(corner), glm::dvec3(sceneFromMesh[3])));
    }
    const double thickness = thicknessAt(reach, placed.rounding);
    if (!(highest > thickness)) return;
    // Cut triangles take twice as long to draw, and the box of what is turned reaches lower than it.
    const bool cut = !(lowest > thickness) && mustBeCut(*mesh, glm::transpose(sceneFromMesh) * plane, thickness);
    for (PlanarPart part : whole->parts) {
        part.crossing = cut;
        part.sceneFromMesh = sceneFromMesh;
        part.mirrored = placed.mirrored;
        part.thickness = thickness;
        parts.push_back(part);
    }
}

PlanarCasters::PlanarCasters(const Casters& casters, const glm::dvec4& groupPlane)
    : origin(casters.layers().origin),
      plane(SceneFrame(origin).plane(groupPlane)),
      low(std::numeric_limits<double>::infinity()),
      high(-low),
      _source(casters.retired()),
      _groupPlane(groupPlane) {}

void PlanarCasters::add(const osg::ref_ptr<const PlanarParts>& more) {
    _meshes.push_back(more);
    lying = {std::min(lying.x, more->lying.x), std::max(lying.y, more->lying.y)};
    if (more->parts.empty()) return;
    low = glm::min(low, more->low);
    high = glm::max(high, more->high);
    highest = std::max(highest, more->highest);
    for (const PlanarPart& part : more->parts) {
        parts.push_back(part);
        crosses = crosses || part.crossing;
    }
}

bool PlanarCasters::seeksSolids(unsigned frame) const {
    return std::any_of(_meshes.begin(), _meshes.end(),
                       [frame](const auto& mesh) { return !mesh->knowsSolids && mesh->firstFrame != frame; });
}

osg::ref_ptr<const PlanarParts> PlanarCasters::find(const PlacedMesh& placed) const {
    const auto found =
        std::find_if(_meshes.begin(), _meshes.end(), [&](const auto& mesh) { return mesh->madeFrom(placed); });
    return found == _meshes.end() ? nullptr : *found;
}

osg::ref_ptr<const PlanarParts> PlanarCasters::at(std::size_t place, const PlacedMesh& placed) const {
    return place < _meshes.size() && _meshes[place]->madeFrom(placed) ? _meshes[place] : nullptr;
}

void PlanarCasters::resizeGLObjectBuffers(unsigned maxSize) {
    for (const PlanarPart& part : parts) part.geometry->resizeGLObjectBuffers(maxSize);
}

void PlanarCasters::releaseGLObjects(osg::State* state) const {
    for (const PlanarPart& part : parts) part.geometry->releaseGLObjects(state);
}

/// Joined meshes by their triangles, bodies as wholes, but for those that lie in the plane in part.
osg::ref_ptr<PlanarCasters> PlanarCasterCache::make(const Casters& casters, const glm::dvec4& groupPlane,
                                                    unsigned frame) {
    const osg::ref_ptr<PlanarCasters> made = new PlanarCasters(casters, groupPlane);
    std::vector<osg::ref_ptr<PlanarCasters>> before;
    for (const auto& entry : _entries)
        if (entry->isOf(groupPlane) && entry->plane == made->plane) before.push_back(entry);
    const SceneFrame scene(casters.layers().origin);
    for (const PlacedMesh& placed : casters.layers().meshes()) {
        osg::ref_ptr<const PlanarParts> known;
        for (const auto& entry : before)
            if (!known) known = placed.isBody ? entry->at(made->size(), placed) : entry->find(placed);
        if (placed.isBody && (known ? known->whole.valid() : !hasLevelAbove(placed, made->plane))) {
            const osg::ref_ptr<const PlanarMesh> whole = wholeOf(*placed.mesh, frame);
            if (!known || known->whole != whole) // else it stands still while others move
                known = new PlanarParts(placed, made->plane, scene.point(placed.bounds._min),
                                        scene.point(placed.bounds._max), *whole);
        } else {
            if (!known || (!known->knowsSolids && known->firstFrame != frame))
                known = new PlanarParts(placed, made->plane, known.valid(), frame); // it stands still: the search pays
        }
        made->add(known);
    }
    return made;
}

osg::ref_ptr<const PlanarMesh> PlanarCasterCache::wholeOf(const CasterMesh& mesh, unsigned frame) {
    osg::ref_ptr<const PlanarMesh>& known = _wholes[&mesh];
    if (!known || (!known->knowsSolids && known->firstFrame != frame))
        known = new PlanarMesh(mesh, known.valid(), frame);
    return known;
}

osg::ref_ptr<PlanarCasters> PlanarCasterCache::of(const Casters& given, const glm::dvec4& groupPlane, unsigned frame,
                                                  std::size_t most) {
    Lock lock(_mutex);
    osg::ref_ptr<PlanarCasters>* entry =
        _entries.find([&](const auto& known) { return known->madeFrom(given, groupPlane); });
    if (entry && (*entry)->seeksSolids(frame)) *entry = make(given, groupPlane, frame);
    if (!entry) {
        const osg::ref_ptr<PlanarCasters> made = make(given, groupPlane, frame);
        _entries.dropIf([](const auto& known) { return known->isRetired(); });
        entry = &_entries.add(made);
    }
    const osg::ref_ptr<PlanarCasters> casters = *entry;
    _entries.dropOldestBeyond(most);
    dropUnused();
    return casters;
}

void PlanarCasterCache::letGo() {
    Lock lock(_mutex);
    _entries.dropIf([](const auto& known) { return known->isRetired(); });
    dropUnused();
}

/// Wholes that no entry has.
void PlanarCasterCache::dropUnused() {
    for (auto whole = _wholes.begin(); whole != _wholes.end();)
        whole = whole->second->referenceCount() == 1 ? _wholes.erase(whole) : std::next(whole);
}

void PlanarCasterCache::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    for (const auto& casters : _entries) casters->resizeGLObjectBuffers(maxSize);
}

void PlanarCasterCache::releaseGLObjects(osg::State* state) const {
    Lock lock(_mutex);
    for (const auto& casters : _entries) casters->releaseGLObjects(state);
}

} // namespace gnomon
