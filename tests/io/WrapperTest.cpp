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
#include <sstream>
#include <vector>

namespace {

using Names = std::vector<std::string>;

/// A class as its header declares it.
struct Declaration {
    std::string name;
    std::string bases;      ///< between its name and its body.
    std::string publicPart; ///< of its body.
    bool named = false;     ///< it tells OSG that it is of the library gnomon.
    bool abstract = false;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::string identifierAt(const std::string& text, std::size_t place) {
    const auto end = std::find_if(text.begin() + std::ptrdiff_t(place), text.end(),
                                  [](unsigned char c) { return !std::isalnum(c) && c != '_'; });
    return text.substr(place, std::size_t(end - text.begin()) - place);
}

std::string withoutComments(std::istream& header) {
    std::string text, line;
    while (std::getline(header, line)) text += line.substr(0, line.find("//")) + "\n";
    return text;
}

/// What stands before the first of these.
std::string upTo(const std::string& text, const Names& ends) {
    std::size_t end = text.size();
    for (const std::string& candidate : ends) end = std::min(end, text.find(candidate));
    return text.substr(0, end);
}

Declaration declaration(const std::string& head, const std::string& body) {
    Declaration result;
    const std::string beforeBases = upTo(head, {" final", " :", ":", " {"});
    result.name = identifierAt(beforeBases, beforeBases.find_last_of(' ') + 1);
    result.bases = head.substr(beforeBases.size());
    result.publicPart = upTo(body, {"\nprotected:", "\nprivate:"});
    const bool meta = contains(body, "META_Node(gnomon,") || contains(body, "META_Object(gnomon,") ||
                      contains(body, "META_StateAttribute(gnomon,");
    result.named = (meta || contains(body, "libraryName() const override { return \"gnomon\"")) &&
                   !contains(result.bases, "public osgUtil::"); // part of a frame, never of a scene
    result.abstract = !meta;
    return result;
}

/// Classes that a header without comments defines at the outermost level.
std::vector<Declaration> declarationsIn(const std::string& header) {
    std::vector<Declaration> result;
    for (std::size_t at = header.find("\nclass "); at != std::string::npos; at = header.find("\nclass ", at + 1)) {
        const std::size_t body = header.find_first_of("{;", at);
        if (body == std::string::npos || header[body] == ';') continue;
        result.push_back(
            declaration(header.substr(at + 1, body - at - 1), header.substr(body, header.find("\n};", body) - body)));
    }
    return result;
}

/// X of every `void setX(`, and Xs of every `void addX(`.
Names propertiesOf(const Declaration& type) {
    Names names;
    for (const std::string verb : {"void set", "void add"})
        for (std::size_t at = type.publicPart.find(verb); at != std::string::npos;
             at = type.publicPart.find(verb, at + 1))
            names.push_back(identifierAt(type.publicPart, at + verb.size()) + (verb == "void add" ? "s" : ""));
    return names;
}

std::vector<Declaration> kitClassesIn(std::vector<Declaration> all) {
    const auto derivesFromKit = [&](const Declaration& type) {
        return std::any_of(all.begin(), all.end(), [&](const Declaration& base) {
            return base.named && contains(type.bases + " ", "public " + base.name + " ");
        });
    };
    for (bool grown = true; grown;) {
        grown = false;
        for (Declaration& type : all)
            if (!type.named && derivesFromKit(type)) type.named = grown = true;
    }
    const auto isNotKept = [](const Declaration& type) {
        return !type.named || type.name == "ShadowedScene"; // files hold the ShadowCasterGroup that it is
    };
    all.erase(std::remove_if(all.begin(), all.end(), isNotKept), all.end());
    return all;
}

osgDB::ObjectWrapper* wrapperOf(const std::string& name) {
    return osgDB::Registry::instance()->getObjectWrapperManager()->findWrapper("gnomon::" + name);
}

bool savesAs(const osgDB::ObjectWrapper& wrapper, const std::string& name) {
    const auto& associates = wrapper.getAssociates();
    return std::any_of(associates.begin(), associates.end(),
                       [&](const auto& associate) { return associate._name == "gnomon::" + name; });
}

/// Fields of the struct that a property takes, by the names of their own properties: "sunAngle" is SunAngle. None if
/// it takes no struct with a public header.
Names fieldsOf(const Declaration& type, const std::string& property) {
    static const std::regex field("    [A-Za-z]+ ([a-z])([A-Za-z]*)( = [^;()]+)?;");
    std::smatch match;
    if (!std::regex_search(type.publicPart, match, std::regex("void set" + property + "\\(const ([A-Za-z]+)&")))
        return {};
    std::ifstream header(std::string(GNOMON_NODES) + "/" + match[1].str() + ".h");
    Names names;
    for (std::string line; std::getline(header, line);)
        if (std::regex_match(line, match, field))
            names.push_back(std::string(1, char(std::toupper(match[1].str()[0]))) + match[2].str());
    return names;
}

/// True if files keep a property: by its own serializer, or its fields one by one.
bool keeps(osgDB::ObjectWrapper& wrapper, const Declaration& type, const std::string& property) {
    const Names fields = fieldsOf(type, property);
    return wrapper.getSerializer(property) ||
           (!fields.empty() && std::all_of(fields.begin(), fields.end(), [&](const std::string& field) {
               return wrapper.getSerializer(field) != nullptr;
           }));
}

/// What files would lose: one line a class without a wrapper, a property without a serializer, a base left out.
Names lostInFiles(const std::vector<Declaration>& kit) {
    Names lost;
    for (const Declaration& type : kit) {
        osgDB::ObjectWrapper* wrapper = wrapperOf(type.name);
        if (!wrapper) {
            lost.push_back(type.name + " has no wrapper");
            continue;
        }
        for (const std::string& property : propertiesOf(type))
            if (!keeps(*wrapper, type, property)) lost.push_back(type.name + "::" + property + " has no serializer");
        for (const Declaration& base : kit)
            if ((contains(type.bases + " ", "public " + base.name + " ") || base.name == type.name) &&
                !savesAs(*wrapper, base.name))
                lost.push_back(type.name + " leaves out what " + base.name + " has");
    }
    return lost;
}

std::vector<Declaration> kit() {
    std::vector<Declaration> all;
    for (const auto& file : std::filesystem::directory_iterator(GNOMON_NODES)) {
        if (file.path().extension() != ".h") continue;
        std::ifstream header(file.path());
        for (const Declaration& type : declarationsIn(withoutComments(header))) all.push_back(type);
    }
    return kitClassesIn(all);
}

std::vector<Declaration> kitOf(const std::string& header) {
    std::istringstream text(header);
    return kitClassesIn(declarationsIn(withoutComments(text)));
}

class Wrappers : public testing::Test {
protected:
    static void SetUpTestSuite() { test::usePluginsOfThisBuild(); }
};

TEST_F(Wrappers, LoseNothingOfTheKit) {
    const std::vector<Declaration> classes = kit();
    Names names;
    for (const Declaration& type : classes) names.push_back(type.name);
    for (const char* known : {"PlanarShadowNode", "ShadowCasterGroup", "ShadowTechnique"})
        EXPECT_TRUE(std::count(names.begin(), names.end(), known)) << known << " was not found in the headers";
    EXPECT_EQ(lostInFiles(classes), Names());
}

TEST_F(Wrappers, MakeObjectsOfTheirClass) {
    for (const Declaration& type : kit()) {
        const osgDB::ObjectWrapper* wrapper = wrapperOf(type.name);
        if (!wrapper || type.abstract) continue;
        const osg::ref_ptr<osg::Object> object = wrapper->createInstance();
        ASSERT_TRUE(object) << type.name;
        EXPECT_EQ(object->getCompoundClassName(), "gnomon::" + type.name);
    }
}

TEST_F(Wrappers, AreMissedWhereAClassHasNone) {
    EXPECT_EQ(lostInFiles(kitOf("\nclass GNOMON_EXPORT Moon : public osg::Group {\npublic:\n"
                                "    META_Node(gnomon, Moon)\n    void setPhase(double phase);\n};\n")),
              Names{"Moon has no wrapper"});
    EXPECT_EQ(lostInFiles(kitOf("\nclass ShadowTechnique : public osg::Geode {\n"
                                "    const char* libraryName() const override { return \"gnomon\"; }\n};\n"
                                "\nclass Moon : public ShadowTechnique {\npublic:\n};\n")),
              Names{"Moon has no wrapper"});
}

TEST_F(Wrappers, AreMissedWhereAPropertyHasNone) {
    EXPECT_EQ(lostInFiles(kitOf("\nclass GNOMON_EXPORT PlanarShadowNode : public ShadowTechnique {\npublic:\n"
                                "    META_Node(gnomon, PlanarShadowNode)\n"
                                "    void addPlane(const osg::Vec4d& plane);\n"
                                "    void setOffset(double offset) { _offset = offset; }\n"
                                "    // void setIdea(int idea);\n"
                                "private:\n    void setUp();\n};\n")),
              Names{"PlanarShadowNode::Offset has no serializer"});
}

TEST_F(Wrappers, MayKeepTheFieldsOfAStructOneByOneButAllOfThem) {
    const std::string begin = "\nclass GNOMON_EXPORT ",
                      options = " : public ShadowTechnique {\npublic:\n    META_Node(gnomon, ";
    const std::string end = ")\n    void setOptions(const ShadowMapOptions& options);\n};\n";
    EXPECT_EQ(lostInFiles(kitOf(begin + "ShadowMapTechnique" + options + "ShadowMapTechnique" + end)), Names());
    EXPECT_EQ(lostInFiles(kitOf(begin + "TerrainShadowGeode" + options + "TerrainShadowGeode" + end)),
              Names{"TerrainShadowGeode::Options has no serializer"});
}

TEST_F(Wrappers, AreMissedWhereTheyLeaveOutABase) {
    EXPECT_EQ(lostInFiles(kitOf("\nclass ShadowTechnique : public ShadowCasterGroup {\npublic:\n"
                                "    const char* libraryName() const override { return \"gnomon\"; }\n};\n"
                                "\nclass ShadowCasterGroup : public osg::Group {\npublic:\n"
                                "    META_Node(gnomon, ShadowCasterGroup)\n};\n")),
              Names{"ShadowTechnique leaves out what ShadowCasterGroup has"});
}

} // namespace
