// SPDX-License-Identifier: MIT
// The truth image against shadows that need no rays: polygons and ellipses on planes, areas, the penumbra of a half-plane.
#include <support/Soup.h>

#include <gnomon/ShadowTruth.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

using gnomon::RayScene;
using gnomon::TruthImage;
using gnomon::TruthPixel;
using gnomon::TruthView;
using test::Soup;

namespace {

const glm::dvec3 utm(432100.25, 6400000.5, 812.0);

glm::dmat4 perspective(const glm::dvec3& eye, const glm::dvec3& about = glm::dvec3(0.0)) {
    return glm::perspective(glm::radians(40.0), 4.0 / 3.0, 1.0, 100.0) *
           glm::lookAt(about + eye, about, glm::dvec3(0.0, 0.0, 1.0));
}

/// Straight down; without a turn +x to the right.
glm::dmat4 plan(double half, const glm::dvec3& up = {0.0, 1.0, 0.0}) {
    return glm::ortho(-half, half, -half, half, 1.0, 100.0) *
           glm::lookAt(glm::dvec3(0.0, 0.0, 50.0), glm::dvec3(0.0), up);
}

TruthImage truthOf(const Soup& soup, const TruthView& view) {
    const RayScene scene(soup.view());
    return shadowTruth(scene, scene, view);
}

/// A plane z = slope.x·x + slope.y·y.
struct Ground {
    glm::dvec2 slope{0.0};
    double at(double x, double y) const { return slope.x * x + slope.y * y; }
};

/// A convex body: what lies behind all of these planes.
using Body = std::vector<glm::dvec4>;

Body boxBody(const glm::dvec3& low, const glm::dvec3& high) {
    return {{-1, 0, 0, low.x},  {1, 0, 0, -high.x}, {0, -1, 0, low.y},
            {0, 1, 0, -high.y}, {0, 0, -1, low.z},  {0, 0, 1, -high.z}};
}

/// Whether the way from a point to the light leads through a body.
bool isBlocked(const glm::dvec3& point, const glm::dvec4& light, const Body& body) {
    const glm::dvec3 way = glm::dvec3(light) - light.w * point;
    double enter = 0.0, leave = light.w > 0.0 ? 1.0 / light.w : std::numeric_limits<double>::infinity();
    for (const glm::dvec4& plane : body) {
        const double outside = glm::dot(plane, glm::dvec4(point, 1.0)), pace = glm::dot(glm::dvec3(plane), way);
        if (pace > 0.0) leave = std::min(leave, -outside / pace);
        if (pace < 0.0) enter = std::max(enter, -outside / pace);
        if (pace == 0.0 && outside > 0.0) return false;
    }
    return enter < leave;
}

/// Of the first two triangles, the ground: pixels that are no edge, and those that the closed form calls otherwise.
struct Count {
    int pixels = 0, shadowed = 0, wrong = 0;
};

Count compare(const TruthImage& image, const std::function<bool(const glm::dvec3&)>& inShadow) {
    Count count;
    for (const TruthPixel& pixel : image.pixels) {
        if (!pixel.seen() || pixel.receiver > 1 || pixel.isEdge()) continue;
        ++count.pixels;
        count.shadowed += !pixel.litCentre;
        count.wrong += pixel.litCentre == inShadow(pixel.position);
    }
    return count;
}

void expectShadowOf(const Body& body, const Soup& soup, const glm::dvec4& light, const char* name) {
    const TruthImage image = truthOf(soup, {perspective({-7.0, -11.0, 9.0}), 640, 480, light});
    const Count count = compare(image, [&](const glm::dvec3& p) { return isBlocked(p, light, body); });
    EXPECT_GT(count.shadowed, 3000) << name;
    EXPECT_GT(count.pixels, 2 * count.shadowed) << name;
    EXPECT_LE(count.wrong, count.pixels / 10000) << name;
}

Soup onGround(const Ground& ground = {}) {
    Soup soup;
    const auto at = [&](double x, double y) { return glm::dvec3(x, y, ground.at(x, y)); };
    soup.quad(at(-9.0, -9.0), at(9.0, -9.0) - at(-9.0, -9.0), at(-9.0, 9.0) - at(-9.0, -9.0));
    return soup;
}

/// Six-sided, upright, between the ground and z = top. @return its planes but for the ground.
Body addPrism(Soup& soup, const Ground& ground, double top) {
    Body body = {{0.0, 0.0, 1.0, -top}};
    const auto at = [&](int i, bool high) {
        const double around = glm::two_pi<double>() * i / 6.0, x = 1.5 * std::cos(around), y = 1.5 * std::sin(around);
        return glm::dvec3(x, y, high ? top : ground.at(x, y));
    };
    for (int i = 0; i < 6; ++i) {
        soup.triangle(at(i, false), at(i + 1, false), at(i + 1, true));
        soup.triangle(at(i, false), at(i + 1, true), at(i, true));
        if (i >= 2) soup.triangle(at(0, true), at(i - 1, true), at(i, true));
        const double across = glm::two_pi<double>() * (i + 0.5) / 6.0;
        body.emplace_back(std::cos(across), std::sin(across), 0.0, -1.5 * std::cos(glm::pi<double>() / 6.0));
    }
    return body;
}

namespace {

constexpr int slidSide = 20;                  // pixels of the pictures that are slid along
constexpr double slidPixel = 10.0 / slidSide; // m

/// Seen from above, 10 m, the camera so much farther along x.
TruthImage slidBy(double way, const Soup& soup, const glm::dvec4& light) {
    const glm::dmat4 clip = plan(5.0) * glm::translate(glm::dmat4(1.0), glm::dvec3(-way, 0.0, 0.0));
    return truthOf(soup, {clip, slidSide, slidSide, light});
}

} // namespace

TEST(ShadowTruth, IsUndecidedWithinASixteenthOfAPixelFromAnEdge) {
    // A plate from x = 10 on, 10 m up, under a sun at 45°: its shadow begins at x = 0. A picture of 10 m that is slid along
    // in steps of a hundredth of a pixel.
    Soup soup;
    soup.ground(40.0);
    soup.quad({10.0, -20.0, 10.0}, {30.0, 0.0, 0.0}, {0.0, 40.0, 0.0});
    int undecided = 0;
    for (int step = 0; step < 100; ++step) {
        const double slid = step * slidPixel / 100.0;
        const TruthImage image = slidBy(slid, soup, {1.0, 0.0, 1.0, 0.0});
        for (int x = 0; x < slidSide; ++x) {
            const double fromEdge = std::abs((x + 0.5) * slidPixel - 5.0 + slid) / slidPixel;
            if (std::abs(fromEdge - 1.0 / 16.0) < 1e-4) continue; // rounding
            ASSERT_EQ(image.at(x, 7).undecided, fromEdge < 1.0 / 16.0) << x << ", " << step;
            undecided += image.at(x, 7).undecided;
        }
    }
    EXPECT_EQ(undecided, 13) << "hundredths in two sixteenths";
}

/// Seen from above, slid along by hundredths of a pixel: a flat top up to x = 0, and beyond it a slope that turns away from the
/// sun. A plate shadows the top, and its shadow would end where the slope begins.
TEST(ShadowTruth, IsUndecidedAtAnEdgeOfTheShadowAlongAnEdgeOfTheSurface) {
    Soup soup;
    soup.quad({-20.0, -20.0, 0.0}, {20.0, 0.0, 0.0}, {0.0, 40.0, 0.0});  // the top
    soup.quad({0.0, -20.0, 0.0}, {20.0, 0.0, -40.0}, {0.0, 40.0, 0.0});  // steeper than the sun, which comes from -x
    soup.quad({-30.0, -20.0, 10.0}, {20.0, 0.0, 0.0}, {0.0, 40.0, 0.0}); // the plate
    int undecided = 0;
    for (int step = 0; step < 100; ++step) {
        const double slid = step * slidPixel / 100.0;
        const TruthImage image = slidBy(slid, soup, {-1.0, 0.0, 1.0, 0.0});
        for (int x = 0; x < slidSide; ++x) {
            const double pastEdge = ((x + 0.5) * slidPixel - 5.0 + slid) / slidPixel;
            if (std::abs(std::abs(pastEdge) - 1.0 / 16.0) < 1e-4) continue; // rounding
            ASSERT_FALSE(image.at(x, 7).litCentre);
            const bool isCloseBefore = pastEdge < -1e-6 && pastEdge > -1.0 / 16.0;
            if (std::abs(pastEdge) > 1e-6) ASSERT_EQ(image.at(x, 7).undecided, isCloseBefore) << x << ", " << step;
            undecided += image.at(x, 7).undecided;
        }
    }
    EXPECT_GE(undecided, 6) << "hundredths in a sixteenth";
}

/// As many hundredths of a pixel past the edge, in the picture of the test above the last.
TEST(ShadowTruth, LooksAtFourPlacesBesideTheCentre) {
    Soup soup;
    soup.ground(40.0);
    soup.quad({10.0, -20.0, 10.0}, {30.0, 0.0, 0.0}, {0.0, 40.0, 0.0});
    const auto besideAt = [&](double hundredths) {
        const double slid = hundredths * slidPixel / 100.0 - 0.5 * slidPixel;
        return slidBy(slid, soup, {1.0, 0.0, 1.0, 0.0}).at(10, 7).litBeside;
    };
    const std::array<bool, 4> lit{true, true, true, true}, dark{}, leftLit{true, false, true, false};
    EXPECT_EQ(besideAt(-7.0), lit);
    EXPECT_EQ(besideAt(-6.0), leftLit);
    EXPECT_EQ(besideAt(6.0), leftLit);
    EXPECT_EQ(besideAt(7.0), dark);
    EXPECT_EQ(besideAt(-60.0), lit) << "no edge in the pixel";
}

TEST(ShadowTruth, OfABoxOnAPlaneIsWhereItsSidesAreMet) {
    const glm::dvec3 low(-1.0, -1.2, 0.0), high(1.3, 1.0, 2.0);
    Soup soup = onGround();
    soup.box(low, high);
    expectShadowOf(boxBody(low, high), soup, {1.0, 0.4, 1.1, 0.0}, "sun");
    expectShadowOf(boxBody(low, high), soup, {1.0, 0.3, 0.35, 0.0}, "low sun");
    expectShadowOf(boxBody(low, high), soup, {2.0, 1.5, 4.5, 1.0}, "lamp");
    expectShadowOf(boxBody(low, high), soup, {1.0, 0.75, 2.25, 0.5}, "lamp, homogeneous");
}

TEST(ShadowTruth, OfAPrismOnATiltedPlaneIsWhereItsSidesAreMet) {
    const Ground ground{{0.25, -0.15}};
    Soup soup = onGround(ground);
    const Body body = addPrism(soup, ground, 2.5);
    expectShadowOf(body, soup, {-0.6, 0.4, 1.0, 0.0}, "sun");
    expectShadowOf(body, soup, {-2.0, 1.0, 5.0, 1.0}, "lamp");
}

TEST(ShadowTruth, OfASphereOnAPlaneIsAnEllipse) {
    constexpr double radius = 1.5, height = 55.0;
    const double sine = std::sin(glm::radians(height)), cosine = std::cos(glm::radians(height));
    Soup soup = onGround();
    soup.sphere({0.0, 0.0, radius}, radius, 256);
    const TruthImage image = truthOf(soup, {perspective({-7.0, -11.0, 9.0}), 640, 480, {cosine, 0.0, sine, 0.0}});
    const Count count = compare(image, [&](const glm::dvec3& p) {
        const double x = (p.x + radius * cosine / sine) * sine; // semi-axes R / sin and R
        return x * x + p.y * p.y < radius * radius;
    });
    EXPECT_GT(count.shadowed, 5000);
    EXPECT_LE(count.wrong, count.pixels / 10000);
}

/// The roof, and what the two walls along the sun throw beyond it.
TEST(ShadowTruth, HasTheAreaOfABoxsShadow) {
    Soup ground = onGround(), box;
    box.box({-1.0, -1.2, 1.0}, {1.3, 1.0, 2.0});
    const glm::dvec4 light(1.0, 0.4, 1.1, 0.0);
    const RayScene seen(ground.view()), casters(box.view());
    const TruthImage image = shadowTruth(seen, casters, {plan(5.0, {0.3, 1.0, 0.0}), 200, 200, light});
    double dark = 0.0;
    for (const TruthPixel& pixel : image.pixels) dark += 1.0 - double(pixel.lit);
    const double expected = 2.3 * 2.2 + 1.0 * (1.0 * 2.2 + 0.4 * 2.3) / 1.1;
    EXPECT_NEAR(dark * 0.05 * 0.05, expected, 0.001 * expected);
}

TEST(ShadowTruth, TellsReceiverPlaceAndBlocker) {
    Soup soup = onGround();
    soup.box({-1.0, -1.0, 1.5}, {1.0, 1.0, 2.0});
    soup.quad({-1.0, -1.0, 8.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}); // behind the lamp
    const TruthImage image = truthOf(soup, {perspective({0.0, -12.0, 1.0}), 320, 240, {0.0, 0.0, 6.0, 1.0}});
    int under = 0, sides = 0;
    for (const TruthPixel& pixel : image.pixels) {
        if (!pixel.seen()) continue;
        EXPECT_NEAR(glm::length(pixel.normal), 1.0, 1e-12);
        EXPECT_GT(glm::dot(pixel.normal, glm::dvec3(0.0, -12.0, 1.0) - pixel.position), 0.0);
        if (pixel.receiver > 1 || glm::length(glm::dvec2(pixel.position)) > 0.8) {
            sides += pixel.facing <= 0.0;
            continue;
        }
        EXPECT_FALSE(pixel.litCentre);
        EXPECT_TRUE(pixel.blocker == 2 || pixel.blocker == 3) << "the box's bottom is met first";
        EXPECT_NEAR(pixel.position.z, 0.0, 1e-6);
        EXPECT_NEAR(pixel.facing, glm::normalize(glm::dvec3(0.0, 0.0, 6.0) - pixel.position).z, 1e-12);
        EXPECT_NEAR(pixel.blockerDistance * pixel.facing, 1.5, 1e-3);
        ++under;
    }
    EXPECT_GT(under, 3);
    EXPECT_GT(sides, 3);
}

TEST(ShadowTruth, SeesWhatOpenGLWouldDrawBetweenNearAndFar) {
    Soup soup = onGround();
    soup.quad({-9.0, -9.0, 49.5}, {18.0, 0.0, 0.0}, {0.0, 18.0, 0.0}); // nearer than near
    const TruthImage image = truthOf(soup, {plan(10.0), 100, 80, {0.3, 0.2, 1.0, 0.0}});
    for (int y = 0; y < 80; ++y)
        for (int x = 0; x < 100; ++x) {
            const glm::dvec2 centre((x + 0.5) / 5.0 - 10.0, (y + 0.5) / 4.0 - 10.0);
            const bool seen = std::max(std::abs(centre.x), std::abs(centre.y)) < 9.0;
            ASSERT_EQ(image.at(x, y).seen(), seen) << x << " " << y;
            if (!seen) continue;
            EXPECT_LE(image.at(x, y).receiver, 1u);
            EXPECT_NEAR(glm::length(glm::dvec2(image.at(x, y).position) - centre), 0.0, 1e-9);
        }
}

TEST(ShadowTruth, OfWhatFacesAwayIsUnlitWithoutABlocker) {
    const TruthImage image = truthOf(onGround(), {plan(5.0), 20, 20, {0.3, 0.2, -1.0, 0.0}});
    for (const TruthPixel& pixel : image.pixels) {
        EXPECT_FALSE(pixel.litCentre);
        EXPECT_EQ(pixel.lit, 0.0f);
        EXPECT_LT(pixel.facing, 0.0);
    }
}

/// A sheet's back has no blocker but where a box is beyond it; a solid's has its own far side.
TEST(ShadowTruth, OfWhatFacesAwayTellsWhatElseIsBetween) {
    const TruthView view{plan(5.0), 100, 100, {0.0, 0.0, -1.0, 0.0}};
    Soup sheet = onGround();
    sheet.box({-1.0, -1.0, -3.0}, {1.0, 1.0, -2.0});
    const TruthImage beyond = truthOf(sheet, view);
    EXPECT_NEAR(beyond.at(50, 50).blockerDistance, 2.0, 1e-3);
    EXPECT_EQ(beyond.at(50, 80).blocker, gnomon::RayHit::none);
    EXPECT_EQ(beyond.at(50, 80).blockerDistance, 0.0);
    Soup solid;
    solid.box({-9.0, -9.0, -0.5}, {9.0, 9.0, 0.0});
    EXPECT_NEAR(truthOf(solid, view).at(50, 80).blockerDistance, 0.5, 1e-3);
}

TEST(ShadowTruth, IsTheSameFarFromTheOrigin) {
    Soup soup = onGround();
    soup.box({-1.0, -1.2, 0.0}, {1.3, 1.0, 2.0});
    for (const glm::dvec4 light : {glm::dvec4(1.0, 0.4, 1.1, 0.0), glm::dvec4(2.0, 1.5, 4.5, 1.0)}) {
        const TruthImage here = truthOf(soup, {perspective({-7.0, -11.0, 9.0}), 320, 240, light});
        Soup moved = soup;
        moved.origin = utm;
        const glm::dvec4 movedLight = light + light.w * glm::dvec4(utm, 0.0);
        const TruthImage there = truthOf(moved, {perspective({-7.0, -11.0, 9.0}, utm), 320, 240, movedLight});
        int different = 0;
        for (std::size_t i = 0; i < here.pixels.size(); ++i)
            different += here.pixels[i].litCentre != there.pixels[i].litCentre ||
                         std::abs(here.pixels[i].lit - there.pixels[i].lit) > 0.13f;
        EXPECT_LE(different, 320 * 240 / 10000);
    }
}

TEST(ShadowTruth, FlatGroundsNeverShadowThemselves) {
    for (const double elevation : {1.0, 5.0, 45.0}) {
        const double angle = glm::radians(elevation);
        const TruthImage image =
            truthOf(onGround({{0.13, 0.07}}),
                    {perspective({-7.0, -11.0, 9.0}), 320, 240, {-std::cos(angle), 0.0, std::sin(angle), 0.0}});
        for (const TruthPixel& pixel : image.pixels) ASSERT_TRUE(!pixel.seen() || pixel.lit == 1.0f) << elevation;
    }
}

TEST(ShadowTruth, ASunHasThePenumbraOfADiscBehindAHalfPlane) {
    Soup ground = onGround(), roof;
    roof.quad({-9.0, 0.0, 10.0}, {18.0, 0.0, 0.0}, {0.0, 18.0, 0.0}); // covers y > 0
    const RayScene seen(ground.view()), casters(roof.view());
    const TruthView view{plan(0.1), 64, 64, {0.0, 0.0, 1.0, 0.0}};
    const TruthImage image = softShadowTruth(seen, casters, view, 0.533, 8);
    const double half = 10.0 * std::tan(glm::radians(0.533 / 2.0));
    double squares = 0.0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            const double t = std::clamp(-((y + 0.5) / 320.0 - 0.1) / half, -1.0, 1.0);
            const double expected = 0.5 + (t * std::sqrt(1.0 - t * t) + std::asin(t)) / glm::pi<double>();
            squares += std::pow(double(image.at(x, y).lit) - expected, 2.0);
        }
    EXPECT_LT(std::sqrt(squares / (64 * 64)), 0.01);
    EXPECT_NEAR(image.at(32, 0).lit, 1.0, 1e-6);
    EXPECT_NEAR(image.at(32, 63).lit, 0.0, 1e-6);
}

TEST(ShadowTruth, FloorCountsCentresOnTheOtherSideOfHalf) {
    TruthImage image;
    image.pixels.resize(10);
    EXPECT_EQ(image.floor(), 0.0);
    for (TruthPixel& pixel : image.pixels) {
        pixel.receiver = 0;
        pixel.facing = 1.0;
        pixel.litCentre = true;
        pixel.lit = 1.0f;
    }
    image.pixels[1].lit = 0.5f;
    image.pixels[2].lit = 7.0f / 16.0f; // wrong
    image.pixels[3].litCentre = false;  // wrong
    image.pixels[4].lit = 0.0f;         // away from the light, and not seen
    image.pixels[4].facing = -0.1;
    image.pixels[5].lit = 0.0f;
    image.pixels[5].receiver = gnomon::RayHit::none;
    EXPECT_EQ(image.floor(), 0.25);
    EXPECT_TRUE(image.pixels[2].isEdge());
    EXPECT_FALSE(image.pixels[0].isEdge());
    EXPECT_FALSE(image.pixels[4].isEdge());
}

} // namespace
