// SPDX-License-Identifier: MIT
#include "SceneFile.h"
#include "CrashGuard.h"
#include "SceneBounds.h"

#include <osg/Group>
#include <osgDB/FileUtils>
#include <osgDB/Registry>

#include <stdexcept>

namespace gnomon::examples {
namespace {

using Result = osgDB::ReaderWriter::ReadResult;

std::string quoted(const std::string& file) { return "\"" + file + "\""; }

std::string damagedSentence(const std::string& file) {
    return quoted(file) +
           " cannot be read as a scene: it is damaged or not what its name says (obj, osgt, ive, stl, 3ds, "
           "… can be read).";
}

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
