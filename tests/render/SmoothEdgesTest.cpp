// SPDX-License-Identifier: MIT
// Edges below one sample of the techniques that are exact: the share of a pixel on their lit side, against closed forms and rays.
#include "IntoTexture.h"

#include <glm/geometric.hpp>
#include <gnomon/ShadowSpec.h>
#include <gtest/gtest.h>
#include <osg/LightSource>
#include <osg/Math>
#include <support/Oracle.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using test::Camera;
using test::Picture;
using test::Scene;
using test::View;

namespace {

constexpr int size = 256;
constexpr double half = 4.0, pixel = 2.0 * half / size;

/// Of a technique, with its greatest error of a share: of rays three in a pixel may be on the other side of a line.
struct Exact {
    const char* name;
    double most;
};
std::ostream& operator<<(std::ostream& out, const Exact& exact) { return out << exact.name; }

class SmoothEdges : public testing::TestWithParam<Exact> {
protected:
    Picture drawn(Scene scene, const char* edges, const test::View& view, bool blends = true) const {
        scene.addShadow(std::string(GetParam().name) + ":edges=" + edges +
                        (blends ? ",composite=blend,dark=0.25" : ""));
        return test::render(scene.root, view);
    }
};

double red(const Picture& picture, int x, int y) { return double(picture.at(x, y) & 0xffu); }

} // namespace

INSTANTIATE_TEST_SUITE_P(Of, SmoothEdges,
                         testing::Values(Exact{"planar", 0.01}, Exact{"hull", 0.01}, Exact{"volume", 0.01},
                                         Exact{"traced", 0.1}),
                         [](const auto& of) { return std::string(of.param.name); });

// A plate over one half of the ground, cut off at a slant, under a sun at 45 degrees: its shadow is cut off as the plate is, its
// height further on. How far a pixel is from there says how much of it is on the lit side. Colours are rounded to a 200th of a share.
TEST_P(SmoothEdges, PixelsHaveTheShareThatIsOnTheLitSide) {
    const double height = 1.0;
    for (const bool blends : {false, true})
        for (const double slant : {10.0, 25.0, 40.0, 65.0}) {
            const double dark = blends ? 0.25 : double(test::shadowedGround) / test::litGround;
            const double angle = osg::DegreesToRadians(slant);
            const glm::dvec3 along(-std::sin(angle), std::cos(angle), 0.0), across(along.y, -along.x, 0.0);
            const Picture picture = drawn(test::groundScene({test::quad(glm::dvec3(0.0, 0.0, height) - 40.0 * along,
                                                                        80.0 * along, -40.0 * across)},
                                                            60.0, {-1.0, 0.0, 1.0, 0.0}),
                                          "smooth", test::fromAbove(half), blends);
            double worst = 0.0;
            int between = 0;
            for (int y = 8; y < size - 8; ++y)
                for (int x = 8; x < size - 8; ++x) {
                    const glm::dvec3 place((x + 0.5) * pixel - half - height, (y + 0.5) * pixel - half, 0.0);
                    if (glm::dot(place, across) < -height * across.x) continue; // the plate itself
                    const double share = (red(picture, x, y) / test::litGround - dark) / (1.0 - dark);
                    const double due = test::coverage(across, glm::dot(place, across) / pixel);
                    worst = std::max(worst, std::abs(share - due));
                    between += due > 0.1 && due < 0.9;
                }
            std::cout << (blends ? "blend, " : "relight, ") << slant << " degrees: off by " << worst << " at most\n";
            EXPECT_GT(between, 100);
            EXPECT_LE(worst, GetParam().most + 0.01) << slant;
        }
}

