// SPDX-License-Identifier: MIT
// What writes depth and hides what is behind it receives, in whichever bin it is drawn.
#include "Trial.h"

#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Image>
#include <osg/LogicOp>
#include <osg/Material>
#include <osg/Texture2D>

using namespace test;

namespace {

GNOMON_BY_TECHNIQUE(AnyBin);

Trial houseTrial() { return {{house({0.0, 0.0}, {2.0, 1.5, 1.0}, 30.0)}}; }

void useBin(osg::Node& node, int number, const std::string& name = "RenderBin") {
    node.getOrCreateStateSet()->setRenderBinDetails(number, name);
}

/// As loaders leave what has, or might have, an alpha of less than 1.
void blendLate(osg::Node& node) {
    node.getOrCreateStateSet()->setMode(GL_BLEND, osg::StateAttribute::ON);
    node.getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
}

/// Drawn late by a logic operation.
void operateLate(osg::Node& node, osg::LogicOp::Opcode code) {
    node.getOrCreateStateSet()->setAttributeAndModes(new osg::LogicOp(code));
    node.getOrCreateStateSet()->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
}

/// Relit, and blended to black if that shows the same.
::testing::AssertionResult isRightWith(const Change& change, bool blended = true) {
    const Trial trial = houseTrial();
    if (blended) return isRight(trial, change);
    Scene shadowed = trial.buildWithShadow();
    change(shadowed);
    Camera camera(shadowed.root, trial.view);
    camera.frame();
    return shows(camera.frame(), truthOf(trial, change));
}

/// A pane over house, ground and shadow.
osg::ref_ptr<osg::Geode> pane(float alpha, bool depth) {
    osg::ref_ptr<osg::Geode> geode = node(quad({-2.0, -2.0, 1.5}, {6.0, 0.0, 0.0}, {0.0, 4.0, 0.0}), "pane");
    auto* colors = static_cast<osg::Vec4Array*>(geode->getDrawable(0)->asGeometry()->getColorArray());
    colors->front() = {0.2f, 0.6f, 1.0f, alpha};
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    blendLate(*geode);
    if (!depth) geode->getStateSet()->setAttribute(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
    return geode;
}

/// White, with this alpha in its left and in its right half.
osg::ref_ptr<osg::Texture2D> halves(unsigned char left, unsigned char right) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < 8; ++i) image->data()[i] = i == 3 ? left : i == 7 ? right : 255;
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    return texture;
}

/// On a ground of half side 8.
void show(osg::Texture2D& texture, osg::Node& ground) {
    osg::Geometry& geometry = *ground.asGeode()->getDrawable(0)->asGeometry();
    osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    for (const osg::Vec3& vertex : *static_cast<osg::Vec3Array*>(geometry.getVertexArray()))
        places->push_back({vertex.x() / 16.0f + 0.5f, 0.5f});
    geometry.setTexCoordArray(0, places, osg::Array::BIND_PER_VERTEX);
    ground.getOrCreateStateSet()->setTextureAttributeAndModes(0, &texture);
}

} // namespace

TEST_P(AnyBin, AWholeSceneInABinAboveTheShadowsReceives) {
    EXPECT_TRUE(isRightWith([](Scene& scene) { useBin(*scene.content, 11); }));
}

TEST_P(AnyBin, AGroundInTheShadowsOwnBinReceives) {
    EXPECT_TRUE(isRightWith([](Scene& scene) { useBin(*find(*scene.root, "ground"), 8); }));
}

TEST_P(AnyBin, ASceneThatBlendsWithAnAlphaOf1Receives) {
    EXPECT_TRUE(isRightWith([](Scene& scene) { blendLate(*scene.content); }));
}

TEST_P(AnyBin, AGroundAloneThatBlendsWithAnAlphaOf1Receives) {
    EXPECT_TRUE(isRightWith([](Scene& scene) { blendLate(*find(*scene.root, "ground")); }));
}

TEST_P(AnyBin, ASceneThatALogicOperationDrawsReceivesWhereItHidesWhatIsBehind) {
    EXPECT_TRUE(isRightWith([](Scene& scene) { operateLate(*scene.content, osg::LogicOp::COPY_INVERTED); }, false));
}

