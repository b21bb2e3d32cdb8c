// SPDX-License-Identifier: MIT
// Casters whose shape only their own code or program knows: drawImplementation() alone, and patches. Maps draw them; each
// picture equals that of the same triangles in a usual geometry. All other techniques say that they cannot.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/FrontFace>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/PatchParameter>
#include <osg/PolygonMode>
#include <osg/Program>
#include <osg/Texture2D>

#include <gtest/gtest.h>

#include <memory>

using namespace test;

namespace {

const Mesh body = sphere({0.0, 0.0, 0.0}, 1.0, 16);
const osg::Vec4d sun(1.0, -0.4, 1.3, 0.0), lamp(1.5, -2.0, 6.0, 1.0);

osg::Vec3 toOsg(const glm::dvec3& v) { return {float(v.x), float(v.y), float(v.z)}; }

/// As osgteapot's: OpenGL alone knows it.
class OwnBody : public osg::Drawable {
public:
    OwnBody() = default;
    OwnBody(const OwnBody& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : osg::Drawable(other, copyOp), scale(other.scale), bounded(other.bounded) {}
    META_Object(test, OwnBody)

    void drawImplementation(osg::RenderInfo&) const override {
        GLint unit = 0;
        glGetIntegerv(GL_ACTIVE_TEXTURE, &unit);
        onFirstUnit = onFirstUnit && unit == GL_TEXTURE0;
        glBegin(GL_TRIANGLES);
        for (std::size_t i = 0; i < body.size(); ++i) {
            const glm::dvec3 normal = body[i];
            glNormal3d(normal.x, normal.y, normal.z);
            glVertex3fv((toOsg(body[i]) * scale).ptr());
        }
        glEnd();
    }
    osg::BoundingBox computeBoundingBox() const override {
        return bounded ? osg::BoundingBox(-1.0f, -1.0f, -1.0f, 1.0f, 1.0f, 1.0f) : osg::BoundingBox();
    }

    float scale = 1.0f;
    bool bounded = true;
    mutable bool onFirstUnit = true; ///< in every draw.

protected:
    ~OwnBody() override = default;
};

osg::ref_ptr<osg::Drawable> usualBody() {
    const osg::ref_ptr<osg::Node> geode = node(body);
    return geode->asGroup()->getChild(0)->asDrawable();
}

constexpr const char* vertex = "#version 400 compatibility\nvoid main() { gl_Position = gl_Vertex; }";
constexpr const char* control = R"(#version 400 compatibility
layout(vertices = 3) out;
uniform float level;
void main() {
    gl_out[gl_InvocationID].gl_Position = gl_in[gl_InvocationID].gl_Position;
    gl_TessLevelInner[0] = level;
    for (int i = 0; i < 3; ++i) gl_TessLevelOuter[i] = level;
})";
constexpr const char* evaluation = R"(#version 400 compatibility
layout(triangles, equal_spacing, ccw) in;
uniform float grown;
void main() {
    vec4 place = gl_TessCoord.x * gl_in[0].gl_Position + gl_TessCoord.y * gl_in[1].gl_Position +
                 gl_TessCoord.z * gl_in[2].gl_Position;
    gl_Position = gl_ModelViewProjectionMatrix * vec4(grown * place.xyz, 1.0);
})";
constexpr const char* fragment = "#version 130\nvoid main() { gl_FragColor = 0.5 * gl_LightSource[0].diffuse; }";

/// As osgtessellationshaders': its program makes the triangles, twice as wide as the patches.
struct Patches {
    Patches() {
        const osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
        for (const glm::dvec3& corner : body) vertices->push_back(toOsg(corner) * 0.5f);
        geometry->setVertexArray(vertices);
        geometry->addPrimitiveSet(new osg::DrawArrays(osg::PrimitiveSet::PATCHES, 0, int(body.size())));
        geometry->setInitialBound(osg::BoundingBox(-1.0f, -1.0f, -1.0f, 1.0f, 1.0f, 1.0f));
        const osg::ref_ptr<osg::Program> program = new osg::Program;
        program->addShader(new osg::Shader(osg::Shader::VERTEX, vertex));
        program->addShader(new osg::Shader(osg::Shader::TESSCONTROL, control));
        program->addShader(new osg::Shader(osg::Shader::TESSEVALUATION, evaluation));
        program->addShader(new osg::Shader(osg::Shader::FRAGMENT, fragment));
        osg::StateSet* state = geometry->getOrCreateStateSet();
        state->setAttributeAndModes(program);
        state->setAttribute(new osg::PatchParameter(3));
        state->addUniform(new osg::Uniform("level", 1.0f));
        state->addUniform(grown);
    }
    osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
    osg::ref_ptr<osg::Uniform> grown = new osg::Uniform("grown", 2.0f);
};

