// SPDX-License-Identifier: MIT
#include "InputFile.h"

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>

#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <unistd.h>

namespace gnomon::examples {
namespace {

/// While it lives, a crash prints one sentence and ends the program: readers of old formats trust their input.
class CrashGuard {
public:
    explicit CrashGuard(const std::string& sentence);
    ~CrashGuard();
    CrashGuard(const CrashGuard&) = delete;
    CrashGuard& operator=(const CrashGuard&) = delete;

private:
    static constexpr std::array<int, 4> signals = {SIGSEGV, SIGABRT, SIGFPE, SIGBUS};

    static void say(int);

    static std::string _sentence;
    std::array<void (*)(int), signals.size()> _before{};
};

std::string CrashGuard::_sentence;

CrashGuard::CrashGuard(const std::string& sentence) {
    _sentence = sentence + "\n";
    for (std::size_t i = 0; i < signals.size(); ++i) _before[i] = std::signal(signals[i], say);
}

CrashGuard::~CrashGuard() {
    for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], _before[i]);
}

void CrashGuard::say(int) {
    const ssize_t written = write(STDERR_FILENO, _sentence.data(), _sentence.size());
    _exit(written > 0 ? 1 : 2);
}

/// OpenSceneGraph's reader goes on at the end of a file that is cut off, with whatever number of things it last read: for
/// hours, or until memory ends. So the end is an exception.
ReadResult readBinary(osgDB::Registry& registry, const std::string& file, const ReadMethod& read) {
    const std::string path = osgDB::findDataFile(file);
    std::ifstream in(path, std::ios::binary);
    osgDB::ReaderWriter* reader = registry.getReaderWriterForExtension("osgb");
    if (!in || !reader || !read.fromStream) return read.byName(registry, file);
    osg::ref_ptr<osgDB::Options> options =
        registry.getOptions() ? registry.getOptions()->cloneOptions() : new osgDB::Options;
    options->getDatabasePathList().push_front(osgDB::getFilePath(path));
    in.exceptions(std::ios::failbit | std::ios::badbit);
    return read.fromStream(*reader, in, options);
}

/// With every way of failing turned into a result.
ReadResult guarded(const std::string& file, const std::string& sentence, const ReadMethod& read) {
    const CrashGuard guard(sentence);
    try {
        osgDB::Registry& registry = *osgDB::Registry::instance();
        return osgDB::getLowerCaseFileExtension(file) == "osgb" ? readBinary(registry, file, read)
                                                                : read.byName(registry, file);
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
    return quoted(file) + " cannot be read as " + kind.article +
           ": it is damaged, or it does not match its name. Allowed: " + kind.formats + ".";
}

std::optional<std::string> fileBytes(const std::filesystem::path& file) {
    std::error_code ignored;
    std::ifstream in(file, std::ios::binary);
    if (!in || std::filesystem::is_directory(file, ignored)) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(in), {});
}

ReadResult readFile(const std::string& file, const std::string& program, const FileKind& kind, const ReadMethod& read) {
    if (osgDB::fileType(file) == osgDB::DIRECTORY)
        throw std::runtime_error(quoted(file) + " is a directory. Give " + kind.article + " file.");
    ReadResult result = guarded(file, program + ": " + damagedSentence(file, kind), read);
    if (result.validObject()) return result;
    if (!isThere(file) && result.status() != ReadResult::ERROR_IN_READING_FILE)
        throw std::runtime_error("there is no file " + quoted(file) + ", or no reader for its type.");
    throw std::runtime_error(damagedSentence(file, kind));
}

} // namespace gnomon::examples
