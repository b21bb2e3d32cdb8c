// SPDX-License-Identifier: MIT
#include "TextTemplate.h"

#include <stdexcept>

namespace gnomon::examples {

std::string fillTemplate(const std::string& text, const std::map<std::string, std::string>& values) {
    std::string result;
    std::size_t at = 0;
    for (std::size_t found; (found = text.find("${", at)) != std::string::npos;) {
        const std::size_t end = text.find('}', found);
        const std::string name = text.substr(found + 2, end - found - 2);
        const auto value = values.find(name);
        if (value == values.end()) throw std::logic_error("The template's ${" + name + "} has no value.");
        result += text.substr(at, found - at) + value->second;
        at = end + 1;
    }
    return result + text.substr(at);
}

} // namespace gnomon::examples
