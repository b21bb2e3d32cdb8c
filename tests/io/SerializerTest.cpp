// SPDX-License-Identifier: MIT
// Scene files keep every setting of every node to the bit, and its picture.
// Files of other versions: what is added later does not harm what is read, and what cannot be read is refused with the
// reason. Binary files know no names: there a property too many, or one too few, would make all that follows wrong.
#include "SceneText.h"

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/HaloNode.h>
#include <gnomon/HaloPulse.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>

#include <gtest/gtest.h>
#include <osg/DisplaySettings>
#include <osg/Notify>
#include <osg/observer_ptr>
#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>
#include <osgDB/Serializer>
#include <support/Picture.h>
#include <support/Scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace {

using gnomon::HaloNode;
using gnomon::PlanarReflectionNode;
using gnomon::PlanarShadowNode;
using gnomon::Selection;
using gnomon::ShadowCasterGroup;
using gnomon::ShadowLight;
using gnomon::ShadowMapTechnique;
using gnomon::TerrainShadowGeode;

/// Numbers that six digits, or a reader that rounds carelessly, would change; and what is not finite: planes are kept as given.
const std::vector<osg::Vec4d> delicate = {
    {0.1, -1.0 / 3.0, 4234567.123456789, 1e-300},
    {-std::nextafter(1.0, 2.0), std::numeric_limits<double>::max(), std::numeric_limits<double>::denorm_min(), -0.0},
    {6378137.0000000009, 123456789012345678.0, 5e-324, 2.2250738585072011e-308},
    {NAN, INFINITY, -INFINITY, 1.0},
};
const float half = std::nextafter(0.5f, 1.0f), third = 1.0f / 3.0f;

const gnomon::CompositorOptions options{0xa5, false};

osg::ref_ptr<PlanarShadowNode> planarOf(const Selection& receiver) {
    osg::ref_ptr<PlanarShadowNode> result = new PlanarShadowNode;
    result->setReceiver(receiver);
    result->setPlanes(delicate);
    result->setEdges(PlanarShadowNode::SMOOTH);
    result->setName("floor's shadow");
    result->setNodeMask(0x10u);
    result->addDrawable(new osg::Geometry);
    return result;
}

osg::ref_ptr<ShadowMapTechnique> mapOf() {
    osg::ref_ptr<ShadowMapTechnique> result = new ShadowMapTechnique;
    result->setSize(20);
    result->setFilter(ShadowMapTechnique::FINE);
    result->setCascades(3);
    result->setEdges(ShadowMapTechnique::SOFT);
    result->setSunAngle(0.1);
    result->setLampSize(1.0 / 3.0);
    result->setRadius(2.0 / 3.0);
    result->setView(ShadowMapTechnique::TEXELS);
    result->setProgramUnit(5);
    return result;
}

osg::ref_ptr<TerrainShadowGeode> terrainOf() {
    osg::ref_ptr<TerrainShadowGeode> result = new TerrainShadowGeode;
    result->setMethod(TerrainShadowGeode::BOX);
    result->setEdges(TerrainShadowGeode::SMOOTH);
    return result;
}

osg::ref_ptr<PlanarReflectionNode> mirrorOf(const Selection& surface) {
    osg::ref_ptr<PlanarReflectionNode> result = new PlanarReflectionNode;
    result->setSurface(surface);
    result->setPlane(delicate[0]);
    result->setReflectance({0.1f, third, half});
    result->setCompositorOptions(options);
    return result;
}

osg::ref_ptr<HaloNode> haloOf() {
    osg::ref_ptr<HaloNode> result = new HaloNode;
    result->setShape(HaloNode::PIXELS);
    result->setScale(1.0 + 1.0 / 3.0);
    result->setWidth(5);
    result->setColor({0.1f, 0.2f, third, 1e-7f});
    result->setCompositorOptions(options);
    result->setUpdateCallback(new gnomon::HaloPulse(0.1));
    return result;
}

