// SPDX-License-Identifier: MIT
// A headless node test in a few lines, against an installed Gnomon: the shadow of a box changes the picture.
#include <gnomon/HeadlessContext.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <osg/ShapeDrawable>
#include <osgViewer/Viewer>

#include <cstring>

static osg::ref_ptr<osg::Image> picture(osg::Node* scene) {
    gnomon::HeadlessContext context(128, 128);
    osgViewer::Viewer viewer;
    context.attach(*viewer.getCamera());
    viewer.setLightingMode(osg::View::SKY_LIGHT);
    viewer.getLight()->setPosition(osg::Vec4(1, 1, 2, 0));
    viewer.getCamera()->setViewMatrixAsLookAt({-6, -8, 8}, {0, 0, 0}, {0, 0, 1});
    viewer.setSceneData(scene);
    viewer.frame();
    return context.image();
}

int main() {
    osg::ref_ptr<osg::Geode> scene = new osg::Geode;
    scene->addDrawable(new osg::ShapeDrawable(new osg::Box({0, 0, 2}, 1)));
    scene->addDrawable(osg::createTexturedQuadGeometry({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}));
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    group->addChild(scene);
    const osg::ref_ptr<osg::Image> lit = picture(group);
    group->addChild(new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0)));
    const osg::ref_ptr<osg::Image> shadowed = picture(group);
    return std::memcmp(lit->data(), shadowed->data(), lit->getTotalSizeInBytes()) == 0;
}
