// SPDX-License-Identifier: MIT
// Soft edges of maps: the share of the light that arrives, against closed forms and against rays.
#include "TracedCases.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/Math>
#include <support/Panels.h>

#include <algorithm>
#include <cmath>
#include <iostream>

using gnomon::ShadowMapTechnique;
using test::Picture;
using test::Scene;
using test::TracedCase;

namespace {

osg::ref_ptr<ShadowMapTechnique> softMap(int size, double sunAngle) {
    osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(size);
    technique->setEdges(ShadowMapTechnique::SOFT);
    technique->setSunAngle(sunAngle);
    return technique;
}

/// Share of a disc of radius 1 that is on the far side of a line, at a distance of -1 … 1 from its middle.
double discBeyond(double t) {
    t = std::clamp(t, -1.0, 1.0);
    return 0.5 + (t * std::sqrt(1.0 - t * t) + std::asin(t)) / osg::PI;
}

/// A thin plate, seen from above, whose edge along y at x = 0 casts its shadow on the ground beyond x = 0: the light comes
/// from where x is negative.
struct Plate {
    double height, depth = 40.0, ground = 60.0; ///< how far the plate reaches behind the edge, the ground to each side.
    osg::Vec4d light{-1.0, 0.0, 1.0, 0.0};

    Scene build() const {
        return test::groundScene({test::box({-depth, -40.0, height}, {0.0, 40.0, height + 0.001})}, ground, light);
    }
    /// Left and right exchanged: what blocks the light is on the map's other side.
    Scene mirrored() const {
        return test::groundScene({test::box({0.0, -40.0, height}, {depth, 40.0, height + 0.001})}, ground,
                                 {-light.x(), light.y(), light.z(), light.w()});
    }
    /// Sine of the angle between a way and the plane through a place on the ground and the edge; positive beyond.
    double beyond(double x, const osg::Vec3d& way) const {
        return (height * way.x() + x * way.z()) / std::hypot(x, height);
    }
};

/// How far shares of the light in pixels are from what they should be.
class Shares {
public:
    void add(double share, double expected) {
        const double off = std::abs(share - expected);
        largest = std::max(largest, off);
        if (expected <= 0.02 || expected >= 0.98) return;
        _sum += off * off;
        ++partly;
    }
    double rms() const { return std::sqrt(_sum / std::max(partly, 1)); }

    double largest = 0.0;
    int partly = 0; ///< pixels that part of the light reaches.

private:
    double _sum = 0.0; ///< of squares, over those.
};

std::ostream& operator<<(std::ostream& out, const Shares& s) {
    return out << "rms " << s.rms() << ", largest " << s.largest << ", of " << s.partly << " pixels";
}

/// Of the sun's light at 45 degrees on a ground of groundScene().
double shareOf(std::uint32_t color) {
    return (double(color & 0xffu) - test::shadowedGround) / (test::litGround - test::shadowedGround);
}

/// The ground at x > 0 of a picture from above, which shows [-half, half]².
template <class Expected>
Shares compare(const Picture& picture, double half, const Expected& expected) {
    Shares result;
    for (int y = picture.height / 4; y < picture.height * 3 / 4; ++y)
        for (int x = picture.width / 2 + 2; x < picture.width; ++x)
            result.add(shareOf(picture.at(x, y)), expected((x + 0.5) * 2.0 * half / picture.width - half));
    return result;
}

Picture from(Scene scene, ShadowMapTechnique* technique, double half) {
    if (technique) scene.addShadow(technique);
    return test::render(scene.root, test::fromAbove(half));
}

Picture mirrored(Picture picture) {
    for (int y = 0; y < picture.height; ++y)
        std::reverse(picture.pixels.begin() + std::ptrdiff_t(y) * picture.width,
                     picture.pixels.begin() + std::ptrdiff_t(y + 1) * picture.width);
    return picture;
}

constexpr double half = 4.0;

} // namespace