/// Every enumerator.
void addChoices(osg::Group& group) {
    for (int i = 0; i < 4; ++i) {
        osg::ref_ptr<ShadowMapTechnique> map = new ShadowMapTechnique;
        map->setFilter(ShadowMapTechnique::Filter(i));
        map->setEdges(ShadowMapTechnique::Edges(i % 3));
        map->setView(ShadowMapTechnique::View(i));
        group.addChild(map);
        osg::ref_ptr<HaloNode> halo = new HaloNode;
        halo->setShape(HaloNode::Shape(i % 3));
        group.addChild(halo);
        osg::ref_ptr<PlanarShadowNode> planar = new PlanarShadowNode;
        planar->setReceiver({nullptr, i == 3 ? 0u : ~0u});
        group.addChild(planar);
    }
}

/// A graph with every node of the kit, in which each setting that files keep has a value other than its default.
osg::ref_ptr<osg::Group> everySetting() {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::LightSource> sun = new osg::LightSource, lamp = new osg::LightSource;
    sun->setLight(new osg::Light(3));
    lamp->setLight(new osg::Light(5));
    root->addChild(sun);
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    root->addChild(group);
    for (const char* name : {"floor", "wall", "tree", "house"}) group->addChild(test::node(test::square(1.0), name));
    group->addChild(lamp);
    const Selection ground{group->getChild(0), 0xf0u, {group->getChild(1)}};

    group->setCasters({group->getChild(2), 0x7fffffffu, {group->getChild(3)}});
    group->setComposite(ShadowCasterGroup::BLEND);
    group->setDark(half);
    group->setOpaqueFrom(third);
    group->setClipping(ShadowCasterGroup::NONE);
    group->setTerminatorOffset(false);
    group->setLightSources({sun, lamp});
    group->setLights(
        {{1, delicate[0]}, {2, delicate[1], {0.1, -1.0 / 3.0, 4234567.123456789}, 100.0 / 3.0}, {7, delicate[2]}});
    group->setLightUniforms({{7, "sun colour \"quoted\""}, {0, "sun.diffuse"}});
    group->setMatrixUniforms({{"view \"projection\"", gnomon::MatrixUniform::VIEW_PROJECTION}, {"mvp"}});
    group->setCompositorOptions(options);

    group->addChild(planarOf(ground));
    group->addChild(mapOf());
    group->addChild(terrainOf());
    osg::ref_ptr<gnomon::ShadowVolumeTechnique> volume = new gnomon::ShadowVolumeTechnique;
    volume->setEdges(gnomon::ShadowVolumeTechnique::SMOOTH);
    volume->setView(gnomon::ShadowVolumeTechnique::VOLUMES);
    group->addChild(volume);
    osg::ref_ptr<gnomon::TracedShadowTechnique> traced = new gnomon::TracedShadowTechnique;
    traced->setReceiver(ground);
    traced->setEdges(gnomon::TracedShadowTechnique::SMOOTH);
    group->addChild(traced);
    osg::ref_ptr<gnomon::AutoShadowTechnique> choice = new gnomon::AutoShadowTechnique;
    choice->setError(1.0 / 3.0);
    group->addChild(choice);
    group->addChild(mirrorOf(ground));
    group->addChild(haloOf());
    osg::ref_ptr<ShadowCasterGroup> maskAlone = new ShadowCasterGroup;
    maskAlone->setCasters({nullptr, 0xdeadbeefu});
    root->addChild(maskAlone);
    addChoices(*root);
    return root;
}

const osgDB::ObjectWrapperManager::WrapperMap& wrappers() {
    osgDB::ObjectWrapperManager& all = *osgDB::Registry::instance()->getObjectWrapperManager();
    all.findWrapper("gnomon::ShadowCasterGroup"); // which loads the plugin
    return all.getWrapperMap();
}

