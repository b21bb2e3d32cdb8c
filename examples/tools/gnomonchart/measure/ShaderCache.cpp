// SPDX-License-Identifier: MIT
#include "ShaderCache.h"

#include <cstdlib>
#include <string>

namespace gnomon::examples {
namespace fs = std::filesystem;

ShaderCache::ShaderCache() {
    std::string name = (fs::temp_directory_path() / "gnomonchart-XXXXXX").string();
    if (!mkdtemp(name.data())) {
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
        return;
    }
    _folder = name;
    setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);
    setenv("MESA_SHADER_CACHE_DIR", name.c_str(), 1);
}

ShaderCache::~ShaderCache() {
    std::error_code ignored;
    if (!_folder.empty()) fs::remove_all(_folder, ignored);
}

/// Mesa keeps a folder for its own bookkeeping, with a folder in it for every first two digits of a shader's hash.
void ShaderCache::empty() const {
    std::error_code ignored;
    if (_folder.empty()) return;
    for (const fs::directory_entry& cache : fs::directory_iterator(_folder, ignored))
        for (const fs::directory_entry& shaders : fs::directory_iterator(cache, ignored))
            if (shaders.is_directory(ignored)) fs::remove_all(shaders, ignored);
}

} // namespace gnomon::examples
