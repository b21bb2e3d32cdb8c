// SPDX-License-Identifier: MIT
// A program that knows nothing of Gnomon, as osgviewer and osgconv do not: it links osgDB alone.
#include <gtest/gtest.h>

#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

class Plugin : public testing::Test {
protected:
    Plugin() {
        setenv("OSG_LIBRARY_PATH", GNOMON_LIBRARIES, 1); // as a user would
        osgDB::Registry::instance()->initLibraryFilePathList();
        std::filesystem::create_directories(folder);
    }
    ~Plugin() override { std::filesystem::remove_all(folder); }

    const std::string folder = testing::TempDir() + "gnomon_plugin_test";
};

/// The same with a suffix on the name.
class Suffix : public Plugin {
protected:
    Suffix() {
        std::ofstream(folder + "/box.osgt")
            << "#Ascii Scene\n#Version 161\n#Generator by hand\nosg::Geode { UniqueID 1 Drawables 1 {\n"
               "  osg::ShapeDrawable { UniqueID 2 Shape TRUE { osg::Box { UniqueID 3 } } } } }\n";
    }
    osgDB::ReaderWriter::ReadResult read(const std::string& suffix) const {
        return osgDB::Registry::instance()->readNode(folder + "/box" + suffix, nullptr);
    }
    /// Class and name of a group's child.
    static std::string child(osg::Node& group, unsigned number) {
        const osg::Node& node = *group.asGroup()->getChild(number);
        return std::string(node.className()) + " " + node.getName();
    }
};

TEST_F(Plugin, IsFoundByProgramsThatKnowNothingOfGnomon) {
    std::ofstream(folder + "/scene.osgt") << "#Ascii Scene\n#Version 161\n#Generator by hand\n"
                                             "gnomon::ShadowCasterGroup { UniqueID 1 Children 1 {\n"
                                             "  gnomon::PlanarShadowNode { UniqueID 2 Planes 1 { 0 0 1 0.1 } } } }\n";
    const osg::ref_ptr<osg::Node> scene = osgDB::readRefNodeFile(folder + "/scene.osgt");
    ASSERT_TRUE(scene);
    EXPECT_STREQ(scene->className(), "ShadowCasterGroup");
    EXPECT_STREQ(scene->asGroup()->getChild(0)->className(), "PlanarShadowNode");
    for (const char* kind : {"osgb", "osgx", "osgt"}) {
        const std::string copy = folder + "/copy." + kind;
        EXPECT_TRUE(osgDB::writeNodeFile(*scene, copy)) << kind;
        const osg::ref_ptr<osg::Node> again = osgDB::readRefNodeFile(copy);
        ASSERT_TRUE(again) << kind;
        EXPECT_STREQ(again->asGroup()->getChild(0)->className(), "PlanarShadowNode") << kind;
    }
    std::ifstream text(folder + "/copy.osgt");
    EXPECT_NE(std::string(std::istreambuf_iterator<char>(text), {}).find("0 0 1 0.1 \n"), std::string::npos);
}

TEST_F(Suffix, AddsTechniquesInEitherSpelling) {
    for (const char* suffix :
         {".osgt.(map:edges=soft,sun-angle=0.5).gnomon", ".osgt.map:edges=soft,sun-angle=0.5.gnomon",
          ".osgt.(map:edges=soft;sun-angle=0.5).GNOMON", ".osgt.nosun+map:edges=soft,sun-angle=0.5.gnomon"}) {
        const osg::ref_ptr<osg::Node> scene = read(suffix).takeNode();
        ASSERT_TRUE(scene) << suffix;
        EXPECT_STREQ(scene->className(), "ShadowCasterGroup");
        EXPECT_EQ(child(*scene, 0), "Geode ") << suffix;
        EXPECT_EQ(child(*scene, 1), "ShadowMapTechnique map:edges=soft,sun-angle=0.5") << suffix;
    }
}

TEST_F(Suffix, IsAutoWhereNoTechniqueIsNamed) {
    for (const char* suffix : {".osgt.gnomon", ".osgt.().gnomon"}) {
        const osg::ref_ptr<osg::Node> scene = read(suffix).takeNode();
        ASSERT_TRUE(scene) << suffix;
        EXPECT_EQ(child(*scene, 1), "AutoShadowTechnique auto") << suffix;
    }
}

TEST_F(Suffix, GoesTogetherWithOthers) {
    const osg::ref_ptr<osg::Node> scene = read(".osgt.2,2,2.scale.(traced).gnomon.30,0,0.rot").takeNode();
    ASSERT_TRUE(scene);
    EXPECT_EQ(child(*scene, 0), "ShadowCasterGroup ");
    EXPECT_NEAR(scene->getBound().radius(), 2.0 * std::sqrt(3.0) / 2.0, 1e-5) << "twice a box of half sides 0.5";
}

TEST_F(Suffix, HandsOptionsOn) {
    std::ofstream(folder + "/far.obj") << "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n";
    const osg::ref_ptr<osgDB::Options> options = new osgDB::Options("noRotation");
    const osg::ref_ptr<osg::Node> scene =
        osgDB::Registry::instance()->readNode(folder + "/far.obj.(map).gnomon", options).takeNode();
    ASSERT_TRUE(scene);
    EXPECT_NEAR(scene->getBound().center().z(), 1.0, 1e-6) << "without it y becomes z";
}

TEST_F(Suffix, SaysWhatIsWrongWithIt) {
    const auto message = [&](const std::string& suffix) { return read(suffix).message(); };
    EXPECT_EQ(message(".osgt.(map+sun:elevation=95).gnomon"),
              "gnomon: elevation=95 cannot be used. Allowed: -90 to 90.");
    EXPECT_EQ(message(".osgt.(planar:receiver=floor).gnomon"),
              "gnomon: no node is named \"floor\" to receive the shadow. Names in the scene: none.");
    EXPECT_EQ(message(".nix.(map).gnomon"),
              "gnomon: the file \"" + folder + "/box.nix\" cannot be read. Check its name and its type.");
    for (const char* suffix : {".osgt.(map.gnomon", ".osgt.map).gnomon"})
        EXPECT_EQ(message(suffix).find("gnomon: its brackets do not match. Write FILE.(map).gnomon"), 0u) << suffix;
}

} // namespace
