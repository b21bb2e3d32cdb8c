// SPDX-License-Identifier: MIT
// What shadows add to a frame on the processor alone, as on a machine whose graphics card draws in no time: Mesa draws nothing
// here. In milliseconds or, under valgrind, in millions of instructions, which a busy machine does not change. Each figure
// comes from a process of its own, so that none depends on what was drawn before.
#include "Contenders.h"

#include <FrameTime.h>
#include <Mesh.h>
#include <OtherProcess.h>
#include <ProcessorAlone.h>
#include <StageViewer.h>

#include <osg/Geometry>
#include <osg/Image>
#include <osg/MatrixTransform>
#include <osg/NodeVisitor>
#include <osg/Texture2D>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <stdexcept>

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
constexpr bool canCount = true;
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
constexpr bool canCount = false;
#endif

namespace {

using gnomon::examples::after;
using gnomon::examples::ChartScene;
using gnomon::examples::Ending;
using gnomon::examples::Receives;
using gnomon::examples::runCommand;
using gnomon::examples::shellWord;
using gnomon::examples::StageViewer;
using gnomon::examples::thisProgram;
using Names = std::vector<std::string>;

constexpr int width = 800, height = 600;
constexpr int warmUp = 12;    // frames: from the ninth on auto has chosen for what moves
constexpr double step = 0.25; // degrees a frame, of the camera and of the light

const std::string alone = "none", peer = "ShadowMap"; // what all are compared with
const Names allScenes = {"town-400", "town-4000", "bodies-1000", "hills", "leaves-100", "solids-100"};
const Names allMotions = {"still", "camera", "light", "body"};
const Names usualTechniques = {"Minimal",
                               "LightSpacePerspective VB",
                               "ViewDependent perspective",
                               "volume:composite=blend",
                               "volume",
                               "map:composite=blend",
                               "map",
                               "hull:composite=blend",
                               "hull",
                               "auto:composite=blend",
                               "auto"};

/// What the command line asks for.
struct Wish {
    Names scenes, motions, techniques;
    int frames = 0;
    bool instructions = false, here = false;
};

/// Vertices in buffers, as programs of today have them, and not in display lists.
struct Buffered : osg::NodeVisitor {
    Buffered() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}
    void apply(osg::Geometry& geometry) override {
        geometry.setUseDisplayList(false);
        geometry.setUseVertexBufferObjects(true);
    }
};

/// Houses on level ground, which is the first child: a drawable each or, as bodies, that in a transform of its own.
osg::ref_ptr<osg::Group> houses(int count, bool asBodies) {
    const int side = 2 * static_cast<int>(std::ceil(std::sqrt(count) / 2.0));
    std::vector<test::Mesh> all = test::town(side);
    all.resize(static_cast<std::size_t>(count));
    osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(test::node(test::square(2.5 * side), "ground"));
    for (const test::Mesh& house : all) {
        const glm::dvec3 at = asBodies ? house.front() : glm::dvec3(0.0);
        osg::ref_ptr<osg::Node> node = test::node(test::moved(house, -at));
        if (asBodies) {
            osg::ref_ptr<osg::MatrixTransform> body =
                new osg::MatrixTransform(osg::Matrixd::translate(at.x, at.y, at.z));
            body->addChild(node);
            node = body;
        }
        group->addChild(node);
    }
    return group;
}

/// Clear outside a disc.
osg::ref_ptr<osg::Texture2D> leafTexture() {
    constexpr int side = 64;
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const bool inside = std::hypot(x - 31.5, y - 31.5) < 28.0;
            const unsigned char texel[4] = {90, 160, 60, static_cast<unsigned char>(inside ? 255 : 0)};
            std::copy_n(texel, 4, image->data(unsigned(x), unsigned(y)));
        }
    return new osg::Texture2D(image);
}

/// Trees of 720 triangles of leaves on level ground, which is the first child: a drawable each, which blends, or not.
osg::ref_ptr<osg::Group> trees(int count, bool blends) {
    constexpr int leaves = 360;
    std::mt19937 random(1);
    const auto any = [&random] { return double(random()) / 4294967295.0 * 2.0 - 1.0; }; // -1 … 1
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    const osg::ref_ptr<osg::Group> group = new osg::Group;
    group->addChild(test::node(test::square(2.5 * side), "ground"));
    const osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setTextureAttributeAndModes(0, leafTexture());
    if (blends) {
        state->setMode(GL_BLEND, osg::StateAttribute::ON);
        state->setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    }
    for (int tree = 0; tree < count; ++tree) {
        const glm::dvec3 foot(5.0 * (tree % side - side / 2.0), 5.0 * (tree / side - side / 2.0), 0.0);
        test::Mesh mesh;
        const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
        for (int leaf = 0; leaf < leaves; ++leaf) {
            const glm::dvec3 middle = foot + glm::dvec3(1.5 * any(), 1.5 * any(), 3.0 + 1.5 * any());
            const glm::dvec3 along = 0.15 * glm::normalize(glm::dvec3(any(), any(), any() + 1e-3)),
                             across = 0.15 * glm::normalize(glm::cross(along, glm::dvec3(any(), any(), 1.0)));
            const glm::dvec3 a = middle - along - across, b = middle + along - across, c = middle + along + across,
                             d = middle - along + across;
            mesh.insert(mesh.end(), {a, b, c, a, c, d});
            for (const osg::Vec2& at :
                 {osg::Vec2(0, 0), osg::Vec2(1, 0), osg::Vec2(1, 1), osg::Vec2(0, 0), osg::Vec2(1, 1), osg::Vec2(0, 1)})
                places->push_back(at);
        }
        const osg::ref_ptr<osg::Geode> node = test::node(mesh, "tree");
        node->getDrawable(0)->asGeometry()->setTexCoordArray(0, places, osg::Array::BIND_PER_VERTEX);
        node->setStateSet(state);
        group->addChild(node);
    }
    return group;
}

