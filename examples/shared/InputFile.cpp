// SPDX-License-Identifier: MIT
#include "InputFile.h"
#include "CrashGuard.h"

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace gnomon::examples {
namespace {

/// With every way of failing turned into a result.
ReadResult guarded(const std::string& file, const std::string& sentence, ReadMethod read) {
    const CrashGuard guard(sentence);
    try {
        return read(*osgDB::Registry::instance(), file);
    } catch (const std::exception&) {
        return ReadResult::ERROR_IN_READING_FILE;
    }
}

/// Also where the last ending only chooses a reader, as .gdal does.
bool isThere(const std::string& file) {
    return !osgDB::findDataFile(file).empty() || !osgDB::findDataFile(osgDB::getNameLessExtension(file)).empty();
}

} // namespace

std::string quoted(const std::string& file) { return "\"" + file + "\""; }

std::string damagedSentence(const std::string& file, const FileKind& kind) {
    return quoted(file) + " cannot be read as " + kind.article + ": it is damaged or not what its name says (" +
           kind.formats + " can be read).";
}

std::optional<std::string> fileBytes(const std::filesystem::path& file) {
    std::error_code ignored;
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file, ignored)) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(in), {});
}

ReadResult readFile(const std::string& file, const std::string& program, const FileKind& kind, ReadMethod read) {
    if (osgDB::fileType(file) == osgDB::DIRECTORY)
        throw std::runtime_error(quoted(file) + " is a directory; " + kind.article + " file is needed.");
    ReadResult result = guarded(file, program + ": " + damagedSentence(file, kind), read);
    if (result.validObject()) return result;
    if (!isThere(file) && result.status() != ReadResult::ERROR_IN_READING_FILE)
        throw std::runtime_error("there is no file " + quoted(file) + ", or no reader for its type.");
    throw std::runtime_error(damagedSentence(file, kind));
}

} // namespace gnomon::examples
