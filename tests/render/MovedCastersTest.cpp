// SPDX-License-Identifier: MIT
// Casters that their programs move, as applications write such programs: instances, skinning, displacement, geometry and
// tessellation shaders. Maps let the programs draw. The same motion is worked out here on the processor, and rays find its
// shadow on a ground.
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PatchParameter>
#include <osg/Program>
#include <osg/Texture2D>
#include <osg/VertexAttribDivisor>
#include <osgAnimation/Bone>
#include <osgAnimation/RigGeometry>
#include <osgAnimation/RigTransformHardware>
#include <osgAnimation/Skeleton>
#include <osgUtil/CullVisitor>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

using namespace test;

namespace {

using Shaders = std::map<osg::Shader::Type, std::string>;
/// Where the motion takes a corner.
using Way = std::function<glm::dvec3(const glm::dvec3&)>;

const View view = perspective({-3.0, -11.0, 9.0}, {0.5, 0.0, 0.0}, 480, 360, 40.0);
const osg::Vec4d sun(1.0, 0.8, 1.2, 0.0), lamp(1.5, 4.0, 6.0, 1.0);
constexpr double half = 8.0; // of the ground's side

osg::ref_ptr<osg::Program> programOf(const Shaders& shaders) {
    const osg::ref_ptr<osg::Program> program = new osg::Program;
    for (const auto& [type, text] : shaders) program->addShader(new osg::Shader(type, text));
    return program;
}

/// @param body  makes gl_Position of gl_Vertex.
osg::ref_ptr<osg::Program> vertexProgram(const std::string& declared, const std::string& body) {
    return programOf({{osg::Shader::VERTEX, "#version 140\n#extension GL_ARB_compatibility : enable\n" + declared +
                                                "\nvoid main() { gl_FrontColor = gl_Color; " + body + " }"}});
}

Mesh carried(Mesh mesh, const Way& way) {
    for (glm::dvec3& corner : mesh) corner = way(corner);
    return mesh;
}

osg::Matrixf leaning(double share) { return osg::Matrixf::translate(float(share), float(-0.5 * share), 0.0f); }

/// What a program draws, how the processor knows it, and what moves it.
struct Figure {
    osg::ref_ptr<osg::Group> node = new osg::Group;
    std::function<Mesh(double)> mesh; ///< at a time.
    std::function<void(double)> setTime = [](double) {};

    /// Drawn from buffers, as lists hold no instances.
    osg::ref_ptr<osg::Geometry> add(const Mesh& arrays, osg::Program* program, const osg::BoundingBox& bounds) {
        const osg::ref_ptr<osg::Geode> geode = test::node(arrays, "figure");
        const osg::ref_ptr<osg::Geometry> geometry = geode->getDrawable(0)->asGeometry();
        geometry->setUseDisplayList(false);
        geometry->setUseVertexBufferObjects(true);
        geometry->setInitialBound(bounds);
        if (program) geometry->getOrCreateStateSet()->setAttribute(program);
        node->addChild(geode);
        return geometry;
    }
    /// A uniform of all of it that is the time.
    void addTime() {
        const osg::ref_ptr<osg::Uniform> time = new osg::Uniform("time", 0.0f);
        node->getOrCreateStateSet()->addUniform(time);
        setTime = [time](double at) { time->set(float(at)); };
    }
};

const osg::BoundingBox around(-4.0f, -4.0f, 0.0f, 4.5f, 4.0f, 2.5f);
const Mesh tuft = box({-0.25, -0.25, 0.0}, {0.25, 0.25, 0.9});
constexpr int rows = 5;

glm::dvec3 placeOf(int instance) { return {1.4 * (instance % rows) - 3.0, 1.3 * (instance / rows) - 2.5, 0.0}; }

/// Tufts that lean with the wind.
Mesh tuftsOf(const Mesh& one, double time) {
    Mesh all;
    for (int i = 0; i < rows * rows; ++i)
        for (const glm::dvec3& corner : one) all.push_back(corner + placeOf(i) + glm::dvec3(time * corner.z, 0.0, 0.0));
    return all;
}

Mesh tufts(double time) { return tuftsOf(tuft, time); }

Figure groundCover() {
    Figure figure;
    figure.mesh = tufts;
    figure.addTime();
    const auto geometry = figure.add(
        tuft,
        vertexProgram("uniform float time;", "vec4 v = gl_Vertex; v.x += time * v.z; int row = gl_InstanceID / 5;\n"
                                             "v.xy += vec2(1.4, 1.3) * vec2(gl_InstanceID - 5 * row, row) - "
                                             "vec2(3.0, 2.5); gl_Position = gl_ModelViewProjectionMatrix * v;"),
        around);
    geometry->getPrimitiveSet(0)->setNumInstances(rows * rows);
    return figure;
}

/// The same, each place an attribute that goes on with the instance.
Figure groundCoverByAttributes() {
    Figure figure;
    figure.mesh = tufts;
    figure.addTime();
    const osg::ref_ptr<osg::Program> program = vertexProgram(
        "uniform float time; in vec3 place; uniform mat4 osg_ViewMatrix, osg_ViewMatrixInverse;",
        "vec4 world = osg_ViewMatrixInverse * gl_ModelViewMatrix * gl_Vertex + vec4(place, 0.0); world.x += time * "
        "gl_Vertex.z; gl_Position = gl_ProjectionMatrix * osg_ViewMatrix * world;");
    program->addBindAttribLocation("place", 6);
    const auto geometry = figure.add(tuft, program, around);
    const osg::ref_ptr<osg::Vec3Array> places = new osg::Vec3Array;
    for (int i = 0; i < rows * rows; ++i)
        places->push_back(osg::Vec3(osg::Vec3d(placeOf(i).x, placeOf(i).y, placeOf(i).z)));
    geometry->setVertexAttribArray(6, places, osg::Array::BIND_PER_VERTEX);
    geometry->getStateSet()->setAttribute(new osg::VertexAttribDivisor(6, 1));
    geometry->getPrimitiveSet(0)->setNumInstances(rows * rows);
    return figure;
}

/// Fragments above a height are discarded, so that lower tufts are left.
Figure cutGroundCover() {
    Figure figure = groundCover();
    osg::StateSet* state = figure.node->getChild(0)->asGeode()->getDrawable(0)->getStateSet();
    const osg::ref_ptr<osg::Program> program =
        vertexProgram("uniform float time; varying float height;",
                      "height = gl_Vertex.z; vec4 v = gl_Vertex; v.x += time * v.z; int row = gl_InstanceID / 5;\n"
                      "v.xy += vec2(1.4, 1.3) * vec2(gl_InstanceID - 5 * row, row) - vec2(3.0, 2.5);\n"
                      "gl_Position = gl_ModelViewProjectionMatrix * v;");
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       "varying float height; void main() { if (height > 0.6) discard; "
                                       "gl_FragColor = vec4(0.9); }"));
    state->setAttribute(program);
    figure.mesh = [](double time) { return tuftsOf(box({-0.25, -0.25, 0.0}, {0.25, 0.25, 0.6}), time); };
    return figure;
}

