// SPDX-License-Identifier: MIT
// Depths that were not taken at their pixel's centre: of a flat ground, where each is known in closed form.
#include <support/Soup.h>

#include <gnomon/rays/DepthBufferShadow.h>
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace {

constexpr int width = 64, height = 48;
const glm::dvec4 sun(0.9, 0.2, 0.4, 0.0);

glm::dmat4 clip() {
    return glm::perspective(glm::radians(40.0), 4.0 / 3.0, 1.0, 100.0) *
           glm::lookAt(glm::dvec3(-3.0, -8.0, 1.0), glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
}

/// Window depth of the plane z = 0 at a place of the picture, in pixels; 1 where it is not seen.
float depthAt(double x, double y) {
    const glm::dmat4 back = glm::inverse(clip());
    const auto at = [&](double depth) {
        const glm::dvec4 point = back * glm::dvec4(2.0 * x / width - 1.0, 2.0 * y / height - 1.0, depth, 1.0);
        return glm::dvec3(point) / point.w;
    };
    const glm::dvec3 near = at(-1.0), far = at(1.0);
    if (!(far.z < 0.0)) return 1.0f;
    const glm::dvec4 met = clip() * glm::dvec4(near + near.z / (near.z - far.z) * (far - near), 1.0);
    return static_cast<float>(0.5 + 0.5 * met.z / met.w);
}

/// The ground's depths, each taken at `place` of its pixel.
gnomon::DepthPicture picture(const glm::dvec2& place) {
    gnomon::DepthPicture result;
    result.viewportWidth = result.width = width;
    result.viewportHeight = result.height = height;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) result.depths.push_back(depthAt(x + place.x, y + place.y));
    return result;
}

std::size_t shadowed(const gnomon::DepthPicture& picture) {
    test::Soup ground;
    ground.ground(500.0);
    const gnomon::RayScene scene(ground.view());
    const std::vector<std::uint8_t> bits = gnomon::depthBufferShadow(scene, picture, clip(), sun).bits;
    std::size_t count = 0;
    for (const std::uint8_t byte : bits)
        for (int i = 0; i < 8; ++i) count += (byte >> i) & 1u;
    return count;
}

TEST(DepthShadow, IsFreeOfAcneWhereItKnowsThePlaceInThePixel) {
    for (const glm::dvec2 place : {glm::dvec2(0.5), glm::dvec2(0.375, 0.125), glm::dvec2(0.875, 0.625)}) {
        gnomon::DepthPicture given = picture(place);
        given.place = place;
        EXPECT_EQ(shadowed(given), 0u) << place.x;
    }
}

TEST(DepthShadow, IsFreeOfAcneWhereItKnowsHowFarOffThePlaceMayBe) {
    gnomon::DepthPicture given = picture({0.375, 0.95}); // above the centre: behind the ground, seen from there
    EXPECT_GT(shadowed(given), std::size_t(width * height / 4)) << "or this test shows nothing";
    given.offPlace = 0.5;
    EXPECT_EQ(shadowed(given), 0u);
}

/// Of interlaced stereo, where the other eye sees the sky above and below.
TEST(DepthShadow, IsFreeOfAcneWhereRowsBetweenAreAnotherEyes) {
    gnomon::DepthPicture given =
        picture({0.5, 0.5 + gnomon::DepthPicture().subpixel}); // as corners that the rasteriser snaps
    for (std::size_t i = 0; i < given.depths.size(); ++i)
        if (i / width % 2) given.depths[i] = 1.0f;
    EXPECT_GT(shadowed(given), std::size_t(width * height / 8)) << "or this test shows nothing";
    given.neighbour = 2;
    EXPECT_EQ(shadowed(given), 0u);
}

} // namespace
