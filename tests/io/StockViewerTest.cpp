// SPDX-License-Identifier: MIT
// The osgviewer that OpenSceneGraph's package brings: it knows nothing of Gnomon, and shows a scene file's shadows.
#include "Desktop.h"
#include "Program.h"
#include "SceneText.h"

#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>
#include <osg/MatrixTransform>
#include <support/Scene.h>

#include <algorithm>

namespace {

using namespace gnomon::testing;

/// A ground from -8 to 8 with a box upon it, under a sun at 45°, traced.
struct Lab {
    Lab() {
        scene.addShadow(technique);
        scene.light->getLight()->setLightNum(1); // number 0 is the viewer's own, at the eye
        scene.root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
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

/// Of a grey pixel; 0 for the background, which is blue.
int level(std::uint32_t c) { return (c & 255u) == c >> 16 ? int(c & 255u) : 0; }

class StockViewer : public testing::Test {
protected:
    StockViewer() { test::usePluginsOfThisBuild(); }
    void write(const Lab& lab) { folder.write("scene.osgt", test::written(*upright(lab), "osgt")); }

    /// Opens its window on the scene, and waits for the ground.
    Screenshot shown(const Lab& lab) {
        write(lab);
        program = std::make_unique<ChildProcess>(std::vector<std::string>{OSGVIEWER, "scene.osgt"}, folder.path(),
                                                 std::vector<std::string>{"DISPLAY=" + desktop->name(),
                                                                          "OSG_WINDOW=50 50 320 240",
                                                                          "OSG_LIBRARY_PATH=" GNOMON_LIBRARIES});
        desktop->useWindow("");
        const auto isLit = [](std::uint32_t c) { return level(c) > 100; };
        return desktop->pictureWhere("the ground is lit", [&](const Screenshot& p) {
            return std::any_of(p.pixels.begin(), p.pixels.end(), isLit);
        });
    }

    /// What it says about a scene in 20 frames.
    std::string said(const Lab& lab, const std::string& environment = "") {
        write(lab);
        const std::string command = environment + " DISPLAY=" + desktop->name() +
                                    " OSG_WINDOW='50 50 320 240' OSG_LIBRARY_PATH=" GNOMON_LIBRARIES
                                    " OSG_RUN_FRAME_COUNT=20 " OSGVIEWER " scene.osgt";
        return runProgram("sh", {"-c", command}, folder.path()).err;
    }

    TemporaryFolder folder;
    std::unique_ptr<Desktop> desktop = std::make_unique<Desktop>(folder.path());
    std::unique_ptr<ChildProcess> program;
};

} // namespace

TEST_F(StockViewer, DISABLED_ShowsTheShadowsOfASceneFileWithoutAnyOption) {
    Lab lab;
    lab.technique->setNodeMask(0);
    const Screenshot none = shown(lab);
    program = nullptr;
    desktop = std::make_unique<Desktop>(folder.path()); // without the first window
    lab.technique->setNodeMask(~0u);
    const Screenshot with = shown(lab);
    int shadowed = 0, other = 0;
    for (std::size_t i = 0; i < with.pixels.size(); ++i) {
        const bool fell = level(none.pixels[i]) - level(with.pixels[i]) > 30;
        shadowed += fell;
        other += !fell && with.pixels[i] != none.pixels[i];
    }
    EXPECT_GT(shadowed, 500);
    EXPECT_LT(other, shadowed / 20) << "nothing becomes lighter";
}

TEST_F(StockViewer, SaysOnceWhatIsMissing) {
    Lab lab;
    EXPECT_EQ(said(lab), "");
    lab.scene.light->getLight()->setLightNum(9);
    lab.scene.group->addLight(lab.scene.light);
    const std::string err = said(lab);
    const std::string cause = "light 9 is left out";
    const std::size_t first = err.find(cause);
    EXPECT_NE(first, std::string::npos) << err;
    EXPECT_EQ(err.find(cause, first + 1), std::string::npos) << err;
}
