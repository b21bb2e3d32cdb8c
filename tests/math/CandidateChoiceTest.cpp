// SPDX-License-Identifier: MIT
// Which of several ways to draw a shadow is taken, and when it changes.
#include <gnomon/choice/CandidateChoice.h>

#include <gtest/gtest.h>

#include <optional>
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

TEST(CandidateChoice, IsTheMostAccurateOfThoseThatTakeUpToAQuarterMoreThanTheCheapest) {
    std::vector<ChoiceCandidate> three = {{true, 0.9, 1.0}, {true, 0.5, 1.2}, {true, 0.2, 1.3}};
    EXPECT_EQ(chooseCandidate(three, 1.0)->index, 1u);
    EXPECT_EQ(chooseCandidate(three, 1.0)->reason, ChoiceReason::MoreAccurate);
    three[2].time = 1.25;
    EXPECT_EQ(chooseCandidate(three, 1.0)->index, 2u);
    three[2].error = 0.49;
    EXPECT_EQ(chooseCandidate(three, 1.0)->index, 1u) << "the cheaper of two that are as accurate";
    three[0].usable = false;
    EXPECT_EQ(chooseCandidate(three, 1.0)->index, 1u);
    EXPECT_EQ(chooseCandidate(three, 1.0)->reason, ChoiceReason::Cheapest);
    three[2] = {true, 0.1, 1.6};
    three[0] = {true, 1.1, 0.1};
    EXPECT_EQ(chooseCandidate(three, 1.0)->index, 1u) << "what does not keep the error makes no other dear";
}

TEST(CandidateChoice, IsTheMostAccurateOfThoseThatTakeALittleMoreThanTheCheapest) {
    const std::vector<ChoiceCandidate> two = {{true, 0.4, 0.3}, {true, 0.1, 0.8}};
    EXPECT_EQ(chooseCandidate(two, 1.0)->index, 0u);
    EXPECT_EQ(chooseCandidate(two, 1.0, {}, 0.49)->index, 0u);
    EXPECT_EQ(chooseCandidate(two, 1.0, {}, 0.51)->index, 1u);
    EXPECT_EQ(chooseCandidate(two, 1.0, {}, 0.51)->reason, ChoiceReason::MoreAccurate);
    EXPECT_EQ(chooseCandidate({{true, 0.4, 10.0}, {true, 0.1, 12.0}}, 1.0, {}, 0.5)->index, 1u) << "a quarter is more";
}

TEST(CandidateChoice, StaysUntilAnotherIsBetterByATenth) {
    std::vector<ChoiceCandidate> two = {{true, 0.5, 1.0}, {true, 0.5, 1.24}};
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 1u);
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->reason, ChoiceReason::Kept);
    two[1].time = 1.38;
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 1u) << "a tenth less is hardly dearer";
    two[1].time = 1.4;
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 0u);
    two[1] = {true, 1.1, 1.05};
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 0u) << "it does not keep the error any more";
    two[1] = {false, 0.5, 1.05};
    EXPECT_EQ(chooseCandidate(two, 1.0, 1)->index, 0u) << "it would be wrong";
    two = {{true, 0.5, 1.0}, {true, 0.46, 1.0}};
    EXPECT_EQ(chooseCandidate(two, 1.0)->index, 1u);
    EXPECT_EQ(chooseCandidate(two, 1.0, 0)->index, 0u) << "hardly more accurate";
    two[1].error = 0.42;
    EXPECT_EQ(chooseCandidate(two, 1.0, 0)->index, 1u);
}

TEST(CandidateChoice, HasFlawsOnlyIfNoOtherKeepsTheError) {
    std::vector<ChoiceCandidate> two = {{true, 0.1, 1.0, true}, {true, 0.4, 3.0}};
    EXPECT_EQ(chooseCandidate(two, 1.0)->index, 1u);
    EXPECT_EQ(chooseCandidate(two, 1.0, 0)->index, 1u) << "at once";
    EXPECT_EQ(chooseCandidate(two, 0.2)->index, 0u);
    EXPECT_EQ(chooseCandidate(two, 0.05)->index, 0u) << "the most accurate";
    two[1].usable = false;
    EXPECT_EQ(chooseCandidate(two, 1.0)->index, 0u);
}

// Times and errors of two cross, as in a flight: first one is better by half, at the end the other.
TEST(CandidateChoice, ChangesOnceWhereTwoCross) {
    for (const bool byError : {false, true}) {
        std::optional<std::size_t> chosen;
        int changes = 0;
        for (int i = 0; i <= 200; ++i) {
            const double tilt = 0.005 * (i - 100) + (i % 2 ? 0.02 : -0.02); // with noise
            std::vector<ChoiceCandidate> two = {{true, 0.5, 1.0}, {true, 0.5, 1.0}};
            double ChoiceCandidate::*what = byError ? &ChoiceCandidate::error : &ChoiceCandidate::time;
            two[0].*what *= 1.0 + tilt;
            two[1].*what *= 1.0 - tilt;
            const std::size_t next = chooseCandidate(two, 1.0, chosen)->index;
            changes += chosen && next != *chosen;
            chosen = next;
        }
        EXPECT_EQ(chosen, 1u);
        EXPECT_EQ(changes, 1) << byError;
    }
}

TEST(CandidateChoice, IsNoneWhereNoneIsUsable) {
    EXPECT_FALSE(chooseCandidate({}, 1.0));
    EXPECT_FALSE(chooseCandidate({{false, 0.1, 0.1}}, 1.0));
}

TEST(ShadowWork, TakesTheTimeOfTheProcessorAndOfTheRenderer) {
    gnomon::ShadowWork work;
    work.pixels = 1000.0;
    work.triangles = 500.0;
    gnomon::RendererRates rates{};
    rates.instructions = 3e6;
    rates.pixel = 0.002;
    rates.triangle = 0.01;
    EXPECT_DOUBLE_EQ(rendererTime(work, rates), 7.0);
    EXPECT_DOUBLE_EQ(processorTime(work, rates), 0.0);
    EXPECT_DOUBLE_EQ(timeOf(work, rates), 7.0);
    work.leaves = 1000.0;
    const double drawn = processorTime(work, rates);
    EXPECT_GT(drawn, 0.0);
    EXPECT_DOUBLE_EQ(rendererTime(work, rates), 7.0) << "leaves are the processor's";
    EXPECT_DOUBLE_EQ(timeOf(work, rates), 7.0 + drawn);
    work.leaves = 3000.0;
    EXPECT_DOUBLE_EQ(processorTime(work, rates), 3.0 * drawn);
    rates.instructions = 6e6;
    EXPECT_DOUBLE_EQ(processorTime(work, rates), 1.5 * drawn);
    rates.instructions = 3e6;
    rates.call = 0.5;
    work.calls = 4.0;
    EXPECT_DOUBLE_EQ(rendererTime(work, rates), 9.0) << "a call takes time of both";
    EXPECT_GT(processorTime(work, rates), 3.0 * drawn);
}