/// Calls take(name, wrapper) with those of the kit.
template <class Take>
void forEachClass(const Take& take) {
    for (const auto& [name, wrapper] : wrappers())
        if (name.find("gnomon::") == 0 && name != "gnomon::FileVersion") take(name, *wrapper); // text has no version
}

/// Every node of the kit, as it is made.
osg::ref_ptr<osg::Group> freshNodes() {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    forEachClass([&](const std::string&, osgDB::ObjectWrapper& wrapper) {
        const osg::ref_ptr<osg::Object> object = wrapper.createInstance();
        if (auto* node = dynamic_cast<osg::Node*>(object.get())) root->addChild(node);
    });
    return root;
}

/// The text of the first object of a class, up to the line that closes it.
std::string textOf(const std::string& file, const std::string& name) {
    const std::size_t begin = file.find(name + " {\n");
    if (begin == std::string::npos) return {};
    const std::size_t line = file.rfind('\n', begin) + 1;
    const std::string indent = file.substr(line, file.find_first_not_of(' ', line) - line);
    return file.substr(begin, file.find('\n' + indent + '}', begin) - begin);
}

bool isGiven(const std::string& object, const std::string& property) {
    std::istringstream words(object);
    for (std::string word; words >> word;)
        if (word == property) return true;
    return false;
}

template <typename Class>
Class& childOf(osg::Group& group, unsigned index) {
    return dynamic_cast<Class&>(*group.getChild(index));
}

/// A kind of scene file, by its suffix.
class SceneFile : public testing::TestWithParam<const char*> {
protected:
    static void SetUpTestSuite() { test::usePluginsOfThisBuild(); }
    std::string kind() const { return GetParam(); }

    /// By the bytes of two kinds of file: should the one round, the other does not.
    void expectSameOnceLoaded(const osg::Group& scene) const {
        const auto copy = test::throughFile(scene, kind());
        ASSERT_TRUE(copy);
        EXPECT_EQ(test::written(*copy, "osgt"), test::written(scene, "osgt"));
        EXPECT_TRUE(test::written(*copy, "osgb") == test::written(scene, "osgb"));
    }

    /// The scene's group is given its light; through a file and back it must look the same, shadow and all.
    void expectSamePictureOnceLoaded(test::Scene& scene) const {
        scene.group->addLight(scene.light);
        const auto copy = test::throughFile(*scene.root, kind());
        ASSERT_TRUE(copy);
        const test::Picture before = test::render(scene.root, view);
        EXPECT_EQ(test::render(copy, view).different(before), 0);
        scene.group->removeChild(1);
        EXPECT_GT(test::render(scene.root, view).different(before), 500) << "there is no shadow to compare";
    }

    const test::View view = test::perspective({-6.0, -8.0, 8.0}, {0.0, 0.0, 0.0});
};
INSTANTIATE_TEST_SUITE_P(EveryKind, SceneFile, testing::Values("osgt", "osgb", "osgx"),
                         [](const auto& test) { return std::string(test.param); });

TEST(SceneFileText, SaysOfEachNodeWhatIsSetAndNothingOfDefaults) {
    test::usePluginsOfThisBuild();
    const std::string set = test::written(*everySetting(), "osgt"), fresh = test::written(*freshNodes(), "osgt");
    unsigned properties = 0;
    forEachClass([&](const std::string& name, osgDB::ObjectWrapper& wrapper) {
        // What is written for a class stands in the objects of those that inherit it.
        const std::string made = name == "gnomon::ShadowTechnique" ? "gnomon::PlanarShadowNode" : name;
        EXPECT_FALSE(textOf(set, made).empty()) << name << " is not in the file";
        EXPECT_NE(textOf(fresh, made).empty(), name != "gnomon::HaloPulse") << name;
        for (const auto& serializer : wrapper.getSerializerList()) {
            if (serializer->getName().find("Cure") != std::string::npos)
                continue; // files of earlier versions have them
            if (name == "gnomon::AutoShadowTechnique" && serializer->getName() == "Time") continue; // is read alone
            ++properties;
            EXPECT_TRUE(isGiven(textOf(set, made), serializer->getName())) << name << "::" << serializer->getName();
            EXPECT_FALSE(isGiven(textOf(fresh, made), serializer->getName())) << name << "::" << serializer->getName();
        }
    });
    EXPECT_GT(properties, 35u) << "the wrappers were not found";
}