TEST_P(AnyBin, ASceneThatALogicOperationCombinesWithWhatIsBehindIsNamedAsTheCause) {
    const Trial trial = houseTrial();
    Scene scene = trial.build();
    osg::Node* ground = find(*scene.root, "ground");
    const auto technique = castingTechnique(GetParam() == By::Hull ? ground : nullptr);
    scene.addShadow(technique);
    operateLate(*ground, osg::LogicOp::OR_INVERTED);
    Camera camera(scene.root, trial.view);
    camera.frame();
    const std::vector<std::string> causes = technique->diagnose();
    const auto isNamed = [](const std::string& cause) {
        return cause.find("a logic operation combines 'ground'") != std::string::npos;
    };
    EXPECT_EQ(std::count_if(causes.begin(), causes.end(), isNamed), 1);
    ground->getStateSet()->setAttributeAndModes(new osg::LogicOp(osg::LogicOp::COPY));
    camera.frame();
    EXPECT_TRUE(technique->diagnose().empty());
}

TEST_P(AnyBin, ANestedAndSortedBinReceives) {
    EXPECT_TRUE(isRightWith([](Scene& scene) {
        useBin(*scene.content, 12);
        useBin(*find(*scene.root, "ground"), 3, "DepthSortedBin");
    }));
}

TEST_P(AnyBin, WhatIsDrawnOverTheLastReceiverStaysOverIt) {
    EXPECT_TRUE(isRightWith(
        [](Scene& scene) {
            useBin(*scene.content, 9);
            scene.root->addChild(pane(0.5f, false));
        },
        false));
}

TEST_P(AnyBin, WhatLetsTheGroundShineThroughReceivesNothingAndLeavesTheGroundItsShadow) {
    EXPECT_TRUE(isRightWith([](Scene& scene) { scene.root->addChild(pane(0.5f, true)); }, false));
}

/// As it is lit without shadows, and nothing can be wrong about what is not lit.
TEST_P(AnyBin, ALitPaneIsNamed) {
    const Trial trial = houseTrial();
    Scene scene = trial.build();
    const auto technique = castingTechnique(GetParam() == By::Hull ? find(*scene.root, "ground") : nullptr);
    scene.addShadow(technique);
    const osg::ref_ptr<osg::Geode> glass = pane(0.5f, true);
    scene.root->addChild(glass);
    Camera camera(scene.root, trial.view);
    const auto isNamed = [&] {
        camera.frame();
        const std::vector<std::string> causes = technique->diagnose();
        return std::any_of(causes.begin(), causes.end(), [](const std::string& cause) {
            return cause.find("'pane' blends with what stands behind it") != std::string::npos;
        });
    };
    EXPECT_FALSE(isNamed());
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setDiffuse(osg::Material::FRONT_AND_BACK, {0.2f, 0.6f, 1.0f, 0.5f});
    glass->getStateSet()->setAttributeAndModes(material);
    glass->getStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::ON);
    EXPECT_EQ(isNamed(), GetParam() != By::Hull) << "hull names its receiver: nothing else receives";
    material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    osg::Geometry& geometry = *glass->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    colors->resize(geometry.getVertexArray()->getNumElements(), {0.2f, 0.6f, 1.0f, 0.5f});
    geometry.setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    EXPECT_EQ(isNamed(), GetParam() != By::Hull) << "by a colour for each vertex";
    const osg::ref_ptr<osg::Vec4ubArray> bytes = new osg::Vec4ubArray;
    bytes->resize(colors->size(), {50, 150, 255, 128});
    geometry.setColorArray(bytes, osg::Array::BIND_PER_VERTEX);
    EXPECT_EQ(isNamed(), GetParam() != By::Hull) << "by bytes";
    material->setColorMode(osg::Material::OFF);
    material->setDiffuse(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 1.0f});
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    image->setColor({1.0f, 1.0f, 1.0f, 0.5f}, 0, 0);
    glass->getStateSet()->setTextureAttributeAndModes(0, new osg::Texture2D(image));
    EXPECT_EQ(isNamed(), GetParam() != By::Hull) << "by a texture";
}

/// A receiver that is named keeps others from receiving, in the late bins too.
TEST_P(AnyBin, AnotherReceiverThanTheNamedOneReceivesNothing) {
    if (GetParam() == By::Planar) return; // names none here
    EXPECT_TRUE(isRightWith([](Scene& scene) { scene.root->addChild(pane(1.0f, true)); }, false));
}

