// SPDX-License-Identifier: MIT
// Casters that an alpha test leaves parts of: their shadow on a ground, worked out texel by texel.
#include <gnomon/Convert.h>
#include <gnomon/ShadowMapTechnique.h>
#include <support/Panels.h>
#include <support/Scene.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>
#include <osg/AlphaFunc>
#include <osg/ClipPlane>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/Program>
#include <osg/TexGen>
#include <osg/TexMat>
#include <osg/Texture2D>

#include <array>
#include <cmath>
#include <functional>

using gnomon::ShadowMapTechnique;
using test::Picture;
using test::Scene;
using test::View;
using On = osg::StateAttribute;

namespace {

constexpr int columns = 8, rows = 4;
constexpr double half = 6.0; // of the ground's side

/// Of a texel of the fence, 0 … 255.
int alphaOf(int column, int row) {
    constexpr int stripes[] = {255, 0, 200, 100, 0, 255, 0, 60};
    return stripes[(column + 3 * row) % columns];
}

osg::ref_ptr<osg::Texture2D> fenceTexture(GLenum format = GL_RGBA) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(columns, rows, 1, format, GL_UNSIGNED_BYTE);
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, float(alphaOf(column, row)) / 255.0f), unsigned(column),
                            unsigned(row));
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(which, osg::Texture::NEAREST);
    for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) texture->setWrap(wrap, osg::Texture::REPEAT);
    return texture;
}

void setTest(osg::StateSet& set, osg::AlphaFunc::ComparisonFunction how, float reference) {
    set.setAttributeAndModes(new osg::AlphaFunc(how, reference));
}

/// A parallelogram with the fence's texture, once over it.
struct Fence {
    glm::dvec3 corner, side, up;

    osg::ref_ptr<osg::Geometry> geometry() const {
        osg::ref_ptr<osg::Geometry> result = osg::createTexturedQuadGeometry(
            osg::Vec3(osg::Vec3d(corner.x, corner.y, corner.z)), osg::Vec3(osg::Vec3d(side.x, side.y, side.z)),
            osg::Vec3(osg::Vec3d(up.x, up.y, up.z)));
        osg::StateSet& set = *result->getOrCreateStateSet();
        set.setTextureAttributeAndModes(0, fenceTexture());
        setTest(set, osg::AlphaFunc::GREATER, 0.5f);
        return result;
    }

    /// Where a ray meets it, 0 … 1 each way; NaN if it does not.
    glm::dvec2 meet(const glm::dvec3& from, const glm::dvec3& way) const {
        const glm::dvec3 at = glm::inverse(glm::dmat3(side, up, -way)) * (from - corner);
        const bool met = at.x >= 0.0 && at.x <= 1.0 && at.y >= 0.0 && at.y <= 1.0 && at.z > 0.0;
        return met ? glm::dvec2(at) : glm::dvec2(NAN);
    }
};

