// SPDX-License-Identifier: MIT
#include "SceneFile.h"
#include "SceneBounds.h"

#include <osg/Group>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <array>
#include <csignal>
#include <stdexcept>
#include <unistd.h>

namespace gnomon::examples {
namespace {

using Result = osgDB::ReaderWriter::ReadResult;

std::string quoted(const std::string& file) { return "\"" + file + "\""; }

std::string damagedSentence(const std::string& file) {
    return quoted(file) +
           " cannot be read as a scene: it is damaged or not what its name says (obj, osgt, ive, stl, 3ds, "
           "… can be read).";
}

/// While it lives, a crash prints one sentence and ends the program: readers of old formats trust their input.
class CrashGuard {
public:
    explicit CrashGuard(const std::string& sentence) {
        _sentence = sentence + "\n";
        for (std::size_t i = 0; i < signals.size(); ++i) _before[i] = std::signal(signals[i], say);
    }
    ~CrashGuard() {
        for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], _before[i]);
    }
    CrashGuard(const CrashGuard&) = delete;
    CrashGuard& operator=(const CrashGuard&) = delete;

private:
    static constexpr std::array<int, 4> signals = {SIGSEGV, SIGABRT, SIGFPE, SIGBUS};

    static void say(int) {
        const ssize_t written = write(STDERR_FILENO, _sentence.data(), _sentence.size());
        _exit(written > 0 ? 1 : 2);
    }

    static std::string _sentence;
    std::array<void (*)(int), signals.size()> _before{};
};

std::string CrashGuard::_sentence;

/// Reads, with every way of failing turned into a result.
Result read(const std::string& file, const std::string& program) {
    const CrashGuard guard(program + ": " + damagedSentence(file));
    try {
        osgDB::Registry* registry = osgDB::Registry::instance();
        return registry->readNode(file, registry->getOptions());
    } catch (const std::exception&) {
        return Result::ERROR_IN_READING_FILE;
    }
}

std::string whyNot(const std::string& file, const Result& result) {
    if (osgDB::findDataFile(file).empty() && result.status() != Result::ERROR_IN_READING_FILE)
        return "there is no file " + quoted(file) + ", or no reader for its type.";
    return damagedSentence(file);
}

osg::ref_ptr<osg::Node> readOne(const std::string& file, const std::string& program) {
    if (osgDB::fileType(file) == osgDB::DIRECTORY)
        throw std::runtime_error(quoted(file) + " is a directory; a scene file is needed.");
    Result result = read(file, program);
    osg::ref_ptr<osg::Node> node = result.getNode();
    if (!node) throw std::runtime_error(whyNot(file, result));
    if (!sceneBounds(*node).valid())
        throw std::runtime_error(quoted(file) +
                                 " holds nothing to draw: it is empty, damaged or not what its name says.");
    return node;
}

} // namespace

osg::ref_ptr<osg::Node> readScene(const std::vector<std::string>& files, const std::string& program) {
    osg::ref_ptr<osg::Group> all = new osg::Group;
    for (const std::string& file : files) all->addChild(readOne(file, program));
    return all->getNumChildren() == 1 ? all->getChild(0) : all.get();
}

} // namespace gnomon::examples
