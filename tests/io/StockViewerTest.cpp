// SPDX-License-Identifier: MIT
// The osgviewer that OpenSceneGraph's package brings: it knows nothing of Gnomon, and shows a scene file's shadows.
#include "Desktop.h"
#include "Program.h"
#include "SceneText.h"

#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/ProxyNode>
#include <support/Scene.h>

#include <algorithm>
#include <cmath>
#include <thread>

namespace {

using namespace gnomon::testing;

constexpr double dim = 0.3; ///< the material's diffuse, by which sun and headlight together stay below white

/// A ground from -8 to 8 with a box of side 2 upon it, under a sun at 45°, traced.
struct Lab {
    explicit Lab(bool withShadow = true) {
        if (withShadow) scene.addShadow(technique);
        scene.light->getLight()->setLightNum(1); // number 0 is the viewer's headlight
        osg::StateSet& state = *scene.root->getOrCreateStateSet();
        state.setMode(GL_LIGHT1, osg::StateAttribute::ON);
        auto& material = dynamic_cast<osg::Material&>(*state.getAttribute(osg::StateAttribute::MATERIAL));
        material.setDiffuse(osg::Material::FRONT_AND_BACK, {float(dim), float(dim), float(dim), 1.0f});
    }

    test::Scene scene = test::groundScene({test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0})});
    osg::ref_ptr<gnomon::TracedShadowTechnique> technique = new gnomon::TracedShadowTechnique;
};

/// The ground faces -y, where osgviewer's camera stands.
osg::ref_ptr<osg::Node> upright(const Lab& lab) {
    osg::ref_ptr<osg::MatrixTransform> turn = new osg::MatrixTransform(osg::Matrixd::rotate(osg::PI_2, osg::X_AXIS));
    turn->addChild(lab.scene.root);
    return turn;
}

/// A file of which the viewer knows only the size when it makes its window.
osg::ref_ptr<osg::Node> loadedLater(const std::string& file) {
    osg::ref_ptr<osg::ProxyNode> later = new osg::ProxyNode;
    later->setFileName(0, file);
    later->setLoadingExternalReferenceMode(osg::ProxyNode::DEFER_LOADING_TO_DATABASE_PAGER);
    later->setCenterMode(osg::ProxyNode::USER_DEFINED_CENTER);
    later->setRadius(12.0);
    return later;
}

/// The ground's colour: ambient light, the headlight's 0.8, and the sun's share.
std::uint32_t ground(double sun) {
    const auto grey = std::uint32_t(std::lround(255.0 * (0.4 + dim * (0.8 + sun))));
    return grey << 16 | grey << 8 | grey;
}
const std::uint32_t lit = ground(0.7 * std::sqrt(0.5)), shadowed = ground(0.0);

long count(const Screenshot& picture, std::uint32_t colour) {
    return std::count(picture.pixels.begin(), picture.pixels.end(), colour);
}

class StockViewer : public testing::Test {
protected:
    StockViewer() { test::usePluginsOfThisBuild(); }
    void write(const Lab& lab) { folder.write("scene.osgt", test::written(*upright(lab), "osgt")); }

    /// Opens its window on a file, with all that it says in "said".
    void open(const std::string& file) {
        const std::string command = "exec " OSGVIEWER " " + file + " 2>said";
        program = std::make_unique<ChildProcess>(std::vector<std::string>{"sh", "-c", command}, folder.path(),
                                                 std::vector<std::string>{"DISPLAY=" + desktop.name(),
                                                                          "OSG_WINDOW=50 50 320 240",
                                                                          "OSG_LIBRARY_PATH=" GNOMON_LIBRARIES});
        desktop.useWindow("");
    }

    Screenshot pictureOfGround() {
        return desktop.pictureWhere("the ground is lit", [](const Screenshot& p) { return count(p, lit) > 0; });
    }

    /// How often it says so, within the second after it does first.
    int timesSaid(const std::string& cause) {
        const auto times = [&] {
            const std::string text = readFile(folder.path() / "said");
            int found = 0;
            for (auto at = text.find(cause); at != std::string::npos; at = text.find(cause, at + 1)) ++found;
            return found;
        };
        waitFor(std::chrono::seconds(10), [&] { return times() > 0; });
        std::this_thread::sleep_for(std::chrono::seconds(1)); // many frames
        return times();
    }

    TemporaryFolder folder;
    Desktop desktop{folder.path()};
    std::unique_ptr<ChildProcess> program;
};

} // namespace

TEST_F(StockViewer, ShowsTheShadowsOfASceneFileWithoutAnyOption) {
    write(Lab());
    open("scene.osgt");
    const Screenshot picture = pictureOfGround();
    const long seen = count(picture, lit) + count(picture, shadowed);
    // Of the ground's 16 × 16, the shadow takes 2 × 2 beside the box.
    EXPECT_NEAR(double(count(picture, shadowed)), double(seen) / 64.0, double(seen) / 640.0);
    EXPECT_EQ(seen + count(picture, picture.at(0, 0)), long(picture.pixels.size())) << "there is no third colour";
    for (int y = 0; y < picture.height; ++y)
        for (int x = picture.width / 2; x < picture.width; ++x)
            ASSERT_NE(picture.at(x, y), shadowed) << "towards the sun, at " << x << ", " << y;
    EXPECT_EQ(readFile(folder.path() / "said"), "");
}

TEST_F(StockViewer, ShowsTheSameShadowsOfAFileThatHasNoneByASuffixOnItsName) {
    write(Lab());
    open("scene.osgt");
    const Screenshot byFile = pictureOfGround();
    program.reset();
    write(Lab(false));
    open("'scene.osgt.(traced).gnomon'");
    EXPECT_EQ(count(pictureOfGround(), shadowed), count(byFile, shadowed));
    EXPECT_EQ(readFile(folder.path() / "said"), "");
}

TEST_F(StockViewer, SaysOnceWhatIsMissing) {
    Lab lab;
    lab.scene.light->getLight()->setLightNum(9);
    lab.scene.group->addLight(lab.scene.light);
    write(lab);
    open("scene.osgt");
    EXPECT_EQ(timesSaid("light 9 is left out"), 1);
}

TEST_F(StockViewer, ShowsTheShadowsOfWhatIsLoadedLaterInAWindowWithoutStencil) {
    write(Lab());
    folder.write("later.osgt", test::written(*loadedLater("scene.osgt"), "osgt"));
    open("later.osgt");
    EXPECT_GT(count(pictureOfGround(), shadowed), 0);
    EXPECT_EQ(readFile(folder.path() / "said"), "");
}

TEST_F(StockViewer, GivesAWindowStencilForWhatIsLoadedLaterIfTheFirstFileHasAGroup) {
    write(Lab());
    osg::ref_ptr<osg::Group> both = new osg::Group;
    both->addChild(new gnomon::ShadowCasterGroup);
    both->addChild(loadedLater("scene.osgt"));
    folder.write("later.osgt", test::written(*both, "osgt"));
    open("later.osgt");
    EXPECT_GT(count(pictureOfGround(), shadowed), 0);
}
