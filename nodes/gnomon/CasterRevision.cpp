// SPDX-License-Identifier: MIT
#include <gnomon/CasterRevision.h>

#include <osg/Geometry>
#include <osg/PrimitiveSet>

namespace gnomon {
namespace {

/// Two counts of 32 bits as one word.
std::uint64_t word(unsigned high, unsigned low) { return std::uint64_t{high} << 32 | low; }

} // namespace

CasterRevision::CasterRevision(const Selection& selection) : CasterVisitor(selection) {}

void CasterRevision::reset() {
    CasterVisitor::reset();
    _hash = 0;
}

void CasterRevision::mix(const osg::Matrixd& matrix) {
    for (int i = 0; i < 16; ++i) mix(matrix.ptr()[i]);
}

void CasterRevision::mix(const osg::Geometry& geometry) {
    const osg::Array* vertices = verticesOf(geometry);
    mix(static_cast<const void*>(vertices));
    if (vertices) mix(word(vertices->getModifiedCount(), vertices->getNumElements()));
    mix(std::uint64_t{geometry.getNumPrimitiveSets()});
    for (const auto& primitives : geometry.getPrimitiveSetList()) {
        const bool listed = primitives->getDrawElements() != nullptr; // then a look at the first would touch the list
        const unsigned indices = primitives->getNumIndices();
        mix(static_cast<const void*>(primitives.get()));
        mix(word(primitives->getModifiedCount(), indices));
        mix(word(primitives->getMode(), listed || indices == 0 ? 0 : primitives->index(0)));
    }
}

void CasterRevision::mixBounds(const osg::Drawable& drawable) {
    const osg::BoundingBox& bounds = drawable.getBoundingBox();
    mix(static_cast<const void*>(&drawable));
    for (int i = 0; i < 3; ++i) mix(double{bounds._min[i]});
    for (int i = 0; i < 3; ++i) mix(double{bounds._max[i]});
}

void CasterRevision::applyCaster(osg::Drawable& drawable) {
    mix(rootFromLocal());
    if (const osg::Geometry* geometry = drawable.asGeometry())
        mix(*geometry);
    else
        mixBounds(drawable);
}

} // namespace gnomon
