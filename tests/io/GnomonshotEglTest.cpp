// SPDX-License-Identifier: MIT
// gnomonshot_egl draws what gnomonshot draws.
#include "Program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <osg/Image>
#include <osgDB/ReadFile>

#include <algorithm>

namespace {

using namespace gnomon::testing;

struct Shot {
    osg::ref_ptr<osg::Image> picture;
    std::string renderer;
};

Shot shoot(const std::string& program, const std::vector<std::string>& options) {
    const TemporaryFolder folder;
    std::vector<std::string> arguments = {
        GNOMON_DATA "/lab8.osgt", "--size", "320x240", "--out", "o.png", "--frames", "1", "--stats", "s.json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Ending ending = runProgram(program, arguments, folder.path());
    if (ending.status != 0) throw std::runtime_error(ending.err);
    return {osgDB::readRefImageFile((folder.path() / "o.png").string()),
            nlohmann::json::parse(readFile(folder.path() / "s.json"))["renderer"]};
}

/// Pixels in which any channel differs by more than `steps` of 255.
long countDifferent(const osg::Image& a, const osg::Image& b, int steps) {
    EXPECT_TRUE(a.s() == b.s() && a.t() == b.t());
    long count = 0;
    for (int y = 0; y < a.t(); ++y)
        for (int x = 0; x < a.s(); ++x) {
            int most = 0;
            for (unsigned i = 0; i < 3; ++i)
                most = std::max(most, int(std::lround(255.0f * std::abs(a.getColor(x, y)[i] - b.getColor(x, y)[i]))));
            count += most > steps;
        }
    return count;
}

class GnomonshotEgl : public testing::TestWithParam<std::vector<std::string>> {};
INSTANTIATE_TEST_SUITE_P(Shadows, GnomonshotEgl,
                         testing::Values(std::vector<std::string>{"--shadow", "none"},
                                         std::vector<std::string>{"--shadow", "planar"},
                                         std::vector<std::string>{"--shadow", "traced"},
                                         std::vector<std::string>{"--shadow", "traced:composite=blend"},
                                         std::vector<std::string>{"--shadow", "planar:composite=blend,dark=0.4"}));

/// Mesa draws both with the same rasteriser: no pixel may differ. Another renderer rounds colours and places edges by
/// its own rules, which OpenGL allows: a step or two of 255, and single pixels along the edges.
TEST_P(GnomonshotEgl, DrawsThePictureOfGnomonshot) {
    const Shot memory = shoot(GNOMONSHOT, GetParam()), egl = shoot(GNOMONSHOT_EGL, GetParam());
    ASSERT_TRUE(memory.picture && egl.picture);
    if (memory.renderer == egl.renderer)
        EXPECT_EQ(countDifferent(*memory.picture, *egl.picture, 0), 0);
    else
        EXPECT_LT(countDifferent(*memory.picture, *egl.picture, 2), 320 * 240 / 100) << egl.renderer;
}

TEST(GnomonshotEgl, DrawsShadowsAtAll) {
    const Shot lit = shoot(GNOMONSHOT_EGL, {"--shadow", "none"});
    for (const char* technique : {"planar", "traced"})
        EXPECT_GT(countDifferent(*lit.picture, *shoot(GNOMONSHOT_EGL, {"--shadow", technique}).picture, 2), 100)
            << technique;
}

} // namespace
