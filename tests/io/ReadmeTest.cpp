// SPDX-License-Identifier: MIT
#include "Program.h"

#include <gtest/gtest.h>

#include <sstream>

namespace {

using gnomon::testing::readFile;

/// Text between the first line that holds `begin` and the next that holds `end`, each line without `indent` spaces.
std::string between(const std::string& text, const std::string& begin, const std::string& end, std::size_t indent) {
    std::istringstream lines(text);
    std::string line, result;
    while (std::getline(lines, line) && line.find(begin) == std::string::npos) {
    }
    while (std::getline(lines, line) && line.find(end) == std::string::npos)
        result += line.substr(std::min(indent, line.find_first_not_of(' '))) + "\n";
    return result;
}

TEST(Readme, QuotesTheFiveLinesOfTheExample) {
    const std::string example = readFile(GNOMON_ROOT "/examples/addshadows/main.cpp");
    const std::string quoted = between(readFile(GNOMON_ROOT "/README.md"), "```cpp", "```", 0);
    EXPECT_EQ(quoted, between(example, "[five lines]", "[/five lines]", 4));
    EXPECT_EQ(std::count(quoted.begin(), quoted.end(), '\n'), 5);
}

} // namespace