// 32 comparisons of a disc are good to about a 32nd, the 8 to 12 of one that is hardly wider than the filter to a 20th; the
// mean distance of what blocks the light is that of its nearer part where little of it does.
TEST(MapSoft, PenumbraOfASunIsAsWideAsItsDiscMakesIt) {
    for (const double angle : {2.0, 3.2, 8.0})
        for (const double height : {1.0, 2.0, 3.0}) {
            const Plate plate{height};
            const osg::Vec3d way(-std::sqrt(0.5), 0.0, std::sqrt(0.5));
            const double radius = std::sin(osg::DegreesToRadians(angle / 2.0));
            for (const Picture& picture : {from(plate.build(), softMap(1024, angle), half),
                                           mirrored(from(plate.mirrored(), softMap(1024, angle), half))}) {
                const Shares result =
                    compare(picture, half, [&](double x) { return discBeyond(plate.beyond(x, way) / radius); });
                std::cout << angle << " degrees, height " << height << ": " << result << "\n";
                EXPECT_LE(result.rms(), height < 2.0 ? 0.045 : 0.03) << angle << ", " << height;
                EXPECT_LE(result.largest, 0.1) << angle << ", " << height;
                EXPECT_GT(result.partly, 200);
            }
        }
}

// Its map is about the way down, while the disc is seen from aside: the closed form has it face each place.
TEST(MapSoft, PenumbraOfALampIsAsWideAsItsSizeMakesIt) {
    for (const double size : {0.4, 1.2}) {
        const Plate plate{1.5, 3.0, 6.0, {-1.5, 0.0, 6.0, 1.0}}; // a ground that is lit at its corners
        const osg::Vec3d lamp(-1.5, 0.0, 6.0);
        const osg::ref_ptr<ShadowMapTechnique> technique = softMap(1024, 0.0);
        technique->setLampSize(size);
        Scene lit = plate.build(), dark = plate.build(), shadowed = plate.build();
        dark.takeLightAway();
        shadowed.addShadow(technique);
        const test::View view = test::fromAbove(half);
        const Picture of[] = {test::render(lit.root, view), test::render(dark.root, view),
                              test::render(shadowed.root, view)};
        Shares result;
        for (int y = view.height * 3 / 8; y < view.height * 5 / 8; ++y)
            for (int x = view.width / 2 + 2; x < view.width; ++x) {
                const auto red = [&](int i) { return double(of[i].at(x, y) & 0xffu); };
                const osg::Vec3d place((x + 0.5) * 2.0 * half / view.width - half,
                                       (y + 0.5) * 2.0 * half / view.height - half, 0.0);
                const double expected = discBeyond(plate.beyond(place.x(), lamp - place) / (size / 2.0));
                if (red(0) - red(1) < 50.0 || expected < 0.02 || expected > 0.98) continue;
                result.add((red(2) - red(1)) / (red(0) - red(1)), expected);
            }
        std::cout << "lamp of " << size << ": " << result << "\n";
        EXPECT_LE(result.rms(), 0.05) << size;
        EXPECT_LE(result.largest, 0.12) << size;
        EXPECT_GT(result.partly, 200);
    }
}

// Where the room lies about the lamp decides in which of its six maps a penumbra lies, and where their sides cut it off: there
// it is another, in up to a pixel of thirty by more than a fifth of the light.
TEST(MapSoft, PenumbrasOfALampAreTheSameInWhicheverOfItsMapsTheyLie) {
    const TracedCase given = test::room();
    const auto underLamp = [](const TracedCase& of) {
        Scene scene = of.build();
        const osg::ref_ptr<ShadowMapTechnique> technique = softMap(1024, 0.0);
        technique->setLampSize(0.5);
        scene.addShadow(technique);
        return test::render(scene.root, of.view);
    };
    const test::Judge judge(given);
    const Picture straight = underLamp(given);
    for (const double angle : {20.0, 45.0, 70.0}) {
        const Picture turned =
            underLamp(test::turned(given, osg::Matrixd::rotate(osg::DegreesToRadians(angle), osg::Z_AXIS)));
        double sum = 0.0, largest = 0.0;
        int partly = 0, far = 0;
        for (int y = 0; y < straight.height; ++y)
            for (int x = 0; x < straight.width; ++x) {
                const auto red = [&](const Picture& of) { return double(of.at(x, y) & 0xffu); };
                const double range = red(judge.lit) - red(judge.dark),
                             share = (red(straight) - red(judge.dark)) / range;
                if (range < 50.0 || share < 0.05 || share > 0.95) continue;
                const double off = std::abs(red(turned) - red(straight)) / range;
                sum += off * off;
                largest = std::max(largest, off);
                far += off > 0.2;
                ++partly;
            }
        std::cout << angle << " degrees: rms " << std::sqrt(sum / partly) << ", largest " << largest << ", " << far
                  << " of " << partly << " pixels by more than 0.2\n";
        EXPECT_GT(partly, 1000);
        EXPECT_LE(std::sqrt(sum / partly), 0.08) << angle;
        EXPECT_LE(far, partly / 25) << angle;
    }
}

