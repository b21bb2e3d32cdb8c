// SPDX-License-Identifier: MIT
// Which frames look for causes that take long to find, and how long these stay.
#include <gnomon/base/FrameDiagnosis.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

using gnomon::CauseKind;

namespace {

using Causes = std::vector<std::string>;

class FrameDiagnosisTest : public testing::Test {
protected:
    /// A frame of two views. @return whether it looks for slow causes.
    bool frame() {
        diagnosis->begin(++number, 0.0, &views[0]);
        diagnosis->begin(number, 0.0, &views[1]);
        const bool first = diagnosis->looksForSlow(number), second = diagnosis->looksForSlow(number);
        EXPECT_EQ(first, second) << "in all views";
        return first;
    }
    void say(const char* cause) { diagnosis->add(number, "it", cause, CauseKind::Slow); }

    const osg::ref_ptr<gnomon::FrameDiagnosis> diagnosis = new gnomon::FrameDiagnosis;
    unsigned number = 0;
    const char views[2] = {};
};

} // namespace

TEST_F(FrameDiagnosisTest, TheFirstTwoFramesLookAndTheOneAfterEachQuestion) {
    EXPECT_TRUE(frame());
    EXPECT_TRUE(frame());
    EXPECT_FALSE(frame());
    diagnosis->known();
    EXPECT_FALSE(frame());
    diagnosis->all();
    EXPECT_TRUE(frame());
    EXPECT_FALSE(frame());
}

TEST_F(FrameDiagnosisTest, AFrameThatHasNotBegunLooksForNothing) {
    frame();
    EXPECT_FALSE(diagnosis->looksForSlow(number + 1));
}

TEST_F(FrameDiagnosisTest, CausesOfAllViewsStayUntilAFrameLooksAgain) {
    frame();
    say("a");
    say("b");
    say("a");
    const Causes both{"it: a", "it: b"};
    EXPECT_EQ(diagnosis->all(), both);
    frame();
    EXPECT_EQ(diagnosis->known(), Causes());
    say("b");
    frame();
    frame();
    EXPECT_EQ(diagnosis->known(), Causes{"it: b"});
}

TEST_F(FrameDiagnosisTest, CausesAreNotRepeatedInAFrameThatCouldNotHaveThem) {
    frame();
    say("a");
    diagnosis->begin(++number, 0.0, &views[0]);
    EXPECT_EQ(diagnosis->known(), Causes());
}
