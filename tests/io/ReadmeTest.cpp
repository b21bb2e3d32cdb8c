// SPDX-License-Identifier: MIT
// The guide against the repository: links, commands, specifications and quoted code.
#include "Pages.h"

#include <gnomon/ShadowSpec.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

namespace {

using namespace gnomon::testing;
namespace fs = std::filesystem;

constexpr long mostReadmeLines = 150;

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

bool holds(const std::vector<std::string>& all, const std::string& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

/// Sources and CMake files of the programs: examples and benchmarks.
const std::string& programs() {
    static const std::string all = [] {
        std::string text;
        for (const char* folder : {"examples", "tests"})
            for (const auto& entry : fs::recursive_directory_iterator(fs::path(GNOMON_ROOT) / folder)) {
                const fs::path relative = fs::relative(entry.path(), GNOMON_ROOT);
                const std::string kind = entry.path().extension().string();
                if (kind == ".cpp" || kind == ".h" || kind == ".txt") text += repositoryFile(relative.string());
            }
        return text;
    }();
    return all;
}

/// Commands of a page that run a program of this project, word by word, the program without its folder.
std::vector<std::vector<std::string>> commandsOf(const Page& page) {
    static const std::regex command(
        ".*build/bin/([a-z0-9_]+.*)|((gnomon|bench_|arl_|halomagic|shad|lab8|gus_|cs4470_)[a-z0-9_]* -.*)");
    std::vector<std::string> lines = codeLinesOf(page.text);
    for (const std::string& piece : codePiecesOf(page.text)) lines.push_back(piece);
    std::vector<std::vector<std::string>> commands;
    for (const std::string& line : lines) {
        std::smatch match;
        if (!std::regex_match(line, match, command)) continue;
        std::istringstream words(match[match[1].matched ? 1 : 2].str());
        commands.emplace_back();
        for (std::string word; words >> word && word != "#";) commands.back().push_back(word);
    }
    return commands;
}

/// Specifications of a page: what follows --shadow, and code of the form NAME:key=value with the name of a technique.
std::vector<std::string> specificationsOf(const Page& page) {
    std::vector<std::string> found;
    for (const std::vector<std::string>& command : commandsOf(page))
        for (std::size_t i = 0; i + 1 < command.size(); ++i)
            if (command[i] == "--shadow") found.push_back(command[i + 1]);
    for (const std::string& piece : codePiecesOf(page.text))
        if (holds(gnomon::shadowTechniques(), piece.substr(0, piece.find(':'))) && piece.find('=') != std::string::npos)
            found.push_back(piece);
    return found;
}

TEST(Readme, QuotesTheLinesOfTheExample) {
    const std::string example = between(repositoryFile("examples/addshadows/main.cpp"), "[lines]", "[/lines]", 4);
    EXPECT_EQ(std::count(example.begin(), example.end(), '\n'), 4);
    for (const char* page : {"README.md", "docs/getting-started.md"})
        EXPECT_EQ(between(repositoryFile(page), "```cpp", "```", 0), example) << page;
}

/// What a page says that a program has: "<!-- examples/tutorial/main.cpp: town -->", then code.
struct Quotation {
    std::string file, part, code;
};

std::vector<Quotation> quotationsOf(const std::string& markdown) {
    std::vector<Quotation> found;
    const std::regex quoted("<!-- (examples/[^ :]+)(: ([a-z]+))? -->\n```[a-z]+\n");
    for (std::sregex_iterator it(markdown.begin(), markdown.end(), quoted), none; it != none; ++it) {
        const auto begin = static_cast<std::size_t>(it->position() + it->length());
        found.push_back({(*it)[1], (*it)[3], markdown.substr(begin, markdown.find("```", begin) - begin)});
    }
    return found;
}

TEST(Pages, QuoteProgramsAsTheyAre) {
    std::size_t found = 0;
    for (const Page& page : pages())
        for (const Quotation& one : quotationsOf(page.text)) {
            const std::string file = repositoryFile(one.file), begin = "// [" + one.part + "]";
            const std::size_t indent = file.find("\n    " + begin) == std::string::npos ? 0 : 4;
            const std::string code = one.part.empty() ? file : between(file, begin, "// [/" + one.part + "]", indent);
            EXPECT_FALSE(code.empty()) << page.path << ": " << one.part;
            EXPECT_EQ(one.code, code) << page.path << ": " << one.part;
            ++found;
        }
    EXPECT_GE(found, 9u);
}

TEST(Readme, HasAHundredAndFiftyLinesAtMost) {
    const std::string text = repositoryFile("README.md");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), mostReadmeLines);
}

