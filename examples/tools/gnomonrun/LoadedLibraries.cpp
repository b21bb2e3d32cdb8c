// SPDX-License-Identifier: MIT
#include "LoadedLibraries.h"

#include <cstddef>
#include <link.h>
#include <string>

namespace gnomon::examples {
namespace {

/// The name without its folder.
std::string fileOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

bool isOsgs(const std::string& file) {
    return file.rfind("libosg", 0) == 0 || file.rfind("libOpenThreads", 0) == 0 || file.rfind("osgdb_", 0) == 0;
}
bool isOurs(const std::string& file) { return file.rfind("gnomonrun", 0) == 0 || file.rfind("libgnomon", 0) == 0; }

const ElfW(Dyn) * dynamicPartOf(const dl_phdr_info& object) {
    for (std::size_t i = 0; i < object.dlpi_phnum; ++i)
        if (object.dlpi_phdr[i].p_type == PT_DYNAMIC)
            return reinterpret_cast<const ElfW(Dyn)*>(object.dlpi_addr + object.dlpi_phdr[i].p_vaddr);
    return nullptr;
}

bool needsOsg(const dl_phdr_info& object) {
    const ElfW(Dyn)* part = dynamicPartOf(object);
    const char* names = nullptr;
    for (const ElfW(Dyn)* entry = part; entry && entry->d_tag != DT_NULL; ++entry)
        if (entry->d_tag == DT_STRTAB) names = reinterpret_cast<const char*>(entry->d_un.d_ptr);
    if (!names || names < reinterpret_cast<const char*>(object.dlpi_addr)) return false; // the vDSO's are not moved
    for (const ElfW(Dyn)* entry = part; entry->d_tag != DT_NULL; ++entry)
        if (entry->d_tag == DT_NEEDED && isOsgs(names + entry->d_un.d_val)) return true;
    return false;
}

int look(dl_phdr_info* object, std::size_t, void* found) {
    const std::string file = fileOf(object->dlpi_name);
    if (!isOsgs(file) && !isOurs(file) && needsOsg(*object)) *static_cast<bool*>(found) = true;
    return 0;
}

} // namespace

bool programNeedsOsg() {
    bool found = false;
    dl_iterate_phdr(look, &found);
    return found;
}

} // namespace gnomon::examples