// Boxes on a ground: of their own faces some are lit as a whole, and the others dark. What is seen before an edge, or beside it, has
// nothing of it: smooth edges change pixels only where all that is seen within one pixel is the ground, and its light ends.
TEST_P(SmoothEdges, NothingComesOfTheEdgesOfObjects) {
    std::vector<test::Mesh> boxes;
    for (int i = 0; i < 6; ++i)
        boxes.push_back(test::house({3.0 * (i % 3) - 3.0, 3.0 * (i / 3) - 1.5}, {0.8, 0.6, 1.0 + 0.2 * i}, 17.0 * i));
    const test::View view = test::perspective({7.0, -9.0, 6.0}, {0.0, 0.0, 0.4});
    const osg::Vec4d light(-1.0, 0.3, 1.2, 0.0);
    const auto scene = [&] { return test::groundScene(boxes, 8.0, light); };
    const test::Mask mask = test::castRays(test::square(8.0), boxes, light, view);
    const Picture hard = drawn(scene(), "hard", view), smooth = drawn(scene(), "smooth", view);
    int changed = 0, beside = 0;
    for (int y = 1; y < view.height - 1; ++y)
        for (int x = 1; x < view.width - 1; ++x) {
            if (hard.at(x, y) == smooth.at(x, y)) continue;
            ++changed;
            bool lit = false, dark = false;
            for (int v = y - 1; v <= y + 1; ++v)
                for (int u = x - 1; u <= x + 1; ++u) {
                    lit = lit || mask.at(u, v) == test::Seen::LitReceiver;
                    dark = dark || mask.at(u, v) == test::Seen::ShadowedReceiver;
                }
            const bool ground =
                mask.at(x, y) == test::Seen::LitReceiver || mask.at(x, y) == test::Seen::ShadowedReceiver;
            beside += !(ground && lit && dark);
        }
    EXPECT_GT(changed, 300);
    EXPECT_LE(beside, 1); // at a corner one ray's pixel is another face's than OpenGL's
}

// Alpha is what edges are found by.
TEST_P(SmoothEdges, AlphaIsAsItWas) {
    const auto scene = [] { return test::groundScene({test::house({0.0, 0.0}, {0.8, 0.6, 1.0}, 17.0)}, 3.0); };
    const test::View view = test::perspective({7.0, -9.0, 3.0}, {0.0, 0.0, 0.4});
    for (const bool blends : {false, true}) {
        const Picture plain = test::render(scene().root, view), smooth = drawn(scene(), "smooth", view, blends);
        int changed = 0;
        for (std::size_t i = 0; i < plain.pixels.size(); ++i)
            changed += (plain.pixels[i] & 0xff000000u) != (smooth.pixels[i] & 0xff000000u);
        EXPECT_EQ(changed, 0) << blends;
        EXPECT_GT(smooth.different(plain), 150);
    }
}

class SmoothEdgesOnAll : public SmoothEdges {};

INSTANTIATE_TEST_SUITE_P(Of, SmoothEdgesOnAll, testing::Values(Exact{"volume", 0.35}, Exact{"traced", 0.35}),
                         [](const auto& of) { return std::string(of.param.name); });

// A sample a pixel leaves edges off by up to half a pixel; 95 % of these are less off by a factor.
TEST_P(SmoothEdgesOnAll, AreNearerToRaysThanHardEdges) {
    for (const test::TracedCase& given : {test::labEight(), test::townOfHouses()}) {
        const test::Judge judge(given);
        const auto off = [&](const char* edges) {
            Scene scene = given.build();
            scene.addShadow(std::string(GetParam().name) + ":edges=" + edges);
            return judge.edgesOff(test::render(scene.root, given.view));
        };
        const double hard = off("hard"), smooth = off("smooth");
        std::cout << given.name << ": hard " << hard << " px, smooth " << smooth << " px\n";
        EXPECT_GT(hard, 0.3) << given.name;
        EXPECT_LE(smooth, GetParam().most * hard) << given.name;
    }
}

// What moves by parts of a pixel changes its edge as much: of hard edges pixels change at once.
TEST_P(SmoothEdges, MoveByPartsOfAPixel) {
    const auto shadowAt = [&](double x, const char* edges) {
        Scene scene = test::groundScene({test::quad({x, -1.5, 1.0}, {0.9, 0.31, 0.0}, {-0.4, 2.4, 0.0})}, 60.0,
                                        {-1.0, 0.0, 1.0, 0.0});
        const Picture picture = drawn(scene, edges, test::fromAbove(half));
        double dark = 0.0;
        for (int y = 0; y < size; ++y)
            for (int column = size / 2; column < size; ++column)
                dark += (1.0 - red(picture, column, y) / test::litGround) / 0.75;
        return dark;
    };
    double least = 1e9, most = 0.0;
    for (int step = 0; step < 8; ++step) {
        const double area = shadowAt(-0.3 + step * pixel / 8.0, "smooth");
        least = std::min(least, area);
        most = std::max(most, area);
    }
    std::cout << "an area of " << least << " to " << most << " pixels\n";
    EXPECT_GT(least, 1000.0);
    EXPECT_LT(most - least, 6.0); // an edge of 160 pixels, by a 30th of one
}

