// SPDX-License-Identifier: MIT
#pragma once
#include <osgDB/Registry>

#include <filesystem>
#include <istream>
#include <optional>
#include <string>

namespace gnomon::examples {

/// What a file is to hold, in words.
struct FileKind {
    const char* article; ///< "a scene"
    const char* formats; ///< "obj, osgt, …"
};

std::string quoted(const std::string& file);
/// That the file cannot be read as what it is to hold.
std::string damagedSentence(const std::string& file, const FileKind& kind);

/// All of a file; nullopt if it is a directory or cannot be opened.
std::optional<std::string> fileBytes(const std::filesystem::path& file);

/// Reads by one of osgDB::Registry's methods, -O options included. A reader that crashes on a damaged file ends the
/// program with the damaged file's sentence and status 1; .osgb that ends early is told at its end.
/// @return an object, of whatever class.
/// @throws std::runtime_error, one sentence, for a file that is missing, a directory, damaged or of another type.
using ReadResult = osgDB::ReaderWriter::ReadResult;
struct ReadMethod {
    ReadResult (*byName)(osgDB::Registry& registry, const std::string& file);
    /// Of .osgb; null: that is not a kind such a file can hold.
    ReadResult (*fromStream)(osgDB::ReaderWriter& reader, std::istream& in, const osgDB::Options* options) = nullptr;
};
ReadResult readFile(const std::string& file, const std::string& program, const FileKind& kind, const ReadMethod& read);

} // namespace gnomon::examples