const Fence level{{-2.0, -1.5, 2.0}, {4.0, 0.0, 0.0}, {0.0, 3.0, 0.0}};
const Fence upright{{-2.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {0.0, 0.0, 2.5}};
const Fence leaning{{-2.0, 0.3, 0.1}, {3.9, 0.2, 0.1}, {-0.2, 1.0, 2.5}};
const osg::Vec4d noon{0.0, 0.0, 1.0, 0.0}, afternoon{0.3, 0.8, 1.0, 0.0}, lamp{0.4, 5.0, 7.0, 1.0};

/// Whether there is something of it at (s, t).
using Solid = std::function<bool(double s, double t)>;

int alphaAt(double s, double t) { return alphaOf(int(std::floor(s * columns)), int(std::floor(t * rows)) % rows); }
bool greater(double s, double t) { return alphaAt(s, t) > 127.5; }
bool everywhere(double, double) { return true; }

struct FenceCase {
    Fence fence;
    osg::Vec4d light = afternoon;
    Solid solid = greater;
    std::function<void(osg::Geometry&)> change = [](osg::Geometry&) {};
};

Scene build(const FenceCase& setup) {
    Scene scene = test::groundScene({}, half, setup.light);
    const osg::ref_ptr<osg::Geometry> fence = setup.fence.geometry();
    setup.change(*fence);
    fence->setName("fence");
    scene.content->addChild(fence);
    return scene;
}

const View view = test::perspective({-1.0, -11.0, 9.0}, {0.0, 0.5, 0.0}, 640, 480);

enum class Ground { Unseen, Lit, Shadowed };

/// What a line of sight finds of the ground. The fence hides it, whatever of it is there.
Ground groundAt(const FenceCase& setup, double x, double y) {
    const test::Sight sight = test::sight(view, x, y);
    const glm::dvec3 at = sight.from - sight.way * (sight.from.z / sight.way.z);
    if (!(std::max(std::abs(at.x), std::abs(at.y)) < half)) return Ground::Unseen;
    if (!std::isnan(setup.fence.meet(sight.from, sight.way).x)) return Ground::Unseen;
    const glm::dvec4 light = gnomon::toGlm(setup.light);
    const glm::dvec2 met = setup.fence.meet(at, light.w == 0.0 ? glm::dvec3(light) : glm::dvec3(light) - at);
    return !std::isnan(met.x) && setup.solid(met.x, met.y) ? Ground::Shadowed : Ground::Lit;
}

struct Judged {
    int shadowed = 0, lit = 0, wrong = 0;
};

/// Of pixels whose neighbours find the same: a map's texel is less than a pixel here.
Judged judge(const FenceCase& setup, const Picture& picture) {
    Scene plain = build(setup), dark = build(setup);
    dark.takeLightAway();
    const Picture asLit = test::render(plain.root, view), asDark = test::render(dark.root, view);
    std::vector<Ground> found;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) found.push_back(groundAt(setup, x + 0.5, y + 0.5));
    const auto at = [&](int x, int y) { return found[std::size_t(y) * std::size_t(view.width) + std::size_t(x)]; };
    Judged result;
    for (int y = 1; y + 1 < view.height; ++y)
        for (int x = 1; x + 1 < view.width; ++x) {
            bool away = at(x, y) != Ground::Unseen;
            for (int i = 0; i < 9; ++i) away = away && at(x + i % 3 - 1, y + i / 3 - 1) == at(x, y);
            if (!away) continue;
            const bool shadowed = at(x, y) == Ground::Shadowed;
            ++(shadowed ? result.shadowed : result.lit);
            result.wrong += picture.at(x, y) != (shadowed ? asDark : asLit).at(x, y);
        }
    return result;
}

/// @return what diagnose() says.
std::vector<std::string> expectShadowOf(const FenceCase& setup, const std::function<void(Scene&)>& prepare = {}) {
    Scene scene = build(setup);
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(2048);
    scene.addShadow(technique);
    if (prepare) prepare(scene);
    const Judged result = judge(setup, test::render(scene.root, view));
    EXPECT_EQ(result.wrong, 0);
    EXPECT_GT(result.shadowed, 1000);
    EXPECT_GT(result.lit, 10000);
    return technique->diagnose();
}

using Causes = std::vector<std::string>;

TEST(MapCutout, AFenceCastsItsStripes) {
    for (const Fence& fence : {level, upright, leaning})
        for (const osg::Vec4d& light : {afternoon, lamp, noon}) {
            if (light == noon && fence.corner != level.corner) continue; // edge-on, or hidden by itself
            EXPECT_EQ(expectShadowOf({fence, light}), Causes());
        }
}

TEST(MapCutout, WithoutATestAFenceCastsAllOfItself) {
    const auto off = [](osg::Geometry& fence) { fence.getStateSet()->setMode(GL_ALPHA_TEST, On::OFF); };
    EXPECT_EQ(expectShadowOf({upright, afternoon, everywhere, off}), Causes());
}

TEST(MapCutout, EachFunctionLeavesWhatItIsToLeave) {
    using F = osg::AlphaFunc;
    struct Function {
        F::ComparisonFunction how;
        float reference; ///< where equality counts, one that bytes have as floats to the bit.
        std::function<bool(int)> passes;
    };
    for (const Function& function : {Function{F::LESS, 0.4f, [](int a) { return a < 102; }},
                                     {F::LEQUAL, 0.0f, [](int a) { return a == 0; }},
                                     {F::GREATER, 0.4f, [](int a) { return a > 102; }},
                                     {F::GEQUAL, 1.0f, [](int a) { return a == 255; }},
                                     {F::EQUAL, 0.0f, [](int a) { return a == 0; }},
                                     {F::NOTEQUAL, 1.0f, [](int a) { return a < 255; }}}) {
        const auto set = [&](osg::Geometry& fence) { setTest(*fence.getStateSet(), function.how, function.reference); };
        const auto solid = [&](double s, double t) { return function.passes(alphaAt(s, t)); };
        SCOPED_TRACE(function.how);
        EXPECT_EQ(expectShadowOf({level, noon, solid, set}), Causes());
    }
}