const Mesh torso = box({-0.3, -0.3, 0.0}, {0.3, 0.3, 1.4});

/// Bodies whose heads follow a bone each: of two a vertex, by weight.
Figure crowd() {
    Figure figure;
    std::vector<osg::ref_ptr<osg::Uniform>> palettes;
    const auto share = [](int body, double time) { return 0.8 * std::sin(time + 1.3 * body); };
    const osg::ref_ptr<osg::Program> program =
        vertexProgram("uniform mat4 palette[2]; in float weight;",
                      "vec4 v = weight * (palette[1] * gl_Vertex) + (1.0 - weight) * (palette[0] * gl_Vertex);\n"
                      "gl_Position = gl_ModelViewProjectionMatrix * vec4(v.xyz, 1.0);");
    program->addBindAttribLocation("weight", 7);
    for (int body = 0; body < 4; ++body) {
        const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
        place->setMatrix(osg::Matrixd::translate(1.7 * body - 2.5, 0.5 * body - 1.0, 0.0));
        figure.node->addChild(place);
        Figure one;
        one.node = place;
        const auto geometry = one.add(torso, program, osg::BoundingBox(-1.5f, -1.0f, 0.0f, 1.5f, 1.0f, 1.5f));
        const osg::ref_ptr<osg::FloatArray> weights = new osg::FloatArray;
        for (const glm::dvec3& corner : torso) weights->push_back(corner.z > 1.0 ? 1.0f : 0.0f);
        geometry->setVertexAttribArray(7, weights, osg::Array::BIND_PER_VERTEX);
        palettes.push_back(new osg::Uniform(osg::Uniform::FLOAT_MAT4, "palette", 2));
        geometry->getStateSet()->addUniform(palettes.back());
    }
    figure.setTime = [palettes, share](double time) {
        for (int body = 0; body < 4; ++body) {
            palettes[std::size_t(body)]->setElement(0, osg::Matrixf());
            palettes[std::size_t(body)]->setElement(1, leaning(share(body, time)));
        }
    };
    figure.setTime(0.0);
    figure.mesh = [share](double time) {
        Mesh all;
        for (int body = 0; body < 4; ++body)
            for (const glm::dvec3& corner : torso) {
                const double head = corner.z > 1.0 ? share(body, time) : 0.0;
                all.push_back(corner + glm::dvec3(1.7 * body - 2.5 + head, 0.5 * body - 1.0 - 0.5 * head, 0.0));
            }
        return all;
    };
    return figure;
}

