// SPDX-License-Identifier: MIT
#include "SettingsTables.h"

#include <gnomon/spec/SpecTable.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace gnomon::testing {
namespace {

std::string code(const std::string& text) { return "`" + text + "`"; }

std::string allowedOf(const SpecKey& key) {
    std::vector<std::string> parts;
    for (const std::string& word : key.words) parts.push_back(code(word));
    for (const std::string& part : {key.range, key.unit})
        if (!part.empty()) parts.push_back(part);
    return listed(parts);
}

std::string defaultOf(const SpecKey& key) {
    const bool isWord = std::find(key.words.begin(), key.words.end(), key.byDefault) != key.words.end();
    return isWord ? code(key.byDefault) : key.byDefault;
}

std::string tableOf(const std::string& name) {
    std::string table = "| key | meaning | allowed | default | in C++ |\n| --- | --- | --- | --- | --- |\n";
    for (const SpecKey& key : name == "every technique" ? sharedKeys() : keysOf(requireTechnique(name)))
        table += "| " + code(key.name) + " | " + key.meaning + " | " + allowedOf(key) + " | " + defaultOf(key) + " | " +
                 code(key.setter) + " |\n";
    return table;
}

} // namespace

std::string withSettings(const std::string& page) {
    const std::string begin = "<!-- settings ", rest = ": made from the table of techniques -->\n",
                      end = "<!-- end -->";
    std::string result;
    std::size_t done = 0;
    for (std::size_t at = page.find(begin); at != std::string::npos; at = page.find(begin, done)) {
        const std::size_t colon = page.find(rest, at), stop = page.find(end, at);
        if (colon > stop || stop == std::string::npos) throw std::invalid_argument("no \"" + end + "\" on the page.");
        const std::size_t name = at + begin.size(), table = colon + rest.size();
        result += page.substr(done, table - done) + tableOf(page.substr(name, colon - name));
        done = stop;
    }
    return result + page.substr(done);
}

} // namespace gnomon::testing
