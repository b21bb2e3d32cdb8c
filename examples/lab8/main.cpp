// SPDX-License-Identifier: MIT
// lab8: the point-light shadows of "Lab 8: Fake Shadow", by its own vertex shader and by PlanarShadowNode.
#include "Example.h"
#include "InputFile.h"
#include "Mesh.h"

#include <gnomon/PlanarShadowNode.h>

#include <lab8_shaders.h>

#include <osg/PolygonOffset>
#include <osg/Program>

#include <iostream>
#include <sstream>

namespace {

using namespace gnomon::examples;

/// The handout's example answers; y up, as it has them.
struct Answers {
    std::optional<osg::Vec3d> eye, at, light;
};
const osg::Vec3d usualEye(0.0, 0.1, 0.1), usualAt(0.0, 0.0, 0.0), usualLight(0.0, 5.0, 0.0);

/// data/lab8.osgt is z up.
osg::Vec3d zUp(const osg::Vec3d& p) { return {p.x(), -p.z(), p.y()}; }

/// "(0.0, 0.1, 0.1)", with or without brackets and spaces. @throws std::invalid_argument
osg::Vec3d readPoint(std::string text) {
    text.erase(std::remove_if(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c); }), text.end());
    if (text.size() > 1 && text.front() == '(' && text.back() == ')') text = text.substr(1, text.size() - 2);
    const std::vector<double> n = readNumbers(text, 3, -1e6, 1e6);
    return {n[0], n[1], n[2]};
}

/// Asks until the answer is a point. @return false at the end of input.
bool ask(const char* what, const osg::Vec3d& usual, std::optional<osg::Vec3d>& answer) {
    for (std::string line; !answer;) {
        std::cout << "Please enter " << what << ": " << std::flush;
        if (!std::getline(std::cin, line)) return std::cout << std::endl, false;
        try {
            answer = line.find_first_not_of(" \t\r") == std::string::npos ? usual : readPoint(line);
        } catch (const std::invalid_argument& error) {
            std::cout << "That cannot be used. " << error.what() << std::endl;
        }
    }
    return true;
}

bool askAll(Answers& answers) {
    return ask("an eye point", usualEye, answers.eye) && ask("an at point", usualAt, answers.at) &&
           ask("a light location", usualLight, answers.light);
}

class Lab8 {
public:
    explicit Lab8(const Answers& answers) : _light(answers.light.value_or(usualLight)) {
        const osg::ref_ptr<osg::Node> scene = readScene({GNOMON_LAB8}, "lab8");
        const osg::ref_ptr<osg::Node> sphere = named(*scene, "sphere"), cube = named(*scene, "cube"),
                                      ground = named(*scene, "ground");
        _setup.root = new osg::Group;
        _setup.group = new gnomon::ShadowCasterGroup;
        _setup.group->addChild(scene);
        _setup.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        _setup.group->setDark(0.0f);
        _node->setReceiver({ground});
        _setup.group->addChild(_node);
        _setup.techniques = {_node};
        _setup.root->addChild(_setup.group);
        _setup.bounds = {-0.75, -0.75, -0.25, 0.75, 0.75, 0.75};
        _source = addLight(*_setup.root, {0.0, 0.0, 1.0, 1.0});
        for (const auto& caster : {sphere, cube}) _glsl->addChild(caster);
        drawByShader();
        _setup.root->addChild(_glsl);
        choose(0);
        moveLight({});
    }

    SceneSetup& setup() { return _setup; }
    void drag(double right, double up) { moveLight({right / 200.0, up / 200.0, 0.0}); }
    /// y up.
    void moveLight(const osg::Vec3d& by) {
        _light += by;
        const osg::Vec4d place(zUp(_light), 1.0);
        _source->getLight()->setPosition(osg::Vec4(place));
        _setup.group->setLights({{0, place}});
        _uniform->set(osg::Vec3(zUp(_light)));
    }
    void next() { choose((_chosen + 1) % 3); }

