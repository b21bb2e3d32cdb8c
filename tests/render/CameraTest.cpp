// SPDX-License-Identifier: MIT
// What a viewer's camera may lay over the whole scene, and how it may look at it.
#include "GlComplaints.h"
#include "GlSnapshot.h"
#include "TwoGrounds.h"

#include <osg/BlendFunc>
#include <osg/CullFace>
#include <osg/Material>
#include <osg/PolygonMode>
#include <osg/Program>
#include <osg/Scissor>
#include <osg/Texture2D>

using namespace test;

namespace {

constexpr auto overriding = osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE;

osg::Camera& cameraOf(Camera& viewer) { return *viewer.viewer().getCamera(); }

Trial laidOver(const std::function<void(osg::StateSet&)>& change) {
    Trial trial;
    trial.set = [change](Camera& viewer) { change(*cameraOf(viewer).getOrCreateStateSet()); };
    return trial;
}

/// Chequered by the position itself, so that no coordinates are needed.
void texture(Scene& scene) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 2, 1, GL_LUMINANCE, GL_UNSIGNED_BYTE);
    for (int i = 0; i < 4; ++i) image->data()[i] = i % 3 ? 255 : 90;
    osg::ref_ptr<osg::Texture2D> texels = new osg::Texture2D(image);
    texels->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    find(*scene.root, "grounds")->getOrCreateStateSet()->setTextureAttributeAndModes(0, texels);
    for (const char* name : {"left", "right"}) {
        auto* geometry = find(*scene.root, name)->asGeode()->getDrawable(0)->asGeometry();
        osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array;
        for (const osg::Vec3& v : *static_cast<osg::Vec3Array*>(geometry->getVertexArray()))
            coordinates->push_back({v.x() / 2.0f, v.y() / 2.0f});
        geometry->setTexCoordArray(0, coordinates);
    }
}

void lightByProgram(osg::StateSet& set) {
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(
        new osg::Shader(osg::Shader::VERTEX,
                        litColor + std::string("varying vec4 color;\n"
                                               "void main() { gl_Position = ftransform(); color = litColor(); }")));
    program->addShader(
        new osg::Shader(osg::Shader::FRAGMENT, "varying vec4 color; void main() { gl_FragColor = color; }"));
    set.setAttribute(program, overriding);
}

/// More lines for a wireframe to show, in the left ground.
void grid(Scene& scene) {
    std::vector<Mesh> tiles;
    for (double y = -4.0; y < 4.0; y += 0.5)
        for (double x = -5.0; x < 0.0; x += 0.5) tiles.push_back(quad({x, y, 0.0}, {0.5, 0.0, 0.0}, {0.0, 0.5, 0.0}));
    osg::Group* grounds = find(*scene.root, "grounds")->asGroup();
    grounds->replaceChild(find(*scene.root, "left"), node(joined(tiles), "left"));
}

/// Stripes, before anything is drawn.
class Backdrop : public osg::Camera::DrawCallback {
public:
    void operator()(osg::RenderInfo& renderInfo) const override {
        glEnable(GL_SCISSOR_TEST);
        for (int i = 0; i < 30; ++i) {
            glScissor(10 * i, 0, 10, 1000);
            glClearColor(i % 2 ? 0.9f : 0.1f, 0.05f * static_cast<float>(i % 20), 0.3f, 1.0f);
            glClear(GL_COLOR_BUFFER_BIT);
        }
        glDisable(GL_SCISSOR_TEST);
        renderInfo.getState()->haveAppliedMode(GL_SCISSOR_TEST, osg::StateAttribute::OFF);
    }
};

/// Half of the colour, rounded either way.
bool isHalf(std::uint32_t actual, std::uint32_t whole) {
    bool half = true;
    for (int shift = 0; shift < 24; shift += 8) {
        const int is = (actual >> shift) & 0xff, was = (whole >> shift) & 0xff;
        half = half && std::abs(2 * is - was) <= 1;
    }
    return half;
}

class CameraState : public testing::TestWithParam<TwoGrounds> {};
INSTANTIATE_TEST_SUITE_P(Planar, CameraState, testing::ValuesIn(allTwoGrounds()),
                         [](const auto& place) { return nameOf(place.param); });

} // namespace

