// SPDX-License-Identifier: MIT
// State and views that would lead the compositor's own drawing astray.
#include "IntoTexture.h"

#include <support/Causes.h>
#include <support/DiscShadow.h>
#include <support/GlDebug.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/DisplaySettings>
#include <osg/Geometry>
#include <osg/LogicOp>
#include <osg/MatrixTransform>
#include <osg/Point>
#include <osg/PolygonOffset>
#include <osg/Program>
#include <osg/Projection>
#include <osg/Stencil>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderBin>

#include <algorithm>

using namespace test;

namespace {

const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 200, 150);
constexpr auto blend = gnomon::ShadowCasterGroup::BLEND;

Scene boxScene() { return groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})}); }

osg::StateSet& groundState(Scene& scene) { return *find(*scene.root, "ground")->getOrCreateStateSet(); }

osg::ref_ptr<DiscShadow> disc(double inner, double outer) {
    osg::ref_ptr<DiscShadow> result = new DiscShadow({100.0, 75.0}, inner, outer);
    result->size.set(view.width, view.height);
    return result;
}

/// What a nested camera lays over the view: seen through a lens of its own, by its depths nearer than all of the view.
osg::ref_ptr<osg::Camera> overlay(osg::Node* content) {
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setRenderOrder(osg::Camera::NESTED_RENDER);
    camera->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
    camera->setViewMatrixAsLookAt({0.0, 0.0, 50.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
    camera->setProjectionMatrixAsOrtho(-4.0, 12.0, -6.0, 6.0, 1.0, 100.0);
    camera->addChild(content);
    return camera;
}

/// Code of an application's own that clears depths.
struct DepthClear : public osg::Drawable {
    struct Callback : public osg::Drawable::DrawCallback {
        void drawImplementation(osg::RenderInfo&, const osg::Drawable*) const override { glClear(GL_DEPTH_BUFFER_BIT); }
    };
    DepthClear() {
        setSupportsDisplayList(false);
        setCullingActive(false);
    }
    DepthClear(const DepthClear& other, const osg::CopyOp& copyOp) : osg::Drawable(other, copyOp) {}
    META_Object(test, DepthClear)
    void drawImplementation(osg::RenderInfo&) const override { glClear(GL_DEPTH_BUFFER_BIT); }
};

/// Code of an application's own that lets OpenGL scale and shift depths wherever pixels are copied or read.
struct DepthTransfer : public osg::Drawable {
    DepthTransfer() = default;
    DepthTransfer(float newScale, float newBias) : scale(newScale), bias(newBias) {
        setSupportsDisplayList(false);
        setCullingActive(false);
    }
    DepthTransfer(const DepthTransfer& other, const osg::CopyOp& copyOp)
        : osg::Drawable(other, copyOp), scale(other.scale), bias(other.bias) {}
    META_Object(test, DepthTransfer)
    void drawImplementation(osg::RenderInfo&) const override {
        glGetFloatv(GL_DEPTH_SCALE, &foundScale);
        glGetFloatv(GL_DEPTH_BIAS, &foundBias);
        glPixelTransferf(GL_DEPTH_SCALE, scale);
        glPixelTransferf(GL_DEPTH_BIAS, bias);
    }
    const float scale = 1.0f, bias = 0.0f;
    mutable float foundScale = 0.0f, foundBias = 0.0f; ///< as the frame before has left them.
};

/// Zooms what is drawn by pixels.
struct PixelZoom : public osg::Drawable {
    PixelZoom() {
        setSupportsDisplayList(false);
        setCullingActive(false);
    }
    PixelZoom(const PixelZoom& other, const osg::CopyOp& copyOp) : osg::Drawable(other, copyOp) {}
    META_Object(test, PixelZoom)
    void drawImplementation(osg::RenderInfo&) const override { glPixelZoom(2.0f, -1.0f); }
};

int changed(const Picture& a, const Picture& b) { return a.different(b); }

} // namespace

TEST(HostileState, ABlendEquationThatIsNotUsedDoesNotBendTheFactor) {
    Scene plain = boxScene(), bent = boxScene();
    groundState(bent).setAttribute(new osg::BlendEquation(osg::BlendEquation::RGBA_MAX)); // GL_BLEND stays off
    for (Scene* scene : {&plain, &bent}) {
        scene->addShadow(planar(find(*scene->root, "ground")));
        scene->group->setComposite(blend);
    }
    EXPECT_EQ(changed(render(bent.root, view), render(plain.root, view)), 0);
}

TEST(HostileState, AReceiverWithALogicOpIsBlendedToo) {
    for (const bool named : {false, true}) {
        Scene scene = boxScene();
        groundState(scene).setAttributeAndModes(new osg::LogicOp(osg::LogicOp::COPY));
        const Picture lit = render(scene.root, view);
        scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
        scene.group->setComposite(blend);
        EXPECT_GT(changed(render(scene.root, view), lit), 500) << "named " << named;
    }
}

// The second eye draws its channels over those of the first, and must not wipe them out.
TEST(HostileState, ABlendingReceiverIsTheSameInAnaglyphStereoWithoutSeparation) {
    const auto shoot = [](bool stereo) {
        Scene scene = boxScene();
        groundState(scene).setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE));
        scene.addShadow(planar());
        Camera camera(scene.root, view);
        osg::ref_ptr<osg::DisplaySettings> settings = new osg::DisplaySettings;
        settings->setStereo(stereo);
        settings->setStereoMode(osg::DisplaySettings::ANAGLYPHIC);
        settings->setEyeSeparation(0.0f);
        camera.viewer().getCamera()->setDisplaySettings(settings);
        camera.viewer().getCamera()->setClearColor(
            {0.0f, 0.0f, 0.0f, 1.0f}); // what the clear of one eye adds is nothing
        return camera.frame();
    };
    EXPECT_EQ(changed(shoot(true), shoot(false)), 0);
}

