// SPDX-License-Identifier: MIT
// The pages' tables of settings against the table of techniques.
#include "Pages.h"
#include "SettingsTables.h"

#include <gnomon/spec/SpecTable.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace {

using namespace gnomon::testing;
namespace fs = std::filesystem;

const std::string begin = "<!-- settings drape: made from the table of techniques -->\n", end = "<!-- end -->\n";

/// Public headers, one after the other.
std::string publicHeaders() {
    std::string all;
    for (const auto& entry : fs::directory_iterator(fs::path(GNOMON_ROOT) / "nodes/gnomon"))
        if (entry.path().extension() == ".h") all += repositoryFile("nodes/gnomon/" + entry.path().filename().string());
    return all;
}

TEST(Settings, OfThePagesAreThoseOfTheTable) {
    for (const Page& page : pages())
        EXPECT_EQ(page.text, withSettings(page.text))
            << page.path << ": cmake --build build --target update_settings writes the table anew.";
}

TEST(Settings, NameSettersThatThereAre) {
    const std::string headers = publicHeaders();
    for (const gnomon::SpecTechnique& technique : gnomon::specTechniques())
        for (const gnomon::SpecKey& key : gnomon::keysOf(technique)) {
            const std::size_t colons = key.setter.rfind("::");
            const std::string setter = key.setter.substr(colons == std::string::npos ? 0 : colons + 2);
            EXPECT_NE(headers.find("void " + setter.substr(0, setter.size() - 1)), std::string::npos) << key.setter;
        }
}

TEST(Settings, ReplaceATableAndLeaveTheRest) {
    const std::string page = withSettings("Before.\n" + begin + "| old |\n" + end + "After.\n");
    EXPECT_EQ(page.find("old"), std::string::npos);
    EXPECT_EQ(page.rfind("Before.\n" + begin + "| key |", 0), 0u);
    EXPECT_NE(page.find("| `error` | largest error of a draped edge in plan; 0 is exact | 0 to 1e6, scene's unit |"),
              std::string::npos);
    EXPECT_EQ(page.substr(page.size() - (end + "After.\n").size()), end + "After.\n");
    EXPECT_EQ(withSettings(page), page);
    EXPECT_EQ(withSettings("No table.\n"), "No table.\n");
}

TEST(Settings, RefuseMarksThatAreWrong) {
    EXPECT_THROW(withSettings(begin), std::invalid_argument);
    EXPECT_THROW(withSettings("<!-- settings moon: made from the table of techniques -->\n" + end),
                 std::invalid_argument);
}

} // namespace
