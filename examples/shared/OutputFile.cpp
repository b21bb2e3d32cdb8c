// SPDX-License-Identifier: MIT
#include "OutputFile.h"

#include <osgDB/FileNameUtils>
#include <osgDB/Registry>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <unistd.h>

namespace gnomon::examples {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
    throw std::runtime_error("\"" + path.string() + "\" cannot be written: " + why + ".");
}

fs::path draftOf(const fs::path& path) {
    const std::string name = "." + path.stem().string() + "-" + std::to_string(getpid()) + path.extension().string();
    return path.parent_path() / name;
}

/// Of this process, without links in their paths.
std::set<fs::path>& inputs() {
    static std::set<fs::path> files;
    return files;
}

void requirePlace(const fs::path& path) {
    std::error_code ignored;
    if (inputs().count(fs::canonical(path, ignored))) refuse(path, "the program reads it. Give another name");
    const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
    if (!path.has_filename() || fs::is_directory(path, ignored)) refuse(path, "it is a directory. Give a file's name");
    if (!fs::is_directory(folder, ignored)) refuse(path, "there is no directory \"" + folder.string() + "\"");
    if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
        refuse(path, "it is not a regular file. Give another name");
}

/// Without alpha, which some formats refuse and no picture here needs.
osg::ref_ptr<osg::Image> opaque(const osg::Image& image) {
    osg::ref_ptr<osg::Image> result = new osg::Image;
    result->allocateImage(image.s(), image.t(), 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (int y = 0; y < image.t(); ++y)
        for (int x = 0; x < image.s(); ++x) std::copy_n(image.data(x, y), 3, result->data(x, y));
    return result;
}

/// True if OSG reads or writes nodes by this ending.
bool isScenes(const std::string& ending) {
    using Plugin = osgDB::ReaderWriter;
    const Plugin* plugin = ending.empty() ? nullptr : osgDB::Registry::instance()->getReaderWriterForExtension(ending);
    return plugin && plugin->supportedFeatures() & (Plugin::FEATURE_READ_NODE | Plugin::FEATURE_WRITE_NODE);
}

/// "png" of "a.png" and "A.PNG".
std::string endingOf(const fs::path& path) {
    const std::string ending = path.extension().string();
    return ending.empty() ? ending : osgDB::convertToLowerCase(ending.substr(1));
}

} // namespace

std::string imageBytes(const osg::Image& image, const std::string& ending) {
    osgDB::Registry* registry = osgDB::Registry::instance();
    osgDB::ReaderWriter* writer = ending.empty() ? nullptr : registry->getReaderWriterForExtension(ending);
    std::ostringstream bytes;
    const bool written = writer && writer->writeImage(image, bytes, registry->getOptions()).success();
    return written ? bytes.str() : "";
}

void requireFolder(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (!fs::is_directory(folder))
        throw std::runtime_error("\"" + folder.string() + "\" cannot be created as a folder: " + error.message() + ".");
}

void noteInput(const std::string& file) {
    std::error_code none;
    const fs::path path = fs::canonical(file, none);
    if (!none) inputs().insert(path);
}

OutputFile::OutputFile(const std::string& path) : _path(path), _draft(draftOf(path)) {
    requirePlace(_path);
    if (!std::ofstream(_draft)) refuse(_path, "its directory is not writable. Give another one");
    removeDraft(); // so that none is left if something in between crashes
}

OutputFile::~OutputFile() { removeDraft(); }

void OutputFile::removeDraft() const {
    std::error_code ignored;
    fs::remove(_draft, ignored);
}

void OutputFile::requireImage() const {
    constexpr const char* allowed = "Allowed: png, jpg, bmp, tif, rgb";
    osg::ref_ptr<osg::Image> dot = new osg::Image;
    dot->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE);
    std::fill(dot->data(), dot->data() + dot->getTotalSizeInBytes(), static_cast<unsigned char>(0));
    const bool isImages = !imageBytes(*dot, endingOf(_path)).empty();
    if (isImages && isScenes(endingOf(_path))) refuse(_path, std::string("its ending is a scene's. ") + allowed);
    if (!isImages) refuse(_path, std::string("OpenSceneGraph writes no such images. ") + allowed);
}

void OutputFile::requireData() const {
    for (const char* kind : {".osgb", ".osgt", ".osgx"})
        if (_path.extension() == kind) return;
    refuse(_path, "this format cannot hold the data. Allowed: .osgb, .osgt, .osgx");
}

void OutputFile::writeData(const osg::Image& image) { write(imageBytes(image, endingOf(_path))); }

void OutputFile::write(const osg::Image& image) { write(imageBytes(*opaque(image), endingOf(_path))); }

void OutputFile::write(const std::string& text) {
    requirePlace(_path);
    std::ofstream out(_draft, std::ios::binary);
    out << text << std::flush;
    if (!out) refuse(_path, "only a part was written. Check that the disk is not full");
    finish();
}

void OutputFile::finish() {
    std::error_code error;
    fs::rename(_draft, _path, error);
    if (error) refuse(_path, error.message());
}

} // namespace gnomon::examples
