// SPDX-License-Identifier: MIT
// The house: which room a file belongs to, and which rooms a room may include. docs/architecture.md draws it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;
using Graph = std::map<std::string, Names>;

Names words(const std::string& text) {
    std::istringstream stream(text);
    Names result;
    for (std::string word; stream >> word;) result.insert(word);
    return result;
}

/// The rooms, each with those that it may include. Every room may include itself, `parts`, and what is public below it.
const Graph& mayInclude() {
    static const std::string technique = "base gl casters compositor group geometry";
    static const Graph table = {
        {"parts", {}},
        {"geometry", {}},
        {"rays", {}},
        {"sky", {}},
        {"metrics", {}},
        {"mapfit", words("geometry")},
        {"ground", words("geometry")},
        {"simd", words("ground")},
        {"choice", {}},
        {"drape", words("geometry ground simd")},
        {"onterrain", words("geometry ground simd drape")},
        {"overlay", words("geometry ground drape onterrain")},
        {"silhouette", words("geometry")},
        {"base", {}},
        {"headless", {}},
        {"gl", words("base geometry")},
        {"casters", words("base gl geometry rays")},
        {"compositor", words("base gl geometry")},
        {"group", words("base casters compositor geometry rays mapfit")},
        {"planar", words(technique)},
        {"map", words(technique + " mapfit")},
        {"terrain", words(technique + " ground drape onterrain overlay")},
        {"traced", words(technique + " rays")},
        {"auto", words(technique + " choice ground mapfit planar map silhouette terrain traced volume")},
        {"volume", words(technique + " overlay silhouette")},
        {"effects", words("base gl compositor group geometry")},
        {"query", words("base casters group rays")},
        {"spec", words("base casters group rays planar map terrain traced volume auto")},
    };
    return table;
}

/// A source file, by its path below the include root: "gnomon/map/MapMark.h".
struct File {
    std::string path;
    std::string room;
    std::vector<std::string> includes; ///< of Gnomon's own, by their paths; others as they are written.
};

/// The file an #include line names, empty for any other line.
std::string included(std::string line) {
    line.erase(std::remove(line.begin(), line.end(), ' '), line.end());
    if (line.rfind("#include<", 0) != 0 && line.rfind("#include\"", 0) != 0) return {};
    return line.substr(9, line.find_first_of(">\"", 9) - 9);
}

bool isSceneGraphOrOpenGL(const std::string& file) {
    for (const char* start : {"osg", "OpenThreads", "GL/", "GLES", "EGL/", "KHR/"})
        if (file.rfind(start, 0) == 0) return true;
    return false;
}

std::vector<std::string> includesOf(const fs::path& file) {
    std::ifstream stream(file);
    std::vector<std::string> result;
    for (std::string line; std::getline(stream, line);)
        if (const std::string name = included(line); !name.empty()) result.push_back(name);
    return result;
}

bool isPublic(const std::string& path) {
    return std::count(path.begin(), path.end(), '/') == 1 || path.rfind("gnomon/metrics/", 0) == 0;
}

/// The house as it stands on disk.
class House {
public:
    House() {
        for (const char* tree : {"/src", "/nodes"}) addTree(std::string(GNOMON_ROOT) + tree);
        for (File& file : files)
            if (file.room.empty()) file.room = roomOfPublic(file.path);
    }
    std::vector<File> files;
    std::map<std::string, Names> roomsOfTree;

private:
    void addTree(const std::string& root) {
        for (const auto& entry : fs::recursive_directory_iterator(root + "/gnomon")) {
            const std::string extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            File file;
            file.path = fs::relative(entry.path(), root).generic_string();
            const fs::path folder = fs::path(file.path).parent_path();
            if (folder != "gnomon") {
                file.room = folder.filename();
                roomsOfTree[root].insert(file.room);
            }
            file.includes = includesOf(entry.path());
            files.push_back(file);
        }
    }
    /// A public header is of the room of its source file; one without is of `base`, in src/ of `ground`.
    std::string roomOfPublic(const std::string& header) const {
        const std::string name = fs::path(header).stem();
        for (const File& file : files)
            if (fs::path(file.path).filename() == name + ".cpp") return file.room;
        static const std::map<std::string, std::string> headerOnly = {{"Ground", "ground"},
                                                                      {"Export", "parts"},
                                                                      {"CompositorOptions", "compositor"},
                                                                      {"HeadlessOptions", "headless"},
                                                                      {"PlanarCures", "planar"},
                                                                      {"ShadowSpec", "spec"},
                                                                      {"TerrainShadowOptions", "terrain"}};
        const auto found = headerOnly.find(name);
        return found == headerOnly.end() ? "base" : found->second;
    }
};