/// A drawable over a ground, beside a usual box that casts as well.
struct Trial {
    Trial(osg::Drawable* drawable, gnomon::ShadowTechnique* with, const osg::Vec4d& light = sun, bool box = true)
        : scene(groundScene(std::vector<Mesh>(box ? 1 : 0, test::box({-3.0, 1.0, 0.0}, {-2.0, 2.0, 1.5})), 8.0, light)),
          technique(with) {
        const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
        geode->setName("teapot");
        geode->addDrawable(drawable);
        place->setMatrix(osg::Matrixd::translate(0.5, 0.0, 1.7));
        place->addChild(geode);
        scene.content->addChild(place);
        scene.addShadow(technique);
        if (auto* terrain = dynamic_cast<gnomon::TerrainShadowGeode*>(with))
            terrain->setReceiver({find(*scene.root, "ground")});
    }
    Picture frame() {
        if (!camera) camera = std::make_unique<Camera>(scene.root, view);
        return camera->frame();
    }
    bool says(const std::string& part) const {
        for (const std::string& cause : technique->diagnose())
            if (cause.find(part) != std::string::npos) return true;
        return false;
    }

    Scene scene;
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform;
    View view = perspective({-4.0, -10.0, 8.0}, {0.0, 0.0, 0.5}, 160, 120, 40.0);
    std::unique_ptr<Camera> camera;
};

osg::ref_ptr<gnomon::ShadowMapTechnique> map() { return new gnomon::ShadowMapTechnique; }

/// Ground alone, for the patches have colours of their own. Maps lie alike, for the boxes are alike.
int differentGround(const Picture& a, const Picture& b) {
    const auto isGround = [](std::uint32_t pixel) { return pixel == grey(litGround) || pixel == grey(shadowedGround); };
    int different = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        different += isGround(a.pixels[i]) && isGround(b.pixels[i]) && a.pixels[i] != b.pixels[i];
    return different;
}

} // namespace

TEST(OwnDrawing, CastsInMapsAsItsTrianglesDo) {
    for (const osg::Vec4d& light : {sun, lamp}) {
        Trial own(new OwnBody, map(), light), usual(usualBody(), map(), light);
        const Picture expected = usual.frame(), found = own.frame();
        // texels at the rim: vertices go another way to the map
        EXPECT_LE(differentGround(found, expected), 12);
        EXPECT_GT(found.count(shadowedGround), 300);
        EXPECT_EQ(own.technique->diagnose(), std::vector<std::string>());
        EXPECT_LE(differentGround(own.frame(), found), 0) << "in the second frame";
    }
}

TEST(OwnDrawing, OfPatchesCastsInMapsAsItsProgramMakesIt) {
    for (const osg::Vec4d& light : {sun, lamp}) {
        Trial own(Patches().geometry, map(), light), usual(usualBody(), map(), light);
        const Picture expected = usual.frame(), found = own.frame();
        EXPECT_LE(differentGround(found, expected), 12);
        EXPECT_GT(found.count(shadowedGround), 300);
        EXPECT_EQ(own.technique->diagnose(), std::vector<std::string>());
    }
}

TEST(OwnDrawing, CastsAlone) {
    Trial own(new OwnBody, map(), sun, false), usual(usualBody(), map(), sun, false);
    const Picture expected = usual.frame(), found = own.frame();
    EXPECT_LE(differentGround(found, expected), 12);
    EXPECT_GT(found.count(shadowedGround), 200);
    EXPECT_EQ(own.technique->diagnose(), std::vector<std::string>());
}

TEST(OwnDrawing, MovesWithWhatItStandsOn) {
    Trial own(new OwnBody, map()), usual(usualBody(), map());
    for (const double x : {0.5, 1.0, -1.0}) {
        for (Trial* trial : {&own, &usual}) trial->place->setMatrix(osg::Matrixd::translate(x, 0.0, 1.7));
        EXPECT_LE(differentGround(own.frame(), usual.frame()), 20) << x;
    }
}

TEST(OwnDrawing, IsDrawnAgainOnlyWhereItChanges) {
    const osg::ref_ptr<gnomon::ShadowMapTechnique> technique = map();
    const osg::ref_ptr<OwnBody> drawable = new OwnBody;
    drawable->setUseDisplayList(false);
    drawable->setDataVariance(osg::Object::STATIC);
    Trial trial(drawable, technique);
    trial.frame();
    const unsigned passes = technique->passes();
    trial.frame();
    EXPECT_EQ(technique->passes(), passes) << "it is static";
    drawable->setDataVariance(osg::Object::DYNAMIC);
    const Picture before = trial.frame();
    drawable->scale = 0.5f;
    EXPECT_LT(trial.frame().count(shadowedGround), before.count(shadowedGround) - 50);
    EXPECT_EQ(technique->passes(), passes + 2);
}

