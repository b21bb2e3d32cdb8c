// SPDX-License-Identifier: MIT
#include "RandomScene.h"

#include "scenes/SceneParts.h"

#include <osg/AlphaFunc>
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
constexpr const char* shapeNames[] = {"box", "sphere", "prism", "sheet", "open sphere", "turned sphere", "fence"};
constexpr const char* stateNames[] = {"plain",
                                      "clipped",
                                      "with a clear texture",
                                      "with a solid texture",
                                      "tested as clear",
                                      "tested as solid",
                                      "of clear colours",
                                      "of solid colours",
                                      "of clear material",
                                      "of solid material",
                                      "restarted",
                                      "indirect",
                                      "back culled",
                                      "front culled",
                                      "culled",
                                      "never passing",
                                      "masked",
                                      "of lines"};
constexpr int states = static_cast<int>(std::size(stateNames));
constexpr double clippedAt = 0.5; // of a unit mesh's height
constexpr unsigned clipPlanes = 6;
const RandomScene usual;
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
    switch (ground) {
    case RandomScene::Ground::FLAT:
        return 0.0;
    case RandomScene::Ground::TILTED:
        return -x * std::tan(osg::DegreesToRadians(slopeDegrees));
    case RandomScene::Ground::HILLS:
        break;
    }
    return hillHeight * std::sin(0.5 * x) * std::cos(0.4 * y);
}

osg::ref_ptr<osg::Geode> groundNode(const RandomScene& scene) {
    switch (scene.ground) {
    case RandomScene::Ground::FLAT:
        return node(square(scene.half), "ground");
    case RandomScene::Ground::TILTED:
        return node(tilted(scene.half, slopeDegrees), "ground");
    case RandomScene::Ground::HILLS:
        break;
    }
    return node(
        landscape([](double x, double y) { return groundHeight(RandomScene::Ground::HILLS, x, y); }, scene.half, 28),
        "terrain");
}

RandomCaster randomCaster(Dice& dice, RandomScene::Ground ground) {
    RandomCaster caster;
    caster.shape = static_cast<RandomShape>(dice.one(3) ? dice.below(6) : 0);
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

/// Of size 1, standing on the origin.
Mesh unitMesh(RandomShape shape) {
    const Mesh ball = sphere({0.0, 0.0, 0.5}, 0.5, 16);
    switch (shape) {
    case RandomShape::BOX:
        return boxAt({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
    case RandomShape::SPHERE:
        return ball;
    case RandomShape::PRISM:
        return moved(sphere({0.0, 0.0, 0.0}, 0.5, 4), {0.0, 0.0, 0.5});
    case RandomShape::SHEET:
        return quad({-0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
    case RandomShape::OPEN:
        return openSphere(ball);
    case RandomShape::FENCE:
        return fence();
    case RandomShape::TURNED:
        break;
    }
    return turnedSphere(ball);
}

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

bool isThere(RandomState state) {
    switch (state) {
    case RandomState::CLEAR_TEXTURE:
    case RandomState::CLEAR_TEST:
    case RandomState::CLEAR_COLORS:
    case RandomState::CLEAR_MATERIAL:
    case RandomState::BOTH_CULLED:
    case RandomState::NEVER:
    case RandomState::MASKED:
    case RandomState::LINES:
        return false;
    default:
        return true;
    }
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

/// @param plane  number of a clip plane that nobody else has.
osg::ref_ptr<osg::Node> withState(osg::Geode& geode, RandomState state, unsigned plane) {
    osg::Geometry& geometry = *geode.getDrawable(0)->asGeometry();
    osg::StateSet& set = *geometry.getOrCreateStateSet();
    const auto colors = [&](float alpha) {
        const osg::ref_ptr<osg::Vec4Array> all = new osg::Vec4Array;
        all->resize(geometry.getVertexArray()->getNumElements(), colorOf(alpha));
        geometry.setColorArray(all, osg::Array::BIND_PER_VERTEX);
        set.setAttribute(material(osg::Material::AMBIENT_AND_DIFFUSE, 1.0f));
        blend(set);
    };
    switch (state) {
    case RandomState::PLAIN:
        break;
    case RandomState::CLIPPED: {
        const osg::ref_ptr<osg::ClipNode> clip = new osg::ClipNode;
        clip->addClipPlane(new osg::ClipPlane(plane, osg::Vec4d(0.0, 0.0, -1.0, clippedAt)));
        clip->addChild(&geode);
        return clip;
    }
    case RandomState::CLEAR_TEXTURE:
    case RandomState::SOLID_TEXTURE:
        addTexture(geometry, set, state == RandomState::CLEAR_TEXTURE ? 0.3f : 0.97f);
        blend(set);
        break;
    case RandomState::CLEAR_TEST:
    case RandomState::SOLID_TEST:
        addTexture(geometry, set, state == RandomState::CLEAR_TEST ? 0.3f : 0.97f);
        set.setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f));
        break;
    case RandomState::CLEAR_COLORS:
    case RandomState::SOLID_COLORS:
        colors(state == RandomState::CLEAR_COLORS ? 0.3f : 0.97f);
        break;
    case RandomState::CLEAR_MATERIAL:
    case RandomState::SOLID_MATERIAL:
        set.setAttribute(material(osg::Material::OFF, state == RandomState::CLEAR_MATERIAL ? 0.3f : 0.97f));
        blend(set);
        break;
    case RandomState::RESTARTED:
        restart(geometry, set);
        break;
    case RandomState::INDIRECT:
        drawIndirect(geometry);
        break;
    case RandomState::BACK_CULLED:
        set.setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
        break;
    case RandomState::FRONT_CULLED:
        set.setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT));
        break;
    case RandomState::BOTH_CULLED:
        set.setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT_AND_BACK));
        break;
    case RandomState::NEVER:
        set.setAttributeAndModes(new osg::Depth(osg::Depth::NEVER));
        break;
    case RandomState::MASKED:
        set.setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
        set.setAttribute(new osg::ColorMask(false, false, false, false));
        break;
    case RandomState::LINES:
        set.setAttribute(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
        break;
    }
    return &geode;
}

void breakMesh(Mesh& mesh) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const glm::dvec3 corner = mesh.front(), bad(nan, 0.0, nan);
    mesh.insert(mesh.end(), {corner, corner, corner, corner, bad, corner, bad, bad, bad});
}