TEST(HostileState, WidePointsBesideTheShadowAreDrawnAgainWhereTheyReachIn) {
    Scene scene = boxScene();
    osg::ref_ptr<osg::Vec3Array> spot = new osg::Vec3Array(1);
    spot->front().set(-2.35f, 1.41f, 0.3f); // ten pixels to the left of the marks' bounds, and 30 pixels wide each way
    osg::ref_ptr<osg::Geometry> point = new osg::Geometry;
    point->setVertexArray(spot);
    osg::ref_ptr<osg::Vec4Array> red = new osg::Vec4Array(1);
    red->front().set(1.0f, 0.0f, 0.0f, 1.0f);
    point->setColorArray(red, osg::Array::BIND_OVERALL);
    point->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, 1));
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(point);
    geode->getOrCreateStateSet()->setAttribute(new osg::Point(60.0f));
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF); // or it would look like the ground
    scene.content->addChild(geode);
    scene.addShadow(disc(30.0, 30.0));
    const Picture filtered = render(scene.root, view);
    const Picture whole = render(test::unfiltered(scene.root), view);
    EXPECT_EQ(changed(filtered, whole), 0);
}

TEST(HostileState, DepthThatIsClearedToLessThanOneIsRefusedWithTheReason) {
    Scene scene = boxScene();
    const auto technique = planar();
    Camera plain(scene.root, view);
    plain.viewer().getCamera()->setClearDepth(0.9);
    const Picture lit = plain.frame();
    scene.addShadow(technique);
    EXPECT_EQ(changed(plain.frame(), lit), 0);
    ASSERT_EQ(technique->diagnose().size(), 1u);
    EXPECT_NE(technique->diagnose()[0].find("cleared to less than 1"), std::string::npos);
}

