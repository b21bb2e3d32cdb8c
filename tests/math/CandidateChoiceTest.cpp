// SPDX-License-Identifier: MIT
// Which of several ways to draw a shadow is taken, and when it changes.
#include <gnomon/choice/CandidateChoice.h>
#include <gnomon/choice/EdgeError.h>
#include <gnomon/choice/ShadowWork.h>
#include <gnomon/metrics/BoundaryDistance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>

using gnomon::ChoiceCandidate;
using gnomon::ChoiceReason;
using gnomon::chooseCandidate;

namespace {

constexpr double any = std::numeric_limits<double>::infinity();
const std::vector<ChoiceCandidate> four = {
    {true, 1.5, 1.0}, {true, 0.8, 2.0}, {true, 0.3, 6.0}, {false, 0.0, 0.1}}; // the last would be wrong

std::size_t chosen(const gnomon::ChoiceBudget& budget, std::optional<std::size_t> before = {}) {
    return chooseCandidate(four, budget, before).value().index;
}

ChoiceReason reason(const gnomon::ChoiceBudget& budget, std::optional<std::size_t> before = {}) {
    return chooseCandidate(four, budget, before).value().reason;
}

} // namespace

TEST(CandidateChoice, TakesTheCheapestThatKeepsTheError) {
    EXPECT_EQ(chosen({2.0, any}), 0u);
    EXPECT_EQ(chosen({1.0, any}), 1u);
    EXPECT_EQ(chosen({0.4, any}), 2u);
    EXPECT_EQ(reason({1.0, any}), ChoiceReason::Cheapest);
}

TEST(CandidateChoice, TakesTheMostAccurateWithinATime) {
    EXPECT_EQ(chosen({0.0, 1.5}), 0u);
    EXPECT_EQ(chosen({0.0, 3.0}), 1u);
    EXPECT_EQ(chosen({0.0, 10.0}), 2u);
    EXPECT_EQ(reason({0.0, 3.0}), ChoiceReason::MostAccurate);
}

TEST(CandidateChoice, SaysWhereNoneKeepsTheBudget) {
    EXPECT_EQ(chosen({0.1, any}), 2u);
    EXPECT_EQ(reason({0.1, any}), ChoiceReason::ErrorTooSmall);
    EXPECT_EQ(chosen({0.4, 3.0}), 1u) << "the most accurate within the time";
    EXPECT_EQ(reason({0.4, 3.0}), ChoiceReason::ErrorTooSmall);
    EXPECT_EQ(chosen({1.0, 0.5}), 1u) << "the cheapest that keeps the error";
    EXPECT_EQ(reason({1.0, 0.5}), ChoiceReason::TimeTooShort);
    EXPECT_EQ(chosen({0.0, 0.5}), 0u) << "the cheapest of all";
}

TEST(CandidateChoice, StaysUntilAnotherSavesAFifth) {
    std::vector<ChoiceCandidate> two = {{true, 0.5, 1.0}, {true, 0.5, 1.2}};
    EXPECT_EQ(chooseCandidate(two, {1.0, any}, 1)->index, 1u);
    EXPECT_EQ(chooseCandidate(two, {1.0, any}, 1)->reason, ChoiceReason::Kept);
    two[1].time = 1.3;
    EXPECT_EQ(chooseCandidate(two, {1.0, any}, 1)->index, 0u);
    two[1] = {true, 1.1, 1.05};
    EXPECT_EQ(chooseCandidate(two, {1.0, any}, 1)->index, 0u) << "it does not keep the error any more";
    two[1] = {false, 0.5, 1.05};
    EXPECT_EQ(chooseCandidate(two, {1.0, any}, 1)->index, 0u) << "it would be wrong";
}

TEST(CandidateChoice, TakesTheCheaperOfTwoThatAreAsAccurate) {
    const std::vector<ChoiceCandidate> two = {{true, 0.100, 9.0}, {true, 0.102, 2.0}};
    EXPECT_EQ(chooseCandidate(two, {0.0, 10.0})->index, 1u);
}

TEST(CandidateChoice, IsNoneWhereNoneIsUsable) {
    EXPECT_FALSE(chooseCandidate({}, {1.0, any}));
    EXPECT_FALSE(chooseCandidate({{false, 0.1, 0.1}}, {1.0, any}));
}

TEST(ShadowWork, TakesWhatItsPartsTake) {
    gnomon::ShadowWork still, change;
    still.pixels = 1000.0;
    change.triangles = 500.0;
    gnomon::CostRates rates;
    rates.pixel = 0.002;
    rates.triangle = 0.01;
    EXPECT_DOUBLE_EQ(timeOf(still, rates), 2.0);
    still += 0.5 * change;
    EXPECT_DOUBLE_EQ(timeOf(still, rates), 4.5);
}

TEST(EdgeError, IsThePixelsWhereTexelsAreSmallAndTheTexelsWhereTheyAreLarge) {
    const gnomon::EdgeFilter filter{0.5, 0.4, 3.0, 1.0};
    EXPECT_DOUBLE_EQ(mapEdgeError(filter, 0.0), 0.4);
    EXPECT_NEAR(mapEdgeError(filter, 100.0), 50.0, 0.01);
    EXPECT_DOUBLE_EQ(gnomon::polygonEdgeError(0.0), gnomon::sampledEdge);
}

// Stripes that rise so, each with another place in its pixels, as one place a pixel decides, and as their area does.
TEST(EdgeError, OfOnePlaceAPixelIsThatOfStripesThatRiseSo) {
    constexpr int width = 48, height = 2000, places = 15; // pixels; places each way of which the area is counted
    constexpr double pitch = 10.0 + 0.618;
    for (const double rise : {0.0, 0.05, 0.125, 0.25, 0.4, 0.5, 0.7, 0.9, 1.0}) {
        const auto isLit = [&](double x, double y) { return std::fmod(y + 100.0 - rise * x, 2.0 * pitch) < pitch; };
        gnomon::metrics::Picture drawn(width, height), truth(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                drawn.at(x, y) = isLit(x + 0.5, y + 0.5) ? 1.0 : 0.0;
                for (int i = 0; i < places * places; ++i)
                    truth.at(x, y) += isLit(x + (i % places + 0.5) / places, y + (i / places + 0.5) / places);
                truth.at(x, y) /= places * places;
            }
        const double off =
            gnomon::metrics::boundaryDistance(drawn, truth, gnomon::metrics::Mask(width, height, 1)).value().p95;
        std::cout << rise << ": " << off << ", " << gnomon::sampledEdgeOf(rise) << " are expected\n";
        EXPECT_NEAR(gnomon::sampledEdgeOf(rise), off, 0.04) << rise; // 15 places tell a level edge to a 15th
    }
}