TEST(MapCutout, TextureMatricesMoveTheStripes) {
    const auto move = [](osg::Geometry& fence) {
        fence.getStateSet()->setTextureAttribute(
            0, new osg::TexMat(osg::Matrixd::scale(0.5, 2.0, 1.0) * osg::Matrixd::translate(0.125, 0.25, 0.0)));
    };
    const auto solid = [](double s, double t) { return greater(0.5 * s + 0.125, 2.0 * t + 0.25); };
    EXPECT_EQ(expectShadowOf({upright, afternoon, solid, move}), Causes());
}

/// Two triangles by indices, their vertices in another order and among others, coordinates homogeneous doubles.
TEST(MapCutout, TakesIndexedTrianglesAndCoordinatesOfOtherKinds) {
    const auto index = [](osg::Geometry& fence) {
        const auto& old = static_cast<const osg::Vec3Array&>(*fence.getVertexArray());
        const auto& at = static_cast<const osg::Vec2Array&>(*fence.getTexCoordArray(0));
        osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        osg::ref_ptr<osg::Vec4dArray> coordinates = new osg::Vec4dArray;
        for (const unsigned i : {2u, 0u, 3u, 1u}) {
            vertices->push_back({99.0f, 99.0f, 99.0f}); // which nothing uses
            coordinates->push_back({0.4, 0.4, 0.0, 1.0});
            vertices->push_back(old[i]);
            coordinates->push_back(osg::Vec4d(at[i].x(), at[i].y(), 0.0, 1.0) * 3.0);
        }
        fence.setVertexArray(vertices);
        fence.setTexCoordArray(0, coordinates, osg::Array::BIND_PER_VERTEX);
        const std::array<GLushort, 6> corners{3, 7, 1, 3, 1, 5};
        fence.setPrimitiveSet(0, new osg::DrawElementsUShort(GL_TRIANGLES, 6, corners.data()));
        const std::array<GLushort, 2> points{0, 5}; // which cast nothing, but use vertices before the triangles do
        fence.insertPrimitiveSet(0, new osg::DrawElementsUShort(GL_POINTS, 2, points.data()));
        fence.dirtyBound();
        fence.setNormalArray(nullptr);
    };
    EXPECT_EQ(expectShadowOf({upright, afternoon, greater, index}), Causes());
}

TEST(MapCutout, StatesAreInheritedFromWithinTheGroupAndFromAboveIt) {
    const auto strip = [](osg::Geometry& fence) { fence.setStateSet(nullptr); };
    for (const bool above : {false, true}) {
        const auto give = [above](Scene& scene) {
            osg::StateSet& set = *(above ? scene.root : scene.content)->getOrCreateStateSet();
            set.setTextureAttributeAndModes(0, fenceTexture());
            setTest(set, osg::AlphaFunc::GREATER, 0.5f);
            test::find(*scene.root, "ground")->getOrCreateStateSet()->setTextureMode(0, GL_TEXTURE_2D, On::OFF);
        };
        SCOPED_TRACE(above);
        EXPECT_EQ(expectShadowOf({upright, afternoon, greater, strip}, give), Causes());
    }
}

TEST(MapCutout, AnOverrideAboveWinsUnlessWhatIsBelowIsProtected) {
    const auto override = [](Scene& scene) {
        scene.root->getOrCreateStateSet()->setMode(GL_ALPHA_TEST, On::OFF | On::OVERRIDE);
    };
    EXPECT_EQ(expectShadowOf({upright, afternoon, everywhere}, override), Causes());
    const auto protect = [](osg::Geometry& fence) {
        fence.getStateSet()->setMode(GL_ALPHA_TEST, On::ON | On::PROTECTED);
    };
    EXPECT_EQ(expectShadowOf({upright, afternoon, greater, protect}, override), Causes());
    const auto less = [](Scene& scene) {
        scene.root->getOrCreateStateSet()->setAttribute(new osg::AlphaFunc(osg::AlphaFunc::LESS, 0.5f),
                                                        On::ON | On::OVERRIDE);
    };
    const auto rest = [](double s, double t) { return !greater(s, t); };
    EXPECT_EQ(expectShadowOf({upright, afternoon, rest}, less), Causes());
}

