// SPDX-License-Identifier: MIT
// The source documents' examples are short enough to be read at a sitting.
#include "Program.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

/// Lines of all that is an example's own, but for its CMake file.
long linesOf(const std::filesystem::path& folder) {
    long lines = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".txt") continue;
        const std::string text = gnomon::testing::readFile(entry.path());
        lines += std::count(text.begin(), text.end(), '\n');
    }
    return lines;
}

} // namespace

TEST(Examples, AreOfTwoHundredLinesAtMost) {
    for (const char* name : {"addshadows", "cs4470_fakeshadow", "gus_shadow", "halomagic", "lab8", "shad"}) {
        const long lines = linesOf(std::filesystem::path(GNOMON_ROOT) / "examples" / name);
        EXPECT_GT(lines, 10) << name;
        EXPECT_LE(lines, 200) << name;
    }
}