// What is always on top is drawn after depths were cleared. Here it is nearest anyway, so that the picture is the same.
TEST(HostileState, DepthsThatAnEarlyBinClearsLeaveTheShadowsOfWhatIsDrawnBeforeAndAfter) {
    enum class Clears { Nobody, ADrawable, ACallback };
    int number = 5;
    const auto picture = [&number](Clears who, const std::string& spec) {
        Scene scene = boxScene();
        const osg::ref_ptr<osg::Geode> top = node(box({-3.4, -5.4, 3.4}, {-2.8, -4.8, 4.0}), "top"),
                                       plate = node(box({-2.6, -5.3, 4.4}, {-2.2, -4.9, 4.5}), "plate");
        for (const auto& each : {top, plate}) {
            scene.content->addChild(each);
            each->getOrCreateStateSet()->setRenderBinDetails(6, "RenderBin");
        }
        osg::ref_ptr<osg::Geode> clear = new osg::Geode;
        if (who == Clears::ADrawable) clear->addDrawable(new DepthClear);
        if (who == Clears::ACallback) {
            clear = node(square(0.01, -1.0)); // under the ground
            clear->getDrawable(0)->setDrawCallback(new DepthClear::Callback);
        }
        clear->setCullingActive(false);
        clear->getOrCreateStateSet()->setRenderBinDetails(number, "RenderBin");
        scene.root->addChild(clear);
        osg::ref_ptr<gnomon::ShadowTechnique> technique;
        if (!spec.empty()) {
            scene.addShadow(spec);
            technique =
                dynamic_cast<gnomon::ShadowTechnique*>(scene.group->getChild(scene.group->getNumChildren() - 1));
        }
        const Picture result = render(scene.root, view);
        if (technique) EXPECT_EQ(causesButLitSurfaces(*technique), std::vector<std::string>()) << spec;
        return result;
    };
    const Picture lit = picture(Clears::Nobody, "");
    for (const Clears who : {Clears::ADrawable, Clears::ACallback}) {
        EXPECT_EQ(changed(picture(who, ""), lit), 0);
        number = 1; // right after the stage's own leaves
        EXPECT_EQ(changed(picture(who, "volume"), picture(Clears::Nobody, "volume")), 0);
        number = 5;
        for (const std::string spec :
             {"planar", "map", "volume", "traced", "planar:composite=blend", "volume:composite=blend"}) {
            const Picture usual = picture(Clears::Nobody, spec);
            EXPECT_GT(changed(usual, lit), 500) << spec;
            // Maps are fitted to what receives before, and to what after: their texels lie elsewhere.
            EXPECT_LE(changed(picture(who, spec), usual), spec == "map" ? 40 : 0) << spec;
        }
    }
}

// OpenGL applies both to depths that are copied into a texture, as those of framebuffer objects are, and to those that are read.
// The flat shadow of a box on a plane, which needs no depths, says where it must be.
TEST(HostileState, AScaleAndABiasOfCopiedDepthsMoveNoShadowAndStandAfterwards) {
    for (const Target& target : {withDepth(depth24), fourSamples()}) {
        Scene flat = boxScene();
        flat.addShadow("planar");
        const Picture expected = IntoTexture(flat.root, view, target).camera->frame();
        for (const std::string spec : {"map", "traced"}) {
            Scene scene = boxScene();
            const osg::ref_ptr<DepthTransfer> transfer = new DepthTransfer(0.5f, 0.25f);
            const osg::ref_ptr<osg::Geode> geode = new osg::Geode;
            geode->addDrawable(transfer);
            geode->setCullingActive(false);
            geode->getOrCreateStateSet()->setRenderBinDetails(-1, "RenderBin");
            scene.root->addChild(geode);
            scene.addShadow(spec);
            IntoTexture into(scene.root, view, target);
            into.camera->frame();
            EXPECT_LE(changed(into.camera->frame(), expected), 150) << spec << target.samples; // along its edges
            EXPECT_EQ(transfer->foundScale, 0.5f) << spec << target.samples;
            EXPECT_EQ(transfer->foundBias, 0.25f) << spec << target.samples;
        }
    }
}

