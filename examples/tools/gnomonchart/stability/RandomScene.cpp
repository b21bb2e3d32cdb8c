// SPDX-License-Identifier: MIT
#include "RandomScene.h"
#include "StabilityScene.h"

#include "scenes/SceneParts.h"

#include <osg/AlphaFunc>
#include <osg/Camera>
#include <osg/ClipNode>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PolygonMode>
#include <osg/PrimitiveRestartIndex>
#include <osg/PrimitiveSetIndirect>
#include <osg/Projection>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <sstream>

namespace gnomon::examples {
namespace {

constexpr double hillHeight = 1.2; // metres
constexpr double slopeDegrees = 18.0;
constexpr double clippedAt = 0.5; // of a unit mesh's height
constexpr unsigned clipPlanes = 6;
constexpr float clear = 0.3f, solid = 1.0f, waterAlpha = 0.7f; // alpha
constexpr int framesOfEdit = 2;
constexpr double roofAbove = 2.0, roofSide = 4.0; // metres, over the eye
const RandomScene usual;
constexpr const char* roofs[] = {"", ", culled roof", ", roof cut by a nested camera"};
constexpr const char* groundNames[] = {"flat", "tilted", "hills"};

/// std's distributions differ between libraries.
class Dice {
public:
    explicit Dice(unsigned seed) : _random(seed) {}
    double between(double low, double high) {
        return low + (high - low) * double(std::uint32_t(_random())) / 4294967296.0;
    }
    int below(int count) { return std::min(count - 1, static_cast<int>(between(0.0, count))); }
    bool one(int in) { return below(in) == 0; }

private:
    std::mt19937 _random;
};

double groundHeight(RandomScene::Ground ground, double x, double y) {
    if (ground == RandomScene::Ground::FLAT) return 0.0;
    if (ground == RandomScene::Ground::TILTED) return -x * std::tan(osg::DegreesToRadians(slopeDegrees));
    return hillHeight * std::sin(0.5 * x) * std::cos(0.4 * y);
}

osg::ref_ptr<osg::Geode> groundNode(const RandomScene& scene) {
    if (scene.ground == RandomScene::Ground::FLAT) return node(square(scene.half), "ground");
    if (scene.ground == RandomScene::Ground::TILTED) return node(tilted(scene.half, slopeDegrees), "ground");
    const auto height = [](double x, double y) { return groundHeight(RandomScene::Ground::HILLS, x, y); };
    return node(landscape(height, scene.half, 28), "terrain");
}

RandomCaster randomCaster(Dice& dice, RandomScene::Ground ground) {
    RandomCaster caster;
    caster.shape = dice.one(3) ? dice.below(6) : 0; // no fence yet
    caster.size = {dice.between(0.4, 3.0), dice.between(0.4, 3.0), dice.between(0.5, 4.0)};
    caster.foot = {dice.between(-6.0, 6.0), dice.between(-6.0, 6.0), 0.0};
    caster.foot.z = groundHeight(ground, caster.foot.x, caster.foot.y) + (dice.one(3) ? dice.between(0.0, 2.0) : -0.6);
    caster.turn = dice.one(4) ? 0.0 : dice.between(0.0, 360.0);
    caster.tilt = dice.one(4) ? dice.between(-40.0, 40.0) : 0.0;
    caster.transforms = dice.one(4) ? 1 + dice.below(8) : 0;
    caster.broken = dice.one(10);
    return caster;
}

glm::dvec4 randomLight(Dice& dice) {
    const double azimuth = dice.between(0.0, 360.0),
                 elevation = dice.one(5) ? dice.between(4.0, 15.0) : dice.between(15.0, 88.0);
    const osg::Vec4d sun = sunAt(azimuth, elevation);
    if (!dice.one(3)) return {sun.x(), sun.y(), sun.z(), 0.0};
    const double distance = dice.between(5.0, 30.0);
    return {sun.x() * distance, sun.y() * distance, std::max(3.0, sun.z() * distance), 1.0};
}

Mesh openSphere(Mesh mesh) {
    Mesh kept;
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3)
        if ((i / 3) % 5 != 2) kept.insert(kept.end(), mesh.begin() + long(i), mesh.begin() + long(i) + 3);
    return kept;
}

Mesh turnedSphere(Mesh mesh) {
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 12) std::swap(mesh[i], mesh[i + 1]);
    return mesh;
}