/// osgAnimation's own skinning, by a program as its example's.
Figure rigged() {
    Figure figure;
    const osg::ref_ptr<osgAnimation::Skeleton> skeleton = new osgAnimation::Skeleton;
    const osg::ref_ptr<osgAnimation::Bone> foot = new osgAnimation::Bone("foot"), head = new osgAnimation::Bone("head");
    for (const auto& bone : {foot, head}) skeleton->addChild(bone);
    const osg::ref_ptr<osg::Geode> geode = node(torso, "figure"), drawn = new osg::Geode;
    const osg::ref_ptr<osgAnimation::RigGeometry> rig = new osgAnimation::RigGeometry;
    const osg::ref_ptr<osgAnimation::RigTransformHardware> hardware = new osgAnimation::RigTransformHardware;
    const osg::ref_ptr<osgAnimation::VertexInfluenceMap> influences = new osgAnimation::VertexInfluenceMap;
    for (unsigned i = 0; i < torso.size(); ++i)
        (*influences)[torso[i].z > 1.0 ? "head" : "foot"].push_back(osgAnimation::VertexIndexWeight(i, 1.0f));
    for (const char* bone : {"foot", "head"}) (*influences)[bone].setName(bone);
    hardware->setShader(new osg::Shader(
        osg::Shader::VERTEX,
        "#version 130\nin vec4 boneWeight0; uniform uint nbBonesPerVertex; uniform mat4 matrixPalette[MAX_MATRIX];\n"
        "vec4 position;\nvoid add(vec4 bone) {\n"
        "position += bone.y * (matrixPalette[int(bone.x)] * gl_Vertex) + bone.w * (matrixPalette[int(bone.z)] * "
        "gl_Vertex); }\nvoid main() { gl_FrontColor = gl_Color; position = vec4(0.0);\n"
        "if (nbBonesPerVertex > 0u) add(boneWeight0);\n"
        "gl_Position = gl_ModelViewProjectionMatrix * vec4(position.xyz, 1.0); }"));
    rig->setInfluenceMap(influences);
    rig->setSourceGeometry(geode->getDrawable(0)->asGeometry());
    rig->setRigTransformImplementation(hardware);
    rig->setComputeBoundingBoxCallback(new osgAnimation::RigComputeBoundingBoxCallback(2.5));
    rig->setName("figure");
    drawn->addDrawable(rig);
    skeleton->addChild(drawn);
    figure.node->addChild(skeleton);
    const auto lean = [](double time) { return 0.7 * std::cos(2.0 * time); };
    figure.setTime = [head, lean](double time) { head->setMatrixInSkeletonSpace(leaning(lean(time))); };
    figure.setTime(0.0);
    figure.mesh = [lean](double time) {
        return carried(torso, [by = lean(time)](const glm::dvec3& corner) {
            return corner + (corner.z > 1.0 ? glm::dvec3(by, -0.5 * by, 0.0) : glm::dvec3(0.0));
        });
    };
    return figure;
}

/// Squares of a grid over [-1, 1]².
Mesh grid(int side) {
    Mesh all;
    const double step = 2.0 / side;
    for (int i = 0; i < side * side; ++i) {
        const Mesh one =
            quad({-1.0 + step * (i % side), -1.0 + step * (i / side), 0.0}, {step, 0.0, 0.0}, {0.0, step, 0.0});
        all.insert(all.end(), one.begin(), one.end());
    }
    return all;
}

/// Height of waves over the ground.
double wave(double x, double y, double time) { return 1.2 + 0.5 * std::sin(3.0 * x + time) + 0.3 * std::cos(2.0 * y); }
constexpr const char* waveText =
    "float wave(vec2 p) { return 1.2 + 0.5 * sin(3.0 * p.x + time) + 0.3 * cos(2.0 * p.y); }";

Mesh waves(const Mesh& sheet, double time) {
    return carried(
        sheet, [time](const glm::dvec3& p) { return glm::dvec3(2.0 * p.x + 0.5, 2.0 * p.y, wave(p.x, p.y, time)); });
}

Figure water() {
    Figure figure;
    figure.addTime();
    figure.mesh = [](double time) { return waves(grid(24), time); };
    figure.add(grid(24),
               vertexProgram("uniform float time;\n" + std::string(waveText),
                             "gl_Position = gl_ModelViewProjectionMatrix * vec4(2.0 * gl_Vertex.xy + vec2(0.5, 0.0), "
                             "wave(gl_Vertex.xy), 1.0);"),
               around);
    return figure;
}

/// The same made of four patches. OpenGL may divide its squares along either diagonal: their corners are the same.
Figure tessellatedHill() {
    Figure figure;
    figure.addTime();
    figure.mesh = [](double time) { return waves(grid(32), time); };
    const osg::ref_ptr<osg::Program> program = programOf(
        {{osg::Shader::VERTEX, "#version 400 compatibility\nvoid main() { gl_Position = gl_Vertex; }"},
         {osg::Shader::TESSCONTROL, "#version 400 compatibility\nlayout(vertices = 4) out;\n"
                                    "void main() { gl_out[gl_InvocationID].gl_Position = "
                                    "gl_in[gl_InvocationID].gl_Position;\n"
                                    "for (int i = 0; i < 4; ++i) gl_TessLevelOuter[i] = 16.0;\n"
                                    "for (int i = 0; i < 2; ++i) gl_TessLevelInner[i] = 16.0; }"},
         {osg::Shader::TESSEVALUATION,
          "#version 400 compatibility\nlayout(quads, equal_spacing, ccw) in; uniform float time;\n" +
              std::string(waveText) +
              "\nvoid main() { vec2 p = mix(gl_in[0].gl_Position.xy, gl_in[2].gl_Position.xy, gl_TessCoord.xy);\n"
              "gl_Position = gl_ModelViewProjectionMatrix * vec4(2.0 * p + vec2(0.5, 0.0), wave(p), 1.0); }"},
         {osg::Shader::FRAGMENT, "#version 130\nvoid main() { gl_FragColor = vec4(0.9); }"}});
    const auto geometry = figure.add({}, program, around);
    const osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
    for (const auto& [x, y] : {std::pair(-1.0f, -1.0f), {0.0f, -1.0f}, {-1.0f, 0.0f}, {0.0f, 0.0f}})
        for (const auto& [right, up] : {std::pair(0.0f, 0.0f), {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}})
            corners->push_back({x + right, y + up, 0.0f});
    geometry->setNormalArray(nullptr);
    geometry->setVertexArray(corners);
    geometry->setPrimitiveSet(0, new osg::DrawArrays(osg::PrimitiveSet::PATCHES, 0, 16));
    geometry->getStateSet()->setAttribute(new osg::PatchParameter(4));
    return figure;
}

