// SPDX-License-Identifier: MIT
// The pseudo-loader: any program that loads files shows shadows by a suffix on the name, "cow.osgt.(map).gnomon".
#include <gnomon/SceneSpec.h>

#include <osgDB/FileNameUtils>
#include <osgDB/FileUtils>
#include <osgDB/ReaderWriter>
#include <osgDB/Registry>

#include <algorithm>
#include <stdexcept>

namespace {

constexpr const char* spelling = "Write FILE.(map).gnomon, with the technique and its settings between the brackets.";

/// A name with the suffix, taken apart.
struct SuffixedName {
    std::string file, items;
};

/// True if a text begins with an item's name: "map", "map:edges=smooth".
bool beginsWithItem(const std::string& text) {
    const std::string name = text.substr(0, text.find_first_of(":+"));
    const std::vector<std::string> techniques = gnomon::shadowTechniques(), parts = gnomon::sceneParts();
    return std::count(techniques.begin(), techniques.end(), name) || std::count(parts.begin(), parts.end(), name);
}

/// "FILE.map:edges=smooth", which needs no quotes in a shell; numbers in it may have a point of their own.
SuffixedName withoutBrackets(const std::string& name) {
    for (std::size_t dot = name.rfind('.'); dot != std::string::npos && dot > 0; dot = name.rfind('.', dot - 1))
        if (beginsWithItem(name.substr(dot + 1))) return {name.substr(0, dot), name.substr(dot + 1)};
    return {name, ""};
}

/// @param name  without ".gnomon". @throws std::invalid_argument
SuffixedName takeApart(const std::string& name) {
    const std::size_t open = name.rfind(".(");
    const bool closed = !name.empty() && name.back() == ')';
    if (closed != (open != std::string::npos))
        throw std::invalid_argument(std::string("its brackets do not match. ") + spelling);
    const SuffixedName result = closed
                                    ? SuffixedName{name.substr(0, open), name.substr(open + 2, name.size() - open - 3)}
                                    : withoutBrackets(name);
    if (result.file.empty()) throw std::invalid_argument(std::string("it names no file. ") + spelling);
    return result;
}

/// Wraps what another reader gives for the name without the suffix.
class ReaderWriterGnomon : public osgDB::ReaderWriter {
public:
    ReaderWriterGnomon() { supportsExtension("gnomon", "Shadows by Gnomon: FILE.(map).gnomon"); }

    const char* className() const override { return "Gnomon's pseudo-loader of shadows"; }

    ReadResult readObject(const std::string& name, const osgDB::Options* options) const override {
        return readNode(name, options);
    }
    ReadResult readNode(const std::string& name, const osgDB::Options* options) const override {
        if (!acceptsExtension(osgDB::getLowerCaseFileExtension(name))) return ReadResult::FILE_NOT_HANDLED;
        try {
            const SuffixedName parts = takeApart(osgDB::getNameLessExtension(name));
            const gnomon::SceneSpec spec = gnomon::parseSceneSpec(parts.items);
            const osg::ref_ptr<osg::Node> scene = read(parts.file, options);
            return gnomon::shadowedScene(*scene, spec).get();
        } catch (const std::exception& error) {
            return std::string("gnomon: ") + error.what();
        }
    }

private:
    /// @throws std::runtime_error
    static osg::ref_ptr<osg::Node> read(const std::string& file, const osgDB::Options* options) {
        ReadResult result = osgDB::Registry::instance()->readNode(file, options);
        if (result.validNode()) return result.takeNode();
        const std::string reason = result.message();
        throw std::runtime_error("the file \"" + file + "\" cannot be read" +
                                 (reason.empty() ? ". Check its name and its type." : ": " + reason));
    }
};

REGISTER_OSGPLUGIN(gnomon, ReaderWriterGnomon)

} // namespace
