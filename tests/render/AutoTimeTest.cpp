// SPDX-License-Identifier: MIT
// A time that an automatic choice is to keep, where timer queries tell what shadows take: on Mesa's softpipe.
#include "AutoTrial.h"

#include <gtest/gtest.h>

using namespace test;

namespace {

/// Frames of a box in whose shadow another one stands.
struct Trial : AutoTrial {
    explicit Trial(double time)
        : AutoTrial({box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}), box({-3.0, -1.5, 0.0}, {-2.0, 0.5, 0.5})}, {0.0, time}) {
        Camera camera(scene.root, perspective({-7.0, -9.0, 7.0}, {-0.5, -0.5, 0.0}, 80, 60));
        for (int i = 0; i < 220; ++i) camera.frame();
    }
};

} // namespace

// No renderer draws a shadow in 0.01 ms by the processor, and none takes 10 s.
TEST(AutoTime, LoosensTheErrorWhereShadowsTakeLongerAndSaysSoAtTheEnd) {
    Trial trial(0.01);
    EXPECT_NE(trial.decision().reason.find("keeps 8 px"), std::string::npos) << trial.decision().reason;
    ASSERT_EQ(trial.technique->diagnose().size(), 1u);
    EXPECT_NE(trial.technique->diagnose().front().find("even with an error of 8 pixels, shadows take longer"),
              std::string::npos)
        << trial.technique->diagnose().front();
}

TEST(AutoTime, TightensTheErrorWhereThereIsTime) {
    Trial trial(1e4);
    ASSERT_NE(trial.chosen(), "") << "there is a decision";
    EXPECT_LE(trial.decision().chosen.error, 0.15);
    EXPECT_EQ(trial.technique->diagnose(), std::vector<std::string>());
}