TEST(OwnDrawing, FollowsUniforms) {
    const osg::ref_ptr<gnomon::ShadowMapTechnique> technique = map();
    const Patches patches;
    Trial trial(patches.geometry, technique);
    const Picture before = trial.frame();
    trial.frame();
    EXPECT_EQ(technique->passes(), 1u);
    patches.grown->set(1.0f);
    EXPECT_LT(trial.frame().count(shadowedGround), before.count(shadowedGround) - 50);
    EXPECT_EQ(technique->passes(), 2u);
    patches.grown->set(1.0f);
    trial.frame();
    EXPECT_EQ(technique->passes(), 2u) << "the same value";
}

TEST(OwnDrawing, OtherTechniquesSayThatItCastsNothing) {
    for (const osg::ref_ptr<gnomon::ShadowTechnique>& technique : std::vector<osg::ref_ptr<gnomon::ShadowTechnique>>{
             planar(), new gnomon::TerrainShadowGeode, new gnomon::TracedShadowTechnique,
             new gnomon::ShadowVolumeTechnique})
        for (const osg::ref_ptr<osg::Drawable>& drawable :
             {osg::ref_ptr<osg::Drawable>(new OwnBody), osg::ref_ptr<osg::Drawable>(Patches().geometry)}) {
            Trial trial(drawable, technique);
            trial.frame();
            EXPECT_TRUE(trial.says("what draws itself or is made of patches casts nothing here: 1, the first in "
                                   "'teapot'"))
                << technique->className();
            EXPECT_EQ(technique->diagnose().size(), 1u);
        }
}

TEST(OwnDrawing, AutoTakesAMap) {
    const osg::ref_ptr<gnomon::AutoShadowTechnique> technique = new gnomon::AutoShadowTechnique;
    Trial trial(new OwnBody, technique);
    trial.frame();
    EXPECT_EQ(technique->lastDecision().front().chosen.spec.substr(0, 3), "map");
    EXPECT_EQ(technique->diagnose(), std::vector<std::string>());
    const std::vector<gnomon::ShadowDecision> decisions = technique->lastDecision();
    for (const gnomon::ShadowCandidate& candidate : decisions.front().candidates)
        EXPECT_EQ(candidate.obstacle.empty(), candidate.spec.find("map") != std::string::npos) << candidate.spec;
}

TEST(OwnDrawing, AutoTakesAMapForOneThatIsAlone) {
    Trial trial(new OwnBody, new gnomon::AutoShadowTechnique, sun, false), mapped(new OwnBody, map(), sun, false);
    EXPECT_GT(trial.frame().count(shadowedGround), mapped.frame().count(shadowedGround) / 2);
}

TEST(OwnDrawing, WithoutBoundsIsReported) {
    const osg::ref_ptr<OwnBody> drawable = new OwnBody;
    drawable->bounded = false;
    Trial trial(drawable, map());
    trial.frame();
    EXPECT_TRUE(trial.says("'teapot' draws itself and has no bounds, so it casts nothing"));
}

/// Evaluators, as osgteapot has, work with the first texture unit alone.
TEST(OwnDrawing, IsDrawnOnTheFirstTextureUnit) {
    const osg::ref_ptr<OwnBody> early = new OwnBody, late = new OwnBody;
    for (const auto& drawable : {early, late}) drawable->setUseDisplayList(false);
    late->getOrCreateStateSet()->setRenderBinDetails(10, "RenderBin");
    Trial trial(early, map());
    trial.place->getChild(0)->asGeode()->addDrawable(late);
    for (int frame = 0; frame < 2; ++frame) trial.frame();
    EXPECT_TRUE(early->onFirstUnit);
    EXPECT_TRUE(late->onFirstUnit);
}

/// The map is drawn in the first frame alone: the second would differ from it where its state stayed.
TEST(OwnDrawing, LeavesTheRestOfTheFrameAsItIs) {
    const osg::ref_ptr<OwnBody> drawable = new OwnBody;
    osg::StateSet* state = drawable->getOrCreateStateSet();
    state->setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT));
    state->setAttribute(new osg::FrontFace(osg::FrontFace::CLOCKWISE));
    state->setAttribute(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE));
    state->setAttribute(new osg::Depth(osg::Depth::ALWAYS));
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(4, 4);
    texture->setInternalFormat(GL_RGBA);
    state->setTextureAttributeAndModes(1, texture);
    Trial own(drawable, map()), usual(usualBody(), map());
    const Picture first = own.frame();
    EXPECT_EQ(first.different(own.frame()), 0);
    EXPECT_LE(differentGround(first, usual.frame()), 40); // lines show less of the body than faces
}