/// The ground's alpha, by a texture or by its vertices, is a half or more to the right of some column: there it receives, and to
/// the left the background shines through more than the ground.
TEST_P(AnyBin, WhatIsClearInPartsReceivesWhereItHidesMoreThanItShows) {
    for (const bool byTexture : {true, false}) {
        const Trial trial = houseTrial();
        const Change change = [byTexture](Scene& scene) {
            osg::Node& ground = *find(*scene.root, "ground");
            osg::Geometry& geometry = *ground.asGeode()->getDrawable(0)->asGeometry();
            osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
            for (const osg::Vec3& vertex : *static_cast<osg::Vec3Array*>(geometry.getVertexArray()))
                colors->push_back({1.0f, 1.0f, 1.0f, byTexture || vertex.x() > 0.0f ? 1.0f : 0.2f});
            geometry.setColorArray(colors, osg::Array::BIND_PER_VERTEX);
            if (byTexture) show(*halves(100, 255), ground);
            osg::ref_ptr<osg::Material> material = new osg::Material;
            material->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
            ground.getOrCreateStateSet()->setAttributeAndModes(material);
            blendLate(ground);
        };
        Scene shadowed = trial.buildWithShadow();
        change(shadowed);
        Truth truth = truthOf(trial, change);
        const double first = byTexture ? 0.0 : -8.0 + 16.0 * (0.5 - 0.2) / (1.0 - 0.2); // x
        const auto columns = static_cast<int>(std::ceil((first / 8.0 + 0.5) * truth.lit.width - 0.5));
        for (int y = 0; y < truth.lit.height; ++y)
            for (int x = 0; x < columns; ++x) {
                const auto at = static_cast<std::size_t>(y * truth.lit.width + x);
                truth.dark.pixels[at] = truth.lit.pixels[at];
            }
        EXPECT_TRUE(shows(render(shadowed.root, trial.view), truth)) << byTexture;
    }
}

/// The half of the ground with the alpha of 1 receives, the other half lets the background shine through.
TEST_P(AnyBin, ATextureWhosePixelsAreAllThereOrClearReceivesWhereTheyAreThere) {
    const Trial trial = houseTrial();
    const Change change = [](Scene& scene) {
        osg::Node& ground = *find(*scene.root, "ground");
        show(*halves(0, 255), ground);
        blendLate(ground);
    };
    Scene shadowed = trial.buildWithShadow();
    change(shadowed);
    Truth truth = truthOf(trial, change);
    for (int y = 0; y < truth.lit.height; ++y)
        for (int x = 0; x < truth.lit.width / 2; ++x) {
            const auto at = static_cast<std::size_t>(y * truth.lit.width + x);
            truth.dark.pixels[at] = truth.lit.pixels[at];
        }
    EXPECT_TRUE(shows(render(shadowed.root, trial.view), truth));
}

TEST_P(AnyBin, ATextureReceivesUntilItIsPaintedClear) {
    const Trial trial = houseTrial();
    const osg::ref_ptr<osg::Texture2D> texture = halves(255, 255);
    const auto build = [&] {
        Scene scene = trial.build();
        osg::Node& ground = *find(*scene.root, "ground");
        show(*texture, ground);
        blendLate(ground);
        return scene;
    };
    Scene lit = build(), shadowed = build();
    shadowed.addShadow(castingTechnique(find(*shadowed.root, "ground")));
    Camera camera(shadowed.root, trial.view);
    EXPECT_FALSE(same(camera.frame(), render(lit.root, trial.view)));
    for (const int alpha : {3, 7}) texture->getImage()->data()[alpha] = 100;
    texture->getImage()->dirty();
    EXPECT_TRUE(same(camera.frame(), render(lit.root, trial.view)));
}

TEST_P(AnyBin, ASceneThatWritesNoDepthIsNamedAsTheCause) {
    const Trial trial = houseTrial();
    Scene scene = trial.build();
    const auto technique = castingTechnique(GetParam() == By::Hull ? find(*scene.root, "ground") : nullptr);
    scene.addShadow(technique);
    scene.content->getOrCreateStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
    Camera camera(scene.root, trial.view);
    camera.frame();
    ASSERT_EQ(technique->diagnose().size(), 1u);
    EXPECT_NE(technique->diagnose()[0].find("no receiver in this view writes depth"), std::string::npos)
        << technique->diagnose()[0];
    scene.content->getStateSet()->removeMode(GL_DEPTH_TEST);
    camera.frame();
    EXPECT_TRUE(technique->diagnose().empty());
}
