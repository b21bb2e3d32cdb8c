// SPDX-License-Identifier: MIT
// Programs that draw elsewhere than arrays and matrices say: what is said of them, and what serves instead.
#include "Trial.h"

#include <gnomon/ShadowMapTechnique.h>
#include <osg/Program>
#include <osg/ShaderAttribute>

using namespace test;

namespace {

GNOMON_BY_TECHNIQUE(ProgramPlaces);

const char* const colored = "gl_FrontColor = gl_Color; ";

osg::ref_ptr<osg::Program> programOf(const std::string& declared, const std::string& body) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, declared + "void main() { " + (colored + body) + " }"));
    return program;
}
osg::ref_ptr<osg::Program> vertexProgram(const std::string& body) { return programOf("", body); }

const Mesh standing = box({-1.5, -0.5, 0.0}, {-0.5, 0.5, 1.0});
const Mesh displaced = moved(standing, {2.0, 0.5, 0.5});
constexpr const char* displacing =
    "vec4 v = gl_Vertex; v.xyz += vec3(2.0, 0.5, 0.5); gl_Position = gl_ModelViewProjectionMatrix * v;";

/// A box whose program draws it elsewhere, on a ground that is the receiver.
struct Moving {
    Moving() {
        box = node(standing, "figure");
        box->getOrCreateStateSet()->setAttribute(vertexProgram(displacing));
        scene.content->addChild(box);
        technique = castingTechnique(find(*scene.root, "ground"));
        scene.addShadow(technique);
    }
    std::vector<std::string> causes() {
        camera.frame();
        return technique->diagnose();
    }

    Scene scene = groundScene({});
    osg::ref_ptr<osg::Geode> box;
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    Camera camera{scene.root, fromAbove(4.0, 128)};
};

/// The figure on the ground, without shadows.
Scene sceneOf(osg::Node* figure) {
    Scene scene = groundScene({});
    scene.content->addChild(figure);
    return scene;
}

/// Applies a program as osgEarth's VirtualProgram does: by a type of its own, or by a program's.
constexpr auto ownType = osg::StateAttribute::Type(127); // the last that the enumeration can hold
class Virtual : public osg::StateAttribute {
public:
    explicit Virtual(osg::Program* what = nullptr, Type type = ownType) : _program(what), _type(type) {}
    Virtual(const Virtual& other, const osg::CopyOp& copyOp)
        : osg::StateAttribute(other, copyOp), _program(other._program), _type(other._type) {}
    osg::Object* cloneType() const override { return new Virtual(nullptr, _type); }
    osg::Object* clone(const osg::CopyOp& copyOp) const override { return new Virtual(*this, copyOp); }
    bool isSameKindAs(const osg::Object* other) const override { return dynamic_cast<const Virtual*>(other); }
    const char* libraryName() const override { return "test"; }
    const char* className() const override { return "Virtual"; }
    Type getType() const override { return _type; }
    int compare(const osg::StateAttribute& other) const override { return this == &other ? 0 : this < &other ? -1 : 1; }
    void releaseGLObjects(osg::State* state) const override {
        if (_program) _program->releaseGLObjects(state);
    }
    void apply(osg::State& state) const override {
        if (_program) return _program->apply(state);
        state.get<osg::GLExtensions>()->glUseProgram(0);
        state.setLastAppliedProgramObject(nullptr);
    }

private:
    osg::ref_ptr<osg::Program> _program;
    const Type _type;
};

bool has(const std::vector<std::string>& causes, const std::string& text) {
    return std::any_of(causes.begin(), causes.end(), [&](const auto& c) { return c.find(text) != std::string::npos; });
}

} // namespace

/// But where a map lets the program draw.
TEST_P(ProgramPlaces, ACasterThatAProgramMovesIsNamed) {
    Moving moving;
    if (GetParam() == By::Map) {
        EXPECT_EQ(moving.causes(), std::vector<std::string>());
    } else {
        EXPECT_EQ(moving.causes().size(), 1u);
        EXPECT_TRUE(has(moving.causes(), "the program of 'figure' moves its vertices, but it casts where its arrays "
                                         "stand. Use map, or take it out of the casters"));
    }
    moving.box->getStateSet()->setAttribute(vertexProgram("gl_Position = ftransform();"));
    EXPECT_TRUE(moving.causes().empty());
}

/// None can draw it as the light sees it, or knows which pixels a light would leave out.
TEST_P(ProgramPlaces, ACasterThatAProgramMovesByItsOwnProjectionIsNamed) {
    Moving moving;
    const osg::ref_ptr<osg::Program> own = programOf("uniform mat4 mine; ", "gl_Position = mine * (gl_Vertex + 1.0);"),
                                     door = vertexProgram(displacing);
    door->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                    "void main() { if (fract(gl_FragCoord.x * 0.5) > 0.4) discard; gl_FragColor = "
                                    "vec4(1.0); }"));
    for (const auto& program : {own, door}) {
        moving.box->getOrCreateStateSet()->setAttribute(program);
        EXPECT_TRUE(has(moving.causes(), "the program of 'figure' moves its vertices by a projection or depth of its "
                                         "own, or discards by pixels, so it casts where its arrays stand"));
    }
}