/// Five bars and two rails.
Mesh fence() {
    std::vector<Mesh> parts;
    for (int bar = 0; bar < 5; ++bar) parts.push_back(boxAt({0.22 * bar - 0.44, 0.0, 0.0}, {0.08, 0.08, 1.0}));
    for (const double height : {0.3, 0.8}) parts.push_back(boxAt({0.0, 0.0, height}, {1.0, 0.04, 0.06}));
    return joined(parts);
}

Mesh ball() { return sphere({0.0, 0.0, 0.5}, 0.5, 16); }

/// Of size 1, standing on the origin.
struct Shape {
    const char* name;
    Mesh (*mesh)();
};

constexpr int fenceShape = 6;
constexpr Shape shapes[] = {
    {"box",
     [] {
         return boxAt({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
     }},
    {"sphere", ball},
    {"prism",
     [] {
         return moved(sphere({0.0, 0.0, 0.0}, 0.5, 4), {0.0, 0.0, 0.5});
     }},
    {"sheet",
     [] {
         return quad({-0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
     }},
    {"open sphere", [] { return openSphere(ball()); }},
    {"turned sphere", [] { return turnedSphere(ball()); }},
    {"fence", fence},
};

/// What is below a height.
Mesh clipped(const Mesh& mesh, double height) {
    Mesh result;
    for (std::size_t i = 0; i + 2 < mesh.size(); i += 3) {
        Mesh polygon;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 &a = mesh[i + k], &b = mesh[i + (k + 1) % 3];
            if (a.z <= height) polygon.push_back(a);
            if ((a.z <= height) != (b.z <= height)) polygon.push_back(a + (b - a) * ((height - a.z) / (b.z - a.z)));
        }
        for (std::size_t k = 2; k < polygon.size(); ++k)
            result.insert(result.end(), {polygon[0], polygon[k - 1], polygon[k]});
    }
    return result;
}

void blend(osg::StateSet& set) {
    set.setMode(GL_BLEND, osg::StateAttribute::ON);
    set.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
}

/// What is clear is black: it adds no light to what is seen through it, by which that is measured.
osg::Vec4 colorOf(float alpha) {
    return alpha < 0.5f ? osg::Vec4(0.0f, 0.0f, 0.0f, alpha) : osg::Vec4(1.0f, 1.0f, 1.0f, alpha);
}

void addTexture(osg::Geometry& geometry, osg::StateSet& set, float alpha) {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 2, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned texel = 0; texel < 4; ++texel) image->setColor(colorOf(alpha), texel % 2, texel / 2);
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) texture->setWrap(wrap, osg::Texture::REPEAT);
    set.setTextureAttributeAndModes(0, texture);
    const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    for (const osg::Vec3& at : static_cast<const osg::Vec3Array&>(*geometry.getVertexArray()))
        places->push_back({at.x() + at.y(), at.z()});
    geometry.setTexCoordArray(0, places, osg::Array::BIND_PER_VERTEX);
}

osg::ref_ptr<osg::Material> material(osg::Material::ColorMode mode, float alpha) {
    const osg::ref_ptr<osg::Material> result = new osg::Material;
    result->setColorMode(mode);
    result->setDiffuse(osg::Material::FRONT_AND_BACK, colorOf(alpha));
    result->setAmbient(osg::Material::FRONT_AND_BACK, colorOf(alpha));
    return result;
}

/// Black, as what is clear: but most of the light behind it is kept back.
void water(osg::StateSet& set) {
    const osg::ref_ptr<osg::Material> dark = new osg::Material;
    dark->setDiffuse(osg::Material::FRONT_AND_BACK, {0.0f, 0.0f, 0.0f, waterAlpha});
    dark->setAmbient(osg::Material::FRONT_AND_BACK, {0.0f, 0.0f, 0.0f, waterAlpha});
    set.setAttribute(dark);
    blend(set);
}

/// By indices, and through buffers.
void setIndices(osg::Geometry& geometry, osg::PrimitiveSet* indices) {
    geometry.setPrimitiveSet(0, indices);
    geometry.setUseDisplayList(false);
    geometry.setUseVertexBufferObjects(true);
}

/// Each triangle is a strip, and the first vertex, another one, ends it.
void restart(osg::Geometry& geometry, osg::StateSet& set) {
    auto& corners = static_cast<osg::Vec3Array&>(*geometry.getVertexArray());
    auto& normals = static_cast<osg::Vec3Array&>(*geometry.getNormalArray());
    const osg::ref_ptr<osg::DrawElementsUInt> strips = new osg::DrawElementsUInt(GL_TRIANGLE_STRIP);
    for (unsigned i = 0; i + 2 < corners.size(); i += 3)
        for (const unsigned index : {i + 1, i + 2, i + 3, 0u}) strips->push_back(index);
    corners.insert(corners.begin(), osg::Vec3(0.0f, 0.0f, 0.5f));
    normals.insert(normals.begin(), osg::Vec3(0.0f, 0.0f, 1.0f));
    setIndices(geometry, strips);
    set.setMode(GL_PRIMITIVE_RESTART, osg::StateAttribute::ON);
    set.setAttribute(new osg::PrimitiveRestartIndex(0));
}

void drawIndirect(osg::Geometry& geometry) {
    const osg::ref_ptr<osg::DrawElementsIndirectUInt> all = new osg::DrawElementsIndirectUInt(GL_TRIANGLES);
    for (unsigned i = 0; i < geometry.getVertexArray()->getNumElements(); ++i) all->push_back(i);
    static_cast<osg::DefaultIndirectCommandDrawElements&>(*all->getIndirectCommandArray())
        .push_back(osg::DrawElementsIndirectCommand(all->getNumIndices(), 1, 0, 0, 0));
    setIndices(geometry, all);
}

void addColors(osg::Geometry& geometry, osg::StateSet& set, float alpha) {
    const osg::ref_ptr<osg::Vec4Array> all = new osg::Vec4Array;
    all->resize(geometry.getVertexArray()->getNumElements(), colorOf(alpha));
    geometry.setColorArray(all, osg::Array::BIND_PER_VERTEX);
    set.setAttribute(material(osg::Material::AMBIENT_AND_DIFFUSE, 1.0f));
    blend(set);
}

void blendTexture(osg::Geometry& geometry, osg::StateSet& set, float alpha) {
    addTexture(geometry, set, alpha);
    blend(set);
}

void testTexture(osg::Geometry& geometry, osg::StateSet& set, float alpha) {
    addTexture(geometry, set, alpha);
    set.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
}

void blendMaterial(osg::StateSet& set, float alpha) {
    set.setAttribute(material(osg::Material::OFF, alpha));
    blend(set);
}

void cull(osg::StateSet& set, osg::CullFace::Mode faces) { set.setAttributeAndModes(new osg::CullFace(faces)); }

/// What rays see of a caster.
enum class Rays { ALL, NOTHING, BELOW_PLANE, FACES };

/// How a caster is drawn.
struct State {
    const char* name;
    Rays rays;
    void (*set)(osg::Geometry& geometry, osg::StateSet& set);
};

using G = osg::Geometry;
using S = osg::StateSet;
constexpr State states[] = {
    {"plain", Rays::ALL, [](G&, S&) {}},
    {"clipped", Rays::BELOW_PLANE, [](G&, S&) {}}, // by a node above it
    {"with a clear texture", Rays::NOTHING, [](G& g, S& s) { blendTexture(g, s, clear); }},
    {"with a solid texture", Rays::ALL, [](G& g, S& s) { blendTexture(g, s, solid); }},
    {"tested as clear", Rays::NOTHING, [](G& g, S& s) { testTexture(g, s, clear); }},
    {"tested as solid", Rays::ALL, [](G& g, S& s) { testTexture(g, s, solid); }},
    {"of clear colours", Rays::NOTHING, [](G& g, S& s) { addColors(g, s, clear); }},
    {"of solid colours", Rays::ALL, [](G& g, S& s) { addColors(g, s, solid); }},
    {"of clear material", Rays::NOTHING, [](G&, S& s) { blendMaterial(s, clear); }},
    {"of solid material", Rays::ALL, [](G&, S& s) { blendMaterial(s, solid); }},
    {"restarted", Rays::ALL, restart},
    {"indirect", Rays::ALL, [](G& g, S&) { drawIndirect(g); }},
    {"back culled", Rays::FACES, [](G&, S& s) { cull(s, osg::CullFace::BACK); }},
    {"front culled", Rays::FACES, [](G&, S& s) { cull(s, osg::CullFace::FRONT); }},
    {"culled", Rays::NOTHING, [](G&, S& s) { cull(s, osg::CullFace::FRONT_AND_BACK); }},
    {"never passing", Rays::NOTHING, [](G&, S& s) { s.setAttributeAndModes(new osg::Depth(osg::Depth::NEVER)); }},
    {"masked", Rays::NOTHING,
     [](G&, S& s) {
         s.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
         s.setAttribute(new osg::ColorMask(false, false, false, false));
     }},
    {"of lines", Rays::NOTHING,
     [](G&, S& s) { s.setAttribute(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE)); }},
    {"of water", Rays::NOTHING, [](G&, S& s) { water(s); }}, // of seeds with more kinds
};

