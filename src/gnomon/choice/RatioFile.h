// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/choice/CostRatios.h>

#include <filesystem>
#include <optional>
#include <string>

namespace gnomon {

/// Where a user's programs keep what they can find again: $XDG_CACHE_HOME/gnomon, or else $HOME/.cache/gnomon.
/// nullopt if neither variable holds an absolute path.
/// Source: XDG Base Directory Specification 0.8.
std::optional<std::filesystem::path> userCache();

/// The cost ratios of one renderer, kept in a file between runs.
class RatioFile {
public:
    /// @param folder    need not be there; write() makes it.
    /// @param renderer  one line: what OpenGL calls the renderer, with its version.
    RatioFile(const std::filesystem::path& folder, const std::string& renderer);

    const std::filesystem::path& path() const { return _path; }
    /// What was read.
    struct Read {
        std::optional<CostRatios> ratios; ///< nullopt if there is no file, or none that can be used.
        std::string trouble;              ///< one sentence if there is one that cannot be used; else empty.
    };
    Read read() const;
    /// Takes the place of the file before, whole or not at all.
    /// @return one sentence if it cannot; else empty.
    std::string write(const CostRatios& ratios) const;
    /// Makes it the file that was used last.
    void touch() const;

    /// Those in a folder that were used last, of whichever renderer. nullopt if no file there can be used.
    static std::optional<CostRatios> usedLast(const std::filesystem::path& folder);

private:
    const std::filesystem::path _folder, _path;
    const std::string _head; ///< what the file begins with.
};

} // namespace gnomon