TEST_P(ProgramPlaces, AProxyThatIsNeverDrawnCastsInItsPlace) {
    Moving moving;
    const osg::ref_ptr<osg::Geode> proxy = node(displaced, "proxy");
    moving.scene.content->addChild(proxy);
    moving.box->setNodeMask(0x1);
    proxy->setNodeMask(0x2);
    moving.camera.viewer().getCamera()->setCullMask(~0x2u);
    moving.scene.group->setCasters({nullptr, ~0x1u});
    Scene lit = sceneOf(moving.box), dark = sceneOf(moving.box);
    dark.takeLightAway();
    const View view = fromAbove(4.0, 128);
    const Truth truth{render(lit.root, view), render(dark.root, view),
                      castRays(square(8.0), {displaced}, {1.0, 0.0, 1.0, 0.0}, view), 2};
    EXPECT_TRUE(shows(moving.camera.frame(), truth));
    EXPECT_TRUE(moving.technique->diagnose().empty());
}

TEST_P(ProgramPlaces, ALogarithmicDepthIsNamedAsTheCause) {
    Moving moving;
    moving.scene.content->removeChild(moving.box);
    moving.scene.content->addChild(node(standing, "box"));
    osg::StateSet& state = *moving.scene.root->getOrCreateStateSet();
    state.setAttribute(vertexProgram("gl_Position = ftransform(); gl_Position.z = (2.0 * log2(gl_Position.w + 1.0) / "
                                     "log2(1001.0) - 1.0) * gl_Position.w;"));
    const std::vector<std::string> causes = moving.causes();
    EXPECT_TRUE(has(causes, "the program of 'ground' replaces OpenGL's depth"));
    EXPECT_FALSE(has(causes, "moves its vertices"));
    state.removeAttribute(osg::StateAttribute::PROGRAM);
    EXPECT_TRUE(moving.causes().empty());
}

namespace {

/// A ground at z = 0 whose arrays lie `raised` above, and whose program lowers it by as much; tiles, so that each has a box.
Scene loweredGround(double raised) {
    Scene scene = sceneOf(node(moved(standing, {1.0, 0.0, 0.4}), "box"));
    scene.content->removeChild(find(*scene.root, "ground"));
    const osg::ref_ptr<osg::Group> ground = new osg::Group;
    ground->setName("ground");
    for (int x = -6; x < 6; ++x)
        for (int y = -6; y < 6; ++y) {
            const osg::ref_ptr<osg::Geode> tile =
                node(quad({double(x), double(y), raised}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}), "tile");
            tile->getDrawable(0)->setCullingActive(false); // its box is elsewhere
            ground->addChild(tile);
        }
    ground->getOrCreateStateSet()->setAttribute(
        vertexProgram("vec4 v = gl_Vertex - vec4(0.0, 0.0, " + std::to_string(raised) +
                      ", 0.0); gl_FrontColor = vec4(0.4) + 0.5 * gl_LightSource[0].diffuse; gl_Position = "
                      "gl_ModelViewProjectionMatrix * v;"));
    scene.content->addChild(ground);
    return scene;
}

} // namespace

// A map's texels may lie otherwise, so that single pixels at edges differ: less than an outline of two pixels' width.
TEST(ProgramPlacesOfReceivers, AGroundThatAProgramLowersHasTheShadowOfOneThatLiesThere) {
    const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 160, 120);
    Scene bare = loweredGround(0.0);
    const Picture lit = render(bare.root, view);
    for (const std::string spec : {"map", "map:receiver=ground", "map:edges=smooth", "volume",
                                   "volume:composite=blend,receiver=ground", "traced"}) {
        Scene there = loweredGround(0.0), lowered = loweredGround(3.0);
        for (Scene* scene : {&there, &lowered}) {
            scene->addShadow(spec);
            scene->group->setCasters({find(*scene->root, "box")});
        }
        const Picture expected = render(there.root, view);
        const int shadowed = expected.different(lit);
        EXPECT_GT(shadowed, 100) << spec;
        EXPECT_LE(render(lowered.root, view).different(expected), spec[0] == 'm' ? shadowed / 5 : 0) << spec;
    }
}