const House& house() {
    static const House one;
    return one;
}

const File* find(const std::string& path) {
    for (const File& file : house().files)
        if (file.path == path) return &file;
    return nullptr;
}

/// "a -> b" for each include that the table does not allow.
std::vector<std::string> forbidden(const std::vector<File>& files, const Graph& table) {
    std::vector<std::string> result;
    for (const File& file : files)
        for (const std::string& path : file.includes) {
            const File* target = find(path);
            if (!target || target->room == file.room || target->room == "parts") continue;
            const auto row = table.find(file.room);
            if (row == table.end() || !row->second.count(target->room)) result.push_back(file.path + " -> " + path);
        }
    return result;
}

/// The nodes of a circle, or none.
std::vector<std::string> circleIn(const Graph& graph) {
    std::map<std::string, int> state;
    std::vector<std::string> way;
    const std::function<bool(const std::string&)> visit = [&](const std::string& node) {
        state[node] = 1;
        way.push_back(node);
        const auto next = graph.find(node);
        if (next != graph.end())
            for (const std::string& to : next->second) {
                if (state[to] == 1) {
                    way.push_back(to);
                    return true;
                }
                if (state[to] == 0 && visit(to)) return true;
            }
        state[node] = 2;
        way.pop_back();
        return false;
    };
    for (const auto& [node, to] : graph)
        if (state[node] == 0 && visit(node)) return way;
    return {};
}

/// A header, its source file, and what that includes in place of code ("-inl.h").
std::string unitOf(const std::string& path) {
    const std::string name = fs::path(path).stem();
    if (name.find("-inl") == std::string::npos) return name;
    return name.find("RayScene") == 0 ? "RayScene" : "ShadowKernel";
}

/// Which unit (a header and its source file) includes which.
Graph units() {
    Graph graph;
    for (const File& file : house().files)
        for (const std::string& path : file.includes)
            if (find(path) && unitOf(path) != unitOf(file.path)) graph[unitOf(file.path)].insert(unitOf(path));
    return graph;
}

} // namespace

TEST(Architecture, TheMathsIncludesNeitherOpenSceneGraphNorOpenGL) {
    int files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(std::string(GNOMON_ROOT) + "/src")) {
        if (!entry.is_regular_file()) continue;
        ++files;
        for (const std::string& name : includesOf(entry.path()))
            EXPECT_FALSE(isSceneGraphOrOpenGL(name)) << entry.path() << " includes " << name;
    }
    EXPECT_GT(files, 50) << "else this has looked in the wrong place";
}

TEST(Architecture, TheMathsIncludesNoNodes) {
    for (const auto& [tree, rooms] : house().roomsOfTree) {
        if (tree != std::string(GNOMON_ROOT) + "/src") continue;
        for (const std::string& room : rooms)
            for (const std::string& other : mayInclude().at(room))
                EXPECT_TRUE(rooms.count(other)) << room << " may include " << other;
    }
}

TEST(Architecture, EveryFileHasARoomAndEveryRoomAnEntry) {
    Names seen;
    for (const File& file : house().files) {
        EXPECT_TRUE(mayInclude().count(file.room)) << file.path << " is in '" << file.room << "'";
        const bool mayBeSource = !isPublic(file.path) || file.room == "metrics";
        EXPECT_TRUE(mayBeSource || fs::path(file.path).extension() == ".h") << file.path << " belongs to a room";
        seen.insert(file.room);
    }
    for (const auto& [room, others] : mayInclude()) EXPECT_TRUE(seen.count(room)) << room << " is empty";
}

TEST(Architecture, NoRoomNameOccursTwice) {
    ASSERT_EQ(house().roomsOfTree.size(), 2u);
    const Names& first = house().roomsOfTree.begin()->second;
    for (const std::string& room : house().roomsOfTree.rbegin()->second) EXPECT_FALSE(first.count(room)) << room;
}

TEST(Architecture, ARoomIncludesOnlyWhatLiesBelowIt) {
    EXPECT_EQ(forbidden(house().files, mayInclude()), std::vector<std::string>());
}