TEST_P(SceneFile, KeepsEverySettingOfEveryNodeToTheBit) { expectSameOnceLoaded(*everySetting()); }

TEST_P(SceneFile, KeepsDefaults) { expectSameOnceLoaded(*freshNodes()); }

TEST_P(SceneFile, KeepsApartAnAlphaThatWasGivenAndNone) {
    for (const float alpha : {-1.0f, 0.0f, 0.5f, 1.0f}) {
        osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
        group->setOpaqueFrom(alpha);
        const auto copy = test::throughFile(*group, kind());
        ASSERT_TRUE(copy);
        EXPECT_EQ(dynamic_cast<ShadowCasterGroup&>(*copy).getOpaqueFrom(), alpha);
    }
}

TEST_P(SceneFile, SelectsTheSameNodesAndLightsOfTheLoadedGraph) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
    osg::ref_ptr<osg::LightSource> inside = new osg::LightSource, outside = new osg::LightSource;
    root->addChild(group);
    root->addChild(outside);
    group->addChild(node); // written before what it refers to
    group->addChild(test::node(test::square(1.0), "floor"));
    group->addChild(inside);
    node->setReceiver({group->getChild(1), 0xffu});
    group->setCasters({root, 0x7fffffffu}); // above it
    group->setLightSources({outside, inside});

    const auto graph = test::throughFile(*root, kind());
    ASSERT_TRUE(graph);
    const osg::ref_ptr<ShadowCasterGroup> copy = &childOf<ShadowCasterGroup>(*graph, 0);
    ASSERT_EQ(copy->getNumChildren(), 3u);
    EXPECT_EQ(childOf<PlanarShadowNode>(*copy, 0).getReceiver(), Selection({copy->getChild(1), 0xffu}));
    EXPECT_EQ(copy->getCasters(), Selection({graph, 0x7fffffffu}));
    ASSERT_EQ(copy->getLightSources().size(), 2u);
    EXPECT_EQ(copy->getLightSources()[0], graph->getChild(1));
    EXPECT_EQ(copy->getLightSources()[1], copy->getChild(2));
}

TEST_P(SceneFile, IsFreedThoughItNamesWhatIsAboveTheGroup) {
    osg::observer_ptr<osg::Node> freed;
    {
        osg::ref_ptr<osg::Group> root = new osg::Group;
        osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
        osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
        root->addChild(group);
        group->addChild(node);
        node->setReceiver({root});
        group->setCasters({group});
        const auto copy = test::throughFile(*root, kind());
        ASSERT_TRUE(copy);
        freed = copy.get();
    }
    EXPECT_FALSE(freed.valid());
}

TEST_P(SceneFile, AsksForTheBitsThatItsShadowsNeedBeforeAWindowIsMade) {
    const osg::ref_ptr<osg::DisplaySettings> before = osg::DisplaySettings::instance();
    osg::DisplaySettings::instance() = new osg::DisplaySettings;
    osg::DisplaySettings& settings = *osg::DisplaySettings::instance();
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    osg::ref_ptr<ShadowMapTechnique> map = new ShadowMapTechnique;
    group->addChild(map);
    settings.setMinimumNumStencilBits(0);
    settings.setMinimumNumAlphaBits(0);
    test::throughFile(*group, kind());
    EXPECT_EQ(settings.getMinimumNumStencilBits(), 8u);
    EXPECT_EQ(settings.getMinimumNumAlphaBits(), 0u) << "hard edges need none";
    map->setEdges(ShadowMapTechnique::SMOOTH);
    map->setFilter(ShadowMapTechnique::NEAREST);
    test::throughFile(*group, kind());
    EXPECT_EQ(settings.getMinimumNumAlphaBits(), 0u) << "smooth edges of one texel are hard";
    map->setFilter(ShadowMapTechnique::BILINEAR);
    settings.setMinimumNumStencilBits(16);
    for (const auto edges : {ShadowMapTechnique::SMOOTH, ShadowMapTechnique::SOFT}) {
        map->setEdges(edges);
        settings.setMinimumNumAlphaBits(0);
        test::throughFile(*group, kind());
        EXPECT_EQ(settings.getMinimumNumStencilBits(), 16u) << "never lowered";
        EXPECT_EQ(settings.getMinimumNumAlphaBits(), 8u) << edges;
    }
    osg::DisplaySettings::instance() = before;
}