TEST_P(CameraState, TexturingOffAndOn) {
    for (const auto value : {osg::StateAttribute::OFF, osg::StateAttribute::ON}) {
        Trial trial = laidOver([value](osg::StateSet& set) {
            set.setTextureMode(0, GL_TEXTURE_2D, value | osg::StateAttribute::OVERRIDE);
        });
        trial.change = texture;
        EXPECT_TRUE(isExact(GetParam(), trial)) << value;
    }
}

TEST_P(CameraState, BackFaceCulling) {
    EXPECT_TRUE(isExact(GetParam(), laidOver([](osg::StateSet& set) {
                            set.setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK), overriding);
                        })));
}

TEST_P(CameraState, Scissor) {
    EXPECT_TRUE(isExact(GetParam(), laidOver([](osg::StateSet& set) {
                            set.setAttributeAndModes(new osg::Scissor(0, 20, 170, 120), osg::StateAttribute::ON);
                        })));
    EXPECT_TRUE(isExact(GetParam(), laidOver([](osg::StateSet& set) {
                            set.setMode(GL_SCISSOR_TEST, osg::StateAttribute::ON); // with the stage's own rectangle
                        })));
}

TEST_P(CameraState, Program) { EXPECT_TRUE(isExact(GetParam(), laidOver(lightByProgram))); }

// As osgviewer's 'l' does, between two frames: nothing can be relit, so all that receives takes the factor.
TEST_P(CameraState, LightingOff) {
    const TwoGrounds& place = GetParam();
    const auto second = [](osg::Node* root, const View& view) {
        Camera camera(root, view);
        camera.frame();
        cameraOf(camera).getStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF | osg::StateAttribute::OVERRIDE);
        return camera.frame();
    };
    Scene scene = place.build();
    const Picture lit = second(scene.root, place.view);
    const auto technique = place.addShadow(scene);
    const Picture actual = second(scene.root, place.view);
    const Mask mask = place.mask();
    int wrong = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const bool same = actual.at(x, y) == lit.at(x, y), half = isHalf(actual.at(x, y), lit.at(x, y));
            wrong += mask.atEdge(x, y) ? !same && !half : mask.at(x, y) == Seen::ShadowedReceiver ? !half : !same;
        }
    EXPECT_EQ(wrong, 0);
    ASSERT_FALSE(technique->diagnose().empty());
    EXPECT_NE(technique->diagnose()[0].find("unlit"), std::string::npos);
}

// As osgviewer's 'w' does: polygons drawn as lines cast nothing.
TEST_P(CameraState, WireframeCastsNothingAndSaysSo) {
    const TwoGrounds& place = GetParam();
    Trial trial = laidOver([](osg::StateSet& set) {
        set.setAttributeAndModes(new osg::PolygonMode(osg::PolygonMode::FRONT_AND_BACK, osg::PolygonMode::LINE),
                                 overriding);
    });
    trial.change = grid;
    Scene scene = place.build();
    trial.change(scene);
    const auto technique = place.addShadow(scene);
    Camera camera(scene.root, place.view);
    trial.set(camera);
    const Picture actual = frames(camera).third;
    EXPECT_EQ(actual.different(unshadowed(place, trial, false).third), 0);
    EXPECT_NE(actual.different(unshadowed(place, trial, true).third), 0) << "nothing is drawn";
    ASSERT_FALSE(technique->diagnose().empty());
    EXPECT_NE(technique->diagnose()[0].find("nothing casts"), std::string::npos) << technique->diagnose()[0];
}

TEST_P(CameraState, ClearsDepthAlone) {
    Trial trial;
    trial.set = [](Camera& viewer) { cameraOf(viewer).setClearMask(GL_DEPTH_BUFFER_BIT); };
    EXPECT_TRUE(isExact(GetParam(), trial));
}

// As the nearer of the cameras that a scene is drawn by when its depth is partitioned; what stands there is no single colour.
TEST_P(CameraState, ClearsNoColorUnderReceiversThatBlend) {
    Trial trial;
    trial.set = [](Camera& viewer) {
        cameraOf(viewer).setClearMask(GL_DEPTH_BUFFER_BIT);
        cameraOf(viewer).setPreDrawCallback(new Backdrop);
    };
    trial.change = [](Scene& scene) {
        osg::StateSet* set = find(*scene.root, "grounds")->getOrCreateStateSet();
        set->setAttributeAndModes(new osg::BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA));
        const osg::ref_ptr<osg::Material> half = new osg::Material;
        half->setAmbient(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 0.5f});
        half->setDiffuse(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 0.5f});
        set->setAttribute(half);
    };
    EXPECT_TRUE(isExact(GetParam(), trial));
}

