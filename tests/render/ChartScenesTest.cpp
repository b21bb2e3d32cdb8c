// SPDX-License-Identifier: MIT
// The chart's scenes: each can be judged, has light and shadow, and is drawn as well as one ray a pixel can be.
#include <ChartScene.h>
#include <InputFile.h>
#include <SceneLights.h>
#include <SceneTruth.h>
#include <support/Picture.h>
#include <support/Scene.h>
#include <support/Truth.h>

#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <metrics/PixelSets.h>
#include <osg/ComputeBoundsVisitor>
#include <osg/Material>
#include <osg/MatrixTransform>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <optional>

using gnomon::examples::ChartScene;
using gnomon::examples::SceneTruth;
using gnomon::metrics::TruthMaps;

namespace {

constexpr int width = 640, height = 480;

/// A technique's picture beside the truth. Edges are not counted.
struct Judgement : test::TruthComparison {
    double dropped = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Judgement& j) {
    return out << j.pixels << " px, " << j.shadowed << " shadowed, wrong " << j.wrong << ", floor " << j.floor
               << ", certain " << j.certain << ", neither " << j.neither << ", " << 100.0 * j.dropped << " % dropped";
}

/// White and without textures, so that lit and shadowed pixels differ.
void whiten(osg::Node& model) {
    osg::StateSet& state = *model.getOrCreateStateSet();
    osg::ref_ptr<osg::Material> white = new osg::Material;
    white->setAmbient(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 1.0f});
    white->setDiffuse(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 1.0f});
    white->setSpecular(osg::Material::FRONT_AND_BACK, {0.0f, 0.0f, 0.0f, 1.0f});
    const auto forced = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;
    state.setAttributeAndModes(white, forced);
    state.setMode(GL_LIGHTING, forced);
    state.setMode(GL_NORMALIZE, forced);
    state.setTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
}

/// Pixels that are neither lit nor dark.
int neitherIn(const test::Picture& actual, const test::Picture& lit, const test::Picture& dark) {
    int count = 0;
    for (std::size_t i = 0; i < actual.pixels.size(); ++i)
        count += actual.pixels[i] != lit.pixels[i] && actual.pixels[i] != dark.pixels[i];
    return count;
}

gnomon::metrics::Picture visibility(const test::Picture& actual, const test::Picture& lit, const test::Picture& dark) {
    gnomon::metrics::Picture result(actual.width, actual.height, std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; i < actual.pixels.size(); ++i)
        if (lit.pixels[i] != dark.pixels[i] &&
            (actual.pixels[i] == lit.pixels[i] || actual.pixels[i] == dark.pixels[i]))
            result.cells[i] = actual.pixels[i] == lit.pixels[i] ? 1.0 : 0.0;
    return result;
}

/// True if the light that arrives differs in a pixel and the eight about it, or between the truth's rays: thin wires.
bool nearEdge(const TruthMaps& truth, std::size_t pixel) {
    const int x = static_cast<int>(pixel) % truth.lit.width, y = static_cast<int>(pixel) / truth.lit.width;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, truth.lit.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, truth.lit.width - 1); ++u)
            if (truth.lit.at(u, v) != truth.lit.at(x, y)) return true;
    return truth.lit.at(x, y) != truth.litCentre.at(x, y);
}

/// @param level  height of the only points that count, in the truth's frame; none: all count.
Judgement judge(const gnomon::metrics::Picture& visibility, const TruthMaps& truth, std::optional<double> level) {
    const gnomon::metrics::PixelSets sets = gnomon::metrics::pixelSets(truth, visibility);
    Judgement result;
    result.dropped = sets.droppedShare;
    const double close = 1e-6 * std::max(1.0, std::abs(level.value_or(0.0))); // heights are floats: 6e-8 of their size
    for (std::size_t i = 0; i < visibility.cells.size(); ++i) {
        if (!sets.facing.cells[i] || (level && std::abs(truth.position.cells[i].z - *level) > close)) continue;
        const bool lit = truth.lit.cells[i] >= 0.5;
        ++result.pixels;
        result.shadowed += !lit;
        const bool wrong = (visibility.cells[i] == 1.0) != lit;
        result.wrong += wrong;
        result.certain += wrong && !nearEdge(truth, i);
        result.floor += (truth.litCentre.cells[i] != 0) != lit;
    }
    return result;
}

