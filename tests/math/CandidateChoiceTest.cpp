// SPDX-License-Identifier: MIT
// Which of several ways to draw a shadow is taken, and when it changes.
#include <gnomon/choice/CandidateChoice.h>

#include <gtest/gtest.h>

#include <vector>

using gnomon::ChoiceCandidate;
using gnomon::ChoiceReason;
using gnomon::chooseCandidate;

namespace {

const std::vector<ChoiceCandidate> four = {
    {true, 1.5, 1.0}, {true, 0.8, 2.0}, {true, 0.3, 6.0}, {false, 0.0, 0.1}}; // the last would be wrong

} // namespace

TEST(CandidateChoice, TakesTheCheapestThatKeepsTheError) {
    EXPECT_EQ(chooseCandidate(four, 2.0)->index, 0u);
    EXPECT_EQ(chooseCandidate(four, 1.0)->index, 1u);
    EXPECT_EQ(chooseCandidate(four, 0.4)->index, 2u);
    EXPECT_EQ(chooseCandidate(four, 1.0)->reason, ChoiceReason::Cheapest);
}

TEST(CandidateChoice, IsTheMostAccurateWhereNoneKeepsTheError) {
    EXPECT_EQ(chooseCandidate(four, 0.1)->index, 2u);
    EXPECT_EQ(chooseCandidate(four, 0.1)->reason, ChoiceReason::ErrorTooSmall);
    const std::vector<ChoiceCandidate> alike = {{true, 0.100, 9.0}, {true, 0.102, 2.0}};
    EXPECT_EQ(chooseCandidate(alike, 0.05)->index, 1u) << "the cheaper of two that are as accurate";
}

TEST(CandidateChoice, StaysUntilAnotherSavesAFifth) {
    std::vector<ChoiceCandidate> two = {{true, 0.5, 1.0}, {true, 0.5, 1.2}};
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 1u);
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->reason, ChoiceReason::Kept);
    two[1].time = 1.3;
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 0u);
    two[1] = {true, 1.1, 1.05};
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 0u) << "it does not keep the error any more";
    two[1] = {false, 0.5, 1.05};
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 0u) << "it would be wrong";
}

TEST(CandidateChoice, IsNoneWhereNoneIsUsable) {
    EXPECT_FALSE(chooseCandidate({}, 1.0));
    EXPECT_FALSE(chooseCandidate({{false, 0.1, 0.1}}, 1.0));
}

TEST(ShadowWork, TakesWhatItsPartsTake) {
    gnomon::ShadowWork work, more;
    work.pixels = 1000.0;
    more.triangles = 500.0;
    gnomon::CostRates rates{};
    rates.pixel = 0.002;
    rates.triangle = 0.01;
    EXPECT_DOUBLE_EQ(timeOf(work, rates), 2.0);
    work += more;
    EXPECT_DOUBLE_EQ(timeOf(work, rates), 7.0);
}