constexpr int waterState = static_cast<int>(std::size(states)) - 1;

const State& stateOf(const RandomCaster& caster) { return states[caster.state]; }
bool isClipped(const RandomCaster& caster) { return stateOf(caster).rays == Rays::BELOW_PLANE; }

/// @param plane  number of a clip plane that nobody else has.
osg::ref_ptr<osg::Node> withState(osg::Geode& geode, const RandomCaster& caster, unsigned plane) {
    osg::Geometry& geometry = *geode.getDrawable(0)->asGeometry();
    stateOf(caster).set(geometry, *geometry.getOrCreateStateSet());
    if (!isClipped(caster)) return &geode;
    const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
    clip->addClipPlane(new osg::ClipPlane(plane, osg::Vec4d(0.0, 0.0, -1.0, clippedAt)));
    clip->addChild(&geode);
    return clip;
}

void breakMesh(Mesh& mesh) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec3 corner = mesh.front(), bad(nan, 0.0, nan);
    mesh.insert(mesh.end(), {corner, corner, corner, corner, bad, corner, bad, bad, bad});
}

/// Moves a geode's vertices in place, and tells OpenSceneGraph by dirtyBound() and dirtyGLObjects() alone.
struct Edit : public osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        const bool elsewhere = int(visitor->getFrameStamp()->getFrameNumber()) < framesOfEdit;
        osg::Geometry& geometry = *node->asGeode()->getDrawable(0)->asGeometry();
        if (elsewhere != isElsewhere) {
            for (osg::Vec3& corner : static_cast<osg::Vec3Array&>(*geometry.getVertexArray()))
                corner.x() += elsewhere ? 1.5f : -1.5f;
            geometry.dirtyGLObjects();
            geometry.dirtyBound();
        }
        isElsewhere = elsewhere;
        traverse(node, visitor);
    }
    bool isElsewhere = false; ///< of the vertices, which copies of the node share.
};

