// SPDX-License-Identifier: MIT
#include <gnomon/BoxShadow.h>
#include <gnomon/CasterRevision.h>
#include <gnomon/Convert.h>
#include <gnomon/ShadowPrisms.h>
#include <gnomon/TerrainGround.h>
#include <gnomon/TerrainScene.h>
#include <gnomon/TerrainShadow.h>

#include <OpenThreads/ScopedLock>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <osg/Camera>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <set>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr std::size_t mostMeshes = 2, mostKnown = 16; // eight lights under two groups

/// The terrain's drawables, and what they are made of.
class TerrainVisitor : public CasterVisitor {
public:
    explicit TerrainVisitor(const Selection& terrain) : CasterVisitor(terrain) {}
    std::set<const osg::Drawable*> drawables;
    std::vector<osg::ref_ptr<const osg::Referenced>> sources;

protected:
    void applyCaster(osg::Drawable& drawable) override {
        drawables.insert(&drawable);
        holdSources(drawable, sources);
    }
};

/// Triangles of all drawables but these.
std::vector<unsigned> trianglesWithout(const CasterMesh& mesh, const std::set<const osg::Drawable*>& terrain) {
    std::vector<unsigned> result;
    const osg::DrawElementsUInt& all = *mesh.triangles;
    for (std::size_t i = 0; i < mesh.drawn.size(); ++i) {
        if (terrain.count(mesh.drawn[i].drawable)) continue;
        const std::size_t end = i + 1 < mesh.drawn.size() ? mesh.drawn[i + 1].first : all.size();
        result.insert(result.end(), all.begin() + std::ptrdiff_t(mesh.drawn[i].first),
                      all.begin() + std::ptrdiff_t(end));
    }
    return result;
}

bool isUnder(const osg::Node& node, const osg::Node& root) {
    if (&node == &root) return true;
    const auto& parents = node.getParents();
    return std::any_of(parents.begin(), parents.end(), [&](const osg::Group* up) { return isUnder(*up, root); });
}

/// Without the view's camera, or another that is drawn for itself.
osg::NodePath belowCamera(const osg::NodePath& path) {
    const auto isCamera = [](const osg::Node* node) { return dynamic_cast<const osg::Camera*>(node) != nullptr; };
    return {std::find_if(path.rbegin(), path.rend(), isCamera).base(), path.end()};
}

void move(glm::dvec4& plane, const glm::dvec3& by) { plane.w -= glm::dot(glm::dvec3(plane), by); }

void move(ConvexPart& part, const glm::dvec3& by) {
    for (glm::dvec3& vertex : part.hull.vertices) vertex += by;
    for (ConvexHull::Face& face : part.hull.faces) move(face.plane, by);
    if (part.front) move(*part.front, by);
}

void findCasters(TerrainScene& scene, const std::set<const osg::Drawable*>& terrain) {
    const std::vector<unsigned> indices = trianglesWithout(*scene.mesh, terrain);
    const osg::Vec3Array& vertices = *scene.mesh->vertices;
    static_assert(sizeof(glm::vec3) == sizeof(osg::Vec3));
    const auto* positions = reinterpret_cast<const glm::vec3*>(vertices.getDataPointer());
    const glm::dvec3 origin = toGlm(scene.mesh->origin);
    if (scene.asBoxes)
        scene.objects = connectedPoints(positions, vertices.size(), indices.data(), indices.size());
    else
        scene.parts = convexParts(positions, vertices.size(), indices.data(), indices.size());
    for (ConvexPart& part : scene.parts) move(part, origin);
    for (auto& object : scene.objects)
        for (glm::dvec3& point : object) point += origin;
}

glm::dvec2 nearestInPlan(const std::vector<glm::dvec3>& points, const glm::dvec2& to) {
    const auto distance = [&](const glm::dvec3& p) {
        const glm::dvec2 way = glm::dvec2(p) - to;
        return glm::dot(way, way);
    };
    return glm::dvec2(*std::min_element(points.begin(), points.end(), [&](const glm::dvec3& a, const glm::dvec3& b) {
        return distance(a) < distance(b);
    }));
}

BoxCaster boxOf(const std::vector<glm::dvec3>& points, const osg::BoundingBoxd& given) {
    BoxCaster box;
    box.low = box.high = points.front();
    for (const glm::dvec3& p : points) box.low = glm::min(box.low, p), box.high = glm::max(box.high, p);
    if (given.valid()) box.low = toGlm(given._min), box.high = toGlm(given._max);
    box.nearestVertex = [&points](const glm::dvec2& corner) { return nearestInPlan(points, corner); };
    return box;
}

/// Whether people should know.
bool isNews(TerrainOutcome outcome) {
    constexpr TerrainOutcome asAsked[] = {TerrainOutcome::fan, TerrainOutcome::draped, TerrainOutcome::turnedAway,
                                          TerrainOutcome::edgeOn, TerrainOutcome::buried};
    return std::find(std::begin(asAsked), std::end(asAsked), outcome) == std::end(asAsked);
}

std::vector<std::string> causesOf(const std::vector<TerrainShadow>& found) {
    std::map<TerrainOutcome, std::size_t> counts;
    for (const TerrainShadow& shadow : found)
        if (isNews(shadow.outcome)) ++counts[shadow.outcome];
    std::vector<std::string> causes;
    for (const auto& [outcome, count] : counts)
        causes.push_back("finds of " + std::to_string(count) + " of " + std::to_string(found.size()) +
                         " casters: " + sentence(outcome));
    return causes;
}