TEST(MapSoft, ARadiusIsThatOfADiscAcrossTheLight) {
    for (const double radius : {0.1, 0.5}) {
        const Plate plate{2.0};
        const osg::ref_ptr<ShadowMapTechnique> technique = softMap(1024, 0.0);
        technique->setRadius(radius);
        const Shares result = compare(from(plate.build(), technique, half), half, [&](double x) {
            return discBeyond((x - plate.height) * std::sqrt(0.5) / radius);
        });
        std::cout << "radius " << radius << ": " << result << "\n";
        EXPECT_LE(result.rms(), 0.03) << radius;
        EXPECT_LE(result.largest, 0.1) << radius;
        EXPECT_GT(result.partly, 500);
    }
}

// The shadow's edge runs away from the eye, through three maps whose texels are 2 cm, 8 cm and half a metre: in all of them
// the disc is as large, and where one ends nothing shows.
TEST(MapSoft, CascadesMeetWithoutASeam) {
    const double height = 6.0, radius = 1.0;
    const test::View view = test::perspective({-5.0, height, 3.0}, {300.0, height, 0.0}, 400, 300, 40.0, 1.0, 1000.0);
    const auto build = [&] {
        Scene scene = test::scene({0.0, -1.0, 1.0, 0.0});
        scene.content->addChild(test::node(test::quad({-10.0, -50.0, 0.0}, {310.0, 0.0, 0.0}, {0.0, 100.0, 0.0})));
        scene.content->addChild(test::node(test::quad({-10.0, -100.0, height}, {310.0, 0.0, 0.0}, {0.0, 100.0, 0.0})));
        return scene;
    };
    const osg::ref_ptr<ShadowMapTechnique> technique = softMap(1024, 0.0);
    technique->setRadius(radius);
    technique->setCascades(3);
    Scene shadowed = build();
    shadowed.addShadow(technique);
    const Picture picture = test::render(shadowed.root, view);
    EXPECT_EQ(technique->passes(), 3u);
    Shares result;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const test::Sight sight = test::sight(view, x + 0.5, y + 0.5);
            const glm::dvec3 place = sight.from - sight.way * (sight.from.z / sight.way.z);
            if (!(sight.way.z < 0.0) || !(place.x < 290.0) || !(place.y > 1.0) || place.y > 45.0) continue;
            const double expected = discBeyond((place.y - height) * std::sqrt(0.5) / radius);
            result.add(shareOf(picture.at(x, y)), expected);
        }
    std::cout << result << "\n";
    EXPECT_LE(result.largest, 0.1);
    EXPECT_GT(result.partly, 5000);
}

// As wide as the filter of each map, in which a texel is several times as wide as in the one before: seen along lines beside the
// edge, a third of a metre and less, the share changes little from one row of pixels to the next, where one map ends, too.
TEST(MapSoft, CascadesOfTheFilterAloneFadeIntoOneAnother) {
    const double height = 6.0;
    const test::View view = test::perspective({-5.0, height, 1.0}, {300.0, height, 0.0}, 1200, 300, 10.0, 1.0, 1000.0);
    Scene scene = test::scene({0.0, -1.0, 1.0, 0.0});
    scene.content->addChild(test::node(test::quad({-10.0, -50.0, 0.0}, {310.0, 0.0, 0.0}, {0.0, 100.0, 0.0})));
    scene.content->addChild(test::node(test::quad({-10.0, -100.0, height}, {310.0, 0.0, 0.0}, {0.0, 100.0, 0.0})));
    const osg::ref_ptr<ShadowMapTechnique> technique = softMap(128, 0.0);
    technique->setCascades(3);
    scene.addShadow(technique);
    const Picture picture = test::render(scene.root, view);
    const auto placeOf = [&](int x, int y) {
        const test::Sight sight = test::sight(view, x + 0.5, y + 0.5);
        return sight.from - sight.way * (sight.from.z / sight.way.z);
    };
    /// Between the two pixels of a row that a line along x passes between.
    const auto shareAt = [&](int row, double line) {
        int x = 0; // left is where y is more
        while (x + 2 < view.width && placeOf(x + 1, row).y > line) ++x;
        const double left = placeOf(x, row).y, right = placeOf(x + 1, row).y, t = (left - line) / (left - right);
        return (1.0 - t) * shareOf(picture.at(x, row)) + t * shareOf(picture.at(x + 1, row));
    };
    double most = 0.0;
    for (const double beside : {-0.3, -0.15, 0.15, 0.3})
        for (int row = 0; placeOf(view.width / 2, row + 1).x < 100.0 && placeOf(view.width / 2, row + 1).x > 0.0; ++row)
            most = std::max(most, std::abs(shareAt(row + 1, height + beside) - shareAt(row, height + beside)));
    std::cout << "from row to row at most " << most << "\n";
    EXPECT_LT(most, 0.12); // what rows differ by anyway, and a fifth; 0.18 where a map ends at once
}

