// SPDX-License-Identifier: MIT
// How the guide is written: what a machine can tell of it.
#include "Pages.h"

#include <gtest/gtest.h>

namespace {

using namespace gnomon::testing;

constexpr unsigned mostWords = 30;

std::string firstWord(const std::string& sentence) { return sentence.substr(0, sentence.find_first_of(" ,:")); }

TEST(Sentences, AreThoseThatAReaderHears) {
    const std::vector<std::string> expected{"One fact.", "M. Kilgard wrote Code well.", "See the page, and stop!",
                                            "An item",   "Another item goes on.",       "After the code."};
    EXPECT_EQ(sentencesOf(
                  "# No heading.\n\nOne *fact*. M. Kilgard wrote\n`a. B. c` well. See [the\npage](x.md), and stop!\n\n"
                  "| no | table. |\n\n    no code.\n\n```\nno. code.\n```\n<!-- no comment. -->\n"
                  "- An item\n- Another item\n  goes on.\n\nAfter the code.\n"),
              expected);
}

TEST(Sentences, HaveWordsAndSignsAreNone) {
    EXPECT_EQ(wordsOf("A sun has one, - a lamp 6."), 7u);
    EXPECT_EQ(wordsOf(""), 0u);
}

TEST(Prose, HasNoSentenceOfMoreThanThirtyWords) {
    for (const Page& page : pages())
        for (const std::string& sentence : sentencesOf(page.text))
            EXPECT_LE(wordsOf(sentence), mostWords) << page.path << ": " << sentence;
}

TEST(Prose, BeginsNoSentenceWithAWordThatHidesItsSubject) {
    for (const Page& page : pages())
        for (const std::string& sentence : sentencesOf(page.text))
            for (const char* hiding : {"Of", "What", "Those", "Where", "Instead"})
                EXPECT_NE(firstWord(sentence), hiding) << page.path << ": " << sentence;
}

TEST(Prose, IsFoundOnEveryPage) {
    ASSERT_GT(pages().size(), 15u);
    for (const Page& page : pages())
        EXPECT_FALSE(sentencesOf(page.text).empty() && anchorsOf(page.text).empty()) << page.path;
}

} // namespace