/// What the scene looks like with a technique, without, and without the light's diffuse and specular.
test::Picture picture(const ChartScene& scene, gnomon::ShadowTechnique* technique, bool dark = false) {
    test::Scene staged = test::scene({0.0, 0.0, 1.0, 0.0});
    osg::ref_ptr<osg::MatrixTransform> mount = new osg::MatrixTransform;
    gnomon::examples::standLight(*mount, *staged.light->getLight(), scene.light);
    mount->addChild(staged.light);
    staged.root->removeChild(staged.light);
    staged.root->addChild(mount);
    staged.content->addChild(scene.content);
    if (dark) staged.takeLightAway();
    if (technique) {
        staged.addShadow(technique);
        staged.group->addLight({0, scene.light});
        staged.group->setTerminatorOffset(false); // the truth is that of facets
    }
    return test::render(staged.root,
                        {scene.camera.width, scene.camera.height, scene.camera.view, scene.camera.projection});
}

/// World height of the flat ground.
double groundHeight(const ChartScene& scene) {
    osg::Node& ground = *test::find(*scene.content, scene.receiver);
    osg::ComputeBoundsVisitor bounds;
    ground.accept(bounds); // with its own transform
    osg::NodePath above = ground.getParentalNodePaths(scene.content).front();
    above.pop_back();
    return (osg::Vec3d(bounds.getBoundingBox().corner(0)) * osg::computeLocalToWorld(above)).z();
}

/// 7,172 triangles with 24 edges that more than two share.
ChartScene horse() {
    gnomon::examples::ViewOptions options;
    options.width = width;
    options.height = height;
    const osg::ref_ptr<osg::Node> model =
        gnomon::examples::readScene({"/usr/share/glmark2/models/horse.3ds"}, "the test");
    ChartScene scene = gnomon::examples::chartSceneOf(*model, options);
    scene.receiver.clear();
    return scene;
}

ChartScene whitened(const std::string& name) {
    ChartScene scene = name == "horse" ? horse() : gnomon::examples::chartScene(name, width, height);
    whiten(*scene.content);
    return scene;
}

class ChartScenes : public testing::TestWithParam<std::string> {
protected:
    ChartScenes()
        : scene(whitened(GetParam())),
          truth(*scene.content),
          lit(picture(scene, nullptr)),
          dark(picture(scene, nullptr, true)),
          maps(truth.maps(scene.camera, scene.light)) {}

    Judgement judged(gnomon::ShadowTechnique* technique, std::optional<double> level = std::nullopt) const {
        const test::Picture actual = picture(scene, technique);
        Judgement result = judge(visibility(actual, lit, dark), maps, level);
        result.neither = neitherIn(actual, lit, dark);
        return result;
    }

    void judgeTraced() const {
        const Judgement traced = judged(new gnomon::TracedShadowTechnique);
        std::cout << "traced " << traced << "\n";
        EXPECT_TRUE(traced.good()) << traced;
        EXPECT_LT(traced.dropped, 0.05) << "else the scene is not to be judged";
        EXPECT_GT(traced.pixels, 50000);
        EXPECT_GT(double(traced.shadowed), 0.02 * double(traced.pixels));
        EXPECT_LT(double(traced.shadowed), 0.9 * double(traced.pixels));
    }

    /// Depths of 24 bits decide beside edges of surfaces that the light grazes: their steps are 0.2 m at 5 km in the
    /// mountains, and 0.2 mm in the room, whose near planes are at 1/2000 of the far ones.
    void judgeVolume() const {
        const int wrongByDepth = scene.name == "mountains-10" ? 20 : 0;
        const int certainByDepth = scene.name == "mountains-10" ? 12 : scene.name == "room" ? 4 : 0;
        const Judgement volume = judged(new gnomon::ShadowVolumeTechnique);
        std::cout << "volume " << volume << "\n";
        EXPECT_LE(volume.wrong, 1.10 * volume.floor + 5 + wrongByDepth) << volume;
        EXPECT_LE(volume.certain, certainByDepth) << volume;
        EXPECT_EQ(volume.neither, 0) << volume;
    }