/// A blade of grass for each point.
Figure blades() {
    Figure figure;
    figure.addTime();
    const osg::ref_ptr<osg::Program> program = programOf(
        {{osg::Shader::VERTEX, "#version 150 compatibility\nvoid main() { gl_Position = gl_Vertex; }"},
         {osg::Shader::GEOMETRY,
          "#version 150 compatibility\nlayout(points) in; layout(triangle_strip, max_vertices = 3) out;\n"
          "uniform float time;\nvoid corner(vec3 by) {\n"
          "gl_Position = gl_ModelViewProjectionMatrix * (gl_in[0].gl_Position + vec4(by, 0.0)); EmitVertex(); }\n"
          "void main() { corner(vec3(-0.4, 0.0, 0.0)); corner(vec3(0.4, 0.0, 0.0)); corner(vec3(time, 0.0, 1.2)); }"},
         {osg::Shader::FRAGMENT, "#version 130\nvoid main() { gl_FragColor = vec4(0.9); }"}});
    const auto geometry = figure.add({}, program, around);
    const osg::ref_ptr<osg::Vec3Array> points = new osg::Vec3Array;
    for (int i = 0; i < rows * rows; ++i) points->push_back({float(placeOf(i).x), float(placeOf(i).y), 0.0f});
    geometry->setNormalArray(nullptr);
    geometry->setVertexArray(points);
    geometry->setPrimitiveSet(0, new osg::DrawArrays(osg::PrimitiveSet::POINTS, 0, rows * rows));
    figure.mesh = [](double time) {
        Mesh all;
        for (int i = 0; i < rows * rows; ++i)
            for (const glm::dvec3& corner : {glm::dvec3(-0.4, 0.0, 0.0), {0.4, 0.0, 0.0}, {time, 0.0, 1.2}})
                all.push_back(placeOf(i) + corner);
        return all;
    };
    return figure;
}

/// The same of no vertices at all.
Figure bladesByNumber() {
    Figure figure;
    figure.addTime();
    figure.mesh = blades().mesh;
    const auto geometry = figure.add(
        {},
        vertexProgram("uniform float time;",
                      "int i = gl_VertexID / 3; int row = i / 5; int corner = gl_VertexID - 3 * i;\n"
                      "vec3 by = corner == 0 ? vec3(-0.4, 0.0, 0.0) : corner == 1 ? vec3(0.4, 0.0, 0.0) : vec3(time, "
                      "0.0, 1.2);\nvec2 place = vec2(1.4, 1.3) * vec2(i - 5 * row, row) - vec2(3.0, 2.5);\n"
                      "gl_Position = gl_ModelViewProjectionMatrix * vec4(by + vec3(place, 0.0), 1.0);"),
        around);
    geometry->setNormalArray(nullptr);
    geometry->setVertexArray(nullptr);
    geometry->setPrimitiveSet(0, new osg::DrawArrays(osg::PrimitiveSet::TRIANGLES, 0, 3 * rows * rows));
    return figure;
}

struct Kind {
    const char* name;
    std::function<Figure()> make;
};
const Kind kinds[] = {{"GroundCover", groundCover},
                      {"GroundCoverByAttributes", groundCoverByAttributes},
                      {"CutGroundCover", cutGroundCover},
                      {"Crowd", crowd},
                      {"Rigged", rigged},
                      {"Water", water},
                      {"TessellatedHill", tessellatedHill},
                      {"Blades", blades},
                      {"BladesByNumber", bladesByNumber}};

struct Judged {
    int shadowed = 0, lit = 0, wrong = 0;
};

/// The ground alone: the figures' own colours are their programs'. Pixels two from an edge: texels are less than one here.
Judged judge(const Picture& picture, const Mesh& casters, const osg::Vec4d& light, const Picture& asLit,
             const Picture& asDark) {
    const Mask mask = castRays(square(half), {casters}, light, view);
    Judged result;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const Seen seen = mask.at(x, y);
            const bool shadowed = seen == Seen::ShadowedReceiver;
            if (!(shadowed || seen == Seen::LitReceiver) || mask.atEdge(x, y, 2)) continue;
            ++(shadowed ? result.shadowed : result.lit);
            result.wrong += picture.at(x, y) != (shadowed ? asDark : asLit).at(x, y);
        }
    return result;
}

/// A figure on a ground, which alone receives.
struct Trial {
    explicit Trial(const Figure& of, const osg::Vec4d& where = sun, gnomon::ShadowTechnique* with = nullptr)
        : figure(of), light(where), technique(with ? with : new gnomon::ShadowMapTechnique) {
        Scene bare = groundScene({}, half, light);
        lit = render(bare.root, view);
        bare.takeLightAway();
        dark = render(bare.root, view);
        scene.content->addChild(figure.node);
        technique->setReceiver({find(*scene.root, "ground")});
        scene.addShadow(technique);
        camera = std::make_unique<Camera>(scene.root, view);
    }
    void blendToBlack() {
        scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        scene.group->setDark(0.0f);
        std::fill(dark.pixels.begin(), dark.pixels.end(), grey(0));
    }
    Judged at(double time) {
        figure.setTime(time);
        return judge(camera->frame(), figure.mesh(time), light, lit, dark);
    }

