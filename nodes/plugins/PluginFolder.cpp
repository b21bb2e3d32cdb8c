// SPDX-License-Identifier: MIT
// Part of the shared library: a program that links it saves and reads the kit's nodes, wherever the library is installed.
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <dlfcn.h>

namespace {

/// Has OpenSceneGraph look beside the library, where its plugins' folder lies, after the folders that it knows.
bool namePluginFolder() {
    Dl_info library{};
    if (!dladdr(reinterpret_cast<const void*>(&namePluginFolder), &library)) return false;
    const std::string file = osgDB::getRealPath(library.dli_fname);
    osgDB::Registry::instance()->getLibraryFilePathList().push_back(osgDB::getFilePath(file));
    return true;
}

[[maybe_unused]] const bool isNamed = namePluginFolder();

} // namespace