/// @param drawn  not as rays see it. @param plane  see withState().
osg::ref_ptr<osg::Node> casterNode(const RandomCaster& caster, bool drawn, unsigned plane) {
    Mesh mesh = shapes[caster.shape].mesh();
    if (drawn && caster.broken) breakMesh(mesh);
    if (!drawn && isClipped(caster)) mesh = clipped(mesh, clippedAt);
    osg::ref_ptr<osg::Node> below = node(mesh);
    if (drawn && caster.edited) below->setUpdateCallback(new Edit);
    if (drawn || stateOf(caster).rays == Rays::FACES) // the eye sees them so, too
        below = withState(*below->asGeode(), caster, plane);
    for (int i = 0; i < caster.transforms; ++i) {
        osg::ref_ptr<osg::MatrixTransform> over =
            new osg::MatrixTransform(osg::Matrixd::scale(i % 2 ? -0.5 : -2.0, 1.0, i % 2 ? 1.25 : 0.8));
        over->addChild(below);
        below = over;
    }
    const double odd = caster.transforms % 2 ? 0.5 : 1.0; // so that its size is its size
    const glm::dvec3& size = caster.size;
    osg::ref_ptr<osg::MatrixTransform> place =
        new osg::MatrixTransform(osg::Matrixd::scale(size.x * odd, size.y, size.z) *
                                 osg::Matrixd::rotate(osg::DegreesToRadians(caster.tilt), 1.0, 0.0, 0.0) *
                                 osg::Matrixd::rotate(osg::DegreesToRadians(caster.turn), 0.0, 0.0, 1.0) *
                                 osg::Matrixd::translate(caster.foot.x, caster.foot.y, caster.foot.z));
    place->addChild(below);
    return place;
}

