// SPDX-License-Identifier: MIT
#include <gnomon/gl/TriangleClusters.h>

#include <OpenThreads/Mutex>
#include <OpenThreads/ScopedLock>
#include <osg/GLExtensions>
#include <osg/ShapeDrawable>
#include <osg/State>
#include <osg/VertexArrayState>
#include <osg/observer_ptr>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <typeinfo>

namespace gnomon {
namespace {

/// How the corners of a mode are cut into runs, which share `overlap` of them.
struct Cutting {
    unsigned cornersInRun = 0, overlap = 0;
};

Cutting cuttingOf(GLenum mode) {
    constexpr unsigned triangles = 16;
    switch (mode) {
    case GL_TRIANGLES:
        return {3 * triangles, 0};
    case GL_QUADS:
        return {2 * triangles, 0};
    case GL_TRIANGLE_STRIP:
        return {triangles, 2}; // an even start keeps the sense of its triangles
    default:
        return {};
    }
}

/// Indirect ones are lists of indices to OSG as well, and draw something else.
bool canBeCut(const osg::PrimitiveSet& primitives) {
    using P = osg::PrimitiveSet;
    const auto types = {P::DrawArraysPrimitiveType, P::DrawElementsUBytePrimitiveType,
                        P::DrawElementsUShortPrimitiveType, P::DrawElementsUIntPrimitiveType};
    return cuttingOf(primitives.getMode()).cornersInRun > 0 && primitives.getNumInstances() == 0 &&
           std::find(types.begin(), types.end(), primitives.getType()) != types.end();
}

/// Smaller ones are drawn as fast as their parts are found.
constexpr std::size_t mostCornersDrawnWhole = 8000;

/// A geometry that draws just its arrays, where they say.
bool isPlain(const osg::Geometry& geometry) {
    const auto& sets = geometry.getPrimitiveSetList();
    const bool isKnown = typeid(geometry) == typeid(osg::Geometry) || typeid(geometry) == typeid(osg::ShapeDrawable);
    return isKnown && !geometry.containsDeprecatedData() && !geometry.getDrawCallback() &&
           !geometry.getComputeBoundingBoxCallback() && !geometry.getInitialBound().valid() &&
           dynamic_cast<const osg::Vec3Array*>(geometry.getVertexArray()) &&
           std::all_of(sets.begin(), sets.end(), [](const auto& set) { return canBeCut(*set); });
}

/// What clusters were made of, to be compared with what a geometry holds now.
struct Origin {
    std::vector<osg::observer_ptr<osg::BufferData>> parts; ///< a new one may stand at the address of one that is gone
    std::vector<std::uint64_t> counts;