    Figure figure;
    osg::Vec4d light;
    Scene scene = groundScene({}, half, light);
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    Picture lit, dark;
    std::unique_ptr<Camera> camera;
};

class MovedCasters : public testing::TestWithParam<Kind> {};
std::ostream& operator<<(std::ostream& out, const Kind& kind) { return out << kind.name; }
INSTANTIATE_TEST_SUITE_P(Programs, MovedCasters, testing::ValuesIn(kinds), testing::PrintToStringParamName());

void expectRight(Trial& trial, const std::string& what) {
    for (const double time : {0.0, 0.0, 0.3, 0.6, -0.5}) {
        const Judged found = trial.at(time);
        EXPECT_GT(found.shadowed, 500) << what << " at " << time;
        EXPECT_EQ(found.wrong, 0) << what << " at " << time << ", of " << found.shadowed + found.lit;
    }
    EXPECT_EQ(trial.technique->diagnose(), std::vector<std::string>()) << what;
}

} // namespace

TEST_P(MovedCasters, CastWhereTheirProgramDrawsThem) {
    for (const osg::Vec4d& light : {sun, lamp}) {
        Trial trial(GetParam().make(), light);
        const std::string by = light == lamp ? "a lamp" : "a sun";
        expectRight(trial, by + ", relit");
        trial.blendToBlack();
        expectRight(trial, by + ", blended");
    }
}

TEST_P(MovedCasters, HaveAMapByAuto) {
    const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
    Trial trial(GetParam().make(), sun, technique);
    for (const double time : {0.0, 0.4}) EXPECT_EQ(trial.at(time).wrong, 0) << time;
    EXPECT_EQ(technique->lastDecision().front().chosen.spec.substr(0, 3), "map");
    EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
}

/// Still, a map is kept, though uniforms are set again.
TEST_P(MovedCasters, AreDrawnAgainOnlyWhereTheyMove) {
    Trial trial(GetParam().make());
    trial.at(0.2);
    const unsigned passes = trial.technique->passes();
    trial.at(0.2);
    if (GetParam().name != std::string("Rigged")) { // a RigGeometry is DYNAMIC
        EXPECT_EQ(trial.technique->passes(), passes);
    }
    const unsigned before = trial.technique->passes();
    trial.at(0.4);
    EXPECT_EQ(trial.technique->passes(), before + 1);
}

TEST(MovedCastersOverTime, AreDrawnInEachFrameByAClock) {
    Figure figure;
    figure.node->getOrCreateStateSet()->setAttribute(vertexProgram(
        "uniform float osg_SimulationTime;",
        "vec4 v = gl_Vertex; v.x += osg_SimulationTime; gl_Position = gl_ModelViewProjectionMatrix * v;"));
    figure.add(torso, nullptr, around);
    figure.mesh = [](double time) { return moved(torso, {time, 0.0, 0.0}); };
    Trial trial(figure);
    for (const double time : {0.0, 0.5, 0.5, 1.0}) {
        trial.camera->viewer().frame(time);
        const Picture picture = pictureOf(trial.camera->context());
        const Judged found = judge(picture, figure.mesh(time), sun, trial.lit, trial.dark);
        EXPECT_GT(found.shadowed, 500) << time;
        EXPECT_EQ(found.wrong, 0) << time;
    }
    EXPECT_EQ(trial.technique->passes(), 4u);
}

/// As programs have them that go without OpenGL's fixed matrices.
TEST(MovedCastersOverTime, TakeOpenSceneGraphsMatrices) {
    Figure figure;
    figure.addTime();
    figure.add(torso,
               programOf({{osg::Shader::VERTEX,
                           "#version 130\nuniform mat4 osg_ModelViewMatrix, osg_ProjectionMatrix; uniform float time;\n"
                           "void main() { vec4 v = gl_Vertex; v.x += time * v.z;\n"
                           "gl_Position = osg_ProjectionMatrix * (osg_ModelViewMatrix * v); }"},
                          {osg::Shader::FRAGMENT, "#version 130\nvoid main() { gl_FragColor = vec4(0.9); }"}}),
               around);
    figure.mesh = [](double time) {
        return carried(torso, [time](glm::dvec3 p) { return p + glm::dvec3(time * p.z, 0.0, 0.0); });
    };
    Trial trial(figure);
    trial.camera->context().graphicsContext()->getState()->setUseModelViewAndProjectionUniforms(true);
    for (const double time : {0.0, 0.5, -0.5}) {
        const Judged found = trial.at(time);
        EXPECT_GT(found.shadowed, 300) << time;
        EXPECT_EQ(found.wrong, 0) << time;
    }
}

