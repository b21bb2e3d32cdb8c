// SPDX-License-Identifier: MIT
// Which of several ways to draw a shadow is taken, and when it changes.
#include <gnomon/choice/CandidateChoice.h>

#include <gtest/gtest.h>

#include <utility>
#include <vector>

using gnomon::ChoiceCandidate;
using gnomon::ChoiceReason;
using gnomon::chooseCandidate;
using gnomon::ErrorControl;

namespace {

const std::vector<ChoiceCandidate> four = {
    {true, 1.5, 1.0}, {true, 0.8, 2.0}, {true, 0.3, 6.0}, {false, 0.0, 0.1}}; // the last would be wrong

/// Errors, frame by frame, that a control asks for where the shadow takes time(error).
std::vector<double> errorsOf(ErrorControl control, double wanted, int frames, double (*time)(double)) {
    std::vector<double> errors;
    for (int i = 0; i < frames; ++i) {
        errors.push_back(control.error());
        control.add(time(control.error()), wanted);
    }
    return errors;
}

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

TEST(ErrorControl, FindsTheTightestErrorThatKeepsATime) {
    const auto time = [](double error) { return 4.0 / error; };
    const std::vector<double> errors = errorsOf({1.0, ErrorControl::tightest}, 3.0, 400, time);
    EXPECT_EQ(errors.front(), 1.0);
    EXPECT_EQ(errors.back(), 2.0) << "4 ms at 1 pixel, 2 at 2";
    EXPECT_EQ(errorsOf({1.0, ErrorControl::tightest}, 20.0, 400, time).back(), 0.25) << "16 ms, and 32 at the next";
    EXPECT_EQ(errorsOf({1.0, 1.0}, 20.0, 400, time).back(), 1.0) << "no tighter error was wanted";
}

TEST(ErrorControl, LoosensInFewFramesAndTriesATighterErrorSeldom) {
    // Quick enough to be tried tighter, where it is too slow: 1 ms and 3, with 2.1 wanted.
    const std::vector<double> errors =
        errorsOf({1.0, 0.5}, 2.1, 10000, [](double error) { return error < 1.0 ? 3.0 : 1.0; });
    int tight = 0, changes = 0;
    for (std::size_t i = 1; i < errors.size(); ++i) {
        tight += errors[i] < 1.0;
        changes += errors[i] != errors[i - 1];
    }
    EXPECT_GT(changes, 2);
    EXPECT_LE(changes, 20) << "each try waits twice as long as the one before";
    EXPECT_LE(tight, 8 * changes / 2) << "eight frames show that it is too slow";
}

TEST(ErrorControl, WaitsBeforeEachTighterErrorAsLongAsBeforeTheFirst) {
    ErrorControl control(8.0, 1.0);
    std::vector<int> changes;
    double before = control.error();
    for (int i = 0, since = 0; i < 200; ++i) {
        control.add(0.1, 1.0);
        ++since;
        if (control.error() == before) continue;
        before = control.error();
        changes.push_back(std::exchange(since, 0));
    }
    EXPECT_EQ(changes, (std::vector<int>{36, 36, 36})) << "4 that may be late, and 32 quick ones";
}

TEST(ErrorControl, HeedsNoSingleFrameAndSaysWhatIsTooSlow) {
    ErrorControl control(1.0, 0.5);
    for (int i = 0; i < 300; ++i) control.add(i % 3 ? 0.8 : 90.0, 1.0);
    EXPECT_EQ(control.error(), 1.0);
    for (int i = 0; i < 100; ++i) control.add(90.0, 1.0);
    EXPECT_EQ(control.error(), ErrorControl::loosest);
    EXPECT_TRUE(control.isTooSlow());
    for (int i = 0; i < 10; ++i) control.add(0.8, 1.0);
    EXPECT_FALSE(control.isTooSlow());
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
