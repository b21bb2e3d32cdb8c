// SPDX-License-Identifier: MIT
// Files of earlier versions load with every setting, also once a later version has added a property. Binary files know no
// names: there a property too many, or one too few, would make all that follows wrong. What scene_files holds was written by
// the wrappers of its time.
#include "EverySetting.h"
#include "SceneFile.h"

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/HaloNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowVolumeTechnique.h>

#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>
#include <osgDB/Serializer>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace {

using gnomon::HaloNode;
using gnomon::ShadowCasterGroup;
using test::SceneFile;

std::string stored(const std::string& name) {
    std::ifstream file(std::string(GNOMON_SCENE_FILES) + "/" + name, std::ios::binary);
    std::stringstream contents;
    contents << file.rdbuf();
    return contents.str();
}

void expectLoadsAs(const std::string& file, const std::string& kind, const osg::Node& expected) {
    const auto scene = test::loaded(file, kind);
    ASSERT_TRUE(scene);
    EXPECT_EQ(test::written(*scene, "osgt"), test::written(expected, "osgt"));
}

osg::ref_ptr<ShadowCasterGroup> darkGroup(float dark) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->setDark(dark);
    return group;
}

/// What stood in a file before 24 November 2026: neither these techniques nor OpaqueFrom. Groups with other lights follow,
/// whose properties begin with other bytes where OpaqueFrom stands today.
osg::ref_ptr<osg::Group> sceneBeforeOpaqueFrom() {
    osg::ref_ptr<osg::Group> root = test::everySetting();
    auto& group = test::childOf<ShadowCasterGroup>(*root, 1);
    group.setOpaqueFrom(osg::ref_ptr<ShadowCasterGroup>(new ShadowCasterGroup)->getOpaqueFrom());
    for (unsigned i = group.getNumChildren(); i-- > 0;)
        if (dynamic_cast<gnomon::ShadowVolumeTechnique*>(group.getChild(i)) ||
            dynamic_cast<gnomon::AutoShadowTechnique*>(group.getChild(i)))
            group.removeChild(i);
    root->addChild(darkGroup(0.1f));
    const osg::ref_ptr<ShadowCasterGroup> sources = darkGroup(0.2f), lamps = darkGroup(0.3f), spots = darkGroup(0.4f),
                                          uniforms = darkGroup(0.5f), options = darkGroup(0.6f);
    const osg::ref_ptr<osg::LightSource> other = new osg::LightSource;
    sources->setLightSources({&test::childOf<osg::LightSource>(*root, 0), other});
    lamps->setLights({{1, {1.0, 2.0, 3.0, 1.0}}, {2, {4.0, 5.0, 6.0, 1.0}}, {3, {7.0, 8.0, 9.0, 1.0}}});
    spots->setLights({{1, {1.0, 2.0, 3.0, 1.0}, {0.0, 0.0, -1.0}, 30.0}});
    uniforms->setLightUniforms({{0, "sun"}, {1, "moon"}, {2, "lamp"}, {3, "torch"}, {4, "fire"}});
    options->setCompositorOptions({0x80, false, 77});
    for (const auto& lit : {sources, lamps, spots, uniforms, options}) root->addChild(lit);
    return root;
}

/// A property that a later version could add, before all others of its class.
class AddedProperty {
public:
    AddedProperty() {
        const osgDB::UpdateWrapperVersionProxy since(&wrapper(), 2); // the first version with a mark
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

TEST_P(SceneFile, WithoutAVersionLoadsWithEverySetting) {
    expectLoadsAs(stored("unmarked." + kind()), kind(), *test::everySetting());
}

TEST_P(SceneFile, LoadsOnceALaterVersionHasAddedAProperty) {
    const std::string marked = test::written(*test::everySetting(), kind());
    const AddedProperty added;
    expectLoadsAs(stored("unmarked." + kind()), kind(), *test::everySetting());
    const osg::ref_ptr<HaloNode> halo = new HaloNode;
    halo->setNodeMask(0x1234u);
    halo->setWidth(5);
    const auto copy = test::throughFile(*halo, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getNodeMask(), 0x1234u);
    EXPECT_EQ(copy->getWidth(), 5);
    EXPECT_NE(test::written(*test::everySetting(), kind()), marked) << "the property was not written";
}

class BinaryFile : public testing::Test {
protected:
    static void SetUpTestSuite() { test::usePluginsOfThisBuild(); }
};

TEST_F(BinaryFile, OfBeforeOpaqueFromLoadsWithEverySetting) {
    expectLoadsAs(stored("before-opaque-from.osgb"), "osgb", *sceneBeforeOpaqueFrom());
}

TEST_F(BinaryFile, OfVersionTwoLoadsWithEverySetting) {
    expectLoadsAs(stored("version-2.osgb"), "osgb", *test::everySetting());
}

TEST_F(BinaryFile, OfALaterVersionIsRefusedWithTheReason) {
    std::string file = test::written(*osg::ref_ptr<osg::Node>(new ShadowCasterGroup), "osgb");
    const std::size_t version = file.find("gnmn") + 4;
    ASSERT_EQ(file.substr(version, 4), std::string("\2\0\0\0", 4));
    EXPECT_TRUE(test::loaded(file, "osgb"));
    file[version] = 77;
    EXPECT_FALSE(test::loaded(file, "osgb"));
    EXPECT_NE(test::whyRefused(file, "osgb").find("the file is of version 77, which this Gnomon does not know"),
              std::string::npos)
        << test::whyRefused(file, "osgb");
}

} // namespace
