// SPDX-License-Identifier: MIT
// The public headers' comments: short sentences that name their subject, and the same headings for every node.
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using Lines = std::vector<std::string>;

constexpr std::size_t mostWords = 30;

/// Headers that stand in these folders themselves; those of the rooms below are internal.
std::vector<std::filesystem::path> publicHeaders() {
    const std::filesystem::path src = std::filesystem::path(GNOMON_ROOT) / "src";
    std::vector<std::filesystem::path> headers;
    for (const auto& folder : {src / "gnomon", src / "gnomon" / "metrics", src / ".." / "nodes" / "gnomon"})
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.path().extension() == ".h") headers.push_back(entry.path());
    return headers;
}

Lines linesOf(std::istream& stream) {
    Lines lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

Lines linesIn(const std::filesystem::path& file) {
    std::ifstream stream(file);
    return linesOf(stream);
}

Lines linesOf(const std::string& text) {
    std::istringstream stream(text);
    return linesOf(stream);
}

bool startsWith(const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; }

std::string trimmed(const std::string& text) {
    const std::size_t begin = text.find_first_not_of(' ');
    return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(' ') + 1 - begin);
}

std::size_t indentOf(const std::string& text) { return std::min(text.find_first_not_of(' '), text.size()); }

/// Without the private members of classes.
Lines interfaceOf(const Lines& header) {
    Lines lines;
    bool hidden = false;
    for (const std::string& line : header) {
        const std::string text = trimmed(line);
        if (text == "private:") hidden = true;
        if (text == "public:" || text == "protected:" || line == "};") hidden = false;
        if (!hidden) lines.push_back(line);
    }
    return lines;
}

/// Splits comments into paragraphs: items of lists, tags such as @param, and runs of plain lines. Leaves out code.
class Paragraphs {
public:
    explicit Paragraphs(const Lines& lines) {
        for (const std::string& line : lines) add(line);
        end();
    }

    Lines all;

private:
    void add(const std::string& line) {
        const std::size_t comment = line.find("///");
        if (comment == std::string::npos) return end();
        const bool trailing = line.compare(comment, 4, "///<") == 0, alone = trimmed(line.substr(0, comment)).empty();
        if (!alone || trailing != _trailing) end();
        _trailing = trailing;
        const std::string text = line.substr(comment + (trailing ? 4 : 3));
        trailing ? append(text) : addText(text);
    }

    void addText(const std::string& text) {
        const std::size_t indent = indentOf(text);
        if (trimmed(text).empty()) {
            end();
            _mayBeCode = true;
        } else if (!(_mayBeCode && indent > 4)) {
            const bool starts = startsWith(trimmed(text), "- ") || startsWith(trimmed(text), "@");
            if (starts || (_isItem && indent < 2)) end();
            _isItem = starts || (_isItem && !_text.empty());
            append(text);
        }
    }

    void append(const std::string& text) {
        _text += " " + trimmed(text);
        _mayBeCode = false;
    }

    void end() {
        if (!trimmed(_text).empty()) all.push_back(trimmed(_text));
        _text.clear();
        _isItem = _mayBeCode = false;
    }

    std::string _text;
    bool _trailing = false, _isItem = false, _mayBeCode = false;
};

std::string words(int count) {
    std::string text = "word";
    for (int i = 1; i < count; ++i) text += " word";
    return text;
}

/// Words that count: with a letter or a digit. Tags and the names of parameters are left out.
Lines wordsOf(const std::string& sentence) {
    std::istringstream stream(sentence);
    Lines words;
    for (std::string word; stream >> word;) {
        if (word == "@param" || word == "@throws")
            stream >> word;
        else if (word[0] != '@' &&
                 std::any_of(word.begin(), word.end(), [](unsigned char c) { return std::isalnum(c); }))
            words.push_back(word);
    }
    return words;
}

Lines sentencesOf(const std::string& paragraph) {
    Lines sentences(1);
    for (std::size_t i = 0; i < paragraph.size(); ++i) {
        sentences.back() += paragraph[i];
        if (std::string(".!?").find(paragraph[i]) != std::string::npos && paragraph[i + 1] == ' ')
            sentences.emplace_back();
    }
    return sentences;
}

bool startsWithoutSubject(const Lines& words) {
    static const std::set<std::string> starts = {"of", "what", "those", "where", "instead"};
    std::string first = words.empty() ? "" : words.front();
    std::transform(first.begin(), first.end(), first.begin(), [](unsigned char c) { return std::tolower(c); });
    first.erase(std::remove_if(first.begin(), first.end(), [](unsigned char c) { return !std::isalpha(c); }),
                first.end());
    return starts.count(first) > 0;
}

template <typename Fault>
Lines sentencesWith(const Lines& header, Fault fault) {
    Lines faulty;
    for (const std::string& paragraph : Paragraphs(interfaceOf(header)).all)
        for (const std::string& sentence : sentencesOf(paragraph))
            if (fault(wordsOf(sentence))) faulty.push_back(trimmed(sentence));
    return faulty;
}

