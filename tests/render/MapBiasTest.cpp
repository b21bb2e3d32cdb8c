// SPDX-License-Identifier: MIT
// What a shadow map's bias is for, over heights of the sun, sizes and depth formats: acne; and what too much of it costs,
// gaps at the foot of what stands on a ground, against their closed form.
// Shadow maps in framebuffer objects: depths in floats, and several samples a pixel, one of which decides.
#include "IntoTexture.h"

#include <gnomon/ShadowMapTechnique.h>

#include <gtest/gtest.h>
#include <metrics/CauseSplit.h>
#include <osg/Math>

#include <SceneTruth.h>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

using namespace test;

using gnomon::ShadowMapTechnique;

namespace {

constexpr double elevations[] = {90.0, 60.0, 45.0, 30.0, 20.0, 10.0, 5.0};
const std::vector<int> sizes{256, 512, 1024, 2048, 4096}; // at most: as many are used as are of use

/// How a ground is drawn and its map looked up.
struct Way {
    std::string name;
    Target target;
    ShadowMapTechnique::Filter filter = ShadowMapTechnique::BICUBIC;
    std::vector<int> mapSizes{64, 128, 256, 512, 1024, 2048, 4096};
};

/// @return the greatest number of pixels that are not lit, of all elevations and sizes.
int mostUnlit(const std::function<TracedCase(double)>& groundAt, const Way& way) {
    const TracedCase first = groundAt(90.0);
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setFilter(way.filter);
    DrawnInto lit(first, way.target, nullptr), shadowed(first, way.target, technique);
    int most = 0;
    for (const double elevation : elevations) {
        for (DrawnInto* each : {&lit, &shadowed}) each->shine(groundAt(elevation).light);
        const Picture asLit = lit.frame();
        for (const int size : way.mapSizes) {
            technique->setSize(size);
            most = std::max(most, shadowed.frame().different(asLit));
        }
    }
    EXPECT_GE(technique->passes(), std::size(elevations) * way.mapSizes.size()) << "the ground is in none of its maps";
    EXPECT_EQ(shadowed.into->complaints->all(), std::vector<std::string>());
    return most;
}

/// Grounds seen from near by and far, in small parts, in millimetres, to the horizon. Tilted: a level one is left out of
/// its own map, see ShadowMapTechnique.
std::vector<std::function<TracedCase(double)>> grounds() {
    return {[](double elevation) { return tilted(flatGround(8.0, 3.0, elevation, 1.0, 100.0)); },
            [](double elevation) { return tilted(flatGround(8.0, 0.5, elevation, 4.0, 20.0, 200)); },
            [](double elevation) { return tilted(flatGround(0.008, 0.003, elevation, 0.001, 0.1)); },
            [](double elevation) { return tilted(flatGround(500.0, 20.0, elevation, 1.0, 2000.0)); }};
}

// The goal is 1 pixel of 10,000 that are lit.
TEST(MapBias, LeavesGroundsFreeOfAcneAtEverySizeAndElevationInBothDepthFormats) {
    for (const Way& way : {Way{"24 bits", withDepth(depth24)},
                           Way{"floats", withDepth(depth32), ShadowMapTechnique::BICUBIC, {64, 512, 4096}}})
        for (const auto& groundAt : grounds()) EXPECT_EQ(mostUnlit(groundAt, way), 0) << way.name;
}

TEST(MapBias, LeavesGroundsFreeOfAcneByEveryFilterAndWithSeveralSamples) {
    for (const Way& way : {Way{"nearest", withDepth(depth24), ShadowMapTechnique::NEAREST, {256, 1024}},
                           Way{"bilinear", withDepth(depth24), ShadowMapTechnique::BILINEAR, {256, 1024}},
                           Way{"4 samples", fourSamples(), ShadowMapTechnique::BICUBIC, {256, 1024}},
                           Way{"4 samples, floats", fourSamples(depth32), ShadowMapTechnique::BICUBIC, {256, 1024}}})
        for (const auto& groundAt : grounds()) EXPECT_EQ(mostUnlit(groundAt, way), 0) << way.name;
}

/// 0 where it is dark, 1 where it is lit, unknown where that makes no difference.
gnomon::metrics::Picture visibility(const Picture& actual, const Picture& lit, const Picture& dark) {
    gnomon::metrics::Picture result(actual.width, actual.height);
    for (std::size_t i = 0; i < result.cells.size(); ++i) {
        const bool told = lit.pixels[i] != dark.pixels[i];
        const double shown = actual.pixels[i] == dark.pixels[i] ? 0.0 : 1.0;
        result.cells[i] = told ? shown : std::numeric_limits<double>::quiet_NaN();
    }
    return result;
}

/// A case of which rays say what is acne, under a sun that moves.
class Judged {
public:
    explicit Judged(TracedCase asked) : given(std::move(asked)), _truth(*given.build().root) {}

