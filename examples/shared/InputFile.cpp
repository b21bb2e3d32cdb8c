// SPDX-License-Identifier: MIT
#include "InputFile.h"
#include "OutputFile.h"
#include "SceneSetup.h"

#include <gnomon/SceneProps.h>

#include <osg/Notify>
#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <unistd.h>

namespace gnomon::examples {
namespace {

using ReadResult = osgDB::ReaderWriter::ReadResult;

/// What a file is to hold, in words, and osgDB::Registry's method for it.
struct FileKind {
    const char* article; ///< "a scene"
    const char* formats; ///< "obj, osgt, …"
    ReadResult (*byName)(osgDB::Registry& registry, const std::string& file);
    /// Of .osgb; null: that is not a kind such a file can hold.
    ReadResult (*fromStream)(osgDB::ReaderWriter& reader, std::istream& in, const osgDB::Options* options) = nullptr;
};

constexpr FileKind scene{
    "a scene", "obj, osgt, ive, stl, 3ds, …",
    [](osgDB::Registry& registry, const std::string& name) { return registry.readNode(name, registry.getOptions()); },
    [](osgDB::ReaderWriter& reader, std::istream& in, const osgDB::Options* options) {
        return reader.readNode(in, options);
    }};
constexpr FileKind elevation{"an elevation model", "tif.gdal, asc.gdal, hgt.gdal, vrt.gdal, …",
                             [](osgDB::Registry& registry, const std::string& name) {
                                 return registry.readHeightField(name, registry.getOptions());
                             }};
constexpr FileKind picture{
    "an image", "tif, osgb, png, …",
    [](osgDB::Registry& registry, const std::string& name) { return registry.readImage(name, registry.getOptions()); },
    [](osgDB::ReaderWriter& reader, std::istream& in, const osgDB::Options* options) {
        return reader.readImage(in, options);
    }};

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

    static inline std::string _sentence;
    std::array<void (*)(int), signals.size()> _before{};
};

/// Hears what OpenSceneGraph says while it lives: a line that was said before is not said again, and classes that no plugin
/// knows are kept for a sentence. Readers of text say the same of each thing behind the end of a file that is cut off.
class Listener {
public:
    Listener() { osg::setNotifyHandler(_handler); }
    ~Listener() { osg::setNotifyHandler(_handler->before); }
    Listener(const Listener&) = delete;
    Listener& operator=(const Listener&) = delete;

    /// "gnomon::HaloNode, gnomon::PlanarShadowNode"; empty: none.
    std::string unknownClasses() const {
        std::string text;
        for (const std::string& name : _handler->unknown) text += (text.empty() ? "" : ", ") + name;
        return text;
    }

private:
    struct Handler : public osg::NotifyHandler {
        void notify(osg::NotifySeverity severity, const char* message) override {
            static const std::string start = "InputStream::readObject(): Unsupported wrapper class ";
            const std::string text = message;
            if (text.rfind(start, 0) == 0)
                unknown.insert(text.substr(start.size(), text.find_last_not_of('\n') + 1 - start.size()));
            else if (said.insert(text).second && before)
                before->notify(severity, message);
        }
        osg::ref_ptr<osg::NotifyHandler> before = osg::getNotifyHandler();
        std::set<std::string> said, unknown;
    };
    osg::ref_ptr<Handler> _handler = new Handler;
};

/// While it lives, each file that a reader finds counts as read: the scene's own, its materials, its textures.
class InputNotes {
public:
    InputNotes() { registry().setFindFileCallback(new Finder); }
    ~InputNotes() { registry().setFindFileCallback(_before); }
    InputNotes(const InputNotes&) = delete;
    InputNotes& operator=(const InputNotes&) = delete;

private:
    struct Finder : public osgDB::FindFileCallback {
        std::string findDataFile(const std::string& name, const osgDB::Options* options,
                                 osgDB::CaseSensitivity sensitivity) override {
            const std::string file = osgDB::FindFileCallback::findDataFile(name, options, sensitivity);
            noteInput(file);
            return file;
        }
    };
    static osgDB::Registry& registry() { return *osgDB::Registry::instance(); }

