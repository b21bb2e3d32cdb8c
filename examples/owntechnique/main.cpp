// SPDX-License-Identifier: MIT
// owntechnique: a ring of balls in a window, with the blobs of BlobShadow.h for shadows.
#include "BlobShadow.h"

#include <gnomon/ShadowCasterGroup.h>

#include <osg/Geode>
#include <osg/ShapeDrawable>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>

#include <cmath>

int main() {
    osg::ref_ptr<osg::Geode> ground = new osg::Geode, balls = new osg::Geode;
    ground->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(0, 0, -0.05f), 12, 12, 0.1f)));
    for (int i = 0; i < 8; ++i) {
        const double angle = 0.25 * osg::PI * i;
        balls->addDrawable(new osg::ShapeDrawable(
            new osg::Sphere(osg::Vec3d(3.0 * std::cos(angle), 3.0 * std::sin(angle), 1.0), 0.3f + 0.06f * float(i))));
    }
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    group->addChild(ground);
    group->addChild(balls);
    group->setCasters({balls}); // the ground has no blob
    group->addChild(new BlobShadow);
    osgViewer::Viewer viewer;
    viewer.setSceneData(group);
    viewer.setLightingMode(osg::View::SKY_LIGHT);
    viewer.getLight()->setPosition(osg::Vec4(1, -1, 2, 0));
    osg::ref_ptr<osgGA::TrackballManipulator> hand = new osgGA::TrackballManipulator;
    hand->setHomePosition(osg::Vec3d(-7, -11, 9), osg::Vec3d(), osg::Vec3d(0, 0, 1));
    viewer.setCameraManipulator(hand);
    return viewer.run();
}
