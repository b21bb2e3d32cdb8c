// SPDX-License-Identifier: MIT
#include "SceneFile.h"
#include "InputFile.h"
#include "SceneCamera.h"

#include <osg/Group>

#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr FileKind scene{"a scene", "obj, osgt, ive, stl, 3ds, …"};

constexpr ReadMethod nodes{
    [](osgDB::Registry& registry, const std::string& name) { return registry.readNode(name, registry.getOptions()); },
    [](osgDB::ReaderWriter& reader, std::istream& in, const osgDB::Options* options) {
        return reader.readNode(in, options);
    }};

osg::ref_ptr<osg::Node> readOne(const std::string& file, const std::string& program) {
    ReadResult result = readFile(file, program, scene, nodes);
    const osg::ref_ptr<osg::Node> node = result.getNode();
    if (!node) throw std::runtime_error(damagedSentence(file, scene));
    if (!sceneBounds(*node).valid())
        throw std::runtime_error(quoted(file) +
                                 " holds nothing to draw. It is empty or damaged, or it does not match its name.");
    return node;
}

} // namespace

osg::ref_ptr<osg::Node> readScene(const std::vector<std::string>& files, const std::string& program) {
    osg::ref_ptr<osg::Group> all = new osg::Group;
    for (const std::string& file : files) all->addChild(readOne(file, program));
    return all->getNumChildren() == 1 ? all->getChild(0) : all.get();
}

} // namespace gnomon::examples