TEST(HostileState, AZoomOfPixelsMovesNoShare) {
    const auto drawn = [](bool zooms) {
        Scene scene = boxScene();
        if (zooms) scene.root->addChild(new PixelZoom);
        scene.addShadow("traced:edges=smooth");
        return render(scene.root, view);
    };
    EXPECT_EQ(changed(drawn(true), drawn(false)), 0);
}

TEST(HostileState, ABinsOwnStateSetCountsAsItDoesOnItsNodes) {
    osg::ref_ptr<osg::Stencil> mark = new osg::Stencil;
    mark->setFunction(osg::Stencil::ALWAYS, 255, ~0u);
    mark->setOperation(osg::Stencil::KEEP, osg::Stencil::KEEP, osg::Stencil::REPLACE);
    const std::vector<osg::ref_ptr<osg::StateAttribute>> states{
        new osg::Depth(osg::Depth::LESS, 0.5, 1.0), new osg::PolygonOffset(8.0f, 800.0f), mark,
        new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE)};
    for (const auto& state : states)
        for (const int bin : {1, 9})
            for (const std::string spec : {"planar", "map", "volume:composite=blend"}) {
                const auto picture = [&](bool ofBin) {
                    osg::ref_ptr<osgUtil::RenderBin> kind = new osgUtil::RenderBin;
                    const osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
                    set->setAttributeAndModes(state, osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
                    if (ofBin) kind->setStateSet(set);
                    osgUtil::RenderBin::addRenderBinPrototype("own", kind);
                    Scene scene = boxScene();
                    if (!ofBin) groundState(scene).merge(*set);
                    groundState(scene).setRenderBinDetails(bin, "own");
                    scene.addShadow(spec);
                    Camera camera(scene.root, view);
                    const Picture result = camera.frame();
                    osgUtil::RenderBin::removeRenderBinPrototype(kind);
                    return result;
                };
                EXPECT_EQ(changed(picture(true), picture(false)), 0) << state->className() << bin << spec;
            }
}

/// As osgSim's light points do, or nodes that place what they draw in the eye's frame.
struct WithoutMatrix : public osg::DrawableCullCallback {
    bool cull(osg::NodeVisitor* visitor, osg::Drawable* drawable, osg::RenderInfo*) const override {
        visitor->asCullVisitor()->addDrawable(drawable, nullptr);
        return true;
    }
};

TEST(HostileState, ALeafWithoutAMatrixReceivesAsOneWithTheIdentity) {
    for (const std::string spec : {"planar", "map", "volume", "traced", "auto"})
        for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, blend}) {
            const auto picture = [&](bool bare, bool shadow = true) {
                Scene scene = boxScene();
                osg::Geode& ground = *find(*scene.root, "ground")->asGeode();
                const osg::ref_ptr<osg::MatrixTransform> inEye = new osg::MatrixTransform;
                inEye->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
                scene.content->addChild(inEye);
                inEye->addChild(&ground);
                scene.content->removeChild(&ground);
                auto& geometry = *ground.getDrawable(0)->asGeometry();
                for (osg::Vec3& vertex : *static_cast<osg::Vec3Array*>(geometry.getVertexArray()))
                    vertex = vertex * view.view;
                for (osg::Vec3& normal : *static_cast<osg::Vec3Array*>(geometry.getNormalArray()))
                    normal = osg::Matrixd::transform3x3(normal, view.view);
                geometry.dirtyBound();
                geometry.setCullingActive(false);
                ground.setCullingActive(false);
                inEye->setCullingActive(false);
                if (bare) geometry.setCullCallback(new WithoutMatrix);
                if (shadow && spec == "planar") scene.addShadow(planar()); // its plane is not the ground's vertices
                if (shadow && spec != "planar") scene.addShadow(spec);
                if (shadow) scene.group->setComposite(composite);
                return render(scene.root, view);
            };
            const Picture expected = picture(false);
            EXPECT_GT(changed(expected, picture(false, false)), 500) << spec << composite;
            EXPECT_EQ(changed(picture(true), expected), 0) << spec << composite;
        }
}

