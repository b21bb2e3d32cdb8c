// SPDX-License-Identifier: MIT
#include <gnomon/base/Fingerprint.h>
#include <gnomon/casters/DrawableContents.h>
#include <gnomon/casters/DrawableTriangles.h>

#include <osg/Geometry>

namespace gnomon {
namespace {

constexpr unsigned char firstVisits = 4; // those of some views, before any of them has drawn it

/// What is no geometry hands out its places one by one.
class PlacesReader : public TriangleDecoder {
public:
    PlacesReader() : TriangleDecoder(osg::Matrixd()) {}
    ~PlacesReader() override = default;
    Fingerprint found;

protected:
    void start(unsigned) override {}
    void point(unsigned) override {}
    void triangle(unsigned a, unsigned b, unsigned c) override {
        for (const unsigned corner : {a, b, c}) {
            const osg::Vec3d place = isInArray(corner) ? local(corner) : osg::Vec3d();
            for (int axis = 0; axis < 3; ++axis) found.mix(place[axis]);
        }
    }
};

void mixData(const osg::BufferData* data, Fingerprint& into) {
    if (data && data->getDataPointer()) into.mixBytes(data->getDataPointer(), data->getTotalDataSize());
}

} // namespace

Follows followsOf(const osg::Drawable& drawable) {
    if (drawable.asGeometry() && drawable.getUseVertexBufferObjects()) return Follows::Counts;
    const bool listed = drawable.getSupportsDisplayList() && drawable.getUseDisplayList();
    return listed && drawable.getDataVariance() != osg::Object::DYNAMIC ? Follows::List : Follows::Each;
}

std::uint64_t contentsOf(const osg::Drawable& drawable, bool all) {
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry) {
        PlacesReader reader;
        readTriangles(drawable, reader);
        return reader.found.value();
    }
    Fingerprint found;
    osg::Geometry::ArrayList arrays;
    if (all) geometry->getArrayList(arrays);
    for (const auto& array : arrays) mixData(array, found);
    if (!all)
        for (const osg::Array* array : {verticesOf(*geometry), normalArrayOf(*geometry)}) mixData(array, found);
    for (const auto& primitives : geometry->getPrimitiveSetList()) {
        mixData(primitives, found);
        mixData(indirectCommands(*primitives), found);
    }
    return found.value();
}

bool ListWatch::mayBeStale(const osg::Drawable& drawable, unsigned contexts) {
    for (unsigned context = 0; context < contexts; ++context)
        if (drawable.getDisplayList(context) != 0) {
            _hadList = true;
            return false;
        }
    if (_hadList) _visits = 0;
    _hadList = false;
    if (_visits == firstVisits) return false;
    ++_visits;
    return true;
}

} // namespace gnomon
