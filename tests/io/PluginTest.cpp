// SPDX-License-Identifier: MIT
// A program that knows nothing of Gnomon, as osgviewer and osgconv do not: it links osgDB alone.
#include <gtest/gtest.h>

#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

TEST(Plugin, IsFoundByProgramsThatKnowNothingOfGnomon) {
    setenv("OSG_LIBRARY_PATH", GNOMON_LIBRARIES, 1); // as a user would
    osgDB::Registry::instance()->initLibraryFilePathList();
    const std::string folder = testing::TempDir() + "gnomon_plugin_test";
    std::filesystem::create_directories(folder);
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
    std::filesystem::remove_all(folder);
}

} // namespace
