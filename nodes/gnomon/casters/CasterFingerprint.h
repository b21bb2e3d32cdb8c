// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/Fingerprint.h>
#include <gnomon/casters/CasterVisitor.h>

#include <cstdint>

namespace gnomon {

/// Fingerprint of everything that CasterExtraction would read: which arrays and primitives, where, and their
/// modification counts. Two frames with the same value have the same casters, so nothing is extracted again.
///
/// Arrays are told apart by address. Compare a value only with one whose CasterMesh (or CasterExtraction) is still held:
/// it keeps the arrays it was made of, so that no later array can stand at the same place.
///
/// Cost    a visit of the casters' nodes (not of their vertices); no allocation once warm.
/// Limits  arrays and primitives changed in place must be dirty()'d, as OpenSceneGraph asks; a change of size shows by
///         itself. Drawables that are not a Geometry count by address and bounds.
class CasterFingerprint : public CasterVisitor {
public:
    explicit CasterFingerprint(const Selection& selection = {});
    ~CasterFingerprint() override = default;
    META_NodeVisitor(gnomon, CasterFingerprint)

    void reset() override;
    std::uint64_t value() const { return _fingerprint.value(); }

    /// Of what CasterExtraction would read of one drawable.
    static std::uint64_t of(const osg::Drawable& drawable, const osg::Matrixd& rootFromLocal, const Casting& casting) {
        return placed(ofGeometry(drawable, casting), rootFromLocal);
    }
    /// The same, wherever it is.
    static std::uint64_t ofGeometry(const osg::Drawable& drawable, const Casting& casting);
    /// Of a geometry, at a place.
    static std::uint64_t placed(std::uint64_t geometry, const osg::Matrixd& rootFromLocal);

protected:
    void applyCaster(osg::Drawable& drawable, const Casting& casting) override {
        _fingerprint.mix(of(drawable, rootFromLocal(), casting));
    }

private:
    Fingerprint _fingerprint;
};

} // namespace gnomon