TEST_P(SceneFile, DrawsTheSamePictureOnceLoaded) {
    for (const auto& [spec, from] : {std::pair("planar:composite=blend,dark=0.3", 0.5),
                                     {"traced:receiver=ground", 0.5},
                                     {"map:size=20,filter=fine", 0.5}, // so coarse that both show
                                     {"volume:view=volumes", 0.5},
                                     {"auto:error=0.2", 0.5},
                                     {"hull", 0.0},
                                     {"box", 0.0}}) {
        SCOPED_TRACE(spec);
        test::Scene scene =
            test::groundScene({test::box({-1.0, -1.0, from}, {1.0, 1.0, 2.0})}, 8.0, {1.0, 0.3, 1.0, 0.0});
        scene.addShadow(std::string(spec));
        expectSamePictureOnceLoaded(scene);
    }
}

TEST_P(SceneFile, DrawsTheSameMirrorAndHaloOnceLoaded) {
    test::Scene scene = test::groundScene({test::box({2.0, 2.0, 0.5}, {3.0, 3.0, 2.0})}, 8.0, {1.0, 0.3, 1.0, 0.0});
    const osg::ref_ptr<HaloNode> halo = new HaloNode;
    halo->addChild(test::node(test::box({-1.0, -1.0, 0.5}, {1.0, 1.0, 2.0}), "ringed"));
    halo->setScale(1.3);
    const osg::ref_ptr<PlanarReflectionNode> mirror = new PlanarReflectionNode;
    mirror->addChild(test::node(test::box({-4.0, 0.0, 0.5}, {-3.0, 1.0, 2.0}), "mirrored"));
    mirror->setSurface({test::find(*scene.content, "ground")});
    mirror->setReflectance({0.9f, 0.5f, 0.1f});
    scene.content->addChild(halo);
    scene.content->addChild(mirror);
    scene.addShadow("planar");
    expectSamePictureOnceLoaded(scene);
    const test::Picture both = test::render(scene.root, view);
    mirror->setSurface({});
    const test::Picture unmirrored = test::render(scene.root, view);
    EXPECT_GT(both.different(unmirrored), 100) << "there is no mirror image to compare";
    halo->setScale(1.0);
    EXPECT_GT(test::render(scene.root, view).different(unmirrored), 100) << "there is no halo to compare";
}

TEST(SceneFileText, CanBeWrittenByHand) {
    test::usePluginsOfThisBuild();
    const auto group = test::loadedAs<ShadowCasterGroup>(R"(#Ascii Scene
#Version 161
#Generator by hand
gnomon::ShadowCasterGroup {
  UniqueID 1
  Children 1 { gnomon::PlanarShadowNode { UniqueID 2
      Receiver { Mask 0xff Node FALSE }
      Planes 2 { 0 0 1 -.5  1e0 0 0 3 } } }
  Casters { Mask 0xf0 Node FALSE }
  Composite BLEND
  Dark 0.25
  Lights 1 { 2 1 2.5 3 0 }
}
)",
                                                         "osgt");
    ASSERT_TRUE(group);
    EXPECT_EQ(group->getCasters().mask, 0xf0u);
    EXPECT_EQ(group->getComposite(), ShadowCasterGroup::BLEND);
    EXPECT_EQ(group->getDark(), 0.25f);
    EXPECT_EQ(group->getLights(), (std::vector<ShadowLight>{{2, {1.0, 2.5, 3.0, 0.0}}}));
    const auto& node = childOf<PlanarShadowNode>(*group, 0);
    EXPECT_EQ(node.getReceiver().mask, 0xffu);
    EXPECT_EQ(node.getPlanes(), (std::vector<osg::Vec4d>{{0.0, 0.0, 1.0, -0.5}, {1.0, 0.0, 0.0, 3.0}}));
}