TEST(Architecture, RoomsStandOnOneAnotherWithoutACircle) {
    EXPECT_EQ(circleIn(mayInclude()), std::vector<std::string>());
}

TEST(Architecture, UnitsIncludeOneAnotherWithoutACircle) { EXPECT_EQ(circleIn(units()), std::vector<std::string>()); }

TEST(Architecture, NoTechniqueKnowsAnother) {
    const Names techniques = words("planar map terrain traced");
    for (const std::string& technique : techniques)
        for (const std::string& other : mayInclude().at(technique)) EXPECT_FALSE(techniques.count(other)) << technique;
}

TEST(Architecture, PublicHeadersIncludeOnlyPublicOnes) {
    int headers = 0;
    for (const File& file : house().files) {
        if (!isPublic(file.path) || fs::path(file.path).extension() != ".h") continue;
        ++headers;
        for (const std::string& path : file.includes)
            EXPECT_TRUE(!find(path) || isPublic(path)) << file.path << " includes " << path;
    }
    EXPECT_GT(headers, 30);
}

/// Programs are users: they see what is installed.
TEST(Architecture, ProgramsAndWrappersIncludeOnlyPublicHeaders) {
    int files = 0;
    for (const char* folder : {"/examples", "/nodes/plugins"})
        for (const auto& entry : fs::recursive_directory_iterator(std::string(GNOMON_ROOT) + folder)) {
            if (!entry.is_regular_file()) continue;
            ++files;
            for (const std::string& path : includesOf(entry.path()))
                EXPECT_TRUE(!find(path) || isPublic(path)) << entry.path() << " includes " << path;
        }
    EXPECT_GT(files, 50);
}

/// Rows "| `room` | holds | may include | tested by |".
TEST(Architecture, ThePageNamesTheSameArrows) {
    std::ifstream page(std::string(GNOMON_ROOT) + "/docs/architecture.md");
    Graph drawn;
    for (std::string line; std::getline(page, line);) {
        if (line.rfind("| `", 0) != 0) continue;
        std::istringstream row(line);
        std::string empty, room, holds, includes;
        for (std::string* cell : {&empty, &room, &holds, &includes}) std::getline(row, *cell, '|');
        Names others = words(includes);
        others.erase("nothing");
        drawn[room.substr(2, room.size() - 4)] = others;
    }
    EXPECT_EQ(drawn, mayInclude());
}

TEST(Architecture, NothingIsIncludedThatIsNotThere) {
    for (const File& file : house().files)
        for (const std::string& path : file.includes)
            EXPECT_TRUE(path.rfind("gnomon/", 0) != 0 || find(path)) << file.path << " includes " << path;
}

// The test itself.

TEST(Architecture, KnowsAnOffendingLineWhenItSeesOne) {
    EXPECT_TRUE(isSceneGraphOrOpenGL(included("#include <osg/Matrixd>")));
    EXPECT_TRUE(isSceneGraphOrOpenGL(included("  # include \"osgUtil/CullVisitor\"")));
    EXPECT_TRUE(isSceneGraphOrOpenGL(included("#include <GL/gl.h>")));
    EXPECT_TRUE(isSceneGraphOrOpenGL(included("#include <EGL/egl.h>")));
    EXPECT_TRUE(isSceneGraphOrOpenGL(included("#include <OpenThreads/Mutex>")));
    EXPECT_FALSE(isSceneGraphOrOpenGL(included("#include <glm/vec3.hpp>")));
    EXPECT_FALSE(isSceneGraphOrOpenGL(included("/// the same bytes as an osg::Matrixd")));
}

TEST(Architecture, KnowsAnArrowThatPointsUpWhenItSeesOne) {
    const std::vector<File> files = {{"gnomon/gl/New.h", "gl", {"gnomon/compositor/Compositor.h", "gnomon/Convert.h"}}};
    EXPECT_EQ(forbidden(files, mayInclude()),
              std::vector<std::string>{"gnomon/gl/New.h -> gnomon/compositor/Compositor.h"});
}

TEST(Architecture, KnowsACircleWhenItSeesOne) {
    EXPECT_EQ(circleIn({{"a", {"b"}}, {"b", {"c"}}, {"c", {"b"}}}), (std::vector<std::string>{"a", "b", "c", "b"}));
    EXPECT_EQ(circleIn({{"a", {"b", "c"}}, {"b", {"c"}}}), std::vector<std::string>());
}
