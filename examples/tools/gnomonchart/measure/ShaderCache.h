// SPDX-License-Identifier: MIT
#pragma once
#include <filesystem>

namespace gnomon::examples {

/// Mesa's cache of compiled shaders, in a folder of this object's own that goes with it: what a run measures does not
/// depend on runs before it, and the user's cache stays as it is. Make it before the first OpenGL context of the process;
/// one that comes later changes nothing.
class ShaderCache {
public:
    ShaderCache();
    ~ShaderCache();
    ShaderCache(const ShaderCache&) = delete;
    ShaderCache& operator=(const ShaderCache&) = delete;

    /// The next context compiles all of its shaders anew.
    void empty() const;

private:
    std::filesystem::path _folder; ///< empty: none could be made, and Mesa does without.
};

} // namespace gnomon::examples
