// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterVisitor.h>

#include <cstdint>
#include <cstring>

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
    /// Each step is one to one, in the word and in what came before: two graphs that differ in one word never agree.
    /// The odd factor carries a difference up, the shift down again, so that it reaches all bits and the words' order
    /// matters.
    void mix(std::uint64_t bits) {
        _hash = (_hash ^ bits) * 0x9e3779b97f4a7c15u + 1;
        _hash ^= _hash >> 32;
    }
    void mix(double value) {
        std::uint64_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        mix(bits);
    }
    void mix(const void* address) { mix(std::uint64_t{reinterpret_cast<std::uintptr_t>(address)}); }
    void mix(const osg::Matrixd& matrix);
    void mix(const osg::Geometry& geometry);
    void mixBounds(const osg::Drawable& drawable);

    std::uint64_t _hash = 0;
};

} // namespace gnomon