osg::Matrixd placeOf(const RandomScene& scene) {
    return osg::Matrixd::scale(scene.scale, scene.scale, scene.scale) *
           osg::Matrixd::translate(scene.offset, -0.6 * scene.offset, 0.1 * scene.offset);
}

/// Between the sun and what the camera looks at, above the eye.
osg::ref_ptr<osg::Node> roofNode(const RandomScene& scene, bool drawn) {
    const glm::dvec3 sun(scene.light), foot = scene.center + sun * ((scene.eye.z + roofAbove - scene.center.z) / sun.z);
    const osg::ref_ptr<osg::Node> roof = node(boxAt(foot, {roofSide, roofSide, 0.5}));
    struct Cull : public osg::NodeCallback {
        void operator()(osg::Node*, osg::NodeVisitor*) override {}
    };
    if (drawn && scene.roof == RandomScene::Roof::CULLED) roof->setCullCallback(new Cull);
    return roof;
}

/// As OpenSceneGraph's users draw a sky: first, through a projection of its own, without depth.
osg::ref_ptr<osg::Node> backdropNode() {
    const osg::ref_ptr<osg::Projection> projection = new osg::Projection(osg::Matrixd::ortho2D(0.0, 1.0, 0.0, 1.0));
    const osg::ref_ptr<osg::MatrixTransform> view = new osg::MatrixTransform;
    view->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    view->addChild(node(quad({0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0})));
    projection->addChild(view);
    osg::StateSet& set = *projection->getOrCreateStateSet();
    set.setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    set.setAttributeAndModes(new osg::Depth(osg::Depth::ALWAYS, 0.0, 1.0, false));
    set.setRenderBinDetails(-10, "RenderBin");
    projection->setCullingActive(false);
    return projection;
}

/// Cuts what is above the eye, as the pass of a mirror cuts what is on the other side.
osg::ref_ptr<osg::Group> cutAboveEye(osg::Node& below, const osg::Vec3d& eye) {
    const osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::NESTED_RENDER);
    camera->setReferenceFrame(osg::Transform::RELATIVE_RF);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setClearMask(0);
    const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
    clip->addClipPlane(new osg::ClipPlane(clipPlanes, osg::Vec4d(0.0, 0.0, -1.0, eye.z())));
    clip->addChild(&below);
    camera->addChild(clip);
    return camera;
}

osg::ref_ptr<osg::Group> contentOf(const RandomScene& scene, bool drawn) {
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(placeOf(scene));
    place->addChild(groundNode(scene));
    unsigned planes = 0;
    for (const RandomCaster& caster : scene.casters)
        if (drawn || stateOf(caster).rays != Rays::NOTHING) {
            place->addChild(casterNode(caster, drawn, planes));
            planes += isClipped(caster) ? 1 : 0;
        }
    if (scene.stray > 0.0) {
        const osg::ref_ptr<osg::MatrixTransform> far =
            new osg::MatrixTransform(osg::Matrixd::translate(scene.stray, 0.4 * scene.stray, 0.0));
        far->addChild(node(shapes[0].mesh()));
        place->addChild(far);
    }
    if (scene.roof != RandomScene::Roof::NONE) place->addChild(roofNode(scene, drawn));
    osg::ref_ptr<osg::Group> content = new osg::Group;
    content->addChild(place);
    return content;
}

osg::Vec3d placed(const glm::dvec3& point, const RandomScene& scene) {
    return osg::Vec3d(point.x, point.y, point.z) * placeOf(scene);
}

void addStates(RandomScene& scene, Dice& dice) {
    unsigned clips = 0;
    for (RandomCaster& caster : scene.casters) {
        if (dice.one(12)) caster.shape = fenceShape;
        if (dice.one(3)) caster.state = 1 + dice.below(waterState - 1);
        if (isClipped(caster) && ++clips > clipPlanes) caster.state = 0;
    }
}