    void shine(const osg::Vec4d& light) {
        _maps = _truth.maps({given.view.view, given.view.projection, given.view.width, given.view.height}, light);
    }
    /// Share of what is truly lit.
    double acne(const gnomon::metrics::Picture& shown) const {
        return gnomon::metrics::causeSplit(shown, _maps, gnomon::metrics::pixelSets(_maps, shown)).acneShare.value();
    }

    const TracedCase given;

private:
    gnomon::examples::SceneTruth _truth;
    gnomon::metrics::TruthMaps _maps;
};

TracedCase sphereAndHouse(double elevation) {
    TracedCase given = labEight();
    given.light = sunAt(20.0, elevation);
    given.view = perspective({-8.0, -14.0, 10.0}, {0.0, 0.0, 0.0}, 320, 240);
    return tilted(given);
}

TEST(MapBias, LeavesWhatIsAmongCastersFreeOfAcneAtEverySizeAndElevationInBothDepthFormats) {
    Judged judged(sphereAndHouse(90.0));
    for (const GLenum format : {depth24, depth32}) {
        const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
        DrawnInto lit(judged.given, withDepth(format), nullptr), dark(judged.given, withDepth(format), nullptr, true),
            shadowed(judged.given, withDepth(format), technique);
        double most = 0.0;
        for (const double elevation : elevations) {
            const osg::Vec4d light = sphereAndHouse(elevation).light;
            judged.shine(light);
            for (DrawnInto* each : {&lit, &dark, &shadowed}) each->shine(light);
            const Picture asLit = lit.frame(), asDark = dark.frame();
            for (const int size : sizes) {
                technique->setSize(size);
                const double acne = judged.acne(visibility(shadowed.frame(), asLit, asDark));
                EXPECT_LT(acne, 1e-4) << elevation << " degrees, size " << size; // the goal
                most = std::max(most, acne);
            }
        }
        std::cout << "acne at most " << most << " of what is lit\n";
    }
}

/// A kerb or a wall across the view, its foot on the ground at x = 0 on the side away from the sun, and where its shadow
/// is.
struct Kerb {
    double height, thickness;  ///< metres.
    double elevation, azimuth; ///< of the sun, degrees; from -x.

