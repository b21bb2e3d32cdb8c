// SPDX-License-Identifier: MIT
#pragma once
#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace gnomon::examples {

/// Pictures that stand inside a page, each once.
///
/// If their files are more than `mostBytes` together, all are shown at a half, a quarter or an eighth of their size
/// each way.
class PagePictures {
public:
    static constexpr std::size_t defaultBytes = 27u << 20; ///< a third more as text: 36 MiB of a page's 40 MB.

    /// @param folder  that names are relative to.
    explicit PagePictures(const std::string& folder, std::size_t mostBytes = defaultBytes);

    /// Takes a picture in. @return its number in json(); null if the name is empty or no PNG file can be read.
    nlohmann::json add(const std::string& name);

    /// data: URIs, a list. @throws nothing: what cannot be shrunk stays as it is.
    nlohmann::json json();
    /// 1, 2, 4 or 8: how much smaller, each way, json() made them.
    int shrunk() const { return _shrunk; }

private:
    void shrink();
    std::size_t bytes() const;

    std::string _folder;
    std::size_t _most;
    std::vector<std::string> _pngs;
    std::map<std::string, std::size_t> _numbers;
    int _shrunk = 1;
};

/// As RFC 4648 has it, with padding.
std::string base64(const std::string& bytes);

} // namespace gnomon::examples