/// A roof is out of sight only where nothing above the eye is in sight.
void addMoreKinds(RandomScene& scene, Dice& dice) {
    scene.backdrop = dice.one(4);
    if (dice.one(4)) scene.fraction = dice.between(0.1, 0.9);
    for (RandomCaster& caster : scene.casters) {
        if (dice.one(6)) caster.state = waterState;
        caster.edited = dice.one(6) && !isClipped(caster);
    }
    const bool wantsRoof = dice.one(3), isCut = dice.one(2);
    if (!wantsRoof || scene.light.w != 0.0 || scene.light.z < 0.4) return;
    scene.roof = isCut ? RandomScene::Roof::CUT : RandomScene::Roof::CULLED;
    const glm::dvec3 way = scene.eye - scene.center;
    const double top = std::tan(osg::DegreesToRadians(scene.fovy / 2.0 + 3.0));
    scene.eye.z = std::max(scene.eye.z, scene.center.z + std::hypot(way.x, way.y) * top);
}

/// Walls stand within some degrees of a plane with the sun.
void turnAlong(RandomScene& scene, double degrees) {
    const double turn = scene.casters.front().turn, along = osg::DegreesToRadians(turn + degrees),
                 level = std::hypot(scene.light.x, scene.light.y);
    scene.light = {level * std::cos(along), level * std::sin(along), scene.light.z, 0.0};
    for (RandomCaster& caster : scene.casters) {
        caster.turn = turn;
        caster.tilt = 0.0;
    }
}

} // namespace

RandomScene randomScene(unsigned seed) {
    Dice dice(seed);
    RandomScene scene;
    scene.seed = seed;
    scene.ground = static_cast<RandomScene::Ground>(dice.one(2) ? 0 : dice.below(3));
    const int casters = 1 + dice.below(dice.one(4) ? 12 : 4);
    for (int i = 0; i < casters; ++i) scene.casters.push_back(randomCaster(dice, scene.ground));
    scene.light = randomLight(dice);
    const double azimuth = dice.between(0.0, 2.0 * osg::PI), distance = dice.between(12.0, 26.0);
    scene.center = {dice.between(-2.0, 2.0), dice.between(-2.0, 2.0), 0.5};
    scene.eye =
        scene.center + glm::dvec3(distance * std::cos(azimuth), distance * std::sin(azimuth), dice.between(4.0, 18.0));
    scene.fovy = dice.between(25.0, 60.0);
    if (dice.one(4)) scene.offset = std::pow(10.0, dice.between(2.0, 7.0));
    if (dice.one(4)) scene.scale = std::pow(10.0, dice.between(-3.0, 3.0));
    addStates(scene, dice);
    if (dice.one(6) && scene.ground != RandomScene::Ground::HILLS) scene.half = std::pow(10.0, dice.between(2.0, 5.0));
    if (dice.one(8)) scene.stray = std::pow(10.0, dice.between(2.0, 7.0));
    if (dice.one(5) && scene.light.w == 0.0) turnAlong(scene, dice.between(-5.0, 5.0));
    if (seed >= firstOfMoreKinds) addMoreKinds(scene, dice);
    return scene;
}

StabilityCase caseOf(const RandomScene& scene, int width, int height) {
    SceneParts parts;
    parts.content = contentOf(scene, true);
    parts.truth = contentOf(scene, false);
    const osg::Vec3d light = scene.light.w == 0.0 ? osg::Vec3d(scene.light.x, scene.light.y, scene.light.z)
                                                  : placed(glm::dvec3(scene.light), scene);
    parts.light = osg::Vec4d(light, scene.light.w);
    parts.eye = placed(scene.eye, scene);
    parts.center = placed(scene.center, scene);
    parts.fovy = scene.fovy;
    parts.radius = 6.0 * scene.scale;
    if (scene.half > usual.half || scene.stray > 0.0) { // else the near plane would go with what is far
        parts.near = 1.0 * scene.scale;
        parts.far = std::max(100.0, 3.0 * scene.half) * scene.scale;
    }
    StabilityCase result = stabilityCase(parts, width, height);
    result.scene.camera.fraction = scene.fraction;
    for (const RandomCaster& caster : scene.casters)
        if (caster.edited) result.scene.framesBefore = framesOfEdit;
    const bool cuts = scene.roof == RandomScene::Roof::CUT;
    if (!cuts && !scene.backdrop) return result;
    result.scene.around = [cuts, backdrop = scene.backdrop, eye = parts.eye](osg::Node& root) {
        osg::ref_ptr<osg::Group> all = new osg::Group;
        if (backdrop) all->addChild(backdropNode());
        all->addChild(cuts ? cutAboveEye(root, eye).get() : &root);
        return osg::ref_ptr<osg::Node>(all);
    };
    return result;
}