Lines longSentences(const Lines& header) {
    return sentencesWith(header, [](const Lines& words) { return words.size() > mostWords; });
}

Lines sentencesWithoutSubject(const Lines& header) { return sentencesWith(header, startsWithoutSubject); }

/// Class names of META_Node(gnomon, NAME).
Lines nodesIn(const Lines& header) {
    const std::string macro = "META_Node(gnomon, ";
    Lines names;
    for (const std::string& line : header)
        if (startsWith(trimmed(line), macro))
            names.push_back(trimmed(line).substr(macro.size(), trimmed(line).find(')') - macro.size()));
    return names;
}

/// The headings that the comment of a class should have and has not. A heading stands above a list.
Lines missingHeadings(const Lines& header, const std::string& name) {
    const auto declares = [&](const std::string& line) {
        return startsWith(line, "class ") && line.find(" " + name + " ") != std::string::npos;
    };
    const auto end = std::find_if(header.begin(), header.end(), declares);
    auto begin = end;
    while (begin != header.begin() && startsWith(*std::prev(begin), "///")) --begin;
    Lines missing;
    for (const char* heading : {"Cost", "Needs", "Limits", "Threads"}) {
        const auto found = std::find(begin, end, std::string("/// ") + heading);
        if (found == end || !startsWith(*std::next(found), "/// - ")) missing.push_back(name + ": " + heading);
    }
    return missing;
}

} // namespace

TEST(HeaderProse, SentencesOfPublicHeadersHaveAtMostThirtyWords) {
    const auto headers = publicHeaders();
    EXPECT_GE(headers.size(), 40u); // else this has looked in the wrong place
    for (const auto& header : headers) EXPECT_EQ(longSentences(linesIn(header)), Lines()) << header;
}

TEST(HeaderProse, SentencesOfPublicHeadersBeginWithTheirSubject) {
    for (const auto& header : publicHeaders()) EXPECT_EQ(sentencesWithoutSubject(linesIn(header)), Lines()) << header;
}

TEST(HeaderProse, EveryPublicNodeHasCostNeedsLimitsAndThreads) {
    int nodes = 0;
    for (const auto& header : publicHeaders())
        for (const std::string& name : nodesIn(linesIn(header))) {
            ++nodes;
            EXPECT_EQ(missingHeadings(linesIn(header), name), Lines()) << header;
        }
    EXPECT_GE(nodes, 7);
}

TEST(HeaderProse, TheLintKnowsALongSentenceWhenItSeesOne) {
    EXPECT_EQ(longSentences(linesOf("/// " + words(30) + ". " + words(30) + ".")), Lines());
    EXPECT_EQ(longSentences(linesOf("/// " + words(31) + ".")).size(), 1u);
    EXPECT_EQ(longSentences(linesOf("/// " + words(15) + "\n/// " + words(16) + ".")).size(), 1u);
    EXPECT_EQ(longSentences(linesOf("int a; ///< " + words(15) + "\n       ///< " + words(16))).size(), 1u);
    EXPECT_EQ(longSentences(linesOf("/// - " + words(15) + "\n///   " + words(16))).size(), 1u);
    EXPECT_EQ(longSentences(linesOf("/// @param a  " + words(31))).size(), 1u);
}

TEST(HeaderProse, TheLintTellsSentencesFromItemsCodeAndPrivateMembers) {
    EXPECT_EQ(longSentences(linesOf("/// - " + words(15) + "\n/// - " + words(16))), Lines());
    EXPECT_EQ(longSentences(linesOf("/// - " + words(15) + "\n/// Needs\n/// - " + words(16))), Lines());
    EXPECT_EQ(longSentences(linesOf("int a; ///< " + words(15) + "\nint b; ///< " + words(16))), Lines());
    EXPECT_EQ(longSentences(linesOf("///\n///     " + words(31))), Lines());
    EXPECT_EQ(longSentences(linesOf("private:\n/// " + words(31))), Lines());
    EXPECT_EQ(longSentences(linesOf("private:\n};\n/// " + words(31))).size(), 1u);
}

TEST(HeaderProse, TheLintKnowsASentenceWithoutSubjectWhenItSeesOne) {
    EXPECT_EQ(sentencesWithoutSubject(linesOf("/// A map. Where it ends, all is lit.")),
              Lines{"Where it ends, all is lit."});
    EXPECT_EQ(sentencesWithoutSubject(linesOf("int size; ///< of a side.")), Lines{"of a side."});
    EXPECT_EQ(sentencesWithoutSubject(linesOf("/// Fits maps. It shows where they end.")), Lines());
}

TEST(HeaderProse, TheLintMissesAHeadingWithoutAList) {
    const Lines header =
        linesOf("/// Cost\n/// - None.\n/// Needs\n/// Limits\n/// - None.\nclass Moon : public osg::Node {\n"
                "    META_Node(gnomon, Moon)");
    EXPECT_EQ(nodesIn(header), Lines{"Moon"});
    EXPECT_EQ(missingHeadings(header, "Moon"), (Lines{"Moon: Needs", "Moon: Threads"}));
}
