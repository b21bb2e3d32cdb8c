// SPDX-License-Identifier: MIT
// Culls a scene by osgUtil::SceneView, as programs with a window system of their own do. It needs no window.
#include <osg/Geode>
#include <osg/ShapeDrawable>
#include <osgUtil/SceneView>

int main() {
    osg::ref_ptr<osg::Geode> scene = new osg::Geode;
    scene->addDrawable(new osg::ShapeDrawable(new osg::Sphere));
    osg::ref_ptr<osgUtil::SceneView> view = new osgUtil::SceneView;
    view->setDefaults();
    view->setSceneData(scene);
    view->setViewport(0, 0, 320, 240);
    view->cull();
    return 0;
}