/// As a file of an earlier version may have it.
TEST(SceneFileText, WithTheMethodDrapeLoadsAsHullAndSaysWhatTakesItsPlace) {
    test::usePluginsOfThisBuild();
    std::string file = test::written(*terrainOf(), "osgt");
    file.replace(file.find("Method BOX"), 10, "Method DRAPE");
    testing::internal::CaptureStderr();
    const auto loaded = test::loadedAs<TerrainShadowGeode>(file, "osgt");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->getMethod(), TerrainShadowGeode::HULL);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("Use hull on terrain, or map or traced"), std::string::npos) << said;
}

/// As files of earlier versions may have them: three of planar shadows, and one of a halo before its other properties.
TEST(SceneFileText, WithCuresThatAreGoneKeepsAllElse) {
    test::usePluginsOfThisBuild();
    const auto halo = test::loadedAs<HaloNode>(R"(#Ascii Scene
#Version 161
#Generator by hand
gnomon::HaloNode {
  UniqueID 1
  Children 1 { gnomon::PlanarShadowNode { UniqueID 2
      Planes 1 { 0 0 1 -.5 }
      StencilCure FALSE
      OffsetCure TRUE
      ClipCure FALSE } }
  Width 5
  StencilCure FALSE
  CompositorOptions 165 FALSE
}
)",
                                               "osgt");
    ASSERT_TRUE(halo);
    EXPECT_EQ(halo->getWidth(), 5);
    EXPECT_EQ(halo->getCompositorOptions(), options);
    EXPECT_EQ(childOf<PlanarShadowNode>(*halo, 0).getPlanes(), (std::vector<osg::Vec4d>{{0.0, 0.0, 1.0, -0.5}}));
    EXPECT_EQ(test::written(*halo, "osgt").find("Cure"), std::string::npos) << "and forgets them";
}

/// As an earlier version wrote it.
TEST_P(SceneFile, WithATimeOfAutoKeepsTheErrorAndSaysThatTheTimeHasNoEffect) {
    const osg::ref_ptr<gnomon::AutoShadowTechnique> choice = new gnomon::AutoShadowTechnique;
    constexpr double error = 1.0 / 3.0, time = 5.0;
    choice->setError(error);
    const std::string now = test::written(*choice, kind());
    std::string file = now;
    if (kind() == "osgb") {
        const std::string bytes(reinterpret_cast<const char*>(&error), sizeof error);
        const std::size_t place = file.find(bytes) + bytes.size();
        file.replace(place, sizeof time, reinterpret_cast<const char*>(&time), sizeof time);
    } else {
        const std::size_t place = file.find('\n', file.find("Error")) + 1;
        file.insert(place, kind() == "osgx" ? "<Time attribute=\"5\" />\n" : "  Time 5\n");
    }
    const osg::NotifySeverity before = osg::getNotifyLevel();
    osg::setNotifyLevel(osg::NOTICE);
    testing::internal::CaptureStdout();
    const auto loaded = test::loadedAs<gnomon::AutoShadowTechnique>(file, kind());
    const std::string said = testing::internal::GetCapturedStdout();
    osg::setNotifyLevel(before);
    ASSERT_TRUE(loaded) << file;
    EXPECT_EQ(loaded->getError(), error);
    EXPECT_NE(said.find("Time of '' has no effect any more: auto keeps the error alone."), std::string::npos) << said;
    EXPECT_EQ(test::written(*loaded, kind()), now);
}

