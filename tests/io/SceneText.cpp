// SPDX-License-Identifier: MIT
#include "SceneText.h"

#include <osgDB/Registry>

#include <sstream>

namespace test {
namespace {

osgDB::ReaderWriter& plugin(const std::string& kind) {
    return *osgDB::Registry::instance()->getReaderWriterForExtension(kind);
}

osg::ref_ptr<osgDB::Options> optionsFor(const std::string& kind) {
    osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
    const char* fileType = kind == "osgt" ? "Ascii" : kind == "osgx" ? "XML" : "Binary";
    options->setPluginStringData("fileType", fileType);
    return options;
}

osgDB::ReaderWriter::ReadResult read(const std::string& contents, const std::string& kind) {
    std::istringstream file(contents);
    return plugin(kind).readNode(file, optionsFor(kind));
}

} // namespace

void usePluginsOfThisBuild() { osgDB::Registry::instance()->getLibraryFilePathList().push_front(GNOMON_LIBRARIES); }

std::string written(const osg::Node& node, const std::string& kind) {
    std::ostringstream file;
    return plugin(kind).writeNode(node, file, optionsFor(kind)).success() ? file.str() : std::string();
}

osg::ref_ptr<osg::Node> loaded(const std::string& contents, const std::string& kind) {
    return read(contents, kind).getNode();
}

std::string whyRefused(const std::string& contents, const std::string& kind) { return read(contents, kind).message(); }

} // namespace test