osg::ref_ptr<osg::Node> filesOf(const std::string& scene) {
    if (scene == "hills") return gnomon::examples::chartScene("hills-45", width, height).content->getChild(0);
    const bool blends = scene.rfind("leaves", 0) == 0;
    if (blends || scene.rfind("solids", 0) == 0) return trees(std::stoi(scene.substr(7)), blends);
    return houses(std::stoi(scene.substr(scene.find('-') + 1)), scene.rfind("bodies", 0) == 0);
}

/// All of it in view.
ChartScene sceneOf(const std::string& name) {
    gnomon::examples::ViewOptions view;
    view.lights = {bench::sun};
    view.ground = "none";
    view.width = width;
    view.height = height;
    return gnomon::examples::chartSceneOf(*filesOf(name), view);
}

/// A scene, and the house in its middle, which may move.
struct Stage {
    explicit Stage(const std::string& name) : scene(sceneOf(name)) {
        Buffered buffered;
        scene.content->accept(buffered);
        osg::Group& all = *scene.content->getChild(0)->asGroup();
        const unsigned middle = all.getNumChildren() / 2;
        body->addChild(all.getChild(middle));
        all.setChild(middle, body);
    }
    void move(StageViewer& viewer, const std::string& motion, int frame) {
        if (motion == "camera") viewer.setCamera(movedCamera(scene, step * frame));
        if (motion == "light") viewer.staging().setLight(movedLight(scene, step * frame));
        if (motion == "body") body->setMatrix(osg::Matrixd::translate(0.02 * frame, 0.0, 0.0));
    }

    ChartScene scene;
    osg::ref_ptr<osg::MatrixTransform> body = new osg::MatrixTransform;
};

/// @throws std::invalid_argument, one sentence.
gnomon::examples::Contender contenderOf(const std::string& technique) {
    if (technique == alone) return gnomon::examples::plainContender();
    for (const gnomon::examples::Peer& each : gnomon::examples::peers())
        if (each.name == technique) return peerContender(each, "defaults", {});
    const std::string name = gnomon::parseShadowSpec(technique).technique;
    return gnomon::examples::gnomonContender(technique, name == "planar"                  ? Receives::FLAT
                                                        : name == "box" || name == "hull" ? Receives::TERRAIN
                                                                                          : Receives::EVERYTHING);
}

/// In this process: prints the median time of a frame, ms. Callgrind counts the same frames if it looks on.
int drawHere(const Wish& wish) {
    gnomon::examples::drawNothing();
    Stage stage(wish.scenes.front());
    StageViewer viewer(contenderOf(wish.techniques.front()).stage(stage.scene, gnomon::examples::Look::SHADED),
                       stage.scene.camera, StageViewer::Colour::BYTES);
    std::vector<double> times;
    for (int frame = -warmUp; frame < wish.frames; ++frame) {
        stage.move(viewer, wish.motions.front(), frame + warmUp);
        if (frame == 0) CALLGRIND_START_INSTRUMENTATION;
        const double time = viewer.time().wall;
        if (frame >= 0) times.push_back(time);
    }
    CALLGRIND_STOP_INSTRUMENTATION;
    std::printf("a frame takes %.4f ms\n", gnomon::examples::quartiles(times).median);
    return 0;
}

/// What another process has found, ms or millions of instructions a frame; or why it has found nothing.
struct Figure {
    double value;
    std::string why;
};

Figure figureOf(const Wish& wish, const std::string& scene, const std::string& motion, const std::string& technique) {
    const std::string frames = std::to_string(wish.frames);
    const std::string counter =
        "valgrind --tool=callgrind --instr-atstart=no --callgrind-out-file=/dev/null "; // what is said at the end is enough
    const Ending ending =
        runCommand((wish.instructions ? counter : "") + shellWord(thisProgram()) + " --here --scene " + scene +
                   " --motion " + motion + " --technique " + shellWord(technique) + " --frames " + frames);
    if (ending.status != 0) {
        const std::string why = after("bench_processor: ", ending.said);
        return {std::nan(""), why.empty() ? "its process ended too soon." : why};
    }
    if (!wish.instructions) return {std::stod(after("a frame takes ", ending.said)), ""};
    return {std::stod(after("Collected :", ending.said)) / wish.frames / 1e6, ""};
}

