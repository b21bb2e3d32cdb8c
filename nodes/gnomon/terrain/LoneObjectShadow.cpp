// SPDX-License-Identifier: MIT
#include <gnomon/terrain/LoneObjectShadow.h>

#include <tbb/parallel_for.h>

namespace gnomon {
namespace {

osg::ref_ptr<const LoneObjectShadow> sceneOf(const CasterMesh& mesh, const TerrainPlace& place,
                                             const TerrainSettings& settings, const LoneObjectShadow* known) {
    const osg::ref_ptr<const GroundRevision> drawn = place.drawn(known ? known->drawn : nullptr);
    if (known && known->mesh == &mesh && known->drawn == drawn && known->asBoxes == settings.asBoxes &&
        known->box == settings.box)
        return known;
    osg::ref_ptr<LoneObjectShadow> scene = new LoneObjectShadow;
    scene->mesh = &mesh;
    scene->drawn = drawn;
    scene->asBoxes = settings.asBoxes;
    scene->box = settings.box;
    if (scene->asBoxes)
        scene->boxes = boxCastersOf(mesh, drawn->drawables, scene->box);
    else
        scene->parts = partsOf(mesh, drawn->drawables);
    return scene;
}

void find(TerrainShadows& request) {
    const LoneObjectShadow& scene = *request.scene;
    const Ground& ground = *scene.drawn->ground;
    std::vector<TerrainShadow> found(scene.asBoxes ? scene.boxes.size() : scene.parts.size(),
                                     TerrainShadow{{}, TerrainOutcome::noGround});
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
        found[i] = scene.asBoxes ? boxShadowOf(ground, scene.boxes[i], request.light)
                                 : terrainShadow(ground, scene.parts[i], request.light, request.settings.method,
                                                 request.settings.error);
    });
    OutcomeCounts outcomes;
    for (TerrainShadow& shadow : found) {
        outcomes.add(shadow.outcome);
        request.shadows.push_back(std::move(shadow.triangles));
    }
    request.causes = outcomes.causes();
}

} // namespace

osg::ref_ptr<const TerrainShadows> TerrainShadows::of(const CasterMesh& mesh, const TerrainPlace& place,
                                                      const glm::dvec4& light, const TerrainSettings& settings,
                                                      const osg::ref_ptr<const TerrainShadows>& known) {
    const osg::ref_ptr<const LoneObjectShadow> scene =
        sceneOf(mesh, place, settings, known ? known->scene.get() : nullptr);
    if (known && known->scene == scene && known->light == light && known->settings == settings) return known;
    osg::ref_ptr<TerrainShadows> found = new TerrainShadows;
    found->scene = scene;
    found->light = light;
    found->settings = settings;
    find(*found);
    return found;
}

} // namespace gnomon
