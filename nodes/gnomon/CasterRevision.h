// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterVisitor.h>

#include <cstdint>

namespace osg {
class Geometry;
}

namespace gnomon {

/// Fingerprint of everything that VertexTraverser would read: which arrays and primitives, where, and their
/// modification counts. Two frames with the same value have the same casters, so nothing is extracted again.
///
/// Arrays are told apart by address. Compare a value only with one whose CasterMesh (or VertexTraverser) is still held:
/// it keeps the arrays it was made of, so that no later array can stand at the same place.
///
/// Cost    a visit of the casters' nodes (not of their vertices); no allocation once warm.
/// Limits  arrays and primitives changed in place must be dirty()'d, as OpenSceneGraph asks; a change of size shows by
///         itself. Drawables that are not a Geometry count by address and bounds.
class GNOMON_EXPORT CasterRevision : public CasterVisitor {
public:
    explicit CasterRevision(const Selection& selection = {});
    ~CasterRevision() override = default;
    META_NodeVisitor(gnomon, CasterRevision)

        void reset() override;
    std::uint64_t value() const { return _hash; }

protected:
    void applyCaster(osg::Drawable& drawable) override;

private:
    void mix(std::uint64_t bits);
    void mix(double value);
    void mix(const void* address);
    void mix(const osg::Matrixd& matrix);
    void mix(const osg::Geometry& geometry);
    void mixBounds(const osg::Drawable& drawable);

    std::uint64_t _hash = 0;
};

} // namespace gnomon