/// A column of 18 characters: what is added to the frame alone, and its share of what the peer adds.
std::string added(double figure, double frameAlone, double framePeer) {
    if (!std::isfinite(figure)) return std::string(17, ' ') + "-";
    char text[32];
    std::snprintf(text, sizeof text, "%11.2f %6.2f", figure - frameAlone,
                  (figure - frameAlone) / (framePeer - frameAlone));
    return text;
}

/// A row for each technique, a column for each motion; after the frame alone and the peer.
void printScene(const Wish& wish, const std::string& scene) {
    std::printf("%s, %dx%d, %s a frame: the frame alone, what shadows add, and the share of what %s adds\n%-30s",
                scene.c_str(), width, height, wish.instructions ? "millions of instructions" : "ms", peer.c_str(), "");
    for (const std::string& motion : wish.motions) std::printf("%18s", motion.c_str());
    std::vector<double> frameAlone, framePeer;
    std::string notes;
    for (const std::string& technique : wish.techniques) {
        std::printf("\n%-30s", technique.c_str());
        for (std::size_t i = 0; i < wish.motions.size(); ++i) {
            const Figure figure = figureOf(wish, scene, wish.motions[i], technique);
            if (technique == alone && !figure.why.empty()) throw std::runtime_error(figure.why);
            if (!figure.why.empty()) notes += "  " + technique + ", " + wish.motions[i] + ": " + figure.why + "\n";
            if (technique == alone) frameAlone.push_back(figure.value);
            if (technique == peer) framePeer.push_back(figure.value);
            if (technique == alone)
                std::printf("%11.2f       ", figure.value);
            else
                std::printf("%s", added(figure.value, frameAlone[i], framePeer[i]).c_str());
            std::fflush(stdout);
        }
    }
    std::printf("\n%s", notes.c_str());
}

std::string listed(const Names& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

/// Takes names of a list, all of it without any.
gnomon::examples::Option someOf(const std::string& option, const std::string& what, const Names& all, Names& into) {
    const auto take = [&all, &into](const std::string& value) {
        if (std::find(all.begin(), all.end(), value) == all.end())
            throw std::invalid_argument("Allowed: " + listed(all) + ".");
        into.push_back(value);
    };
    return {option, "NAME", what + ": " + listed(all), "all", take, true};
}

gnomon::examples::Options optionsInto(Wish& wish) {
    const auto takeTechnique = [&wish](const std::string& value) {
        contenderOf(value);
        wish.techniques.push_back(value);
    };
    return {{"--instructions", "", "count instructions by valgrind's callgrind, and take no times", "",
             [&wish](const std::string&) { wish.instructions = true; }},
            someOf("--scene", "what is drawn", allScenes, wish.scenes),
            someOf("--motion", "what moves", allMotions, wish.motions),
            {"--technique", "NAME",
             "a specification as of gnomonshot --shadow, or a name of osgShadow's as of gnomonchart --list",
             "some of both", takeTechnique, true},
            {"--here", "",
             "draw the one scene, motion and technique that are named in this process, and print the frame's time: for "
             "profilers",
             "", [&wish](const std::string&) { wish.here = true; }}};
}

/// Fills in what is not named. @throws std::invalid_argument or std::runtime_error, one sentence, if it cannot be done.
void complete(Wish& wish) {
    if (wish.here && (wish.scenes.size() != 1 || wish.motions.size() != 1 || wish.techniques.size() != 1))
        throw std::invalid_argument("--here needs one --scene, one --motion and one --technique.");
    if (wish.here && wish.instructions) throw std::invalid_argument("give either --here or --instructions.");
    if (wish.instructions && runCommand("command -v valgrind").status != 0)
        throw std::runtime_error("--instructions needs valgrind, which is not installed.");
    if (wish.instructions && !canCount)
        throw std::runtime_error(
            "this program was built without valgrind's header. Touch bench_processor.cpp and build again.");
    if (wish.here) return;
    if (wish.scenes.empty()) wish.scenes = allScenes;
    if (wish.motions.empty()) wish.motions = allMotions;
    Names techniques = {alone, peer};
    for (const std::string& each : wish.techniques.empty() ? usualTechniques : wish.techniques)
        if (std::find(techniques.begin(), techniques.end(), each) == techniques.end()) techniques.push_back(each);
    wish.techniques = techniques;
}

int measure(osg::ArgumentParser& arguments) {
    Wish wish;
    const auto frames = bench::framesAsked(
        arguments, "What shadows add to a frame on the processor alone: Mesa draws nothing.", optionsInto(wish), 20);
    if (!frames) return 0;
    wish.frames = *frames;
    complete(wish);
    if (wish.here) return drawHere(wish);
    for (const std::string& scene : wish.scenes) printScene(wish, scene);
    return 0;
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("bench_processor", argc, argv, measure); }