TEST_P(ProgramPlaces, AnAttributeThatMayApplyAProgramIsNamed) {
    Moving moving;
    const osg::ref_ptr<osg::Program> program = vertexProgram(displacing);
    const osg::ref_ptr<osg::ShaderAttribute> composed = new osg::ShaderAttribute;
    composed->setType(osg::StateAttribute::HINT);
    const osg::ref_ptr<osg::StateAttribute> attributes[] = {
        new Virtual(program), new Virtual(program, osg::StateAttribute::PROGRAM), composed};
    for (const auto& attribute : attributes) {
        moving.box->setStateSet(nullptr);
        moving.box->getOrCreateStateSet()->setAttribute(attribute);
        EXPECT_TRUE(has(moving.causes(), "a state attribute of 'figure' may apply a program"))
            << attribute->className();
        moving.box->getStateSet()->setAttribute(new osg::Program, osg::StateAttribute::ON);
        moving.box->getStateSet()->removeAttribute(attribute);
        EXPECT_TRUE(moving.causes().empty()) << attribute->className();
    }
}

/// What an application's own matrix makes of it under a light nobody knows: all of it casts.
TEST_P(ProgramPlaces, HolesUnderAProjectionOfItsOwnAreClosed) {
    const View view = fromAbove(4.0, 128);
    const osg::ref_ptr<osg::Program> holes =
        programOf("#version 130\nuniform mat4 mine; out float x; ", "x = gl_Vertex.x; gl_Position = mine * gl_Vertex;");
    holes->addShader(new osg::Shader(osg::Shader::FRAGMENT, "#version 130\nin float x; void main() {\n"
                                                            "if (x < -1.0) discard; gl_FragColor = gl_Color; }"));
    const Mesh hole = quad({-2.0, -1.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}), rest = moved(hole, {1.0, 0.0, 0.0});
    const osg::ref_ptr<osg::Geode> figure = node(joined({hole, rest}), "figure");
    figure->getOrCreateStateSet()->setAttribute(holes);
    figure->getStateSet()->addUniform(new osg::Uniform("mine", osg::Matrixf(view.view * view.projection)));
    Scene lit = sceneOf(figure), dark = sceneOf(figure), scene = sceneOf(figure);
    dark.takeLightAway();
    const osg::ref_ptr<gnomon::ShadowTechnique> technique = castingTechnique(find(*scene.root, "ground"));
    scene.addShadow(technique);
    const Truth truth{render(lit.root, view), render(dark.root, view),
                      castRays(square(8.0), {rest}, {1.0, 0.0, 1.0, 0.0}, view, {hole}), 2};
    EXPECT_TRUE(shows(render(scene.root, view), truth));
    EXPECT_TRUE(has(technique->diagnose(),
                    "what discards by gl_FragCoord, or has a projection of its own and discards, "
                    "casts as if it were solid, because no light can draw it: 1, the first in "
                    "'figure'"));
}

/// A roof of which x < -1 is cut off: it is drawn into the map by itself, whoever applies the program.
TEST(ProgramsInMaps, CutAsTheyDoInTheView) {
    const std::string vertex = "#version 130\nout float x; void main() { x = gl_Vertex.x; gl_FrontColor = gl_Color;\n"
                               "gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex; ";
    const osg::ref_ptr<osg::Program> holes = new osg::Program, cut = new osg::Program;
    holes->addShader(new osg::Shader(osg::Shader::VERTEX, vertex + "}"));
    holes->addShader(new osg::Shader(osg::Shader::FRAGMENT, "#version 130\nin float x; void main() {\n"
                                                            "if (x < -1.0) discard; gl_FragColor = gl_Color; }"));
    cut->addShader(new osg::Shader(osg::Shader::VERTEX, vertex + "gl_ClipDistance[0] = x + 1.0; }"));
    const View view = fromAbove(4.0, 128);
    const Mesh roof = moved(square(1.0, 1.0), {-1.0, 0.0, 0.0}),
               left = quad({-1.0, -1.0, 1.0}, {1.0, 0.0, 0.0}, {0.0, 2.0, 0.0});
    const osg::ref_ptr<osg::StateAttribute> attributes[] = {
        new Virtual(holes), new Virtual(holes, osg::StateAttribute::PROGRAM), holes, cut};
    for (const auto& attribute : attributes) {
        const osg::ref_ptr<osg::Geode> figure = node(roof, "figure");
        figure->getOrCreateStateSet()->setAttribute(attribute);
        figure->getOrCreateStateSet()->setMode(GL_CLIP_PLANE0, attribute == cut ? 1 : 0);
        Scene lit = sceneOf(figure), dark = sceneOf(figure), scene = sceneOf(figure);
        dark.takeLightAway();
        const osg::ref_ptr<gnomon::ShadowTechnique> map = new gnomon::ShadowMapTechnique;
        map->setReceiver({find(*scene.root, "ground")});
        scene.addShadow(map);
        const Truth truth{render(lit.root, view), render(dark.root, view),
                          castRays(square(8.0), {left}, {1.0, 0.0, 1.0, 0.0}, view), 2};
        EXPECT_TRUE(shows(render(scene.root, view), truth)) << attribute->className() << " " << attribute->getType();
    }
}