    bool operator==(const Origin& other) const {
        const auto holds = [](const auto& mine, const auto& theirs) { return mine.valid() && mine == theirs; };
        return counts == other.counts &&
               std::equal(parts.begin(), parts.end(), other.parts.begin(), other.parts.end(), holds);
    }
};

Origin originOf(const osg::Geometry& geometry) {
    const auto word = [](unsigned high, unsigned low) { return std::uint64_t{high} << 32 | low; };
    const osg::Array& vertices = *geometry.getVertexArray();
    Origin result{{const_cast<osg::Array*>(&vertices)}, {word(vertices.getModifiedCount(), vertices.getNumElements())}};
    for (const auto& set : geometry.getPrimitiveSetList()) {
        const auto* arrays = dynamic_cast<const osg::DrawArrays*>(set.get());
        result.parts.emplace_back(set.get());
        result.counts.push_back(word(set->getModifiedCount(), set->getNumIndices()));
        result.counts.push_back(word(set->getMode(), arrays ? static_cast<unsigned>(arrays->getFirst()) : 0u));
    }
    return result;
}

bool isOutside(const osg::BoundingBox& box, const osg::Vec4d& side) {
    const double farthest = side.x() * (side.x() > 0.0 ? box.xMax() : box.xMin()) +
                            side.y() * (side.y() > 0.0 ? box.yMax() : box.yMin()) +
                            side.z() * (side.z() > 0.0 ? box.zMax() : box.zMin()) + side.w();
    return farthest < 0.0;
}

GLenum indexType(const osg::DrawElements& elements) {
    switch (elements.getType()) {
    case osg::PrimitiveSet::DrawElementsUBytePrimitiveType:
        return GL_UNSIGNED_BYTE;
    case osg::PrimitiveSet::DrawElementsUShortPrimitiveType:
        return GL_UNSIGNED_SHORT;
    default:
        return GL_UNSIGNED_INT;
    }
}

/// Where the indices of a list begin: in its buffer, which gets bound, or in memory. A number, for offsets into a buffer are
/// no pointers to count on from.
std::uintptr_t indicesOf(const osg::DrawElements& elements, osg::State& state, bool useBuffers) {
    osg::GLBufferObject* buffer = useBuffers ? elements.getOrCreateGLBufferObject(state.getContextID()) : nullptr;
    osg::VertexArrayState& arrays = *state.getCurrentVertexArrayState();
    if (buffer)
        arrays.bindElementBufferObject(buffer);
    else if (useBuffers)
        arrays.unbindElementBufferObject();
    if (!buffer) return reinterpret_cast<std::uintptr_t>(elements.getDataPointer());
    return static_cast<std::uintptr_t>(buffer->getOffset(elements.getBufferIndex()));
}

/// Runs of one primitive set, in one call: calls cost more than small runs do.
void drawRuns(const osg::PrimitiveSet& primitives, const TriangleClusters::Run* runs, std::size_t number,
              osg::State& state, bool useBuffers) {
    const osg::GLExtensions& gl = *state.get<osg::GLExtensions>();
    const auto drawn = static_cast<GLsizei>(number);
    std::vector<GLsizei> counts(number);
    for (std::size_t i = 0; i < number; ++i) counts[i] = static_cast<GLsizei>(runs[i].count);
    if (const osg::DrawElements* elements = primitives.getDrawElements()) {
        const std::size_t size = elements->getTotalDataSize() / elements->getNumIndices();
        const std::uintptr_t indices = indicesOf(*elements, state, useBuffers);
        std::vector<const void*> places(number);
        for (std::size_t i = 0; i < number; ++i)
            places[i] = reinterpret_cast<const void*>(indices + runs[i].first * size);
        gl.glMultiDrawElements(elements->getMode(), counts.data(), indexType(*elements), places.data(), drawn);
    } else {
        const auto& arrays = static_cast<const osg::DrawArrays&>(primitives);
        std::vector<GLint> firsts(number);
        for (std::size_t i = 0; i < number; ++i) firsts[i] = arrays.getFirst() + static_cast<GLint>(runs[i].first);
        gl.glMultiDrawArrays(arrays.getMode(), firsts.data(), counts.data(), drawn);
    }
}

/// What was made of each drawable, as long as it lives.
class Cache {
public:
    osg::ref_ptr<const TriangleClusters> find(const osg::Geometry& geometry, const Origin& origin) {
        OpenThreads::ScopedLock<OpenThreads::Mutex> lock(_mutex);
        const auto entry = _entries.find(&geometry);
        const bool holds = entry != _entries.end() && entry->second.drawable.valid() && entry->second.origin == origin;
        return holds ? entry->second.clusters : nullptr;
    }

    void keep(const osg::Geometry& geometry, const Origin& origin, const TriangleClusters* clusters) {
        OpenThreads::ScopedLock<OpenThreads::Mutex> lock(_mutex);
        for (auto entry = _entries.begin(); entry != _entries.end();)
            entry = entry->second.drawable.valid() ? std::next(entry) : _entries.erase(entry);
        _entries[&geometry] = {const_cast<osg::Geometry*>(&geometry), origin, clusters};
    }

private:
    struct Entry {
        osg::observer_ptr<osg::Geometry> drawable;
        Origin origin;
        osg::ref_ptr<const TriangleClusters> clusters;
    };
    OpenThreads::Mutex _mutex;
    std::map<const osg::Geometry*, Entry> _entries;
};

} // namespace

bool TriangleClusters::isBig(const osg::Geometry& geometry) {
    std::size_t corners = 0;
    for (const auto& primitives : geometry.getPrimitiveSetList()) corners += primitives->getNumIndices();
    return corners > mostCornersDrawnWhole;
}

ScreenSides screenSides(const ScreenRect& bounds, const osg::Matrixd& clipFromLocal) {
    const auto column = [&](int i) {
        return osg::Vec4d(clipFromLocal(0, i), clipFromLocal(1, i), clipFromLocal(2, i), clipFromLocal(3, i));
    };
    const osg::Vec4d x = column(0), y = column(1), w = column(3);
    return {x - w * bounds.low.x, w * bounds.high.x - x, y - w * bounds.low.y, w * bounds.high.y - y};
}

bool mayTouch(const osg::BoundingBox& box, const ScreenSides& sides) {
    return std::none_of(sides.begin(), sides.end(), [&box](const osg::Vec4d& side) { return isOutside(box, side); });
}

osg::ref_ptr<const TriangleClusters> TriangleClusters::of(const osg::Drawable& drawable) {
    static Cache cache;
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry || !isBig(*geometry) || !isPlain(*geometry)) return nullptr;
    const Origin origin = originOf(*geometry);
    osg::ref_ptr<const TriangleClusters> clusters = cache.find(*geometry, origin);
    if (clusters) return clusters;
    clusters = new TriangleClusters(*geometry);
    cache.keep(*geometry, origin, clusters);
    return clusters;
}

