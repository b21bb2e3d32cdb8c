// SPDX-License-Identifier: MIT
#include "Pages.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

namespace gnomon::testing {
namespace fs = std::filesystem;
namespace {

const fs::path root = GNOMON_ROOT;

enum class Kind { Blank, Fence, Code, Heading, Table, Comment, Item, Text };

bool startsWith(const std::string& text, const std::string& with) { return text.compare(0, with.size(), with) == 0; }

/// @param inText  whether the line before it is text, whose lines may be indented.
Kind kindOf(const std::string& line, bool inText) {
    const std::size_t first = line.find_first_not_of(' ');
    if (first == std::string::npos) return Kind::Blank;
    if (first >= 4 && !inText) return Kind::Code;
    const std::string bare = line.substr(first);
    if (startsWith(bare, "```")) return Kind::Fence;
    if (startsWith(bare, "#")) return Kind::Heading;
    if (startsWith(bare, "|")) return Kind::Table;
    if (startsWith(bare, "<!--")) return Kind::Comment;
    static const std::regex item("([-*]|[0-9]+\\.) .*");
    return std::regex_match(bare, item) ? Kind::Item : Kind::Text;
}

struct Line {
    Kind kind;
    std::string text;
};

std::vector<Line> linesOf(const std::string& markdown) {
    std::istringstream stream(markdown);
    std::vector<Line> lines;
    bool fenced = false;
    for (std::string text; std::getline(stream, text);) {
        const bool inText = !lines.empty() && (lines.back().kind == Kind::Text || lines.back().kind == Kind::Item);
        Kind kind = kindOf(text, inText);
        if (kind == Kind::Fence)
            fenced = !fenced;
        else if (fenced)
            kind = Kind::Code;
        lines.push_back({kind, text});
    }
    return lines;
}

/// A paragraph or item as a reader hears it.
std::string spoken(const std::string& text) {
    static const std::regex code("`[^`]*`"), link("!?\\[([^\\]]*)\\]\\([^)]*\\)"), marks("[*_]+");
    static const std::regex item("^ *([-*]|[0-9]+\\.) ");
    std::string result = std::regex_replace(text, item, "");
    result = std::regex_replace(result, code, "Code");
    result = std::regex_replace(result, link, "$1");
    return std::regex_replace(result, marks, "");
}

bool endsSentence(const std::string& word) {
    const std::size_t last = word.find_last_not_of(")\"");
    if (last == std::string::npos || last == 0) return false;
    const bool initial = last == 1 && std::isupper(static_cast<unsigned char>(word[0])) != 0; // M. Kilgard
    return !initial && std::string(".!?").find(word[last]) != std::string::npos;
}

void addSentences(std::vector<std::string>& sentences, const std::string& paragraph) {
    std::istringstream words(spoken(paragraph));
    std::string sentence;
    for (std::string word; words >> word;) {
        sentence += (sentence.empty() ? "" : " ") + word;
        if (!endsSentence(word)) continue;
        sentences.push_back(sentence);
        sentence.clear();
    }
    if (!sentence.empty()) sentences.push_back(sentence);
}

std::vector<std::string> matches(const std::string& text, const std::regex& wanted) {
    std::vector<std::string> found;
    for (std::sregex_iterator i(text.begin(), text.end(), wanted), end; i != end; ++i) found.push_back((*i)[1]);
    return found;
}

/// All lines but those of code blocks.
std::string withoutCode(const std::string& markdown) {
    std::string text;
    for (const Line& line : linesOf(markdown))
        if (line.kind != Kind::Code && line.kind != Kind::Fence) text += line.text + "\n";
    return text;
}

} // namespace

std::string repositoryFile(const std::string& path) {
    std::ifstream file(root / path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool isInRepository(const std::string& path) { return fs::exists(root / path); }

const std::vector<Page>& pages() {
    static const std::vector<Page> all = [] {
        std::vector<std::string> paths{"README.md", "CONTRIBUTING.md", "CHANGELOG.md"};
        for (const auto& entry : fs::directory_iterator(root / "docs"))
            if (entry.path().extension() == ".md") paths.push_back("docs/" + entry.path().filename().string());
        std::vector<Page> read;
        for (const std::string& path : paths) read.push_back({path, repositoryFile(path)});
        return read;
    }();
    return all;
}

std::vector<std::string> sentencesOf(const std::string& markdown) {
    std::vector<std::string> sentences;
    std::string paragraph;
    for (const Line& line : linesOf(markdown)) {
        if (line.kind != Kind::Text) {
            addSentences(sentences, paragraph);
            paragraph.clear();
        }
        if (line.kind == Kind::Text || line.kind == Kind::Item) paragraph += line.text + "\n";
    }
    addSentences(sentences, paragraph);
    return sentences;
}

unsigned wordsOf(const std::string& sentence) {
    std::istringstream words(sentence);
    unsigned count = 0;
    for (std::string word; words >> word;)
        count += std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c) != 0; });
    return count;
}

std::vector<std::string> codeLinesOf(const std::string& markdown) {
    std::vector<std::string> lines;
    for (const Line& line : linesOf(markdown))
        if (line.kind == Kind::Code)
            lines.push_back(line.text.substr(std::min(line.text.find_first_not_of(' '), line.text.size())));
    return lines;
}

std::vector<std::string> codePiecesOf(const std::string& markdown) {
    return matches(withoutCode(markdown), std::regex("`([^`]+)`"));
}

std::vector<std::string> linksOf(const std::string& markdown) {
    return matches(withoutCode(markdown), std::regex("\\]\\(([^)]+)\\)"));
}

std::vector<std::string> anchorsOf(const std::string& markdown) {
    std::vector<std::string> anchors;
    for (const Line& line : linesOf(markdown)) {
        if (line.kind != Kind::Heading) continue;
        std::string anchor;
        for (const char c : line.text.substr(std::min(line.text.size(), line.text.find_first_not_of("# ")))) {
            if (c == ' ') anchor += '-';
            if (c == '-' || c == '_' || std::isalnum(static_cast<unsigned char>(c)))
                anchor += static_cast<char>(std::tolower(c));
        }
        anchors.push_back(anchor);
    }
    return anchors;
}

} // namespace gnomon::testing