TEST_P(CameraState, ComputesNearAndFarAsWithoutGnomon) {
    for (const auto mode : {osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES,
                            osg::CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES}) {
        std::vector<osg::ref_ptr<GlProbe>> probes;
        Trial trial;
        trial.set = [mode](Camera& viewer) { cameraOf(viewer).setComputeNearFarMode(mode); };
        trial.change = [&probes](Scene& scene) {
            probes.push_back(new GlProbe);
            probes.back()->getOrCreateStateSet()->setRenderBinDetails(9, "RenderBin");
            scene.root->addChild(probes.back());
        };
        EXPECT_TRUE(isExact(GetParam(), trial));
        const auto projection = [](const osg::ref_ptr<GlProbe>& probe) {
            return probe->seen().at("GL_PROJECTION_MATRIX");
        };
        ASSERT_EQ(probes.size(), 3u); // with Gnomon, lit, dark
        EXPECT_EQ(projection(probes[0]), projection(probes[1]));
        const double given = GetParam().view.projection(2, 2);
        EXPECT_NE(projection(probes[0])[10], static_cast<float>(given)) << "near and far are not computed";
    }
}

TEST_P(CameraState, ViewportThatDoesNotBeginAtZero) {
    TwoGrounds place = GetParam();
    View whole = place.view;
    whole.width = 300;
    whole.height = 220;
    const auto picture = [&](int kind) { // 0: lit, 1: dark, 2: with shadows
        Scene scene = place.build();
        if (kind == 1) scene.takeLightAway();
        if (kind == 2) place.addShadow(scene);
        Camera camera(scene.root, whole);
        cameraOf(camera).setViewport(new osg::Viewport(37, 21, place.view.width, place.view.height));
        return cropped(frames(camera).third, 37, 21, place.view.width, place.view.height);
    };
    EXPECT_TRUE(judge(picture(2), picture(0), picture(1), place.mask()));
}

TEST_P(CameraState, SlavesSideBySideInOneContext) {
    TwoGrounds place = GetParam(), left = place, right = place;
    View whole = place.view;
    whole.width = 2 * place.view.width;
    right.view.view = place.view.view * osg::Matrixd::rotate(-0.05, osg::Vec3d(0.0, 1.0, 0.0));
    const auto picture = [&](int kind) {
        Scene scene = place.build();
        if (kind == 1) scene.takeLightAway();
        if (kind == 2) place.addShadow(scene);
        Camera camera(nullptr, whole);
        cameraOf(camera).setGraphicsContext(nullptr);
        cameraOf(camera).setViewport(nullptr);
        for (const bool second : {false, true}) {
            osg::ref_ptr<osg::Camera> slave = new osg::Camera;
            slave->setGraphicsContext(camera.context().graphicsContext());
            slave->setViewport(second ? place.view.width : 0, 0, place.view.width, place.view.height);
            camera.viewer().addSlave(slave, osg::Matrixd(),
                                     second ? osg::Matrixd::rotate(-0.05, osg::Vec3d(0.0, 1.0, 0.0)) : osg::Matrixd());
        }
        camera.viewer().setSceneData(scene.root);
        return frames(camera).third;
    };
    const Picture actual = picture(2), lit = picture(0), dark = picture(1);
    const auto half = [&](const Picture& both, bool second) {
        return cropped(both, second ? place.view.width : 0, 0, place.view.width, place.view.height);
    };
    EXPECT_TRUE(judge(half(actual, false), half(lit, false), half(dark, false), left.mask()));
    EXPECT_TRUE(judge(half(actual, true), half(lit, true), half(dark, true), right.mask()));
}

// Two stages draw into the same pixels one after the other, each in channels of its own. The eyes see the same.
TEST_P(CameraState, AnaglyphStereo) {
    Trial trial;
    trial.set = [](Camera& viewer) {
        osg::ref_ptr<osg::DisplaySettings> settings = new osg::DisplaySettings;
        settings->setStereo(true);
        settings->setStereoMode(osg::DisplaySettings::ANAGLYPHIC);
        settings->setEyeSeparation(0.0f);
        cameraOf(viewer).setDisplaySettings(settings);
    };
    EXPECT_TRUE(isExact(GetParam(), trial));
}
