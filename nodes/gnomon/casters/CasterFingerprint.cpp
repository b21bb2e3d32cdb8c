// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterFingerprint.h>
#include <gnomon/casters/DrawableTriangles.h>

#include <osg/Geometry>
#include <osg/PrimitiveSet>

namespace gnomon {
namespace {

/// Two counts of 32 bits as one word.
std::uint64_t word(unsigned high, unsigned low) { return std::uint64_t{high} << 32 | low; }

void mixGeometry(const osg::Geometry& geometry, const osg::Array* vertices, Fingerprint& into) {
    into.mix(static_cast<const void*>(vertices));
    if (vertices) {
        into.mix(word(vertices->getModifiedCount(), vertices->getNumElements()));
        into.mix(std::uint64_t{vertices->getNormalize()});
    }
    into.mix(std::uint64_t{geometry.getNumPrimitiveSets()});
    for (const auto& primitives : geometry.getPrimitiveSetList()) {
        if (const osg::BufferData* commands = indirectCommands(*primitives)) {
            into.mix(static_cast<const void*>(commands));
            into.mix(word(commands->getModifiedCount(), commands->getTotalDataSize()));
            into.mix(static_cast<const void*>(primitives.get()));
            into.mix(word(primitives->getModifiedCount(), primitives->getMode()));
            continue;
        }
        const bool listed = primitives->getDrawElements() != nullptr; // then a look at the first would touch the list
        const unsigned indices = primitives->getNumIndices();
        into.mix(static_cast<const void*>(primitives.get()));
        into.mix(word(primitives->getModifiedCount(), indices));
        into.mix(word(primitives->getMode(), listed || indices == 0 ? 0 : primitives->index(0)));
    }
}

void mixBounds(const osg::Drawable& drawable, Fingerprint& into) {
    const osg::BoundingBox& bounds = drawable.getBoundingBox();
    into.mix(static_cast<const void*>(&drawable));
    for (int i = 0; i < 3; ++i) into.mix(double{bounds._min[i]});
    for (int i = 0; i < 3; ++i) into.mix(double{bounds._max[i]});
}

} // namespace

CasterFingerprint::CasterFingerprint(const Selection& selection) : CasterVisitor(selection) {}

void CasterFingerprint::reset() {
    CasterVisitor::reset();
    _fingerprint = Fingerprint();
}

std::uint64_t CasterFingerprint::ofGeometry(const osg::Drawable& drawable, const Casting& casting) {
    Fingerprint result;
    if (const osg::Geometry* geometry = drawable.asGeometry())
        mixGeometry(*geometry, verticesOf(*geometry), result);
    else
        mixBounds(drawable, result);
    casting.mix(drawable, result);
    return result.value();
}

std::uint64_t CasterFingerprint::placed(std::uint64_t geometry, const osg::Matrixd& rootFromLocal) {
    Fingerprint result;
    result.mix(rootFromLocal);
    result.mix(geometry);
    return result.value();
}

} // namespace gnomon