    std::vector<std::string> describe() const {
        constexpr const char* ways[] = {"PlanarShadowNode", "the handout's vertex shader", "none"};
        std::ostringstream light;
        light << "light at (" << _light.x() << ", " << _light.y() << ", " << _light.z()
              << ") (u: up, d: down, or drag)";
        std::vector<std::string> lines = {std::string("shadow: ") + ways[_chosen] + " (n: next)", light.str()};
        for (const std::string& cause : _setup.causes()) lines.push_back(cause);
        return lines;
    }

private:
    /// Every triangle once more, flat on the ground and before it by a step of depth.
    void drawByShader() {
        osg::ref_ptr<osg::Program> program = new osg::Program;
        program->addShader(new osg::Shader(osg::Shader::VERTEX, lab8::shadow_vert));
        program->addShader(new osg::Shader(osg::Shader::FRAGMENT, lab8::shadow_frag));
        osg::StateSet& set = *_glsl->getOrCreateStateSet();
        set.setAttribute(program);
        set.addUniform(_uniform);
        set.setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
        _glsl->setCullingActive(false); // its shadow lies elsewhere
    }

    void choose(int way) {
        _chosen = way;
        _node->setNodeMask(way == 0 ? ~0u : 0u);
        _glsl->setNodeMask(way == 1 ? ~0u : 0u);
    }

    osg::Vec3d _light;
    SceneSetup _setup;
    osg::ref_ptr<gnomon::PlanarShadowNode> _node = new gnomon::PlanarShadowNode(osg::Vec4d(0, 0, 1, 0));
    osg::ref_ptr<osg::Group> _glsl = new osg::Group;
    osg::ref_ptr<osg::Uniform> _uniform = new osg::Uniform("light", osg::Vec3());
    osg::ref_ptr<osg::LightSource> _source;
    int _chosen = 0;
};

const std::vector<Key<Lab8>> keys = {
    {'n', "Shadow by PlanarShadowNode, by the handout's vertex shader, or none.", [](Lab8& c, Hud&) { c.next(); }},
    {'u', "Raise the light by 0.05.",
     [](Lab8& c, Hud&) {
         c.moveLight({0.0, 0.05, 0.0});
     }},
    {'d', "Lower the light by 0.05.",
     [](Lab8& c, Hud&) {
         c.moveLight({0.0, -0.05, 0.0});
     }},
    {'g', "Hide or show the text.", [](Lab8&, Hud& hud) { hud.toggle(); }},
};

Options ownOptions(Answers& into) {
    const auto option = [](const char* name, const char* says, const char* usual, std::optional<osg::Vec3d>& place) {
        return Option{name, "(x,y,z)", says, usual, [&place](const std::string& t) { place = readPoint(t); }};
    };
    return {option("--eye", "camera position, y up, -1e6 to 1e6 each; brackets are optional", "asked for, or 0,0.1,0.1",
                   into.eye),
            option("--at", "point that the camera looks at, -1e6 to 1e6 each", "asked for, or 0,0,0", into.at),
            option("--light", "position of the light, -1e6 to 1e6 each", "asked for, or 0,5,0", into.light)};
}

int run(osg::ArgumentParser& arguments) {
    const ExampleText text = {
        "lab8", "shows Lab 8's point-light shadows.",
        "Shows a sphere and a cube on the ground y = 0 with their shadows from a point light, after Lab 8, \"Fake "
        "Shadow\".\n\nAsks for eye, point and light if no option gives them and a window is opened.\n",
        "lab8 --eye 0,0.3,0.3 --at 0,0,0 --light 1,2,1 --out lab8.png"};
    Answers answers;
    ExampleOptions defaults;
    defaults.view.width = defaults.view.height = 600;
    auto options = readExample(arguments, text, ownOptions(answers), defaults, keysHelp(keys));
    if (!options || (options->out.empty() && !askAll(answers))) return 0;
    options->view.eye = zUp(answers.eye.value_or(usualEye));
    options->view.center = zUp(answers.at.value_or(usualAt));
    options->view.orthographic = 1.0;
    Lab8 lab(answers);
    return showExample(text, *options, keys, lab);
}

} // namespace

int main(int argc, char** argv) { return runProgram("lab8", argc, argv, run); }