/// As where one buffer is filled while the other is drawn.
TEST(MovedCastersOverTime, FollowTwoBuffersThatTakeTurns) {
    Figure figure;
    const char* body = "vec4 v = gl_Vertex; v.x += lean * v.z; gl_Position = gl_ModelViewProjectionMatrix * v;";
    const osg::ref_ptr<osg::Uniform> lean = new osg::Uniform("lean", 0.5f);
    figure.node->getOrCreateStateSet()->setAttribute(vertexProgram("uniform float lean;", body));
    figure.node->getOrCreateStateSet()->addUniform(lean);
    const Mesh left = torso, right = moved(torso, {1.5, 0.3, 0.0});
    figure.add(left, nullptr, around);
    figure.add(right, nullptr, around);
    const osg::ref_ptr<osg::Node> buffers[] = {figure.node->getChild(0), figure.node->getChild(1)};
    int shown = 0;
    figure.mesh = [&](double) {
        return carried(shown ? right : left, [](glm::dvec3 p) { return p + glm::dvec3(0.5 * p.z, 0.0, 0.0); });
    };
    Trial trial(figure);
    for (int frame = 0; frame < 6; ++frame) {
        shown = frame % 2;
        figure.node->removeChildren(0, figure.node->getNumChildren());
        figure.node->addChild(buffers[shown]);
        const Judged found = trial.at(0.0);
        EXPECT_GT(found.shadowed, 300) << frame;
        EXPECT_EQ(found.wrong, 0) << frame;
    }
}

namespace {

/// Hills that shadow each other: of vertices that a texture displaces, or in their place. Both shade by OpenGL's light alone.
struct Hills {
    explicit Hills(bool displaced, gnomon::ShadowTechnique* technique) {
        constexpr int side = 32;
        const auto heightAt = [](double x, double y) {
            return float(0.8 * std::sin(3.0 * x) * std::cos(2.5 * y) + 0.2 * std::sin(9.0 * x + y));
        };
        const osg::ref_ptr<osg::Image> image = new osg::Image;
        image->allocateImage(side + 1, side + 1, 1, GL_RED, GL_FLOAT);
        image->setInternalTextureFormat(0x822E); // GL_R32F
        auto* heights = reinterpret_cast<float*>(image->data());
        for (int i = 0; i < (side + 1) * (side + 1); ++i)
            heights[i] = heightAt(2.0 * (i % (side + 1)) / side - 1.0, 2.0 * (i / (side + 1)) / side - 1.0);
        const auto heightOf = [&](const glm::dvec3& p) {
            const long column = std::lround((p.x + 1.0) * side / 2.0), row = std::lround((p.y + 1.0) * side / 2.0);
            return double(heights[row * (side + 1) + column]);
        };
        const Mesh flat = carried(grid(side), [](glm::dvec3 p) { return p * 4.0; });
        const osg::ref_ptr<osg::Geode> hills = test::node(
            displaced ? flat
                      : carried(flat, [&](glm::dvec3 p) { return p + glm::dvec3(0.0, 0.0, heightOf(p * 0.25)); }),
            "hills");
        hills->getDrawable(0)->setInitialBound(osg::BoundingBox(-4.0f, -4.0f, -1.0f, 4.0f, 4.0f, 1.0f));
        const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
        for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
            texture->setFilter(which, osg::Texture::NEAREST);
        texture->setResizeNonPowerOfTwoHint(false);
        const osg::ref_ptr<osg::Program> program = vertexProgram(
            "uniform sampler2D heights;",
            displaced ? "vec4 v = gl_Vertex; v.z += texelFetch(heights, ivec2(round((v.xy + 4.0) * 4.0)), 0).r;\n"
                        "gl_Position = gl_ModelViewProjectionMatrix * v;"
                      : "gl_Position = gl_ModelViewProjectionMatrix * gl_Vertex;");
        program->addShader(
            new osg::Shader(osg::Shader::FRAGMENT,
                            "void main() { gl_FragColor = vec4(0.2 + 0.7 * gl_LightSource[0].diffuse.rgb, 1.0); }"));
        osg::StateSet* state = hills->getOrCreateStateSet();
        state->setAttribute(program);
        if (displaced) {
            state->setTextureAttribute(0, texture);
            state->addUniform(new osg::Uniform("heights", 0));
        }
        scene.content->addChild(hills);
        scene.addShadow(technique);
    }
    Scene scene = test::scene(osg::Vec4d(1.0, 0.4, 0.5, 0.0));
};

} // namespace

/// Rays at the hills that stand there tell, but for pixels within two of an edge. Some that the hills graze differ, as where
/// a map has the same triangles.
TEST(MovedCastersOverTime, ShadowThemselves) {
    const osg::ref_ptr<gnomon::ShadowMapTechnique> technique = new gnomon::ShadowMapTechnique;
    Hills displaced(true, technique), mapped(false, new gnomon::ShadowMapTechnique),
        standing(false, new gnomon::TracedShadowTechnique);
    const View near = perspective({-2.0, -9.0, 8.0}, {0.0, 0.0, 0.0}, 480, 360, 45.0);
    const Picture rays = render(standing.scene.root, near), map = render(mapped.scene.root, near),
                  found = render(displaced.scene.root, near);
    int wrong = 0, wrongOfMap = 0, judged = 0, shadowed = 0;
    for (int y = 2; y + 2 < near.height; ++y)
        for (int x = 2; x + 2 < near.width; ++x) {
            bool away = true;
            for (int i = 0; i < 25; ++i) away = away && rays.at(x + i % 5 - 2, y + i / 5 - 2) == rays.at(x, y);
            if (!away) continue;
            ++judged;
            shadowed += rays.at(x, y) == grey(51);
            wrong += found.at(x, y) != rays.at(x, y);
            wrongOfMap += map.at(x, y) != rays.at(x, y);
        }
    EXPECT_GT(shadowed, 5000);
    EXPECT_LE(wrong, wrongOfMap + 10) << "of " << judged;
    EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
}

