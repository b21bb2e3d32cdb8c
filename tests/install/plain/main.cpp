// SPDX-License-Identifier: MIT
// A program against an installed Gnomon, by pkg-config, that needs OpenSceneGraph and GLM alone: it puts a box into shadow by
// a line of text.
#include <gnomon/SceneProps.h>
#include <gnomon/SceneSpec.h>
#include <gnomon/ShadowMapTechnique.h>
#include <osg/Geode>
#include <osg/ShapeDrawable>
#include <osg/io_utils>

#include <iostream>

int main() {
    osg::ref_ptr<osg::Geode> box = new osg::Geode;
    box->addDrawable(new osg::ShapeDrawable(new osg::Box({0, 0, 2}, 1)));
    const auto group = gnomon::shadowedScene(*box, gnomon::parseSceneSpec("map+ground"));
    const auto* technique = dynamic_cast<const gnomon::ShadowMapTechnique*>(group->getChild(2));
    std::cout << gnomon::sceneBounds(*group)._max << std::endl;
    return technique && technique->getSize() == 1024 ? 0 : 1;
}