namespace {

const View slanted = test::perspective({-6.0, -9.0, 6.0}, {0.0, 0.5, 0.0}, 161, 121);

/// What is drawn how, with edges of one kind.
struct Several {
    const char* name;
    std::vector<std::string> specs;
    int lights = 1;
};
std::ostream& operator<<(std::ostream& out, const Several& several) { return out << several.name; }

Scene lit(int lights) {
    Scene scene =
        test::groundScene({test::house({0.0, 0.0}, {2.0, 1.5, 1.0}, 30.0), test::sphere({-1.5, 1.5, 1.0}, 0.7, 10)},
                          8.0, {1.0, 0.4, 1.2, 0.0});
    if (lights > 1) scene.addSecondLight();
    return scene;
}

class SmoothEdgesOfSeveral : public testing::TestWithParam<Several> {
protected:
    static Picture drawn(const std::string& edges) {
        Scene scene = lit(GetParam().lights);
        for (const std::string& spec : GetParam().specs)
            scene.addShadow(spec + (spec.find(':') == std::string::npos ? ":" : ",") + "edges=" + edges);
        Camera camera(scene.root, slanted);
        const test::GlComplaints complaints(camera);
        camera.frame();
        Picture picture = camera.frame();
        EXPECT_EQ(complaints.all(), std::vector<std::string>());
        return picture;
    }
};

} // namespace

INSTANTIATE_TEST_SUITE_P(
    Of, SmoothEdgesOfSeveral,
    testing::Values(Several{"twoLights", {"volume"}, 2}, Several{"twoLightsBlended", {"volume:composite=blend"}, 2},
                    Several{"twoTechniques", {"volume", "planar:receiver=ground"}},
                    Several{"twoTechniquesBlended", {"volume:composite=blend", "planar:composite=blend"}},
                    Several{
                        "withRaysBlended", {"volume:composite=blend,dark=0.3", "traced:composite=blend,dark=0.3"}, 2},
                    Several{"three", {"volume", "planar:receiver=ground", "traced"}, 2},
                    Several{"raysOfTwoLights", {"traced"}, 2}, Several{"named", {"volume:receiver=ground"}},
                    Several{"namedBlended", {"volume:receiver=ground,composite=blend"}}),
    [](const auto& of) { return std::string(of.param.name); });

// A pixel with a share of light is between those about it that are lit and that are not, channel by channel.
TEST_P(SmoothEdgesOfSeveral, LieBetweenWhatHardEdgesHave) {
    const Picture hard = drawn("hard"), smooth = drawn("smooth");
    int changed = 0, outside = 0;
    for (int y = 1; y + 1 < hard.height; ++y)
        for (int x = 1; x + 1 < hard.width; ++x) {
            changed += hard.at(x, y) != smooth.at(x, y);
            bool within = true;
            for (const int shift : {0, 8, 16}) {
                const auto channel = [shift](std::uint32_t color) { return int(color >> shift & 0xffu); };
                int least = 255, most = 0;
                for (int i = 0; i < 9; ++i) {
                    const int value = channel(hard.at(x + i % 3 - 1, y + i / 3 - 1));
                    least = std::min(least, value);
                    most = std::max(most, value);
                }
                const int value = channel(smooth.at(x, y));
                within = within && value >= least - 3 && value <= most + 3;
            }
            outside += !within;
        }
    EXPECT_GT(changed, 30);
    EXPECT_LE(outside, 2); // where edges of two lights cross
}

// Where two techniques of a light find the same shadow, a pixel has the share that either lets through, and no product of both.
TEST(SmoothEdgesOfOneLight, ASecondTechniqueThatFindsTheSameChangesNothing) {
    for (const char* composite : {"relight", "blend"}) {
        Picture pictures[2];
        for (const int techniques : {1, 2}) {
            Scene scene = lit(1);
            for (int i = 0; i < techniques; ++i)
                scene.addShadow(std::string("volume:edges=smooth,composite=") + composite);
            pictures[techniques - 1] = test::render(scene.root, slanted);
        }
        int changed = 0;
        for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i)
            changed += std::abs(int(pictures[0].pixels[i] & 0xffu) - int(pictures[1].pixels[i] & 0xffu)) > 2;
        EXPECT_EQ(changed, 0) << composite;
    }
}