std::vector<RandomScene> simpler(const RandomScene& scene) {
    std::vector<RandomScene> all;
    const std::string before = describe(scene);
    const auto add = [&](const auto& change) {
        RandomScene copy = scene;
        change(copy);
        if (describe(copy) != before) all.push_back(std::move(copy));
    };
    for (std::size_t i = 0; scene.casters.size() > 1 && i < scene.casters.size(); ++i)
        add([i](RandomScene& s) { s.casters.erase(s.casters.begin() + long(i)); });
    add([](RandomScene& s) { s.offset = 0.0; });
    add([](RandomScene& s) { s.scale = 1.0; });
    add([](RandomScene& s) { s.half = usual.half; });
    add([](RandomScene& s) { s.stray = 0.0; });
    add([](RandomScene& s) { s.roof = RandomScene::Roof::NONE; });
    add([](RandomScene& s) { s.backdrop = false; });
    add([](RandomScene& s) { s.fraction = 0.0; });
    add([](RandomScene& s) { s.ground = RandomScene::Ground::FLAT; });
    for (std::size_t i = 0; i < scene.casters.size(); ++i) {
        add([i](RandomScene& s) { s.casters[i].broken = false; });
        add([i](RandomScene& s) { s.casters[i].edited = false; });
        add([i](RandomScene& s) { s.casters[i].state = 0; });
        add([i](RandomScene& s) { s.casters[i].transforms = 0; });
        add([i](RandomScene& s) { s.casters[i].shape = 0; });
        add([i](RandomScene& s) { s.casters[i].tilt = 0.0; });
        add([i](RandomScene& s) { s.casters[i].turn = 0.0; });
    }
    return all;
}

std::string describe(const RandomScene& scene) {
    std::ostringstream out;
    const auto put = [&out](const glm::dvec3& v) { out << "(" << v.x << ", " << v.y << ", " << v.z << ")"; };
    out << "seed " << scene.seed << ": " << groundNames[int(scene.ground)] << " ground, "
        << (scene.light.w == 0.0 ? "sun " : "lamp ");
    put(glm::dvec3(scene.light));
    out << ", eye ";
    put(scene.eye);
    out << ", center ";
    put(scene.center);
    out << ", fovy " << scene.fovy << ", offset " << scene.offset << ", scale " << scene.scale << ", half "
        << scene.half << ", stray " << scene.stray << roofs[int(scene.roof)] << (scene.backdrop ? ", backdrop" : "");
    if (scene.fraction > 0.0) out << ", viewport off by " << scene.fraction << " px";
    for (const RandomCaster& caster : scene.casters) {
        out << "; " << shapes[caster.shape].name << " " << stateOf(caster).name << " at ";
        put(caster.foot);
        out << " of ";
        put(caster.size);
        out << " turned " << caster.turn << ", tilted " << caster.tilt << ", " << caster.transforms << " transforms"
            << (caster.broken ? ", broken" : "") << (caster.edited ? ", edited" : "");
    }
    return out.str();
}