TEST(HostileState, AViewOfIdentifiersIsLeftAsItIs) {
    const std::string data = "void main() { gl_FragColor = vec4(0.8); }",
                      picture = "varying vec3 n; void main() { gl_FragColor = vec4(0.8 * abs(normalize(n).z)); }";
    for (const bool isData : {true, false})
        for (const std::string spec : {"planar", "volume", "map:composite=blend", "volume:composite=blend"}) {
            const auto build = [&](bool shadow) {
                Scene scene = boxScene();
                osg::ref_ptr<osg::Program> program = new osg::Program;
                program->addShader(new osg::Shader(
                    osg::Shader::VERTEX,
                    "varying vec3 n; void main() { n = gl_NormalMatrix * gl_Normal; gl_Position = ftransform(); }"));
                if (isData) program->removeShader(program->getShader(0));
                program->addShader(new osg::Shader(osg::Shader::FRAGMENT, isData ? data : picture));
                scene.root->getOrCreateStateSet()->setAttributeAndModes(program, osg::StateAttribute::ON |
                                                                                     osg::StateAttribute::OVERRIDE);
                if (shadow) scene.addShadow(spec);
                return scene;
            };
            Scene scene = build(true);
            const int darker = changed(render(scene.root, view), render(build(false).root, view));
            const auto* technique =
                dynamic_cast<gnomon::ShadowTechnique*>(scene.group->getChild(scene.group->getNumChildren() - 1));
            const std::vector<std::string> causes = technique->diagnose();
            const bool isTold = std::any_of(causes.begin(), causes.end(), [](const std::string& cause) {
                return cause.find("as programs do that draw identifiers") != std::string::npos;
            });
            EXPECT_EQ(isTold, isData) << spec;
            EXPECT_EQ(darker > 500, !isData) << spec;
            EXPECT_TRUE(darker > 500 || darker == 0) << spec;
        }
}

TEST(HostileState, ALightSourceOfANumberThatOpenGLLacksIsNamed) {
    for (const int number : {-1, 8, 40})
        for (const bool isGiven : {true, false}) { // to the group; else the group finds it
            Scene scene = boxScene();
            osg::ref_ptr<osg::LightSource> odd = new osg::LightSource;
            odd->getLight()->setLightNum(number);
            scene.root->addChild(odd);
            const auto technique = planar();
            scene.addShadow(technique);
            if (isGiven) scene.group->addLight(odd);
            Camera camera(scene.root, view);
            // OpenSceneGraph itself asks OpenGL for that light, and would tell of the error.
            camera.context().graphicsContext()->getState()->setCheckForGLErrors(osg::State::NEVER_CHECK_GL_ERRORS);
            stopListeningToGl(*camera.context().graphicsContext());
            camera.frame();
            ASSERT_EQ(technique->diagnose().size(), 1u) << number << isGiven;
            EXPECT_NE(technique->diagnose()[0].find("light " + std::to_string(number) +
                                                    " is left out, because OpenGL's lights are 0 to 7"),
                      std::string::npos)
                << technique->diagnose()[0];
        }
}