namespace {

using gnomon::MatrixUniform;

const Mesh wide = box({-0.9, -0.4, 0.0}, {0.9, 0.4, 1.5}), wideBelow = box({-0.9, -0.4, 0.0}, {0.9, 0.4, 1.0});
const osg::Matrixd placing = osg::Matrixd::rotate(0.5, 0.0, 0.0, 1.0) * osg::Matrixd::translate(0.7, -0.4, 0.0);

/// A program that projects by a uniform of its own.
struct OwnMatrix {
    const char* name;
    MatrixUniform uniform;
    std::string declared, clip; ///< the product that takes v to clip space.
    bool discards = false;      ///< what is above a height, and moves nothing.
};
std::ostream& operator<<(std::ostream& out, const OwnMatrix& own) { return out << own.name; }
const OwnMatrix ownMatrices[] = {
    {"ModelViewProjection", {"mvp", MatrixUniform::MODEL_VIEW_PROJECTION}, "uniform mat4 mvp;", "mvp * v"},
    {"Projection",
     {"projection", MatrixUniform::PROJECTION},
     "uniform mat4 projection;",
     "projection * (gl_ModelViewMatrix * v)"},
    {"ViewProjection",
     {"viewProjection", MatrixUniform::VIEW_PROJECTION},
     "uniform mat4 world, viewProjection;",
     "viewProjection * (world * v)"},
    {"Discarding", {"mvp", MatrixUniform::MODEL_VIEW_PROJECTION}, "uniform mat4 mvp;", "mvp * v", true}};

osg::Matrixd valueOf(MatrixUniform::Kind kind, const View& from) {
    const osg::Matrixd clipFromWorld = from.view * from.projection;
    return kind == MatrixUniform::PROJECTION        ? from.projection
           : kind == MatrixUniform::VIEW_PROJECTION ? clipFromWorld
                                                    : placing * clipFromWorld;
}

/// Sets the uniform in each update, as applications do.
struct FollowsView : public osg::UniformCallback {
    FollowsView(MatrixUniform::Kind which, const std::shared_ptr<View>& from) : kind(which), shown(from) {}
    void operator()(osg::Uniform* uniform, osg::NodeVisitor*) override {
        uniform->set(osg::Matrixf(valueOf(kind, *shown)));
    }
    const MatrixUniform::Kind kind;
    const std::shared_ptr<View> shown;
};

/// A leaning body, or one whose head is discarded, at another place than its arrays'.
Figure projected(const OwnMatrix& own, const std::shared_ptr<View>& shown = nullptr) {
    Figure figure;
    figure.addTime();
    const osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(placing);
    figure.node->addChild(place);
    const osg::ref_ptr<osg::Program> program =
        vertexProgram("uniform float time; varying float height; " + own.declared,
                      std::string("vec4 v = gl_Vertex; height = v.z; ") +
                          (own.discards ? "" : "v.x += 0.7 * time * v.z; ") + "gl_Position = " + own.clip + ";");
    const std::string cut = own.discards ? "if (height > 1.0) discard; " : "";
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       "varying float height; void main() { " + cut + "gl_FragColor = gl_Color; }"));
    Figure one;
    one.node = place;
    one.add(wide, program, around);
    osg::StateSet* state = place->getOrCreateStateSet();
    const osg::ref_ptr<osg::Uniform> matrix =
        new osg::Uniform(own.uniform.name.c_str(), osg::Matrixf(valueOf(own.uniform.kind, view)));
    if (shown) matrix->setUpdateCallback(new FollowsView(own.uniform.kind, shown));
    state->addUniform(matrix);
    state->addUniform(new osg::Uniform("world", osg::Matrixf(placing)));
    figure.mesh = [discards = own.discards](double time) {
        return carried(discards ? wideBelow : wide, [&](const glm::dvec3& p) {
            const osg::Vec3d to = osg::Vec3d(p.x + (discards ? 0.0 : 0.7 * time * p.z), p.y, p.z) * placing;
            return glm::dvec3(to.x(), to.y(), to.z());
        });
    };
    return figure;
}

class ProjectedCasters : public testing::TestWithParam<OwnMatrix> {};
INSTANTIATE_TEST_SUITE_P(Uniforms, ProjectedCasters, testing::ValuesIn(ownMatrices), testing::PrintToStringParamName());

} // namespace

/// The view goes away and comes back between the pictures.
TEST_P(ProjectedCasters, CastWhereTheirProgramDrawsThemOnceTheirMatrixIsNamed) {
    for (const osg::Vec4d& light : {sun, lamp}) {
        const auto shown = std::make_shared<View>(view);
        Trial trial(projected(GetParam(), shown), light);
        trial.scene.group->addMatrixUniform(GetParam().uniform);
        const std::string by = light == lamp ? "a lamp" : "a sun";
        expectRight(trial, by + ", relit");
        *shown = perspective({4.0, -9.0, 7.0}, {0.0, 0.0, 0.0}, 480, 360, 45.0);
        trial.camera->setView(*shown);
        trial.camera->frame();
        *shown = view;
        trial.camera->setView(view);
        trial.blendToBlack();
        expectRight(trial, by + ", blended");
    }
}

