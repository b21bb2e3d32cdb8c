// SPDX-License-Identifier: MIT
// docs/troubleshooting.md quotes every message of src/ and nodes/, and none that is not there.
#include "Program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <regex>
#include <sstream>

namespace {

using gnomon::testing::readFile;
using Texts = std::vector<std::string>;

const std::string gap = "…";

/// The string literals of each statement of C++ code, with a gap where something else stands between two of them.
class Statements {
public:
    explicit Statements(const std::string& code) : _code(code) {
        while (_at < _code.size()) step();
        end();
    }
    Texts all;

private:
    bool sees(const char* text) const { return _code.compare(_at, std::string(text).size(), text) == 0; }
    void skipPast(const std::string& text) {
        const std::size_t end = _code.find(text, _at + 1);
        _at = end == std::string::npos ? _code.size() : end + text.size();
    }
    bool beginsLine() const { return _at == 0 || _code.find_last_not_of(" \t", _at - 1) == _code.rfind('\n', _at); }

    void step() {
        const char c = _code[_at];
        if (sees("//") || (c == '#' && beginsLine())) return skipPast("\n");
        if (sees("/*")) return skipPast("*/");
        if (c == '"') return takeLiteral();
        if (sees("'\\")) return void(_at += 4);
        if (c == '\'' && _at + 2 < _code.size() && _code[_at + 2] == '\'') return void(_at += 3);
        if (c == ';' || c == '{' || c == '}') end();
        if (!std::isspace(static_cast<unsigned char>(c))) _goesOn = false;
        ++_at;
    }

    void takeLiteral() {
        if (!_goesOn && !_statement.empty()) _statement += gap;
        for (++_at; _at < _code.size() && _code[_at] != '"'; ++_at) {
            if (_code[_at] == '\\') ++_at;
            _statement += _code[_at];
        }
        ++_at;
        _goesOn = true;
    }

    void end() {
        if (!_statement.empty()) all.push_back(_statement);
        _statement.clear();
        _goesOn = false;
    }