    const osg::ref_ptr<osgDB::FindFileCallback> _before = registry().getFindFileCallback();
};

/// OpenSceneGraph's reader goes on at the end of a file that is cut off, with whatever number of things it last read: for
/// hours, or until memory ends. So the end is an exception.
ReadResult readBinary(osgDB::Registry& registry, const std::string& file, const FileKind& kind) {
    const std::string path = osgDB::findDataFile(file);
    std::ifstream in(path, std::ios::binary);
    osgDB::ReaderWriter* reader = registry.getReaderWriterForExtension("osgb");
    if (!in || !reader || !kind.fromStream) return kind.byName(registry, file);
    osg::ref_ptr<osgDB::Options> options =
        registry.getOptions() ? registry.getOptions()->cloneOptions() : new osgDB::Options;
    options->getDatabasePathList().push_front(osgDB::getFilePath(path));
    in.exceptions(std::ios::failbit | std::ios::badbit);
    return kind.fromStream(*reader, in, options);
}

/// With every way of failing turned into a result.
ReadResult guarded(const std::string& file, const std::string& sentence, const FileKind& kind) {
    const CrashGuard guard(sentence);
    try {
        osgDB::Registry& registry = *osgDB::Registry::instance();
        return osgDB::getLowerCaseFileExtension(file) == "osgb" ? readBinary(registry, file, kind)
                                                                : kind.byName(registry, file);
    } catch (const std::exception&) {
        return ReadResult::ERROR_IN_READING_FILE;
    }
}

constexpr const char* damaged = "it is damaged, or it does not match its name";

/// That the file cannot be read as what it is to hold, and how an elevation model is read.
std::string unreadSentence(const std::string& file, const FileKind& kind, const std::string& cause = damaged) {
    const std::string start = quoted(file) + " cannot be read as " + kind.article + ": ";
    const std::string ending = osgDB::getLowerCaseFileExtension(file);
    const std::string byGdal = ending == "gdal" ? file : file + ".gdal";
    if (&kind == &elevation && ending != "gdal")
        return start + "its name does not say that GDAL is to read it. Give " + quoted(byGdal) + ".";
    for (const char* each : {"asc", "dem", "gdal", "hgt", "vrt"})
        if (&kind == &scene && ending == each)
            return start + "by its name it is an elevation model. Use arl_terrain " + quoted(byGdal) + ".";
    return start + cause + ". Allowed: " + kind.formats + ".";
}

/// The name as far as it is a file's: endings may only choose a reader, as .gdal does, or move what is read, as .30,0,0.rot does.
/// Empty: there is no such file.
std::string fileIn(const std::string& name) {
    const std::string shorter = osgDB::getNameLessExtension(name);
    if (!osgDB::findDataFile(name).empty()) return name;
    return shorter != name ? fileIn(shorter) : "";
}

/// Why a file that is there cannot be read. The ending .gdal chooses GDAL, whatever the file's own is.
std::string causeOf(const std::string& name) {
    const std::string ending = osgDB::getLowerCaseFileExtension(fileIn(name));
    const bool hasPlugin = ending.empty() || osgDB::getLowerCaseFileExtension(name) == "gdal" ||
                           osgDB::Registry::instance()->getReaderWriterForExtension(ending);
    return hasPlugin ? damaged : "no plugin of OpenSceneGraph here reads files that end in ." + ending;
}

/// Reads an object, of whatever class, -O options included. A reader that crashes on a damaged file ends the program with the
/// damaged file's sentence and status 1; .osgb that ends early is told at its end.
/// @throws std::runtime_error, one sentence, for a file that is missing, a directory, damaged or of another type.
ReadResult readFile(const std::string& file, const std::string& program, const FileKind& kind) {
    if (osgDB::fileType(file) == osgDB::DIRECTORY)
        throw std::runtime_error(quoted(file) + " is a directory. Give " + kind.article + " file.");
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) &&
        !std::filesystem::is_regular_file(file, ignored)) // a pipe is waited for
        throw std::runtime_error(quoted(file) + " is a device or a pipe. Give " + kind.article + " file.");
    const Listener listener;
    const InputNotes notes;
    ReadResult result = guarded(file, program + ": " + unreadSentence(file, kind), kind);
    const std::string unknown = listener.unknownClasses();
    if (result.validObject() && !unknown.empty())
        std::cerr << program << ": note: " << quoted(file) << " is shown in part: no plugin here reads its " << unknown
                  << "." << std::endl;
    if (result.validObject()) return result;
    if (fileIn(file).empty()) throw std::runtime_error("there is no file " + quoted(file) + ".");
    if (!unknown.empty())
        throw std::runtime_error("no plugin here reads " + unknown + " in " + quoted(file) +
                                 ". Name the folder of its plugin's folder in OSG_LIBRARY_PATH.");
    throw std::runtime_error(unreadSentence(file, kind, causeOf(file)));
}

osg::ref_ptr<osg::Node> readOne(const std::string& file, const std::string& program) {
    ReadResult result = readFile(file, program, scene);
    const osg::ref_ptr<osg::Node> node = result.getNode();
    if (!node) throw std::runtime_error(unreadSentence(file, scene));
    if (!sceneBounds(*node).valid())
        throw std::runtime_error(quoted(file) +
                                 " holds nothing to draw. It is empty or damaged, or it does not match its name.");
    return node;
}

bool isLevelAtZero(const osg::HeightField& field) {
    const auto& heights = field.getHeightList();
    return std::all_of(heights.begin(), heights.end(), [](float height) { return height == 0.0f; });
}

} // namespace

std::string quoted(const std::string& file) { return "\"" + file + "\""; }

osg::ref_ptr<osg::Node> readScene(const std::vector<std::string>& files, const std::string& program) {
    osg::ref_ptr<osg::Group> all = new osg::Group;
    for (const std::string& file : files) all->addChild(readOne(file, program));
    return all->getNumChildren() == 1 ? all->getChild(0) : all.get();
}

osg::ref_ptr<osg::HeightField> readElevation(const std::string& file, const std::string& program) {
    ReadResult result = readFile(file, program, elevation);
    osg::ref_ptr<osg::HeightField> field = result.getHeightField();
    if (!field || field->getNumColumns() < 2 || field->getNumRows() < 2)
        throw std::runtime_error(unreadSentence(file, elevation));
    if (isLevelAtZero(*field))
        throw std::runtime_error(quoted(file) +
                                 " has the height 0 everywhere. The data that it refers to may be missing or damaged.");
    return field;
}

osg::ref_ptr<osg::Image> readImage(const std::string& file, const std::string& program) {
    ReadResult result = readFile(file, program, picture);
    osg::ref_ptr<osg::Image> image = result.getImage();
    if (!image || image->s() < 1 || image->t() < 1 || !image->data())
        throw std::runtime_error(unreadSentence(file, picture));
    return image;
}

} // namespace gnomon::examples