/// @param drawn  not as rays see it. @param plane  see withState().
osg::ref_ptr<osg::Node> casterNode(const RandomCaster& caster, bool drawn, unsigned plane) {
    Mesh mesh = unitMesh(caster.shape);
    if (drawn && caster.broken) breakMesh(mesh);
    const bool culled = caster.state == RandomState::BACK_CULLED || caster.state == RandomState::FRONT_CULLED;
    if (!drawn && caster.state == RandomState::CLIPPED) mesh = clipped(mesh, clippedAt);
    osg::ref_ptr<osg::Node> below = node(mesh);
    if (drawn || culled) below = withState(*below->asGeode(), caster.state, plane); // the eye sees them so, too
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

osg::ref_ptr<osg::Group> contentOf(const RandomScene& scene, bool drawn) {
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(placeOf(scene));
    place->addChild(groundNode(scene));
    unsigned planes = 0;
    for (const RandomCaster& caster : scene.casters)
        if (drawn || isThere(caster.state)) {
            const bool clips = caster.state == RandomState::CLIPPED;
            place->addChild(casterNode(caster, drawn, planes));
            planes += clips ? 1 : 0;
        }
    if (scene.stray > 0.0) {
        const osg::ref_ptr<osg::MatrixTransform> far =
            new osg::MatrixTransform(osg::Matrixd::translate(scene.stray, 0.4 * scene.stray, 0.0));
        far->addChild(node(unitMesh(RandomShape::BOX)));
        place->addChild(far);
    }
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
        if (dice.one(12)) caster.shape = RandomShape::FENCE;
        if (dice.one(3)) caster.state = static_cast<RandomState>(1 + dice.below(states - 1));
        if (caster.state == RandomState::CLIPPED && ++clips > clipPlanes) caster.state = RandomState::PLAIN;
    }
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

/// Adds what `change` makes of a copy, if that is any different.
template <typename Part, typename Value>
void plainer(std::vector<RandomScene>& into, const RandomScene& scene, Part part, const Value& plain) {
    RandomScene copy = scene;
    auto& value = part(copy);
    if (value == plain) return;
    value = plain;
    into.push_back(std::move(copy));
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
    return stabilityCase(parts, width, height);
}

std::vector<RandomScene> simpler(const RandomScene& scene) {
    std::vector<RandomScene> all;
    for (std::size_t i = 0; scene.casters.size() > 1 && i < scene.casters.size(); ++i) {
        all.push_back(scene);
        all.back().casters.erase(all.back().casters.begin() + long(i));
    }
    plainer(
        all, scene, [](RandomScene & s) -> auto& { return s.offset; }, 0.0);
    plainer(
        all, scene, [](RandomScene & s) -> auto& { return s.scale; }, 1.0);
    plainer(
        all, scene, [](RandomScene & s) -> auto& { return s.half; }, usual.half);
    plainer(
        all, scene, [](RandomScene & s) -> auto& { return s.stray; }, usual.stray);
    plainer(
        all, scene, [](RandomScene & s) -> auto& { return s.ground; }, RandomScene::Ground::FLAT);
    for (std::size_t i = 0; i < scene.casters.size(); ++i) {
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].broken; }, false);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].state; }, RandomState::PLAIN);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].transforms; }, 0);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].shape; }, RandomShape::BOX);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].tilt; }, 0.0);
        plainer(
            all, scene, [i](RandomScene & s) -> auto& { return s.casters[i].turn; }, 0.0);
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
        << scene.half << ", stray " << scene.stray;
    for (const RandomCaster& caster : scene.casters) {
        out << "; " << shapeNames[int(caster.shape)] << " " << stateNames[int(caster.state)] << " at ";
        put(caster.foot);
        out << " of ";
        put(caster.size);
        out << " turned " << caster.turn << ", tilted " << caster.tilt << ", " << caster.transforms << " transforms"
            << (caster.broken ? ", broken" : "");
    }
    return out.str();
}

} // namespace gnomon::examples