    double shadowLength() const { // along x
        return height * std::cos(osg::DegreesToRadians(azimuth)) / std::tan(osg::DegreesToRadians(elevation));
    }
    osg::Vec4d light() const { return sunAt(180.0 + azimuth, elevation); }
};

/// From straight above. A texel of the smallest map is as long as a kerb is high.
constexpr double seenFrom = -3.2053, pixel = 0.02; // metres
constexpr int columns = 1280, rows = 48;

View stripFromAbove() {
    View view;
    view.width = columns;
    view.height = rows;
    view.view.makeLookAt({0.0, 0.0, 50.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    view.projection.makeOrtho(seenFrom, seenFrom + columns * pixel, -rows * pixel / 2.0, rows * pixel / 2.0, 1.0,
                              100.0);
    return view;
}

/// Metres: no texel of the map is longer. The map covers what is seen and, as it says, a sixteenth of that more on either
/// side; and the border that a comparison reaches over.
double longestTexel(const Kerb& kerb, int size) {
    const double turn = osg::DegreesToRadians(kerb.azimuth), rise = osg::DegreesToRadians(kerb.elevation);
    const double width = columns * pixel, depth = rows * pixel;
    const double along = (width * std::cos(turn) + depth * std::sin(turn)) * std::sin(rise);
    const double across = width * std::sin(turn) + depth * std::cos(turn);
    constexpr double reserve = 1.125, border = 6.0;
    return reserve * std::hypot(along + kerb.height * std::cos(rise), across) / (size - border);
}

/// A kerb on a ground. One that is flat is left out of the map; a stone far off makes it one that is not.
TracedCase kerbOn(const Kerb& kerb, bool flat) {
    const Mesh ground = square(30.0), stone = box({28.0, 28.0, 0.0}, {28.5, 28.5, 0.05});
    return {"kerb",
            {flat ? ground : joined({ground, stone}), box({-kerb.thickness, -4.0, 0.0}, {0.0, 4.0, kerb.height})},
            kerb.light(),
            stripFromAbove()};
}

/// Where a row's shadow begins and what is wrong besides.
struct Row {
    double gap; ///< metres that are lit between the foot and the shadow.
    int wrong;  ///< pixels lit within the shadow, or dark outside of it.
};

/// @param blur  metres about the shadow's far end and the kerb's edges that do not count, but for the gap.
Row judge(const Picture& shadowed, const Picture& lit, int row, const Kerb& kerb, double blur) {
    const double length = kerb.shadowLength();
    Row result{length, 0};
    bool begun = false;
    for (int column = 0; column < columns; ++column) {
        const double x = seenFrom + (column + 0.5) * pixel;
        const bool dark = shadowed.at(column, row) != lit.at(column, row);
        if (x < 0.0 || x > length) {
            const double fromEdge = std::min(
                {std::abs(x + kerb.thickness), std::abs(x), std::abs(x - length)}); // of ground, top and shadow
            result.wrong += dark && fromEdge > blur;
        } else if (!begun && dark) {
            result.gap = std::max(0.0, x - pixel / 2.0);
            begun = true;
        } else if (begun && !dark) {
            result.wrong += x < length - blur;
        }
    }
    return result;
}

/// The sun over a kerb at every elevation, maps of every size.
void expectNoGap(double height, double thickness, bool flat, double azimuth, ShadowMapTechnique::Filter filter,
                 const std::vector<int>& mapSizes) {
    const auto kerbAt = [=](double elevation) { return Kerb{height, thickness, elevation, azimuth}; };
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setFilter(filter);
    const Target target = withDepth(depth24);
    DrawnInto lit(kerbOn(kerbAt(90.0), flat), target, nullptr), shadowed(kerbOn(kerbAt(90.0), flat), target, technique);
    double most = 0.0;
    for (const double elevation : elevations) {
        const Kerb kerb = kerbAt(elevation);
        for (DrawnInto* each : {&lit, &shadowed}) each->shine(kerb.light());
        const Picture asLit = lit.frame();
        for (const int size : mapSizes) {
            technique->setSize(size);
            const Picture picture = shadowed.frame();
            const double texel = longestTexel(kerb, size), rise = osg::DegreesToRadians(elevation);
            const double allowed = texel / std::tan(rise) + pixel; // which pixel is the first is a pixel's matter
            for (int row = 0; row < rows; ++row) {
                const Row found = judge(picture, asLit, row, kerb, texel / std::sin(rise) + pixel);
                ASSERT_LE(found.gap, allowed) << elevation << " degrees, size " << size << ", row " << row;
                ASSERT_EQ(found.wrong, 0) << elevation << " degrees, size " << size << ", row " << row;
                most = std::max(most, found.gap / allowed);
            }
        }
    }
    std::cout << "height " << height << ", azimuth " << azimuth << (flat ? ", flat" : "") << ", filter " << filter
              << ": gap at most " << most << " of what is allowed\n";
}

/// On grounds that are in the map and that are not, across the view and slanted, by each filter. Metres.
void expectNoGaps(double height, double thickness) {
    for (const bool flat : {true, false})
        for (const double azimuth : {0.0, 25.0}) {
            SCOPED_TRACE(testing::Message() << (flat ? "flat" : "not flat") << ", azimuth " << azimuth);
            expectNoGap(height, thickness, flat, azimuth, ShadowMapTechnique::BICUBIC, sizes);
            for (const auto filter : {ShadowMapTechnique::NEAREST, ShadowMapTechnique::BILINEAR})
                expectNoGap(height, thickness, flat, azimuth, filter, {256, 1024});
        }
}

TEST(MapBias, LeavesNoGapUnderAKerbWiderThanATexelOverTheSunsTangent) { expectNoGaps(0.1, 0.3); }

TEST(MapBias, LetsNoLightThroughTheFootOfAThinWall) { expectNoGaps(0.5, 0.1); }

/// A map of which a texel is less than a pixel in the cases here.
TruthComparison drawn(const TracedCase& given, const Target& target) {
    const osg::ref_ptr<ShadowMapTechnique> technique = new ShadowMapTechnique;
    technique->setSize(2048);
    DrawnInto shadowed(given, target, technique);
    const TruthComparison found = compareWithRays(shadowed, given, target);
    std::cout << given.name << ": " << found << "\n";
    EXPECT_EQ(found.neither, 0) << given.name;
    EXPECT_GT(found.shadowed, 2000) << given.name;
    EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
    EXPECT_EQ(shadowed.into->complaints->all(), std::vector<std::string>());
    return found;
}

TEST(MapBuffers, OfFloatDepthsAreAsRightAsOthers) {
    for (const TracedCase& given : {labEight(), townOfHouses(), room()}) {
        const TruthComparison found = drawn(given, withDepth(depth32));
        EXPECT_EQ(found.certain, 0) << given.name;
        EXPECT_LE(found.wrong - found.floor, found.edges / 8) << given.name << ", as Map has it";
    }
}

// A pixel may be wrong if an edge runs through it or, by what a map's edges are off, beside it: 17 of 92,000 in the town.
TEST(MapBuffers, OfFourSamplesAreRightAwayFromEdges) {
    for (const auto& [given, format] :
         {std::pair(labEight(), depth24), {townOfHouses(), depth24}, {room(), depth32}, {labEight(), depth32}}) {
        const TruthComparison found = drawn(given, fourSamples(format));
        EXPECT_LE(found.certain, found.pixels / 4000) << given.name;
    }
}

} // namespace