    void judgePlanar() const {
        if (scene.receiver.empty()) return; // hills and mountains
        const osg::ref_ptr<gnomon::PlanarShadowNode> node = test::planar(test::find(*scene.content, scene.receiver));
        node->setPlanes({osg::Vec4d(0.0, 0.0, 1.0, -groundHeight(scene))});
        const Judgement planar = judged(node, groundHeight(scene) - truth.origin().z());
        std::cout << "planar " << planar << "\n";
        EXPECT_TRUE(planar.good()) << planar;
        EXPECT_GT(planar.shadowed, 2000);
    }

    ChartScene scene;
    SceneTruth truth;
    test::Picture lit, dark;
    TruthMaps maps;
};

/// One test a scene, for its rays take longer than all pictures.
TEST_P(ChartScenes, AreDrawnAsWellAsOneRayAPixelCanBe) {
    judgeTraced();
    judgeVolume();
    judgePlanar();
}

std::vector<std::string> sceneNames() {
    std::vector<std::string> names = gnomon::examples::chartSceneNames();
    names.push_back("horse");
    return names;
}

INSTANTIATE_TEST_SUITE_P(All, ChartScenes, testing::ValuesIn(sceneNames()), [](const auto& each) {
    std::string name = each.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

/// What is before this near plane is not seen in any of them.
ChartScene withNearPlaneAt(double share, ChartScene scene) {
    double fovy = 0.0, aspect = 0.0, near = 0.0, far = 0.0;
    scene.camera.projection.getPerspective(fovy, aspect, near, far);
    scene.camera.projection.makePerspective(fovy, aspect, share * far, far);
    return scene;
}

/// The same views with depths in finer steps: what judgeVolume() allows for is theirs, and not the volumes'.
TEST(ChartScenesOfFineDepths, AreDrawnByVolumesAsWellAsOneRayAPixelCanBe) {
    for (const std::string name : {"mountains-10", "room"}) {
        const ChartScene scene = withNearPlaneAt(0.01, whitened(name));
        SceneTruth truth(*scene.content);
        const test::Picture lit = picture(scene, nullptr), dark = picture(scene, nullptr, true);
        const TruthMaps maps = truth.maps(scene.camera, scene.light);
        const test::Picture actual = picture(scene, new gnomon::ShadowVolumeTechnique);
        const Judgement volume = judge(visibility(actual, lit, dark), maps, std::nullopt);
        std::cout << name << " " << volume << "\n";
        EXPECT_LE(volume.wrong, 1.10 * volume.floor + 5) << name << ": " << volume;
        EXPECT_EQ(volume.certain, 0) << name << ": " << volume;
    }
}

TEST(ChartScene, ANameThatIsNotThereIsRefusedWithThoseThatAre) {
    try {
        gnomon::examples::chartScene("moon", 8, 8);
        FAIL();
    } catch (const std::invalid_argument& refusal) {
        EXPECT_EQ(std::string(refusal.what()).substr(0, 45), "no scene is named \"moon\". Allowed: lab8-45 la");
    }
}

TEST(ChartScene, TheCameraAndTheLightMoveAboutWhatIsLookedAt) {
    const ChartScene scene = gnomon::examples::chartScene("room", 64, 48);
    const gnomon::examples::SceneCamera turned = gnomon::examples::movedCamera(scene, 90.0);
    const osg::Vec3d eye = osg::Vec3d() * osg::Matrixd::inverse(scene.camera.view), c = scene.center;
    const osg::Vec3d expected(c.x() - (eye.y() - c.y()), c.y() + (eye.x() - c.x()), eye.z());
    EXPECT_LT((osg::Vec3d() * osg::Matrixd::inverse(turned.view) - expected).length(), 1e-9);
    const osg::Vec4d light = gnomon::examples::movedLight(scene, 180.0);
    EXPECT_LT((light - osg::Vec4d(2.0 * c.x() - 0.1, 2.0 * c.y() - 0.3, 1.25, 1.0)).length(), 1e-9);
    EXPECT_EQ(gnomon::examples::movedCamera(scene, 0.0).projection, scene.camera.projection);
}

} // namespace
