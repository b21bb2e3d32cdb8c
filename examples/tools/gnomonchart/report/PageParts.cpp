// SPDX-License-Identifier: MIT
#include "PageParts.h"

#include "FigureSvg.h"

namespace gnomon::examples {

std::string element(const std::string& name, const std::string& content, const std::string& attributes) {
    return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + name + ">\n";
}

std::string inlineScript(const std::string& script) {
    std::string text;
    for (std::size_t i = 0; i < script.size(); ++i)
        text += script.compare(i, 3, "</s") == 0 || script.compare(i, 3, "</S") == 0 ? "<\\" : script.substr(i, 1);
    return text;
}

std::string madeHtml(const std::vector<std::pair<std::string, std::string>>& made) {
    std::string html;
    for (const auto& [name, value] : made) html += element("dt", escaped(name)) + element("dd", escaped(value));
    return element("dl", html);
}

std::string shrunkText(int times) {
    if (times == 1) return "";
    return element("p",
                   "Pictures on this page are reduced to 1/" + std::to_string(times) +
                       " of their width and height. The files beside the page have full size.",
                   "class=\"note\"");
}

} // namespace gnomon::examples