TEST(MapCutout, SolidCastersBesideItAndASecondFenceCastToo) {
    const FenceCase setup{upright};
    const auto add = [](Scene& scene) {
        scene.content->addChild(test::node(test::box({-5.0, 3.0, 0.0}, {-4.0, 4.0, 1.0})));
        const Fence other{{3.0, 2.0, 0.5}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
        const osg::ref_ptr<osg::Geometry> second = other.geometry();
        second->setStateSet(test::find(*scene.root, "fence")->getStateSet()); // so that both are drawn in one call
        scene.content->addChild(second);
    };
    Scene scene = build(setup), without = build(setup);
    scene.addShadow(new ShadowMapTechnique);
    add(scene);
    add(without);
    const Picture shadowed = test::render(scene.root, view), lit = test::render(without.root, view);
    int box = 0, fence = 0; // darkened, left of where the first fence's shadow begins and right of where it ends
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const test::Sight sight = test::sight(view, x + 0.5, y + 0.5);
            const glm::dvec3 at = sight.from - sight.way * (sight.from.z / sight.way.z);
            const bool darker = shadowed.at(x, y) != lit.at(x, y);
            box += darker && at.x < -4.0 && at.y < 6.0;
            fence += darker && at.x > 2.1 && at.y < 6.0;
        }
    EXPECT_GT(box, 300);
    EXPECT_GT(fence, 100);
}

Causes solidWith(const std::function<void(osg::Geometry&)>& change) {
    return expectShadowOf({upright, afternoon, everywhere, change});
}

/// By a program, a texture on another unit, and the one texel that is shown without coordinates.
TEST(MapCutout, WhatOnlyItsOwnDrawingTellsIsDrawnByIt) {
    const auto otherUnit = [](osg::Geometry& fence) {
        fence.getStateSet()->setTextureMode(0, GL_TEXTURE_2D, On::OFF);
        fence.getStateSet()->setTextureAttributeAndModes(1, fenceTexture());
        fence.setTexCoordArray(1, fence.getTexCoordArray(0), osg::Array::BIND_PER_VERTEX);
    };
    EXPECT_EQ(expectShadowOf({upright, afternoon, greater, otherUnit}), Causes());
    const auto generated = [](osg::Geometry& fence) { // from x and y
        fence.getStateSet()->setTextureAttributeAndModes(0, new osg::TexGen);
    };
    const auto byPlace = [](double s, double) { return alphaOf((int(std::floor(32.0 * s)) + 16) % columns, 0) > 127; };
    EXPECT_EQ(expectShadowOf({upright, afternoon, byPlace, generated}), Causes());
    EXPECT_EQ(solidWith([](osg::Geometry& fence) { fence.setTexCoordArray(0, nullptr); }), Causes());
    const auto programmed = [](const char* text) {
        return [text](osg::Geometry& fence) {
            osg::ref_ptr<osg::Program> program = new osg::Program;
            program->addShader(new osg::Shader(osg::Shader::FRAGMENT, text));
            fence.getStateSet()->setAttribute(program);
        };
    };
    const auto saysUnlitAlone = [](const Causes& causes) {
        return causes.size() == 1 && causes[0].find("no light can be taken from 'fence'") != std::string::npos;
    };
    EXPECT_TRUE(saysUnlitAlone(solidWith(programmed("void main() { gl_FragColor = vec4(1.0); }"))));
    const auto discards = programmed("uniform sampler2D t; void main() { if (texture2D(t, gl_TexCoord[0].xy).a < 0.5) "
                                     "discard; gl_FragColor = vec4(0.0); }");
    const auto withoutTest = [&](osg::Geometry& fence) {
        discards(fence);
        fence.getStateSet()->setMode(GL_ALPHA_TEST, On::OFF);
    };
    EXPECT_TRUE(saysUnlitAlone(expectShadowOf({upright, afternoon, greater, withoutTest})));
}

/// Half of what is behind it must be hidden, by all that makes its alpha.
TEST(MapCutout, WhatBlendsCastsWhereItsAlphaIsAHalfOrMore) {
    const auto blends = [](osg::Geometry& fence) {
        fence.getStateSet()->setMode(GL_ALPHA_TEST, On::OFF);
        fence.getStateSet()->setMode(GL_BLEND, On::ON);
        fence.getStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    };
    EXPECT_EQ(expectShadowOf({leaning, lamp, greater, blends}), Causes());
    const auto paler = [&](osg::Geometry& fence) {
        blends(fence);
        const osg::ref_ptr<osg::Material> material = new osg::Material;
        material->setAlpha(osg::Material::FRONT_AND_BACK, 0.6f);
        fence.getStateSet()->setAttribute(material);
    };
    const auto from213 = [](double s, double t) { return alphaAt(s, t) > 212; };
    EXPECT_EQ(expectShadowOf({upright, afternoon, from213, paler}), Causes()) << "though its alpha is 1 nowhere";
    const auto fading = [&](osg::Geometry& fence) { // in colours of the vertices, upwards
        blends(fence);
        const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
        for (const auto& place : static_cast<const osg::Vec2Array&>(*fence.getTexCoordArray(0)))
            colors->push_back({1.0f, 1.0f, 1.0f, place.y()});
        fence.setColorArray(colors, osg::Array::BIND_PER_VERTEX);
        fence.getStateSet()->setMode(GL_LIGHTING, On::OFF);
    };
    const auto times = [](double s, double t) { return t * alphaAt(s, t) > 127.5; };
    const Causes causes = expectShadowOf({upright, afternoon, times, fading});
    for (const std::string& cause : causes) EXPECT_NE(cause.find("unlit"), std::string::npos) << cause;
}

