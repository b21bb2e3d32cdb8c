// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>

namespace {

/// The file an #include line names, empty for any other line.
std::string included(std::string line) {
    line.erase(std::remove(line.begin(), line.end(), ' '), line.end());
    const bool include = line.rfind("#include<", 0) == 0 || line.rfind("#include\"", 0) == 0;
    return include ? line.substr(9) : std::string();
}

bool includesSceneGraphOrOpenGL(const std::string& line) {
    const std::string file = included(line);
    for (const char* start : {"osg", "OpenThreads", "GL/", "GLES", "EGL/", "KHR/"})
        if (file.rfind(start, 0) == 0) return true;
    return false;
}

int offendingLines(const std::filesystem::path& file) {
    std::ifstream stream(file);
    int count = 0;
    for (std::string line; std::getline(stream, line);) count += includesSceneGraphOrOpenGL(line);
    return count;
}

} // namespace

TEST(Architecture, TheMathsIncludesNeitherOpenSceneGraphNorOpenGL) {
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(GNOMON_SOURCE_DIR)) {
        if (!entry.is_regular_file()) continue;
        ++files;
        EXPECT_EQ(offendingLines(entry.path()), 0) << entry.path();
    }
    EXPECT_GE(files, 6); // Plane, PlanarShadow and ScreenBounds: else this has looked in the wrong place
}

TEST(Architecture, TheTestKnowsAnOffendingLineWhenItSeesOne) {
    EXPECT_TRUE(includesSceneGraphOrOpenGL("#include <osg/Matrixd>"));
    EXPECT_TRUE(includesSceneGraphOrOpenGL("  # include \"osgUtil/CullVisitor\""));
    EXPECT_TRUE(includesSceneGraphOrOpenGL("#include <GL/gl.h>"));
    EXPECT_TRUE(includesSceneGraphOrOpenGL("#include <EGL/egl.h>"));
    EXPECT_TRUE(includesSceneGraphOrOpenGL("#include <OpenThreads/Mutex>"));
    EXPECT_FALSE(includesSceneGraphOrOpenGL("#include <glm/vec3.hpp>"));
    EXPECT_FALSE(includesSceneGraphOrOpenGL("/// the same bytes as an osg::Matrixd"));
}