TEST(Pages, LinkToFilesAndHeadingsThatAreThere) {
    for (const Page& page : pages())
        for (const std::string& link : linksOf(page.text)) {
            if (link.find("://") != std::string::npos) continue;
            const std::size_t hash = std::min(link.find('#'), link.size());
            const fs::path target =
                hash ? fs::path(page.path).parent_path() / link.substr(0, hash) : fs::path(page.path);
            EXPECT_TRUE(isInRepository(target.string())) << page.path << ": " << link;
            if (hash < link.size()) {
                const std::vector<std::string> anchors = anchorsOf(repositoryFile(target.string()));
                EXPECT_TRUE(holds(anchors, link.substr(hash + 1))) << page.path << ": " << link;
            }
        }
}

TEST(Pages, AreAllInTheIndex) {
    const std::vector<std::string> links = linksOf(repositoryFile("docs/README.md"));
    for (const Page& page : pages())
        if (fs::path(page.path).parent_path() == "docs" && page.path != "docs/README.md") {
            EXPECT_TRUE(holds(links, fs::path(page.path).filename().string())) << page.path;
        }
}

TEST(Pages, NameProgramsAndOptionsThatThereAre) {
    std::size_t options = 0;
    for (const Page& page : pages())
        for (const std::vector<std::string>& command : commandsOf(page)) {
            EXPECT_NE(programs().find(command.front()), std::string::npos) << page.path << ": " << command.front();
            for (const std::string& word : command) {
                if (word.compare(0, 2, "--") != 0 || word.compare(0, 4, "--gt") == 0 ||
                    word.compare(0, 11, "--benchmark") == 0)
                    continue;
                EXPECT_NE(programs().find("\"" + word + "\""), std::string::npos) << page.path << ": " << word;
                ++options;
            }
        }
    EXPECT_GT(options, 30u);
}

TEST(Pages, HaveSpecificationsThatAreUnderstood) {
    std::size_t found = 0;
    for (const Page& page : pages())
        for (const std::string& specification : specificationsOf(page)) {
            EXPECT_NO_THROW(gnomon::parseShadowSpec(specification)) << page.path << ": " << specification;
            ++found;
        }
    EXPECT_GT(found, 20u);
}

TEST(Pages, HaveOnePlaceForTheSettingsOfEachTechnique) {
    std::string all;
    for (const Page& page : pages()) all += page.text;
    for (const std::string& technique : gnomon::shadowTechniques()) {
        if (technique == "none") continue;
        const std::string mark = "<!-- settings " + technique + ": made from the table of techniques -->\n";
        const std::size_t place = all.find(mark);
        ASSERT_NE(place, std::string::npos) << technique;
        EXPECT_EQ(all.find(mark, place + 1), std::string::npos) << technique;
        const std::size_t end = all.find("<!-- end -->", place);
        EXPECT_NE(end, std::string::npos) << technique;
        EXPECT_LT(end, all.find("<!-- settings", place + 1)) << technique;
    }
}

/// A suite or a test, as its TEST macro in tests/ names it.
bool isTest(const std::string& name) {
    const std::size_t dot = name.find('.');
    const std::string macro = "TEST(_[FP])?\\(" + name.substr(0, dot) + ", ";
    const std::string rest = dot == std::string::npos ? "" : name.substr(dot + 1) + "\\)";
    return std::regex_search(programs(), std::regex(macro + rest));
}

/// What the last column of docs/company.md's tables names.
std::vector<std::string> testsOfCompany() {
    std::vector<std::string> tests;
    std::istringstream lines(repositoryFile("docs/company.md"));
    for (std::string line; std::getline(lines, line);) {
        if (line.size() < 2 || line.front() != '|') continue;
        const std::vector<std::string> named = codePiecesOf(line.substr(line.rfind('|', line.size() - 2)));
        tests.insert(tests.end(), named.begin(), named.end());
    }
    return tests;
}

TEST(Company, HasATestForEachFeature) {
    ASSERT_GE(testsOfCompany().size(), 25u);
    for (const std::string& name : testsOfCompany()) EXPECT_TRUE(isTest(name)) << name;
}

} // namespace
