// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterMesh.h>

#include <OpenThreads/ScopedLock>
#include <osg/BufferObject>
#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

osg::BoundingBoxd boundsOf(const CasterExtraction& casters) {
    osg::BoundingBoxd bounds;
    for (unsigned index : casters.getTriangles()) bounds.expandBy(casters.getVertices()[index]);
    return bounds;
}

constexpr std::size_t mostSamples = 1000; // of the corners, to tell where most are
constexpr double farthest = 64.0; // the casters' reach in that of most, for which floats about the centre are fine

/// The middle one of some values.
double middleOf(std::vector<double> values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
}

/// The centre of all, unless a few are so far that floats about it were coarse for the others: then a place among most.
osg::Vec3d originOf(const CasterExtraction& casters, const osg::BoundingBoxd& bounds) {
    const std::vector<unsigned>& corners = casters.getTriangles();
    const std::size_t every = corners.size() / mostSamples + 1;
    std::vector<osg::Vec3d> places;
    for (std::size_t i = 0; i < corners.size(); i += every) places.push_back(casters.getVertices()[corners[i]]);
    const auto middle = [&places](const auto& measure) {
        std::vector<double> values;
        for (const osg::Vec3d& place : places) values.push_back(measure(place));
        return middleOf(std::move(values));
    };
    const osg::Vec3d among(middle([](const osg::Vec3d& p) { return p.x(); }),
                           middle([](const osg::Vec3d& p) { return p.y(); }),
                           middle([](const osg::Vec3d& p) { return p.z(); }));
    const double most = middle([&among](const osg::Vec3d& p) { return (p - among).length(); });
    return bounds.radius() <= farthest * most ? bounds.center() : among;
}

constexpr unsigned nowhere = std::numeric_limits<unsigned>::max();

/// @param places  where each vertex went, if it is used; those of a drawable still follow one another.
CasterExtraction::Cutout renumbered(const CasterExtraction::Cutout& found, const std::vector<unsigned>& places) {
    CasterExtraction::Cutout result{found.drawn, found.selfDrawn, found.test, nowhere, {}};
    const unsigned* own = places.data() + found.firstVertex;
    for (std::size_t i = 0; i < found.coordinates.size(); ++i)
        result.firstVertex = std::min(result.firstVertex, own[i]);
    for (std::size_t i = 0; i < found.coordinates.size(); ++i) {
        if (own[i] == nowhere) continue;
        const std::size_t at = own[i] - result.firstVertex;
        if (result.coordinates.size() <= at) result.coordinates.resize(at + 1);
        result.coordinates[at] = found.coordinates[i];
    }
    return result;
}

} // namespace

CasterMesh::CasterMesh(const CasterExtraction& casters, const std::optional<osg::Vec3d>& about)
    : vertices(new osg::Vec3Array),
      triangles(new osg::DrawElementsUInt(osg::PrimitiveSet::TRIANGLES)),
      bounds(boundsOf(casters)),
      rounding(casters.getRounding()),
      drawn(casters.getDrawn()),
      sources(casters.getSources()) {
    // Attached here, for the first geometry to use the array would do so, perhaps in one of several threads.
    vertices->setVertexBufferObject(new osg::VertexBufferObject);
    triangles->setElementBufferObject(new osg::ElementBufferObject);
    if (!casters.getOffsets().empty()) {
        offsets = new osg::Vec4Array;
        offsets->setVertexBufferObject(new osg::VertexBufferObject);
    }
    if (about || bounds.valid()) origin = about ? *about : originOf(casters, bounds);
    std::vector<unsigned> places(casters.getVertices().size(), nowhere);
    triangles->reserve(casters.getTriangles().size());
    for (unsigned index : casters.getTriangles()) {
        if (places[index] == nowhere) {
            places[index] = static_cast<unsigned>(vertices->size());
            vertices->push_back(osg::Vec3(casters.getVertices()[index] - origin));
            if (offsets) offsets->push_back(toOsg(casters.getOffsets()[index]));
        }
        triangles->push_back(places[index]);
    }
    for (const CasterExtraction::Cutout& cutout : casters.getCutouts()) cutouts.push_back(renumbered(cutout, places));
}

/// Isolated: a thread that waits for others must not take up work of the caller's, which might ask for the same in turn.
std::shared_ptr<const void> CasterMesh::derived(const std::type_info& type,
                                                const std::function<std::shared_ptr<const void>()>& make,
                                                bool keep) const {
    using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;
    Slot* slot = nullptr;
    {
        Lock lock(_mutex);
        slot = &_slots[type];
    }
    Lock lock(slot->mutex);
    std::shared_ptr<const void> result = slot->made.lock();
    if (!result && make) slot->made = result = tbb::this_task_arena::isolate(make);
    if (keep) slot->kept = result;
    return result;
}

osg::ref_ptr<osg::Geometry> casterGeometry(const CasterMesh& mesh, osg::DrawElementsUInt* triangles) {
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    geometry->setUseDisplayList(false);
    geometry->setUseVertexBufferObjects(true);
    geometry->setVertexArray(mesh.vertices.get());
    geometry->addPrimitiveSet(triangles);
    return geometry;
}

} // namespace gnomon
