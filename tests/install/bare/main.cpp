// SPDX-License-Identifier: MIT
// A program against a Gnomon that was built without its optional parts: planar and map work, and what is missing says so.
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/RayScene.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowQuery.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/SunClock.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <osg/LightSource>
#include <osg/Notify>
#include <osg/ShapeDrawable>
#include <osgDB/Registry>
#include <osgUtil/SceneView>

#include <algorithm>
#include <functional>
#include <iostream>
#include <sstream>

namespace {

int failures = 0;

void expect(bool holds, const std::string& what) {
    if (holds) return;
    ++failures;
    std::cerr << "bare: " << what << std::endl;
}

/// Has one sentence that names library, package and option.
void expectRefusal(const std::string& who, const std::string& said, const std::string& library) {
    std::string option = library;
    std::transform(option.begin(), option.end(), option.begin(), [](unsigned char c) { return std::toupper(c); });
    for (const std::string& part :
         {"built without " + library, std::string("Install lib"), "GNOMON_WITH_" + option + "=ON"})
        expect(said.find(part) != std::string::npos, who + " says \"" + said + "\", and not " + part);
}

std::string thrownBy(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::exception& failure) {
        return failure.what();
    }
    return "nothing";
}

class Warnings : public osg::NotifyHandler {
public:
    void notify(osg::NotifySeverity severity, const char* message) override {
        if (severity <= osg::WARN) text += message;
    }
    std::string text;
};

osg::ref_ptr<osg::Geode> makeScene() {
    osg::ref_ptr<osg::Geode> scene = new osg::Geode;
    scene->addDrawable(new osg::ShapeDrawable(new osg::Box({0, 0, 2}, 1)));
    scene->addDrawable(osg::createTexturedQuadGeometry({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}));
    scene->setName("ground");
    return scene;
}

osg::ref_ptr<gnomon::ShadowCasterGroup> makeGroup(osg::Node* scene) {
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    group->addChild(scene);
    group->addLight(gnomon::ShadowLight{0, {1, 1, 2, 0}});
    return group;
}

/// The cull of a frame, for which no OpenGL is needed.
void cull(osg::Node& root) {
    osg::ref_ptr<osg::FrameStamp> stamp = new osg::FrameStamp;
    stamp->setFrameNumber(1);
    osg::ref_ptr<osgUtil::SceneView> view = new osgUtil::SceneView;
    view->setDefaults();
    view->setFrameStamp(stamp);
    view->setViewport(0, 0, 64, 64);
    view->setProjectionMatrixAsPerspective(40, 1, 1, 100);
    view->setViewMatrixAsLookAt({-6, -8, 8}, {0, 0, 0}, {0, 0, 1});
    view->getLight()->setPosition({1, 1, 2, 0});
    view->setSceneData(&root);
    view->cull();
}

void techniquesSayWhatIsMissing() {
    const osg::ref_ptr<osg::Node> scene = makeScene();
    const auto group = makeGroup(scene);
    const osg::ref_ptr<gnomon::PlanarShadowNode> planar = new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0));
    const osg::ref_ptr<gnomon::ShadowMapTechnique> map = new gnomon::ShadowMapTechnique;
    const osg::ref_ptr<gnomon::TracedShadowTechnique> traced = new gnomon::TracedShadowTechnique;
    const osg::ref_ptr<gnomon::TerrainShadowGeode> hull = new gnomon::TerrainShadowGeode;
    hull->setReceiver({scene});
    for (osg::Node* node : {static_cast<osg::Node*>(planar), static_cast<osg::Node*>(map),
                            static_cast<osg::Node*>(traced), static_cast<osg::Node*>(hull)})
        group->addChild(node);
    cull(*group);
    for (const std::string& cause : planar->diagnose()) expect(false, cause);
    for (const std::string& cause : map->diagnose()) expect(false, cause);
    expect(traced->diagnose().size() == 1 && hull->diagnose().size() == 1, "traced and hull have one cause each");
    if (failures > 0) return;
    expectRefusal("traced", traced->diagnose().front(), "Embree");
    expectRefusal("hull", hull->diagnose().front(), "Qhull");
}

void autoTakesAnother() {
    const auto group = makeGroup(makeScene());
    const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
    group->addChild(technique);
    cull(*group);
    const auto decisions = technique->lastDecision();
    expect(decisions.size() == 1, "auto decides for one light");
    for (const gnomon::ShadowDecision& decision : decisions)
        for (const gnomon::ShadowCandidate& candidate : decision.candidates)
            if (candidate.spec.find("traced") == 0)
                expect(candidate.obstacle == "this build has no Embree", "auto says " + candidate.obstacle);
}

void namesAreRefused() {
    for (const auto& [name, library] : {std::pair("traced", "Embree"), {"hull", "Qhull"}})
        expectRefusal(name, thrownBy([name = name] { gnomon::parseShadowSpec(name); }), library);
    const std::vector<std::string> allowed = {"none", "planar", "box", "map", "volume", "auto"};
    expect(gnomon::shadowTechniques() == allowed, "other techniques can be used");
}

void classesThrow() {
    expectRefusal("RayScene", thrownBy([] { gnomon::RayScene{gnomon::TriangleSoup()}; }), "Embree");
    expectRefusal("SunClock", thrownBy([] { gnomon::SunClock(36.6, -84.3); }), "libnova");
    expectRefusal("julianDay()", thrownBy([] { gnomon::julianDay("2026-06-21T15:00:00Z"); }), "libnova");
    const auto group = makeGroup(makeScene());
    const osg::ref_ptr<gnomon::PlanarShadowNode> planar = new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0));
    group->addChild(planar);
    expectRefusal("ShadowQuery", thrownBy([&] { gnomon::ShadowQuery(*planar, {0, {1, 1, 2, 0}}); }), "Embree");
}

/// A scene file keeps the nodes, and who reads it is told.
void filesKeepWhatIsMissing() {
    const auto group = makeGroup(makeScene());
    group->addChild(new gnomon::TracedShadowTechnique);
    group->addChild(new gnomon::TerrainShadowGeode);
    std::stringstream file;
    osgDB::ReaderWriter* text = osgDB::Registry::instance()->getReaderWriterForExtension("osgt");
    expect(text && text->writeNode(*group, file).success(), "the scene is written");
    const osg::ref_ptr<Warnings> warnings = new Warnings;
    osg::setNotifyHandler(warnings);
    osgDB::ReaderWriter::ReadResult read = text->readNode(file);
    osg::setNotifyHandler(new osg::StandardNotifyHandler);
    const osg::Group* again = read.getNode() ? read.getNode()->asGroup() : nullptr;
    expect(again && again->getNumChildren() == 3, "the scene is read with both techniques");
    expectRefusal("TracedShadowTechnique in a file", warnings->text, "Embree");
    expectRefusal("TerrainShadowGeode in a file", warnings->text, "Qhull");
}

} // namespace

int main() {
    techniquesSayWhatIsMissing();
    autoTakesAnother();
    namesAreRefused();
    classesThrow();
    filesKeepWhatIsMissing();
    return failures;
}
