// SPDX-License-Identifier: MIT
// Every class of the kit has a wrapper, every property a serializer: the public headers are compared with the plugin.
#include "SceneText.h"

#include <gtest/gtest.h>

#include <osgDB/ObjectWrapper>
#include <osgDB/Registry>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <vector>

namespace {

using Names = std::vector<std::string>;

/// A class as its header declares it, without comments.
struct Declaration {
    std::string name, bases;
    std::string publicPart; ///< of its body.
    bool abstract() const { return !std::regex_search(publicPart, std::regex("META_\\w+\\(gnomon,")); }
    bool derivesFrom(const std::string& base) const {
        return std::regex_search(bases, std::regex("public " + base + "\\b"));
    }
};

/// Classes at the outermost level of a header.
std::vector<Declaration> declarationsIn(const std::filesystem::path& header) {
    std::ifstream file(header);
    std::string text;
    for (std::string line; std::getline(file, line);) text += line.substr(0, line.find("//")) + "\n";
    static const std::regex head("\nclass (?:[A-Z_]+ )?(\\w+)(?: final)?([^;{]*)\\{");
    std::vector<Declaration> result;
    for (std::sregex_iterator at(text.begin(), text.end(), head), end; at != end; ++at) {
        const auto from = std::size_t(at->position() + at->length());
        const std::string body = text.substr(from, text.find("\n};", from) - from);
        result.push_back(
            {at->str(1), at->str(2), body.substr(0, std::min(body.find("\nprotected:"), body.find("\nprivate:")))});
    }
    return result;
}

/// What a file may hold: ShadowTechnique, and what is made as an object of the library gnomon.
std::vector<Declaration> kit() {
    std::vector<Declaration> result;
    for (const auto& file : std::filesystem::directory_iterator(GNOMON_NODES)) {
        if (file.path().extension() != ".h") continue;
        for (const Declaration& type : declarationsIn(file.path())) {
            const bool keeps =
                !type.abstract() || type.name == "ShadowTechnique" || type.derivesFrom("ShadowTechnique");
            if (keeps && !type.derivesFrom("osg::NodeVisitor")) result.push_back(type);
        }
    }
    return result;
}

osgDB::ObjectWrapper* wrapperOf(const std::string& name) {
    return osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper("gnomon::" + name);
}

/// X of every `void setX(`, and Xs of every `void addX(`.
Names propertiesOf(const Declaration& type) {
    static const std::regex setter("void (set|add)(\\w+)");
    Names names;
    for (std::sregex_iterator at(type.publicPart.begin(), type.publicPart.end(), setter), end; at != end; ++at)
        names.push_back(at->str(2) + (at->str(1) == "add" ? "s" : ""));
    return names;
}

/// Fields of the struct that a property takes, by the names of their own properties: "sunAngle" is SunAngle. None if
/// it takes no struct with a public header.
Names fieldsOf(const Declaration& type, const std::string& property) {
    static const std::regex field("    [A-Za-z]+ ([a-z])([A-Za-z]*)( = [^;()]+)?;");
    std::smatch match;
    if (!std::regex_search(type.publicPart, match, std::regex("void set" + property + "\\(const ([A-Za-z]+)&")))
        return {};
    std::ifstream header(std::string(GNOMON_NODES) + "/" + match.str(1) + ".h");
    Names names;
    for (std::string line; std::getline(header, line);)
        if (std::regex_match(line, match, field))
            names.push_back(std::string(1, char(std::toupper(match.str(1)[0]))) + match.str(2));
    return names;
}

/// True if files keep a property: by its own serializer, or its fields one by one.
bool keeps(osgDB::ObjectWrapper& wrapper, const Declaration& type, const std::string& property) {
    const Names fields = fieldsOf(type, property);
    const auto isKept = [&](const std::string& name) { return wrapper.getSerializer(name) != nullptr; };
    return isKept(property) || (!fields.empty() && std::all_of(fields.begin(), fields.end(), isKept));
}

bool savesAs(const osgDB::ObjectWrapper& wrapper, const std::string& name) {
    const auto& associates = wrapper.getAssociates();
    return std::any_of(associates.begin(), associates.end(),
                       [&](const auto& associate) { return associate._name == "gnomon::" + name; });
}

TEST(Wrappers, LoseNothingOfTheKit) {
    test::usePluginsOfThisBuild();
    const std::vector<Declaration> classes = kit();
    std::size_t properties = 0;
    for (const Declaration& type : classes) {
        osgDB::ObjectWrapper* wrapper = wrapperOf(type.name);
        ASSERT_TRUE(wrapper) << type.name << " has no wrapper";
        for (const std::string& property : propertiesOf(type)) {
            EXPECT_TRUE(keeps(*wrapper, type, property)) << type.name << "::" << property << " has no serializer";
            ++properties;
        }
        for (const Declaration& base : classes)
            EXPECT_TRUE(savesAs(*wrapper, base.name) || !(type.derivesFrom(base.name) || type.name == base.name))
                << type.name << " leaves out what " << base.name << " has";
        const osg::ref_ptr<osg::Object> object = wrapper->createInstance();
        if (object) EXPECT_EQ(object->getCompoundClassName(), "gnomon::" + type.name);
        EXPECT_EQ(object == nullptr, type.abstract()) << type.name;
    }
    EXPECT_GE(classes.size(), 10u) << "the headers were not understood";
    EXPECT_GE(properties, 40u);
}

} // namespace
