// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/casters/KnownCasters.h>
#include <gnomon/rays/Placement.h>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

constexpr std::size_t mostUnseen = 1000000; // triangles of levels that no view has now

/// Reads a drawable in its own frame, whole: see isBody().
class BodyReader : public CasterExtraction {
public:
    explicit BodyReader(const Casting& casting) {
        _casting.restart = casting.restart;
        _casting.offsetsTerminator = casting.offsetsTerminator;
    }

protected:
    Casting castingOf(const osg::Drawable&) override { return _casting; }

private:
    Casting _casting;
};

osg::ref_ptr<const CasterMesh> extracted(const Caster& piece) {
    const osg::ref_ptr<BodyReader> found = new BodyReader(piece.casting);
    const_cast<osg::Drawable&>(*piece.drawable).accept(*found); // which changes nothing
    return new CasterMesh(*found);
}

} // namespace

const Caster* KnownCasters::find(std::uint64_t fingerprint) const {
    const auto known = _levels.find(fingerprint);
    return known == _levels.end() ? nullptr : known->second.piece.get();
}

void KnownCasters::add(const Caster& piece) { _levels[piece.fingerprint] = {&piece, _visit}; }

std::optional<PlacedMesh> KnownCasters::placed(const Caster& piece, const osg::Vec3d& origin) {
    osg::ref_ptr<const CasterMesh>& mesh = _bodies[piece.geometry];
    if (!mesh) mesh = extracted(piece);
    if (mesh->triangles->size() != 3 * piece.triangles) return std::nullopt;
    piece.body = mesh;
    const glm::dmat4 groupFromLocal = toGlm(piece.groupFromLocal);
    const double longer = stretch(groupFromLocal);
    const glm::dmat4 fromMesh = glm::translate(groupFromLocal, toGlm(mesh->origin));
    return PlacedMesh{mesh,           glm::translate(glm::dmat4(1.0), -toGlm(origin)) * fromMesh,
                      true,           glm::determinant(glm::dmat3(fromMesh)) < 0.0,
                      longer,         longer * mesh->rounding,
                      piece.hiding,   piece.bounds,
                      piece.selfDrawn};
}

osg::BoundingBoxd KnownCasters::boundsOf(std::uint64_t geometry, const osg::Matrixd& groupFromLocal,
                                         std::size_t& triangles) const {
    osg::BoundingBoxd bounds;
    const auto known = _bodies.find(geometry);
    if (known == _bodies.end() || !isPlacement(toGlm(groupFromLocal))) return bounds;
    const CasterMesh& mesh = *known->second;
    const glm::dmat4x3 groupFromMesh(glm::translate(toGlm(groupFromLocal), toGlm(mesh.origin)));
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (const osg::Vec3& vertex : *mesh.vertices) {
        const glm::dvec3 place = groupFromMesh * glm::dvec4(vertex.x(), vertex.y(), vertex.z(), 1.0);
        low = glm::min(low, place);
        high = glm::max(high, place);
    }
    const glm::dvec3 reach = glm::max(glm::abs(low), glm::abs(high));
    constexpr double most = 1e18; // see TriangleDecoder
    if (reach.x <= most && reach.y <= most && reach.z <= most) bounds.set(low.x, low.y, low.z, high.x, high.y, high.z);
    triangles = mesh.triangles->size() / 3;
    return bounds;
}

void KnownCasters::pruneLevels() {
    std::unordered_map<const osg::Drawable*, int> held; // by pieces
    std::size_t seen = 0, unseen = 0;
    for (const auto& [fingerprint, known] : _levels) {
        const Caster& piece = *known.piece;
        const int sources =
            piece.drawable->asGeometry() ? 0 : 1 + (piece.kept ? 1 : 0) + (piece.body ? 1 : 0); // itself
        held[piece.drawable.get()] += 1 + sources;
        (known.lastVisit == _visit ? seen : unseen) += known.piece->triangles;
    }
    std::vector<std::pair<unsigned, std::uint64_t>> old; // by age
    for (auto entry = _levels.begin(); entry != _levels.end();) {
        const auto& [piece, lastVisit] = entry->second;
        const bool isGone = lastVisit != _visit && piece->drawable->referenceCount() <= held[piece->drawable.get()];
        if (isGone) unseen -= piece->triangles;
        if (!isGone && lastVisit != _visit) old.emplace_back(lastVisit, entry->first);
        entry = isGone ? _levels.erase(entry) : std::next(entry);
    }
    const std::size_t most = std::max(3 * seen, mostUnseen);
    if (unseen <= most) return;
    std::sort(old.begin(), old.end());
    for (std::size_t i = 0; i < old.size() && unseen > most; ++i) {
        const auto entry = _levels.find(old[i].second);
        unseen -= entry->second.piece->triangles;
        _levels.erase(entry);
    }
}

void KnownCasters::pruneBodies() {
    for (auto entry = _bodies.begin(); entry != _bodies.end();)
        entry = entry->second->referenceCount() == 1 ? _bodies.erase(entry) : std::next(entry);
}

void KnownCasters::clear() {
    _levels.clear();
    _bodies.clear();
}

} // namespace gnomon