    const std::string _code;
    std::string _statement;
    std::size_t _at = 0;
    bool _goesOn = false; ///< the last token is a literal, and the next one would be a part of it.
};

bool isLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Without what is no letter at its ends.
std::string trimmed(const std::string& text) {
    const auto begin = std::find_if(text.begin(), text.end(), isLetter);
    const auto end = std::find_if(text.rbegin(), text.rend(), isLetter).base();
    return begin < end ? std::string(begin, end) : "";
}

Texts split(std::string text, const std::string& at) {
    Texts parts;
    for (std::size_t end; (end = text.find(at)) != std::string::npos; text = text.substr(end + at.size()))
        parts.push_back(text.substr(0, end));
    parts.push_back(text);
    return parts;
}

bool isSentence(std::string text) {
    while (text.size() > gap.size() && text.compare(text.size() - gap.size(), gap.size(), gap) == 0)
        text.resize(text.size() - gap.size());
    const std::size_t last = text.find_last_not_of(' ');
    return last != std::string::npos && text.find(' ') < last && text[last] == '.';
}

Texts messagesOf(const std::string& code) {
    Texts messages = Statements(code).all;
    messages.erase(std::remove_if(messages.begin(), messages.end(), [](const auto& text) { return !isSentence(text); }),
                   messages.end());
    return messages;
}

/// Why parts are missing, as cmake/OptionalParts.cmake says it of each in cmake/Dependencies.cmake.
Texts missingParts() {
    const std::string sentence = readFile(GNOMON_ROOT "/cmake/OptionalParts.cmake");
    const std::string parts = readFile(GNOMON_ROOT "/cmake/Dependencies.cmake");
    EXPECT_NE(sentence.find("\"This Gnomon was built without ${library}, which ${work}. Install "), std::string::npos);
    const std::regex part("gnomon_optional_part\\(\\w+ (\\w+) [\\w:]+ [a-z0-9-]+ \"(.*)\"\\)");
    Texts all;
    for (std::sregex_iterator found(parts.begin(), parts.end(), part), end; found != end; ++found)
        all.push_back("This Gnomon was built without " + found->str(1) + ", which " + found->str(2) + ". Install it.");
    EXPECT_EQ(all.size(), 5u);
    return all;
}

/// What cmake/gnomonConfig.cmake.in says to those who use a static library.
Texts missingLibraries() {
    const std::string config = readFile(GNOMON_ROOT "/cmake/gnomonConfig.cmake.in");
    const std::regex refusal("gnomon_NOT_FOUND_MESSAGE \"([A-Z][^$]*)\\$\\{\\w+\\}([^\"$]*)\"");
    std::smatch found;
    EXPECT_TRUE(std::regex_search(config, found, refusal));
    return {found.str(1) + gap + found.str(2)};
}

/// Of src/, nodes/, the optional parts and the package's file.
Texts allMessages() {
    Texts all = missingParts();
    for (const std::string& text : missingLibraries()) all.push_back(text);
    for (const char* folder : {GNOMON_ROOT "/src/gnomon", GNOMON_ROOT "/nodes/gnomon"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
            const std::string ending = entry.path().extension().string();
            if (ending != ".cpp" && ending != ".h") continue;
            const Texts here = messagesOf(readFile(entry.path()));
            all.insert(all.end(), here.begin(), here.end());
        }
    return all;
}

/// Two words or more each, without what varies.
Texts phrasesOf(const std::string& sentences) {
    Texts phrases;
    for (const std::string& sentence : split(sentences, ". "))
        for (const std::string& part : split(sentence, gap)) {
            const std::string phrase = trimmed(part);
            if (phrase.find(' ') != std::string::npos) phrases.push_back(phrase);
        }
    return phrases;
}

/// What is wrong: the first sentence.
Texts leadingPhrases(const std::string& message) { return phrasesOf(message.substr(0, message.find(". "))); }

std::string page() {
    std::string text = readFile(GNOMON_ROOT "/docs/troubleshooting.md");
    text.erase(std::remove(text.begin(), text.end(), '`'), text.end());
    return text;
}

/// The first cells of the tables whose first column is "It says".
Texts quoted(const std::string& page) {
    Texts cells;
    std::istringstream lines(page);
    bool inTable = false;
    for (std::string line; std::getline(lines, line);) {
        const bool begins = line.rfind("| It says |", 0) == 0;
        inTable = begins || (inTable && line.rfind("| ", 0) == 0);
        if (inTable && !begins && line.rfind("| --- ", 0) != 0) cells.push_back(split(line, " | ").front().substr(2));
    }
    return cells;
}

TEST(Troubleshooting, QuotesEveryMessageOfTheSources) {
    const std::string text = page();
    const Texts messages = allMessages();
    EXPECT_GT(messages.size(), 90u); // else this has looked in the wrong place
    for (const std::string& message : messages)
        for (const std::string& phrase : leadingPhrases(message))
            EXPECT_NE(text.find(phrase), std::string::npos) << "\"" << phrase << "\" of: " << message;
}

TEST(Troubleshooting, QuotesNoMessageThatIsNotInTheSources) {
    std::string sources;
    for (const std::string& message : allMessages()) sources += message + "\n";
    const Texts cells = quoted(page());
    EXPECT_GT(cells.size(), 90u);
    for (const std::string& cell : cells)
        for (const std::string& phrase : phrasesOf(cell))
            EXPECT_NE(sources.find(phrase), std::string::npos) << "\"" << phrase << "\" of: " << cell;
}

TEST(Troubleshooting, TheScanKnowsAMessageWhenItSeesOne) {
    const Texts found = messagesOf("#include \"a file.h\"\n"
                                   "// report(\"not this one.\");\n/* \"nor this.\" */\n"
                                   "if (c == '\"') return \"no words\";\n"
                                   "report(frame, \"light \" + std::to_string(3) + \" has \"\n  \"gone. Move it.\");\n"
                                   "return none ? \"all is \\\"well\\\".\" : \"\";\n"
                                   "return {\"a list.\"};");
    ASSERT_EQ(found, (Texts{"light … has gone. Move it.", "all is \"well\".…", "a list."}));
    EXPECT_EQ(leadingPhrases(found[0]), (Texts{"has gone"}));
    EXPECT_EQ(quoted("| It says | Why |\n| --- | --- |\n| a | b |\n\n| c | d |\n"), (Texts{"a"}));
}

} // namespace
