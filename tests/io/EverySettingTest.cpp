// SPDX-License-Identifier: MIT
// Files keep every setting of every node.
// Files of other versions: what is added later does not harm what is read, and what cannot be read is refused with the
// reason. Binary files know no names: there a property too many, or one too few, would make all that follows wrong.
#include "SceneFile.h"

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

#include <osg/Group>
#include <osg/ref_ptr>
#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>
#include <osgDB/Serializer>
#include <support/Scene.h>

#include <algorithm>
#include <sstream>

namespace {

using test::SceneFile;

const gnomon::CompositorOptions options{0x80, false};

osg::ref_ptr<gnomon::PlanarShadowNode> planarOf(const gnomon::Selection& receiver) {
    osg::ref_ptr<gnomon::PlanarShadowNode> result = new gnomon::PlanarShadowNode;
    result->setReceiver(receiver);
    result->setPlanes({{0.0, 0.0, 1.0, 0.0}, {0.1, -1.0 / 3.0, 1e-300, 4234567.123456789}});
    result->setStencilCure(false);
    result->setOffsetCure(false);
    result->setClipCure(false);
    return result;
}

osg::ref_ptr<gnomon::ShadowMapTechnique> mapOf() {
    osg::ref_ptr<gnomon::ShadowMapTechnique> result = new gnomon::ShadowMapTechnique;
    result->setSize(20);
    result->setFilter(gnomon::ShadowMapTechnique::FINE);
    result->setCascades(3);
    result->setEdges(gnomon::ShadowMapTechnique::SOFT);
    result->setSunAngle(0.1);
    result->setLampSize(1.0 / 3.0);
    result->setRadius(2.0 / 3.0);
    result->setView(gnomon::ShadowMapTechnique::TEXELS);
    result->setProgramUnit(5);
    return result;
}

osg::ref_ptr<gnomon::TerrainShadowGeode> terrainOf() {
    osg::ref_ptr<gnomon::TerrainShadowGeode> result = new gnomon::TerrainShadowGeode;
    result->setMethod(gnomon::TerrainShadowGeode::BOX);
    return result;
}

osg::ref_ptr<gnomon::PlanarReflectionNode> mirrorOf(const gnomon::Selection& surface) {
    osg::ref_ptr<gnomon::PlanarReflectionNode> result = new gnomon::PlanarReflectionNode;
    result->setSurface(surface);
    result->setPlane({0.1, 0.2, 1.0, -1.0 / 3.0});
    result->setReflectance({0.1f, 0.2f, 1.0f / 3.0f});
    result->setStencilCure(false);
    result->setCompositorOptions(options);
    return result;
}

osg::ref_ptr<gnomon::HaloNode> haloOf() {
    osg::ref_ptr<gnomon::HaloNode> result = new gnomon::HaloNode;
    result->setShape(gnomon::HaloNode::PIXELS);
    result->setScale(1.0 + 1.0 / 3.0);
    result->setWidth(5);
    result->setColor({0.1f, 0.2f, 1.0f / 3.0f, 1e-7f});
    result->setStencilCure(false);
    result->setCompositorOptions(options);
    result->setUpdateCallback(new gnomon::HaloPulse(0.1));
    return result;
}

/// A graph with every node of the kit, in which each setting that files keep has a value other than its default.
osg::ref_ptr<osg::Group> everySetting() {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    const osg::ref_ptr<osg::LightSource> sun = new osg::LightSource;
    sun->setLight(new osg::Light(3));
    root->addChild(sun);
    osg::ref_ptr<gnomon::ShadowCasterGroup> group = new gnomon::ShadowCasterGroup;
    root->addChild(group);
    for (const char* name : {"floor", "wall", "tree", "house"}) group->addChild(test::node(test::square(1.0), name));
    const gnomon::Selection ground{group->getChild(0), 0xf0u, {group->getChild(1)}};

    group->setCasters({group->getChild(2), 0x7fffffffu, {group->getChild(3)}});
    group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    group->setDark(0.1f);
    group->setOpaqueFrom(1.0f / 3.0f);
    group->setLightSources({sun});
    group->setLights({{2, {0.1, -1.0 / 3.0, 4234567.123456789, 1.0}, {0.1, 0.2, -1.0}, 100.0 / 3.0}});
    group->setLightUniforms({{1, "sun colour \"quoted\""}});
    group->setCompositorOptions(options);

    group->addChild(planarOf(ground));
    group->addChild(mapOf());
    group->addChild(terrainOf());
    osg::ref_ptr<gnomon::ShadowVolumeTechnique> volume = new gnomon::ShadowVolumeTechnique;
    volume->setView(gnomon::ShadowVolumeTechnique::VOLUMES);
    group->addChild(volume);
    osg::ref_ptr<gnomon::TracedShadowTechnique> traced = new gnomon::TracedShadowTechnique;
    traced->setReceiver(ground);
    group->addChild(traced);
    osg::ref_ptr<gnomon::AutoShadowTechnique> choice = new gnomon::AutoShadowTechnique;
    choice->setError(1.0 / 3.0);
    choice->setTime(0.7);
    group->addChild(choice);
    group->addChild(mirrorOf(ground));
    group->addChild(haloOf());
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

TEST(EverySetting, IsInTheTextOfItsNode) {
    test::usePluginsOfThisBuild();
    const std::string file = test::written(*everySetting(), "osgt");
    unsigned properties = 0;
    for (const auto& [name, wrapper] : osgDB::Registry::instance()->getObjectWrapperManager()->getWrapperMap()) {
        if (name.find("gnomon::") != 0 || name == "gnomon::FileVersion") continue; // which text does not need
        // What is written for a class stands in the objects of those that inherit it.
        const std::string object = textOf(file, name == "gnomon::ShadowTechnique" ? "gnomon::PlanarShadowNode" : name);
        EXPECT_FALSE(object.empty()) << name << " is not in the file";
        for (const auto& serializer : wrapper->getSerializerList()) {
            ++properties;
            EXPECT_TRUE(isGiven(object, serializer->getName())) << name << "::" << serializer->getName();
        }
    }
    EXPECT_GT(properties, 40u) << "the wrappers were not found";
}

TEST_P(SceneFile, KeepsEverySettingOfEveryNode) {
    const osg::ref_ptr<osg::Group> scene = everySetting();
    const auto copy = test::throughFile(*scene, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(test::written(*copy, "osgt"), test::written(*scene, "osgt"));
}

using gnomon::HaloNode;
using gnomon::ShadowCasterGroup;

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

TEST(BinaryFile, OfAnotherVersionIsRefusedWithTheReason) {
    test::usePluginsOfThisBuild();
    std::string file = test::written(*osg::ref_ptr<osg::Node>(new ShadowCasterGroup), "osgb");
    const std::size_t version = file.find("gnmn") + 4;
    ASSERT_EQ(file.substr(version, 4), std::string("\3\0\0\0", 4));
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
