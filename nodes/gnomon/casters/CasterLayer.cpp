// SPDX-License-Identifier: MIT
#include <gnomon/casters/CasterBodies.h>
#include <gnomon/casters/CasterLayer.h>

#include <algorithm>
#include <utility>

namespace gnomon {

CasterLayer::CasterLayer(CasterDrawables::List given, const osg::Vec3d& about, CasterBodies& bodies,
                         const std::vector<const CasterLayer*>& before)
    : pieces(std::move(given)), origin(about) {
    std::vector<PlacedMesh> placed;
    for (const auto& piece : pieces) {
        triangles += piece->triangles;
        std::optional<PlacedMesh> body;
        if (CasterBodies::isBody(*piece)) body = bodies.placed(*piece, origin);
        if (body)
            placed.push_back(*std::move(body));
        else
            loosePieces.push_back(piece);
    }
    join(before);
    meshes.insert(meshes.end(), placed.begin(), placed.end());
}

void CasterLayer::join(const std::vector<const CasterLayer*>& before) {
    if (loosePieces.empty()) return;
    const auto same = std::find_if(before.begin(), before.end(), [this](const CasterLayer* layer) {
        return layer && layer->origin == origin && layer->loosePieces == loosePieces;
    });
    loose = same != before.end() ? (*same)->loose : meshOf(loosePieces, origin);
    loose->sources.clear(); // the pieces hold them
    PlacedMesh joined{loose, glm::dmat4(1.0), false, false, 1.0, loose->rounding, Hiding::Both, loose->bounds};
    if (!loose->triangles->empty()) meshes.push_back(joined);
}

} // namespace gnomon