namespace {

constexpr unsigned seedsAProcess = 25; // whose truths one process keeps
constexpr double lostBelow = 0.5;
constexpr std::size_t leastShadow = 200, leastTurnedAway = 50; // px; the first of a false one, too

StabilityScene seedsFrom(unsigned first, unsigned count) {
    StabilityScene scene;
    scene.id = "seeds from " + std::to_string(first);
    scene.parameter = "seed";
    for (unsigned i = 0; i < count; ++i) scene.values.push_back(first + i);
    scene.make = [](double seed, int width, int height) {
        return caseOf(randomScene(static_cast<unsigned>(seed)), width, height);
    };
    return scene;
}

/// Of the seeds of a batch.
StabilityPlan planOf(const RandomSearch& search) {
    StabilityPlan plan;
    plan.contenders = search.contenders;
    plan.width = search.width;
    plan.height = search.height;
    plan.workers = search.workers;
    for (unsigned done = 0; done < search.count; done += seedsAProcess)
        plan.scenes.push_back(seedsFrom(search.first + done, std::min(seedsAProcess, search.count - done)));
    return plan;
}

/// One scene under one technique.
StabilityCell cellOf(const RandomSearch& search, const Entrant& contender, const RandomScene& scene) {
    StabilityPlan plan;
    plan.contenders = {contender};
    plan.width = search.width;
    plan.height = search.height;
    plan.scenes = {{{"plainer", "", "", "", "", "", {0.0}},
                    [scene](double, int width, int height) { return caseOf(scene, width, height); }}};
    return runStability(plan, [](std::size_t, const std::string&) { return true; }).rows[0].cells[0];
}

RandomFault shrunk(const RandomSearch& search, const Entrant& contender, unsigned seed, const StabilityCell& cell) {
    RandomFault fault{contender.contender.technique, seed, randomScene(seed), cell};
    for (bool plainer = true; plainer;) {
        plainer = false;
        for (const RandomScene& tried : simpler(fault.plainest)) {
            const StabilityCell tryCell = cellOf(search, contender, tried);
            if (!isRandomFault(tryCell)) continue;
            fault.plainest = tried;
            fault.cell = tryCell;
            plainer = true;
            break;
        }
    }
    return fault;
}

void tellFaults(const RandomSearch& search, const StabilityResults& results,
                const std::function<void(const RandomFault&)>& found) {
    for (std::size_t i = 0; i < results.rows.size(); ++i) {
        const StabilityRow& row = results.rows[i];
        const StabilitySceneText& scene = results.scenes[i / search.contenders.size()];
        for (std::size_t place = 0; place < row.cells.size(); ++place)
            if (isRandomFault(row.cells[place]))
                found(shrunk(search, search.contenders[i % search.contenders.size()],
                             static_cast<unsigned>(scene.values[place]), row.cells[place]));
    }
}

} // namespace

bool isRandomFault(const StabilityCell& cell) {
    if (cell.failure == "crashed" || cell.failure == "hung" || cell.failure == "failed" || cell.notFinite > 0)
        return true;
    const StabilityJudgement& judged = cell.onReceiver ? *cell.onReceiver : cell.everywhere;
    const bool lost = std::max(judged.shadow, judged.wrong) > leastShadow && judged.iou < lostBelow;
    return cell.failure.empty() && !cell.stated() && (lost || judged.turnedAwayWrong > leastTurnedAway);
}

unsigned searchRandomScenes(const RandomSearch& search,
                            const std::function<bool(std::size_t, const std::string&)>& progress,
                            const std::function<void(const RandomFault&)>& found) {
    for (unsigned done = 0; done < search.count; done += search.batch) {
        RandomSearch batch = search;
        batch.first = search.first + done;
        batch.count = std::min(search.batch, search.count - done);
        const std::size_t before = std::size_t(done) * search.contenders.size();
        const auto tell = [&](std::size_t cells, const std::string& doing) { return progress(before + cells, doing); };
        const StabilityResults results = runStability(planOf(batch), tell);
        tellFaults(batch, results, found);
        if (!results.complete) return done;
    }
    return search.count;
}

std::string faultText(const RandomFault& fault) {
    const StabilityJudgement& judged = fault.cell.onReceiver ? *fault.cell.onReceiver : fault.cell.everywhere;
    const std::string what = fault.cell.failure.empty()
                                 ? "IoU " + valueText(judged.iou) + " of " + std::to_string(judged.shadow) + " px, " +
                                       std::to_string(judged.turnedAwayWrong) + " px turned away wrong"
                                 : fault.cell.failure + ", " + fault.cell.message;
    return fault.technique + " breaks (" + what + "): " + describe(fault.plainest);
}

} // namespace gnomon::examples