/// The view draws by the application's own value, though osg::State has no reason to set that again.
TEST_P(ProjectedCasters, AreSeenWhereTheyWere) {
    Figure seen = projected(GetParam());
    Scene bare = groundScene({}, half, sun);
    bare.content->addChild(seen.node);
    Camera camera(bare.root, view);
    Trial trial(projected(GetParam()));
    trial.scene.group->addMatrixUniform(GetParam().uniform);
    for (const double time : {0.0, 0.4, -0.3}) {
        EXPECT_EQ(trial.at(time).wrong, 0) << time;
        seen.setTime(time);
        const Picture expected = camera.frame(), found = trial.camera->frame();
        const Mask mask = castRays(square(half), {seen.mesh(time)}, sun, view);
        int different = 0, all = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                if (mask.at(x, y) != Seen::Caster) continue;
                ++all;
                different += found.at(x, y) != expected.at(x, y);
            }
        EXPECT_GT(all, 500) << time;
        EXPECT_EQ(different, 0) << time;
    }
}

TEST_P(ProjectedCasters, CastAsTheirArraysStandAndAreNamedUntilTheirMatrixIs) {
    Trial trial(projected(GetParam()));
    const auto isNamed = [&trial] {
        const std::vector<std::string> causes = trial.technique->diagnose();
        return std::any_of(causes.begin(), causes.end(), [](const std::string& cause) {
            return cause.find("name its matrix by addMatrixUniform()") != std::string::npos;
        });
    };
    EXPECT_GT(trial.at(0.6).wrong, 100);
    EXPECT_TRUE(isNamed());
    trial.scene.group->addMatrixUniform({"other", GetParam().uniform.kind});
    EXPECT_GT(trial.at(0.6).wrong, 100) << "the program has no such uniform";
    EXPECT_TRUE(isNamed());
    trial.scene.group->addMatrixUniform(GetParam().uniform);
    EXPECT_EQ(trial.at(0.6).wrong, 0);
    EXPECT_FALSE(isNamed());
    trial.scene.group->setMatrixUniforms({});
    EXPECT_GT(trial.at(0.6).wrong, 100);
    EXPECT_TRUE(isNamed());
}

/// A uniform of another kind is drawn by another matrix: the map is drawn again.
TEST(ProjectedCastersByName, MayBeNamedOtherwise) {
    Trial trial(projected(ownMatrices[0]));
    trial.scene.group->addMatrixUniform({"mvp", MatrixUniform::PROJECTION});
    EXPECT_GT(trial.at(0.3).wrong, 100);
    trial.scene.group->setMatrixUniforms({ownMatrices[0].uniform});
    EXPECT_EQ(trial.at(0.3).wrong, 0);
    trial.scene.group->addMatrixUniform({"mvp", MatrixUniform::Kind(3)}); // refused
    trial.scene.group->setMatrixUniforms(trial.scene.group->getMatrixUniforms());
    EXPECT_EQ(trial.scene.group->getMatrixUniforms(), std::vector<MatrixUniform>{ownMatrices[0].uniform});
    EXPECT_EQ(trial.at(0.3).wrong, 0);
}

/// The world's frame is above the camera that draws, whatever the viewer's own camera sees.
TEST(ProjectedCastersByName, HaveTheViewOfANestedCamera) {
    Trial trial(projected(ownMatrices[2]));
    trial.scene.group->addMatrixUniform(ownMatrices[2].uniform);
    const osg::ref_ptr<osg::Camera> nested = new osg::Camera;
    nested->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    nested->setRenderOrder(osg::Camera::POST_RENDER);
    nested->setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    nested->setClearColor(osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
    nested->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
    nested->setViewport(0, 0, view.width, view.height);
    nested->setViewMatrix(view.view);
    nested->setProjectionMatrix(view.projection);
    nested->addChild(trial.scene.root);
    Camera camera(nested, perspective({4.0, -9.0, 7.0}, {0.0, 0.0, 0.0}, view.width, view.height, 45.0));
    for (const double time : {0.0, 0.4}) {
        trial.figure.setTime(time);
        const Judged found = judge(camera.frame(), trial.figure.mesh(time), sun, trial.lit, trial.dark);
        EXPECT_GT(found.shadowed, 500) << time;
        EXPECT_EQ(found.wrong, 0) << time;
    }
}

namespace {

/// Hands what is below it the matrix of the view that culls, as no node of the graph has it.
struct PushesMatrix : public osg::NodeCallback {
    void operator()(osg::Node* node, osg::NodeVisitor* visitor) override {
        osgUtil::CullVisitor& cull = *visitor->asCullVisitor();
        const osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
        state->addUniform(
            new osg::Uniform("mvp", osg::Matrixf(*cull.getModelViewMatrix() * *cull.getProjectionMatrix())));
        cull.pushStateSet(state);
        traverse(node, visitor);
        cull.popStateSet();
    }
};

} // namespace

TEST(ProjectedCastersByName, MayHaveTheirMatrixByACullCallback) {
    const Figure figure = projected(ownMatrices[0]);
    osg::Group& place = *figure.node->getChild(0)->asGroup();
    place.getStateSet()->removeUniform("mvp");
    place.getChild(0)->setCullCallback(new PushesMatrix);
    Trial trial(figure);
    trial.scene.group->addMatrixUniform(ownMatrices[0].uniform);
    expectRight(trial, "a sun");
}