/// A property that a later version could add, before all others of its class.
class AddedProperty {
public:
    AddedProperty() {
        const osgDB::UpdateWrapperVersionProxy since(&wrapper(), 3);
        wrapper().addSerializer(new osgDB::PropByValSerializer<HaloNode, unsigned>("Added", 0u, &HaloNode::getNodeMask,
                                                                                   &HaloNode::setNodeMask),
                                osgDB::BaseSerializer::RW_UINT);
        std::rotate(list().begin(), list().end() - 1, list().end());
    }
    ~AddedProperty() { list().erase(list().begin()); }

private:
    static osgDB::ObjectWrapper& wrapper() {
        return *osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper("gnomon::HaloNode");
    }
    static osgDB::ObjectWrapper::SerializerList& list() { return wrapper().getSerializerList(); }
};

TEST_P(SceneFile, LoadsOnceALaterVersionHasAddedAProperty) {
    const std::string marked = test::written(*everySetting(), kind());
    const AddedProperty added;
    const osg::ref_ptr<HaloNode> halo = new HaloNode;
    halo->setNodeMask(0x1234u);
    halo->setWidth(5);
    const auto copy = test::throughFile(*halo, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getNodeMask(), 0x1234u);
    EXPECT_EQ(copy->getWidth(), 5);
    EXPECT_NE(test::written(*everySetting(), kind()), marked) << "the property was not written";
}

TEST(BinaryFile, OfTheVersionBeforeHasDefaultsForWhatCameLater) {
    test::usePluginsOfThisBuild();
    const osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->setDark(third);
    group->setClipping(ShadowCasterGroup::ALL);
    group->setTerminatorOffset(false);
    group->addMatrixUniform({"mvp"});
    std::string file = test::written(*group, "osgb");
    file[file.find("gnmn") + 4] = 3;
    const auto loaded = test::loadedAs<ShadowCasterGroup>(file, "osgb");
    ASSERT_TRUE(loaded);
    EXPECT_EQ(loaded->getDark(), third);
    EXPECT_EQ(loaded->getClipping(), ShadowCasterGroup::GRAPH);
    EXPECT_TRUE(loaded->getTerminatorOffset());
    EXPECT_TRUE(loaded->getMatrixUniforms().empty());
}

TEST(BinaryFile, WithCuresThatAreGoneKeepsAllElse) {
    test::usePluginsOfThisBuild();
    const std::string file = test::written(*planarOf({nullptr, 0xffu}), "osgb");
    std::string off = file;
    const std::size_t cures = off.rfind(std::string(3, '\1'));
    ASSERT_NE(cures, std::string::npos);
    off.replace(cures, 3, 3, '\0');
    const auto loaded = test::loadedAs<PlanarShadowNode>(off, "osgb");
    ASSERT_TRUE(loaded);
    EXPECT_TRUE(test::written(*loaded, "osgb") == file);
}

TEST(BinaryFile, OfAnotherVersionIsRefusedWithTheReason) {
    test::usePluginsOfThisBuild();
    std::string file = test::written(*osg::ref_ptr<osg::Node>(new ShadowCasterGroup), "osgb");
    const std::size_t version = file.find("gnmn") + 4;
    ASSERT_EQ(file.substr(version, 4), std::string("\6\0\0\0", 4));
    EXPECT_TRUE(test::loaded(file, "osgb"));
    const auto why = [&](char number) {
        file[version] = number;
        EXPECT_FALSE(test::loaded(file, "osgb"));
        return test::whyRefused(file, "osgb");
    };
    EXPECT_NE(why(77).find("the file is of version 77, which this Gnomon does not know"), std::string::npos);
    EXPECT_NE(why(2).find("the file is of a version before the first release"), std::string::npos);
    file[version - 1] = 'x';
    EXPECT_NE(why(3).find("the file is of a version before the first release"), std::string::npos) << "without a mark";
}

} // namespace