// Its hard edges are those of the same filter, whatever is added to them.
TEST(MapSoft, WithoutExtentIsTheFilterAndItsHalfIsTheHardEdge) {
    const test::Judge town(test::townOfHouses());
    const osg::ref_ptr<ShadowMapTechnique> hard = softMap(1024, 0.0);
    hard->setEdges(ShadowMapTechnique::HARD);
    const Picture of[] = {town.lit, town.dark, town.with(hard), town.with(softMap(1024, 0.0))};
    int between = 0, other = 0;
    for (int y = 0; y < of[0].height; ++y)
        for (int x = 0; x < of[0].width; ++x) {
            const auto red = [&](int i) { return int(of[i].at(x, y) & 0xffu); };
            if (red(0) - red(1) < 20) continue;
            const double share = double(red(3) - red(1)) / (red(0) - red(1));
            between += share > 0.05 && share < 0.95;
            other += std::abs(share - 0.5) > 0.05 && (share > 0.5) != (red(2) == red(0));
        }
    EXPECT_GT(between, 5000);
    EXPECT_LE(other, between / 50); // slopes at silhouettes are found otherwise
}

TEST(MapSoft, FlatGroundsAreFreeOfAcne) {
    for (const double elevation : {90.0, 45.0, 20.0, 10.0}) {
        const test::Judge ground(test::tilted(test::flatGround(8.0, 3.0, elevation, 1.0, 100.0, 20))); // not left out
        for (const int size : {256, 2048})
            for (const auto& [angle, radius] : {std::pair(0.533, 0.0), {10.0, 0.0}, {0.0, 0.3}}) {
                const osg::ref_ptr<ShadowMapTechnique> technique = softMap(size, angle);
                technique->setRadius(radius);
                EXPECT_EQ(ground.with(technique).different(ground.lit), 0)
                    << elevation << " degrees, size " << size << ", sun of " << angle << " degrees, radius " << radius;
            }
    }
}

TEST(MapSoft, IsNearerToRaysAtTheSunsDiscThanHardEdgesAre) {
    for (TracedCase given : {test::labEight(), test::townOfHouses()}) {
        given.view.width /= 2; // enough pixels, for rays to a disc are many
        given.view.height /= 2;
        for (const double angle : {0.533, 4.0}) {
            const gnomon::TruthImage truth = test::truthOf(given.meshes, given.light, given.view, angle);
            const test::Judge judge(given);
            const auto off = [&](const osg::ref_ptr<ShadowMapTechnique>& technique) {
                return test::shareOff(judge.with(technique), judge.lit, judge.dark, truth);
            };
            const osg::ref_ptr<ShadowMapTechnique> hard = new ShadowMapTechnique;
            hard->setSize(2048);
            const double atPoint = off(softMap(2048, 0.0)), atDisc = off(softMap(2048, angle)), hardly = off(hard);
            std::cout << given.name << ", " << angle << " degrees: hard " << hardly << ", filter " << atPoint
                      << ", penumbra " << atDisc << "\n";
            EXPECT_LT(atDisc, hardly * 0.7) << given.name << ", " << angle;
            EXPECT_LE(atDisc, atPoint * 1.02) << given.name << ", " << angle;
        }
    }
}
