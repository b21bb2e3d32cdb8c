// SPDX-License-Identifier: MIT
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace gnomon::examples {

/// `content` is markup already.
std::string element(const std::string& name, const std::string& content, const std::string& attributes = "");

/// A script that stands inside a page: a closing tag in one of its texts would end it.
std::string inlineScript(const std::string& script);

/// Names and values as a list of definitions.
std::string madeHtml(const std::vector<std::pair<std::string, std::string>>& made);

/// What the page says if its pictures were reduced; empty for 1.
std::string shrunkText(int times);

} // namespace gnomon::examples
