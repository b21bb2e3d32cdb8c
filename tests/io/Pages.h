// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <vector>

namespace gnomon::testing {

/// A page of the guide.
struct Page {
    std::string path; ///< from the repository's root: "docs/maps.md".
    std::string text;
};

/// README.md, CONTRIBUTING.md, CHANGELOG.md and docs/*.md.
const std::vector<Page>& pages();

/// What a file of the repository holds; empty if it is not there. @param path  from the repository's root.
std::string repositoryFile(const std::string& path);
/// True if there is such a file or folder.
bool isInRepository(const std::string& path);

/// Sentences of a Markdown text, outside headings, tables, code blocks and comments. Code within a line counts as one word, a link
/// or picture as its words.
std::vector<std::string> sentencesOf(const std::string& markdown);
unsigned wordsOf(const std::string& sentence);

/// Lines of code blocks, fenced or indented by four spaces, without the indent.
std::vector<std::string> codeLinesOf(const std::string& markdown);
/// Pieces of code within a line, between backticks, in tables too.
std::vector<std::string> codePiecesOf(const std::string& markdown);
/// Where links and pictures lead: what is between the brackets after ].
std::vector<std::string> linksOf(const std::string& markdown);
/// The names by which links reach headings: "which-technique-when".
std::vector<std::string> anchorsOf(const std::string& markdown);

} // namespace gnomon::testing