TEST(MapCutout, WhatAPlaneCutsIsCutOutToo) {
    const auto cut = [](osg::Geometry& fence) {
        fence.getStateSet()->setAttributeAndModes(new osg::ClipPlane(0, osg::Vec4d(0.0, 0.0, -1.0, 1.7)));
    };
    const auto below = [](double s, double t) { return 2.5 * t < 1.7 && greater(s, t); };
    EXPECT_EQ(expectShadowOf({upright, afternoon, below, cut}), Causes());
    const auto otherUnit = [&](osg::Geometry& fence) { // by its own drawing
        cut(fence);
        fence.getStateSet()->setTextureMode(0, GL_TEXTURE_2D, On::OFF);
        fence.getStateSet()->setTextureAttributeAndModes(1, fenceTexture());
        fence.setTexCoordArray(1, fence.getTexCoordArray(0), osg::Array::BIND_PER_VERTEX);
    };
    for (const osg::Vec4d& light : {afternoon, lamp}) {
        SCOPED_TRACE(light.w());
        EXPECT_EQ(expectShadowOf({upright, light, below, otherUnit}), Causes());
    }
    Scene plain = build({upright, lamp, below, otherUnit}), scene = build({upright, lamp, below, otherUnit});
    scene.addShadow(new ShadowMapTechnique);
    const View low = test::perspective({-1.0, -9.0, 1.0}, {0.0, 0.0, 1.2}, 320, 240);
    const Picture unshadowed = test::render(plain.root, low), shadowed = test::render(scene.root, low);
    int background = 0;
    for (std::size_t i = 0; i < unshadowed.pixels.size(); ++i) {
        if (unshadowed.pixels[i] != unshadowed.pixels.back()) continue;
        ++background;
        ASSERT_EQ(shadowed.pixels[i], unshadowed.pixels[i]) << "the view is cut as before";
    }
    EXPECT_GT(background, 20000);
}

TEST(MapCutout, WhatHasNoAlphaIsSolidAndNothingIsSaidOfIt) {
    EXPECT_EQ(
        solidWith([](osg::Geometry& fence) { fence.getStateSet()->setTextureAttribute(0, fenceTexture(GL_RGB)); }),
        Causes());
    EXPECT_EQ(solidWith([](osg::Geometry& fence) { fence.getStateSet()->setTextureMode(0, GL_TEXTURE_2D, On::OFF); }),
              Causes());
}

TEST(MapCutout, ANewReferenceAnotherTextureAndAnImageDirtiedAreSeenInTheNextFrame) {
    const auto texture = fenceTexture();
    const auto give = [&](osg::Geometry& fence) { fence.getStateSet()->setTextureAttribute(0, texture); };
    FenceCase setup{upright, afternoon, greater, give};
    Scene scene = build(setup);
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(2048);
    scene.addShadow(technique);
    scene.group->setCasters({test::find(*scene.root, "fence")}); // so that nothing solid casts beside it
    test::Camera camera(scene.root, view);
    EXPECT_EQ(judge(setup, camera.frame()).wrong, 0);
    camera.frame();
    EXPECT_EQ(technique->passes(), 1u);
    auto* fence = static_cast<osg::Geometry*>(test::find(*scene.root, "fence"));
    static_cast<osg::AlphaFunc*>(fence->getStateSet()->getAttribute(On::ALPHAFUNC))->setReferenceValue(0.9f);
    const auto solid = [](double s, double t) { return alphaAt(s, t) > 229; };
    EXPECT_EQ(judge({upright, afternoon, solid, give}, camera.frame()).wrong, 0);
    EXPECT_EQ(technique->passes(), 2u);
    for (unsigned row = 0; row < unsigned(rows); ++row)
        for (unsigned column = 0; column < unsigned(columns); ++column)
            texture->getImage()->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, column < 4 ? 1.0f : 0.0f), column, row);
    texture->getImage()->dirty();
    const auto leftHalf = [](double s, double) { return s < 0.5; };
    EXPECT_EQ(judge({upright, afternoon, leftHalf, give}, camera.frame()).wrong, 0);
    EXPECT_EQ(technique->passes(), 3u);
}

} // namespace
