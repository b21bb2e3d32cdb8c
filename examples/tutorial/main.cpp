// SPDX-License-Identifier: MIT
// tutorial: the program that docs/tutorial.md writes step by step. A town in the afternoon sun.
// [includes]
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowReport.h>
#include <gnomon/ShadowStats.h>
#include <gnomon/SunClock.h>

#include <osg/Geode>
#include <osg/Material>
#include <osg/ShapeDrawable>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>
#include <osgViewer/ViewerEventHandlers>

#include <iostream>
// [/includes]

// [box]
osg::ref_ptr<osg::Geode> makeBox(const osg::Vec3& middle, const osg::Vec3& size, const osg::Vec4& colour) {
    osg::ref_ptr<osg::Geode> box = new osg::Geode;
    box->addDrawable(new osg::ShapeDrawable(new osg::Box(middle, size.x(), size.y(), size.z())));
    osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, colour);
    material->setDiffuse(osg::Material::FRONT_AND_BACK, colour);
    box->getOrCreateStateSet()->setAttributeAndModes(material);
    return box;
}
// [/box]

// [town]
osg::ref_ptr<osg::Group> makeTown() {
    osg::ref_ptr<osg::Group> town = new osg::Group;
    osg::ref_ptr<osg::Geode> ground = makeBox({0, 0, -0.5f}, {120, 120, 1}, {0.35f, 0.5f, 0.3f, 1});
    ground->setName("ground");
    town->addChild(ground);
    for (int x = -2; x <= 2; ++x)
        for (int y = -2; y <= 2; ++y) {
            const float height = 6.0f + 3.0f * static_cast<float>((x * x + 2 * y * y) % 5); // metres
            const osg::Vec3 middle(20.0f * static_cast<float>(x), 20.0f * static_cast<float>(y), height / 2.0f);
            town->addChild(makeBox(middle, {9, 9, height}, {0.8f, 0.72f, 0.62f, 1}));
        }
    return town;
}
// [/town]

int main() {
    // [viewer]
    osg::ref_ptr<osg::Group> town = makeTown();
    osgViewer::Viewer viewer;
    viewer.setUpViewInWindow(50, 50, 800, 600);
    osg::ref_ptr<osgGA::TrackballManipulator> hand = new osgGA::TrackballManipulator;
    hand->setHomePosition({-70, -110, 70}, {0, 0, 0}, {0, 0, 1});
    viewer.setCameraManipulator(hand);
    // [/viewer]

    // [sun]
    const gnomon::SunClock clock(48.1, 11.6); // Munich: degrees north, degrees east
    const glm::dvec3 sun = clock.towards(*gnomon::julianDay("2026-06-21T15:00:00Z"));
    viewer.setLightingMode(osg::View::SKY_LIGHT);
    viewer.getLight()->setPosition(osg::Vec4d(sun.x, sun.y, sun.z, 0.0)); // w = 0: a direction
    // [/sun]

    // [shadow]
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
    group->addChild(town);
    group->addChild(technique);
    viewer.setSceneData(group);
    // [/shadow]

    // [statistics]
    osg::ref_ptr<osgViewer::StatsHandler> statistics = new osgViewer::StatsHandler; // the key s
    gnomon::addShadowStats(*statistics);
    viewer.addEventHandler(statistics);
    // [/statistics]

    // [report]
    technique->lastReport(); // from now on it is recorded
    viewer.frame();
    const gnomon::ShadowReport report = technique->lastReport();
    std::cout << report.text() << std::endl;
    for (const gnomon::ShadowDecision& decision : report.decisions) std::cout << decision.text() << std::endl;
    for (const std::string& cause : report.causes) std::cout << cause << std::endl;
    // [/report]
    return viewer.run();
}
