// SPDX-License-Identifier: MIT
// Files of other versions: what is added later does not harm what is read, and what cannot be read is refused with the
// reason. Binary files know no names: there a property too many, or one too few, would make all that follows wrong.
#include "EverySetting.h"
#include "SceneFile.h"

#include <gnomon/HaloNode.h>
#include <gnomon/ShadowCasterGroup.h>

#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>
#include <osgDB/Serializer>

#include <algorithm>

namespace {

using gnomon::HaloNode;
using gnomon::ShadowCasterGroup;
using test::SceneFile;

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
    const std::string marked = test::written(*test::everySetting(), kind());
    const AddedProperty added;
    const osg::ref_ptr<HaloNode> halo = new HaloNode;
    halo->setNodeMask(0x1234u);
    halo->setWidth(5);
    const auto copy = test::throughFile(*halo, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getNodeMask(), 0x1234u);
    EXPECT_EQ(copy->getWidth(), 5);
    EXPECT_NE(test::written(*test::everySetting(), kind()), marked) << "the property was not written";
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