// As hands and cockpits are drawn: their depths do not tell where they are.
TEST(TwoLenses, WhatAProjectionOfItsOwnDrawsIsNamedAndLeftAsItIs) {
    for (const std::string spec : {"planar", "planar:receiver=ground", "map", "volume", "traced"}) {
        const auto build = [](bool apart) {
            Scene scene = boxScene();
            osg::Matrixd wider = view.projection;
            wider(0, 0) *= 0.999; // a tenth of a per cent
            const osg::ref_ptr<osg::Projection> lens = new osg::Projection(wider);
            const osg::ref_ptr<osg::Node> ground = find(*scene.root, "ground");
            if (!apart) return scene;
            scene.content->removeChild(ground);
            scene.content->addChild(lens);
            lens->addChild(ground);
            return scene;
        };
        const auto causesOf = [&](Scene& scene, Picture& picture) {
            scene.addShadow(spec);
            picture = render(scene.root, view);
            return causesButLitSurfaces(
                *dynamic_cast<gnomon::ShadowTechnique*>(scene.group->getChild(scene.group->getNumChildren() - 1)));
        };
        Scene usual = build(false), lit = build(true), scene = build(true);
        Picture picture;
        EXPECT_EQ(causesOf(usual, picture), std::vector<std::string>()) << spec;
        const std::vector<std::string> causes = causesOf(scene, picture);
        ASSERT_EQ(causes.size(), 1u) << spec;
        EXPECT_NE(causes[0].find("'ground' is drawn through a projection of its own"), std::string::npos) << causes[0];
        EXPECT_EQ(changed(picture, render(lit.root, view)), 0) << spec << ": the box is lit where one sees it";
    }
}

// The view's shadow, that of the overlay, and both: none takes the other away.
TEST(TwoLenses, ShadowsOfBothAreBlended) {
    const auto build = [](bool inView, bool inOverlay) {
        Scene below = boxScene(), above = groundScene({box({-1.0, -1.0, 1.0}, {1.0, 1.0, 2.0})}, 3.0);
        if (inView) below.addShadow(planar());
        if (inOverlay) above.addShadow(planar());
        for (Scene* scene : {&below, &above}) {
            if (!scene->group) continue;
            scene->group->setComposite(blend);
            scene->group->addLight({0, osg::Vec4d(1.0, 0.0, 1.0, 0.0)}); // both scenes bring a light of this number
        }
        const osg::ref_ptr<osg::Camera> corner = overlay(above.root);
        corner->setProjectionMatrixAsOrtho(-3.0, 21.0, -3.0, 15.0, 1.0, 100.0); // clear of the view's own shadow
        below.root->addChild(corner);
        return below.root;
    };
    const Picture none = render(build(false, false), view);
    const int first = changed(render(build(true, false), view), none);
    const int second = changed(render(build(false, true), view), none);
    EXPECT_GT(first, 100);
    EXPECT_GT(second, 100);
    EXPECT_EQ(changed(render(build(true, true), view), none), first + second);
}

TEST(TwoLenses, SoftEdgesOfTheViewLeaveWhatIsLaidOverIt) {
    for (const auto& [composite, twoLights] : {std::pair(gnomon::ShadowCasterGroup::RELIGHT, false),
                                               {gnomon::ShadowCasterGroup::RELIGHT, true},
                                               {blend, false}}) {
        Scene scene = boxScene();
        osg::ref_ptr<osg::LightSource> second = new osg::LightSource;
        second->getLight()->setLightNum(1);
        second->getLight()->setPosition({-1.0f, 0.0f, 1.0f, 0.0f});
        second->getLight()->setDiffuse({0.2f, 0.2f, 0.2f, 1.0f});
        scene.root->addChild(second);
        if (twoLights) scene.root->getOrCreateStateSet()->setMode(GL_LIGHT1, osg::StateAttribute::ON);
        osg::ref_ptr<osg::Geode> cover = node(square(2.0), "cover");
        scene.root->addChild(overlay(cover));
        const Picture lit = render(scene.root, view);
        cover->setNodeMask(0);
        const Picture bare = render(scene.root, view);
        cover->setNodeMask(~0u);
        scene.addShadow(disc(30.0, 60.0));
        scene.group->setComposite(composite);
        const Picture shadowed = render(scene.root, view);
        int covered = 0, wrong = 0;
        for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
            if (lit.pixels[i] == bare.pixels[i]) continue;
            ++covered;
            wrong += shadowed.pixels[i] != lit.pixels[i];
        }
        EXPECT_GT(covered, 1000);
        EXPECT_EQ(wrong, 0) << "composite " << composite << ", two lights " << twoLights;
        EXPECT_GT(changed(shadowed, lit), 1000) << "there is a shadow beside it";
    }
}