TerrainShadow boxShadowOf(const std::vector<glm::dvec3>& object, const TerrainShadows& asked) {
    if (asked.light.w == 0.0 && !(asked.light.z > 0.0)) return {{}, TerrainOutcome::lightBelow};
    auto box = boxShadow(*asked.scene->drawn->ground, boxOf(object, asked.settings.box), asked.light);
    if (!box) return {{}, TerrainOutcome::noGround};
    return {std::move(*box), TerrainOutcome::fan};
}

void find(TerrainShadows& asked) {
    const TerrainScene& scene = *asked.scene;
    const bool box = scene.asBoxes;
    std::vector<TerrainShadow> found(box ? scene.objects.size() : scene.parts.size(),
                                     TerrainShadow{{}, TerrainOutcome::noGround});
    const TerrainMethod method =
        asked.settings.method == TerrainShadowGeode::DRAPE ? TerrainMethod::drape : TerrainMethod::hull;
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
        found[i] = box ? boxShadowOf(scene.objects[i], asked)
                       : terrainShadow(*scene.drawn->ground, scene.parts[i], asked.light, method, asked.settings.error);
    });
    asked.causes = causesOf(found);
    if (found.empty()) asked.causes.emplace_back("has nothing to cast but its own receiver: name the terrain alone.");
    for (TerrainShadow& shadow : found) asked.shadows.push_back(std::move(shadow.triangles));
}

} // namespace

TerrainPlace TerrainPlace::inFrameOf(const osg::Node& group, const Selection& terrain) {
    const auto root = const_cast<osg::Node*>(&group); // visitors ask for more than they need
    if (!terrain.node || isUnder(*terrain.node, group)) return {*root, terrain, osg::Matrixd::identity()};
    const osg::NodePath path = belowCamera(group.getParentalNodePaths().front());
    return {*path.front(), terrain, osg::Matrixd::inverse(osg::computeLocalToWorld(path, false))};
}

std::uint64_t TerrainPlace::revision() const {
    CasterRevision revision(terrain);
    revision.setRootFromVisited(groundFromRoot);
    root.accept(revision);
    return revision.value();
}

/// One that is known already, whatever cast on it.
osg::ref_ptr<const TerrainDrawn> TerrainCache::drawnAt(const TerrainPlace& place) const {
    const std::uint64_t revision = place.revision();
    for (const auto& known : _known)
        if (known->scene->drawn->revision == revision) return known->scene->drawn;
    TerrainVisitor visitor(place.terrain);
    place.root.accept(visitor);
    osg::ref_ptr<TerrainDrawn> drawn = new TerrainDrawn;
    drawn->revision = revision;
    drawn->drawables = std::move(visitor.drawables);
    drawn->sources = std::move(visitor.sources);
    drawn->ground = groundOf(place.root, place.terrain, place.groundFromRoot);
    return drawn;
}

osg::ref_ptr<const TerrainScene> TerrainCache::sceneOf(const CasterMesh& mesh, const TerrainPlace& place,
                                                       bool asBoxes) {
    const osg::ref_ptr<const TerrainDrawn> drawn = drawnAt(place);
    for (const auto& known : _known)
        if (known->scene->mesh == &mesh && known->scene->drawn == drawn && known->scene->asBoxes == asBoxes)
            return known->scene;
    osg::ref_ptr<TerrainScene> scene = new TerrainScene;
    scene->mesh = &mesh;
    scene->drawn = drawn;
    scene->asBoxes = asBoxes;
    findCasters(*scene, drawn->drawables);
    return scene;
}

/// Of casters that moved on, or of a third group, nothing is kept.
void TerrainCache::add(const osg::ref_ptr<const TerrainShadows>& shadows) {
    std::set<const CasterMesh*> meshes{shadows->scene->mesh.get()};
    for (std::size_t i = _known.size(); i-- > 0;) {
        if (meshes.size() < mostMeshes) meshes.insert(_known[i]->scene->mesh.get());
        if (!meshes.count(_known[i]->scene->mesh.get())) _known.erase(_known.begin() + std::ptrdiff_t(i));
    }
    if (_known.size() >= mostKnown) _known.erase(_known.begin());
    _known.push_back(shadows);
}

osg::ref_ptr<const TerrainShadows> TerrainCache::shadows(const CasterMesh& mesh, const TerrainPlace& place,
                                                         const glm::dvec4& light, const TerrainSettings& settings) {
    Lock lock(_mutex);
    const osg::ref_ptr<const TerrainScene> scene = sceneOf(mesh, place, settings.method == TerrainShadowGeode::BOX);
    const auto known = std::find_if(_known.begin(), _known.end(), [&](const auto& entry) {
        return entry->scene == scene && entry->light == light && entry->settings == settings;
    });
    if (known != _known.end()) {
        std::rotate(known, known + 1, _known.end());
        return _known.back();
    }
    osg::ref_ptr<TerrainShadows> found = new TerrainShadows;
    found->scene = scene;
    found->light = light;
    found->settings = settings;
    find(*found);
    ++_builds;
    add(found);
    return found;
}

osg::ref_ptr<const TerrainPrisms> TerrainCache::prismsOf(const TerrainShadows& shadows) {
    Lock lock(_mutex);
    if (!shadows.prisms)
        shadows.prisms = new TerrainPrisms(shadowPrisms(shadows.shadows, toGlm(shadows.scene->mesh->origin)));
    return shadows.prisms;
}

unsigned TerrainCache::builds() const {
    Lock lock(_mutex);
    return _builds;
}

void TerrainCache::resizeGLObjectBuffers(unsigned maxSize) {
    Lock lock(_mutex);
    for (const auto& known : _known)
        if (known->prisms) known->prisms->resizeGLObjectBuffers(maxSize);
}

void TerrainCache::releaseGLObjects(osg::State* state) const {
    Lock lock(_mutex);
    for (const auto& known : _known)
        if (known->prisms) known->prisms->releaseGLObjects(state);
}

} // namespace gnomon
