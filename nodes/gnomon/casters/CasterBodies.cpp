// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/casters/CasterBodies.h>
#include <gnomon/casters/CasterExtraction.h>
#include <gnomon/rays/Placement.h>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x3.hpp>
#include <glm/matrix.hpp>

#include <iterator>
#include <limits>

namespace gnomon {
namespace {

/// Reads a drawable in its own frame, whole: see isBody().
class BodyReader : public CasterExtraction {
public:
    std::optional<unsigned> restart;

protected:
    Casting castingOf(const osg::Drawable&) override {
        Casting casting;
        casting.restart = restart;
        return casting;
    }
};

osg::ref_ptr<const CasterBody> extracted(const CasterDrawable& piece) {
    const osg::ref_ptr<BodyReader> found = new BodyReader;
    found->restart = piece.casting.restart;
    const_cast<osg::Drawable&>(*piece.drawable).accept(*found); // which changes nothing
    const osg::ref_ptr<CasterBody> body = new CasterBody;
    const osg::ref_ptr<CasterMesh> mesh = new CasterMesh(*found);
    body->sources.swap(mesh->sources);
    body->mesh = mesh;
    return body;
}

} // namespace

bool CasterBodies::isBody(const CasterDrawable& piece) {
    return piece.triangles >= fewestTriangles && piece.casting.isWhole() && piece.invalidTriangles == 0 &&
           isPlacement(toGlm(piece.groupFromLocal));
}

std::optional<PlacedMesh> CasterBodies::placed(const CasterDrawable& piece, const osg::Vec3d& origin) {
    osg::ref_ptr<const CasterBody>& body = _known[piece.geometry];
    if (!body) body = extracted(piece);
    const osg::ref_ptr<const CasterMesh>& mesh = body->mesh;
    if (mesh->triangles->size() != 3 * piece.triangles) return std::nullopt;
    piece.body = body;
    const glm::dmat4 groupFromLocal = toGlm(piece.groupFromLocal);
    const double longer = stretch(groupFromLocal);
    const glm::dmat4 fromMesh = glm::translate(groupFromLocal, toGlm(mesh->origin));
    return PlacedMesh{mesh,          glm::translate(glm::dmat4(1.0), -toGlm(origin)) * fromMesh,
                      true,          glm::determinant(glm::dmat3(fromMesh)) < 0.0,
                      longer,        longer * mesh->rounding,
                      piece.hiding,  piece.bounds,
                      piece.ownDrawn};
}

osg::BoundingBoxd CasterBodies::boundsOf(std::uint64_t geometry, const osg::Matrixd& groupFromLocal,
                                         std::size_t& triangles) const {
    osg::BoundingBoxd bounds;
    const auto known = _known.find(geometry);
    if (known == _known.end() || !isPlacement(toGlm(groupFromLocal))) return bounds;
    const CasterMesh& mesh = *known->second->mesh;
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

void CasterBodies::prune() {
    for (auto entry = _known.begin(); entry != _known.end();)
        entry = entry->second->referenceCount() == 1 ? _known.erase(entry) : std::next(entry);
}

} // namespace gnomon
