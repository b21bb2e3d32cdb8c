// SPDX-License-Identifier: MIT
// addshadows FILE: shows a scene file in a window, with shadows by whichever technique costs least.
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowCasterGroup.h>

#include <osg/DisplaySettings>
#include <osgDB/ReadFile>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>

#include <iostream>

int main(int argc, char** argv) {
    osg::ref_ptr<osg::Node> scene = argc == 2 ? osgDB::readRefNodeFile(argv[1]) : nullptr;
    if (!scene) {
        std::cerr << "addshadows: no scene file can be read. Give one with a ground, for example data/lab8.osgt.\n";
        return 1;
    }
    osgViewer::Viewer viewer;
    // [lines]
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    group->addChild(scene);
    group->addChild(new gnomon::AutoShadowTechnique);
    viewer.setSceneData(group);
    // [/lines]
    const osg::BoundingSphere& all = scene->getBound();
    osg::ref_ptr<osgGA::TrackballManipulator> hand = new osgGA::TrackballManipulator;
    hand->setHomePosition(all.center() + osg::Vec3d(-1, -2, 1.5) * all.radius(), all.center(), osg::Vec3d(0, 0, 1));
    viewer.setCameraManipulator(hand);
    viewer.setLightingMode(osg::View::SKY_LIGHT);
    viewer.getLight()->setPosition(osg::Vec4(1, -1, 2, 0));
    viewer.realize();
    if (viewer.isRealized()) return viewer.run();
    std::cerr << "addshadows: no window can be opened. Set DISPLAY to an X server with OpenGL.\n";
    return 1;
}
