// SPDX-License-Identifier: MIT
// Files keep every setting of every node.
#include "EverySetting.h"
#include "SceneFile.h"

#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>

#include <sstream>

namespace {

using test::SceneFile;

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
    const std::string file = test::written(*test::everySetting(), "osgt");
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
    const osg::ref_ptr<osg::Group> scene = test::everySetting();
    const auto copy = test::throughFile(*scene, kind());
    ASSERT_TRUE(copy);
    EXPECT_EQ(test::written(*copy, "osgt"), test::written(*scene, "osgt"));
}

} // namespace
