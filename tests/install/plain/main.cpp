// SPDX-License-Identifier: MIT
// A program against an installed Gnomon, by pkg-config, that needs OpenSceneGraph and GLM alone: it puts a box into shadow by
// a line of text, saves the scene and reads it again, and reads the box by a name with the suffix.
#include <gnomon/SceneProps.h>
#include <gnomon/SceneSpec.h>
#include <gnomon/ShadowMapTechnique.h>
#include <osg/Geode>
#include <osg/ShapeDrawable>
#include <osg/io_utils>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>

#include <cstdio>
#include <iostream>

/// The size of the map of the scene's technique; 0: it has none.
static int mapSize(osg::Node* scene) {
    const osg::Group* group = scene ? scene->asGroup() : nullptr;
    if (!group || group->getNumChildren() < 3) return 0;
    const auto* technique = dynamic_cast<const gnomon::ShadowMapTechnique*>(group->getChild(2));
    return technique ? technique->getSize() : 0;
}

static osg::ref_ptr<osg::Node> writtenAndRead(const osg::Node& node, const std::string& file,
                                              const std::string& suffix = "") {
    osgDB::writeNodeFile(node, file);
    const osg::ref_ptr<osg::Node> again = osgDB::readRefNodeFile(file + suffix);
    std::remove(file.c_str());
    return again;
}

static int failures = 0;

static void expectSize(osg::Node* scene, int size, const std::string& what) {
    const int found = mapSize(scene);
    if (found == size) return;
    std::cerr << what << ": the map's size is " << found << " and not " << size << std::endl;
    ++failures;
}

int main() {
    osg::ref_ptr<osg::Geode> box = new osg::Geode;
    box->addDrawable(new osg::ShapeDrawable(new osg::Box({0, 0, 2}, 1)));
    const auto group = gnomon::shadowedScene(*box, gnomon::parseSceneSpec("map:size=512+ground"));
    std::cout << gnomon::sceneBounds(*group)._max << std::endl;
    expectSize(group, 512, "by text");
    for (const std::string kind : {"osgt", "osgb", "osgx"})
        expectSize(writtenAndRead(*group, "plain_scene." + kind), 512, kind);
    expectSize(writtenAndRead(*box, "plain_box.osgt", ".(map:size=256+ground).gnomon"), 256, "by a suffix");
    return failures;
}