TriangleClusters::TriangleClusters(const osg::Geometry& geometry) {
    const auto& vertices = static_cast<const osg::Vec3Array&>(*geometry.getVertexArray());
    for (unsigned i = 0; i < geometry.getNumPrimitiveSets(); ++i) cut(*geometry.getPrimitiveSet(i), i, vertices);
}

void TriangleClusters::cut(const osg::PrimitiveSet& primitives, unsigned index, const osg::Vec3Array& vertices) {
    const Cutting cutting = cuttingOf(primitives.getMode());
    const unsigned corners = primitives.getNumIndices();
    for (unsigned first = 0; first + cutting.overlap < corners; first += cutting.cornersInRun) {
        const unsigned count = std::min(cutting.cornersInRun + cutting.overlap, corners - first);
        Cluster cluster{{index, first, count}, {}};
        for (unsigned i = first; i < first + count; ++i) {
            const unsigned corner = primitives.index(i);
            if (corner < vertices.size()) cluster.box.expandBy(vertices[corner]);
        }
        _clusters.push_back(cluster);
    }
}

std::vector<TriangleClusters::Run>
TriangleClusters::touching(const ScreenRect& bounds, const osg::Matrixd& clipFromLocal,
                           const std::function<bool(const osg::BoundingBox&)>& test) const {
    const ScreenSides sides = screenSides(bounds, clipFromLocal);
    std::vector<Run> runs;
    for (const Cluster& cluster : _clusters) {
        if (!mayTouch(cluster.box, sides) || (test && !test(cluster.box))) continue;
        const Run& run = cluster.run;
        // A strip's runs overlap, and so does what is joined.
        const bool follows = !runs.empty() && runs.back().primitiveSet == run.primitiveSet &&
                             runs.back().first + runs.back().count >= run.first;
        if (follows)
            runs.back().count = run.first + run.count - runs.back().first;
        else
            runs.push_back(run);
    }
    return runs;
}

void TriangleClusters::draw(osg::RenderInfo& renderInfo, const osg::Geometry& geometry, const std::vector<Run>& runs) {
    osg::State& state = *renderInfo.getState();
    osg::VertexArrayState* arrays = state.getCurrentVertexArrayState();
    const bool useBuffers = state.useVertexBufferObject(geometry.getUseVertexBufferObjects());
    state.bindVertexArrayObject(arrays);
    arrays->setVertexBufferObjectSupported(useBuffers);
    geometry.drawVertexArraysImplementation(renderInfo);
    for (std::size_t begin = 0, end; begin < runs.size(); begin = end) {
        const unsigned set = runs[begin].primitiveSet;
        for (end = begin; end < runs.size() && runs[end].primitiveSet == set;) ++end;
        osg::AttributeDispatchers& perSet = state.getAttributeDispatchers();
        if (perSet.active()) perSet.dispatch(set);
        drawRuns(*geometry.getPrimitiveSet(set), &runs[begin], end - begin, state, useBuffers);
    }
    if (!useBuffers) return;
    arrays->unbindVertexBufferObject();
    arrays->unbindElementBufferObject();
}

} // namespace gnomon
