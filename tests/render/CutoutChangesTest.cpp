// SPDX-License-Identifier: MIT
// Casters with clear parts that change under a camera and a light that stand still: each picture is what is left then, worked
// out pixel by pixel.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <osg/AlphaFunc>
#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/Notify>
#include <osg/Program>
#include <osg/TexEnv>
#include <osg/TexGen>
#include <osg/TexMat>
#include <osg/Texture2D>
#include <osg/TextureCubeMap>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

using namespace test;
using On = osg::StateAttribute;

namespace {

constexpr const char* program = R"(#pragma import_defines(WHOLE)
uniform sampler2D cut;
void main() {
#ifndef WHOLE
    if (texture2D(cut, gl_TexCoord[0].xy).a * gl_Color.a < 0.5) discard;
#endif
    gl_FragColor = vec4(1.0);
})";

/// Solid on one side.
osg::ref_ptr<osg::Image> halfImage(bool right) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < 2; ++i)
        image->setColor(osg::Vec4(1.0f, 1.0f, 1.0f, (i == 1) == right ? 1.0f : 0.0f), i, 0u);
    return image;
}

osg::ref_ptr<osg::Texture2D> halfTexture(bool right) {
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(halfImage(right));
    for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        texture->setFilter(which, osg::Texture::NEAREST);
    return texture;
}

osg::ref_ptr<osg::Program> fragmentProgram(const std::string& text) {
    osg::ref_ptr<osg::Program> result = new osg::Program;
    result->addShader(new osg::Shader(osg::Shader::FRAGMENT, text));
    return result;
}

/// What is there of the plate at a share of its width.
using Solid = std::function<bool(double s)>;
bool isLeft(double s) { return s < 0.5; }
bool isRight(double s) { return s >= 0.5; }
bool isAll(double) { return true; }
bool isNone(double) { return false; }

/// A plate 2 wide and 3 deep, 1 above a ground. The sun stands low in the east: the shadow lies 3 to the west of it.
struct Plate {
    explicit Plate(gnomon::ShadowTechnique* with = new gnomon::ShadowMapTechnique) : technique(with) {
        geometry->setName("plate");
        geometry->setColorArray(new osg::Vec4Array(1, &white), osg::Array::BIND_OVERALL);
        scene.content->addChild(geometry);
        scene.addShadow(technique);
    }
    osg::StateSet& state() { return *geometry->getOrCreateStateSet(); }
    void testAlpha() { state().setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.5f)); }
    osg::Vec4Array& colors() { return static_cast<osg::Vec4Array&>(*geometry->getColorArray()); }

    /// Pixels of the ground in the next frame that are not as they are to be, but for those beside an edge.
    int wrong(const Solid& solid, double time = 0.0) {
        if (!camera) {
            lit = render(groundScene({}, 8.0, light).root, view);
            camera = std::make_unique<Camera>(scene.root, view);
        }
        camera->viewer().advance(time);
        camera->viewer().eventTraversal();
        camera->viewer().updateTraversal();
        camera->viewer().renderingTraversals();
        const Picture shown = pictureOf(camera->context());
        const auto shadowed = [&](int x, int y) {
            const double east = (x + 0.5) * 9.0 / view.width - 4.5, north = (y + 0.5) * 9.0 / view.height - 4.5;
            const double s = (east + 4.0) / 2.0;
            return s >= 0.0 && s < 1.0 && std::abs(north) < 1.5 && solid(s);
        };
        int found = 0;
        for (int y = 1; y + 1 < view.height; ++y)
            for (int x = 1; x + 1 < view.width / 2 - 16; ++x) { // where the plate does not hide the ground
                bool away = true;
                for (int i = 0; i < 9; ++i) away = away && shadowed(x + i % 3 - 1, y + i / 3 - 1) == shadowed(x, y);
                found += away && (shown.at(x, y) != lit.at(x, y)) != shadowed(x, y);
            }
        return found;
    }

    const osg::Vec4 white{1.0f, 1.0f, 1.0f, 1.0f};
    const osg::Vec4d light{3.0, 0.0, 1.0, 0.0};
    const View view = fromAbove(4.5, 128);
    Scene scene = groundScene({}, 8.0, light);
    osg::ref_ptr<osg::Geometry> geometry = osg::createTexturedQuadGeometry(
        osg::Vec3(-1.0f, -1.5f, 1.0f), osg::Vec3(2.0f, 0.0f, 0.0f), osg::Vec3(0.0f, 3.0f, 0.0f));
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    Picture lit;
    std::unique_ptr<Camera> camera;
};

std::vector<osg::ref_ptr<gnomon::ShadowTechnique>> mapAndAuto() {
    return {new gnomon::ShadowMapTechnique, new gnomon::AutoShadowTechnique};
}

/// Fills a texture by itself, as streams do.
class Filling : public osg::Texture2D::SubloadCallback {
public:
    void load(const osg::Texture2D&, osg::State&) const override { fill(); }
    void subload(const osg::Texture2D&, osg::State&) const override { fill(); }
    bool right = false;

private:
    void fill() const {
        const osg::ref_ptr<osg::Image> image = halfImage(right);
        glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, image->data());
    }
};

} // namespace

TEST(CutoutChanges, OfWhatAProgramReadsAreSeenInTheNextFrame) {
    Plate plate;
    const osg::ref_ptr<osg::Program> cutting = fragmentProgram(program);
    plate.state().setAttributeAndModes(cutting);
    plate.state().addUniform(new osg::Uniform("cut", 0));
    plate.state().setTextureAttributeAndModes(0, halfTexture(false));
    EXPECT_EQ(plate.wrong(isLeft), 0);
    const osg::ref_ptr<osg::Texture2D> other = halfTexture(true);
    plate.state().setTextureAttributeAndModes(0, other);
    EXPECT_EQ(plate.wrong(isRight), 0) << "another texture";
    other->setImage(halfImage(false));
    EXPECT_EQ(plate.wrong(isLeft), 0) << "another image";
    other->getImage()->setColor(plate.white, 1u, 0u);
    other->getImage()->dirty();
    EXPECT_EQ(plate.wrong(isAll), 0) << "an image that is edited";
    other->setImage(halfImage(true));
    const osg::ref_ptr<osg::TexMat> matrix = new osg::TexMat;
    plate.state().setTextureAttribute(0, matrix);
    EXPECT_EQ(plate.wrong(isRight), 0);
    matrix->setMatrix(osg::Matrixd::translate(0.5, 0.0, 0.0));
    other->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    EXPECT_EQ(plate.wrong(isLeft), 0) << "a texture matrix, and another wrap";
    plate.state().setDefine("WHOLE");
    EXPECT_EQ(plate.wrong(isAll), 0) << "a define";
    plate.state().removeDefine("WHOLE");
    EXPECT_EQ(plate.wrong(isLeft), 0);
    cutting->getShader(0)->setShaderSource(
        "void main() { if (gl_TexCoord[0].x > 2.0) discard; gl_FragColor = vec4(1.0); }");
    EXPECT_EQ(plate.wrong(isAll), 0) << "another text";
}

TEST(CutoutChanges, OfColoursUnderAProgramAreSeenInTheNextFrame) {
    Plate plate;
    plate.state().setAttributeAndModes(
        fragmentProgram("void main() { if (gl_Color.a < 0.5) discard; gl_FragColor = vec4(1.0); }"));
    plate.state().setMode(GL_LIGHTING, On::OFF);
    EXPECT_EQ(plate.wrong(isAll), 0);
    plate.colors()[0].a() = 0.0f;
    plate.colors().dirty();
    plate.geometry->dirtyGLObjects(); // its list
    EXPECT_EQ(plate.wrong(isNone), 0) << "a colour array";
    plate.state().setMode(GL_LIGHTING, On::ON);
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    plate.state().setAttribute(material);
    EXPECT_EQ(plate.wrong(isAll), 0) << "lit";
    material->setAlpha(osg::Material::FRONT_AND_BACK, 0.0f);
    EXPECT_EQ(plate.wrong(isNone), 0) << "a material";
}

TEST(CutoutChanges, ByAClockAreSeenInEveryFrame) {
    for (const osg::ref_ptr<gnomon::ShadowTechnique>& technique : mapAndAuto()) {
        Plate plate(technique);
        plate.state().setAttributeAndModes(fragmentProgram(
            "uniform float osg_SimulationTime; void main() { if (gl_TexCoord[0].x > osg_SimulationTime) "
            "discard; gl_FragColor = vec4(1.0); }"));
        for (const double time : {0.25, 0.5, 0.75, 0.5})
            EXPECT_EQ(plate.wrong([time](double s) { return s < time; }, time), 0) << time;
    }
}

/// Half of it by a pattern of the picture's pixels, of which the map has others: its shadow would be a pattern, too, that crawls.
TEST(CutoutChanges, ByThePicturesPixelsCastNothingButAllOfItAndAreNamed) {
    for (const osg::ref_ptr<gnomon::ShadowTechnique>& technique : mapAndAuto()) {
        Plate plate(technique);
        plate.state().setAttributeAndModes(fragmentProgram(
            "void main() { if (mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0) > 0.5) discard; gl_FragColor = "
            "vec4(1.0); }"));
        EXPECT_EQ(plate.wrong(isAll), 0);
        const std::vector<std::string> causes = plate.technique->diagnose();
        EXPECT_TRUE(std::any_of(causes.begin(), causes.end(), [](const std::string& cause) {
            return cause.find("what discards by gl_FragCoord, or has a projection of its own") != std::string::npos &&
                   cause.find("the first in 'plate'") != std::string::npos;
        }));
    }
}

TEST(CutoutChanges, OnASecondUnitAreSeenInTheNextFrame) {
    Plate plate;
    plate.testAlpha();
    plate.geometry->setTexCoordArray(1, plate.geometry->getTexCoordArray(0), osg::Array::BIND_PER_VERTEX);
    plate.state().setTextureAttributeAndModes(1, halfTexture(false));
    EXPECT_EQ(plate.wrong(isLeft), 0);
    plate.state().setTextureAttributeAndModes(1, halfTexture(true));
    EXPECT_EQ(plate.wrong(isRight), 0) << "another texture";
    plate.state().setTextureMode(1, GL_TEXTURE_2D, On::OFF);
    plate.state().setTextureAttributeAndModes(0, halfTexture(false));
    const osg::ref_ptr<osg::TexGen> generator = new osg::TexGen;
    generator->setPlane(osg::TexGen::S, osg::Plane(0.5, 0.0, 0.0, 0.5));
    plate.state().setTextureAttributeAndModes(0, generator);
    EXPECT_EQ(plate.wrong(isLeft), 0) << "generated coordinates";
    generator->setPlane(osg::TexGen::S, osg::Plane(-0.5, 0.0, 0.0, 0.5));
    EXPECT_EQ(plate.wrong(isRight), 0) << "another plane";
}

TEST(CutoutChanges, OfAnImageThatIsLetGoWhenDrawnAreSeenInTheNextFrame) {
    for (const bool programmed : {false, true}) {
        Plate plate;
        if (programmed)
            plate.state().setAttributeAndModes(fragmentProgram(program));
        else
            plate.testAlpha();
        const osg::ref_ptr<osg::Texture2D> texture = halfTexture(false);
        texture->setUnRefImageDataAfterApply(true);
        plate.state().setTextureAttributeAndModes(0, texture);
        EXPECT_EQ(plate.wrong(isLeft), 0);
        ASSERT_FALSE(texture->getImage());
        texture->setImage(halfImage(true)); // mostly at the address of the one before
        EXPECT_EQ(plate.wrong(isRight), 0);
        for (int frame = 0; frame < 8; ++frame) EXPECT_EQ(plate.wrong(isRight), 0); // maps are drawn once more at rest
        const unsigned passes = static_cast<gnomon::ShadowMapTechnique&>(*plate.technique).passes();
        EXPECT_EQ(plate.wrong(isRight), 0);
        EXPECT_EQ(plate.wrong(isRight), 0);
        EXPECT_EQ(static_cast<gnomon::ShadowMapTechnique&>(*plate.technique).passes(), passes) << "it stands still";
        texture->setImage(halfImage(false));
        EXPECT_EQ(plate.wrong(isLeft), 0);
    }
}

TEST(CutoutChanges, OfATextureThatACallbackFillsAreSeenInEveryFrame) {
    Plate plate;
    plate.testAlpha();
    const osg::ref_ptr<osg::Texture2D> texture = halfTexture(false);
    texture->setImage(nullptr);
    const osg::ref_ptr<Filling> filling = new Filling;
    texture->setSubloadCallback(filling);
    EXPECT_EQ(plate.wrong(isAll), 0); // so that nothing of the texture is compiled before its first frame
    plate.state().setTextureAttributeAndModes(0, texture);
    EXPECT_EQ(plate.wrong(isLeft), 0);
    filling->right = true;
    EXPECT_EQ(plate.wrong(isRight), 0);
}

namespace {

/// A camera that fills it with its clear colour.
osg::ref_ptr<osg::Camera> cameraInto(osg::Texture2D& texture) {
    osg::ref_ptr<osg::Camera> into = new osg::Camera;
    into->setRenderOrder(osg::Camera::PRE_RENDER);
    into->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
    into->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
    into->setViewport(0, 0, 16, 16);
    into->attach(osg::Camera::COLOR_BUFFER, &texture);
    return into;
}

} // namespace

TEST(CutoutChanges, OfATextureThatIsRenderedToAreSeenInEveryFrame) {
    Plate plate;
    plate.testAlpha();
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D;
    texture->setTextureSize(16, 16);
    texture->setInternalFormat(GL_RGBA);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    const osg::ref_ptr<osg::Camera> into = cameraInto(*texture);
    EXPECT_EQ(plate.wrong(isAll), 0); // so that nothing of the texture is compiled before its first frame
    plate.scene.root->addChild(into);
    plate.state().setTextureAttributeAndModes(0, texture);
    for (int i = 0; i < 3; ++i) {
        into->setClearColor(osg::Vec4(1.0f, 1.0f, 1.0f, float(i % 2)));
        EXPECT_EQ(plate.wrong(i % 2 ? isAll : isNone), 0);
    }
}

// As where a file was not found. OpenGL draws without it; nothing changes, so nothing is drawn again.
TEST(CutoutChanges, OfATextureThatHoldsNothingAreNone) {
    const osg::ref_ptr<osg::Image> noData = new osg::Image;
    for (const bool programmed : {false, true})
        for (const osg::ref_ptr<osg::Image>& image : {osg::ref_ptr<osg::Image>(), noData}) {
            const osg::ref_ptr<gnomon::ShadowMapTechnique> map = new gnomon::ShadowMapTechnique;
            Plate plate(map);
            if (programmed)
                plate.state().setAttribute(fragmentProgram(program));
            else
                plate.testAlpha();
            const osg::ref_ptr<osg::Texture2D> texture = halfTexture(false);
            texture->setImage(image);
            plate.state().setTextureAttributeAndModes(0, texture);
            for (int frame = 0; frame < 8; ++frame) EXPECT_EQ(plate.wrong(isAll), 0);
            const unsigned passes = map->passes();
            EXPECT_EQ(plate.wrong(isAll), 0);
            EXPECT_EQ(plate.wrong(isAll), 0);
            EXPECT_EQ(map->passes(), passes) << "it stands still";
            if (!programmed) EXPECT_EQ(map->diagnose(), std::vector<std::string>());
            texture->setImage(halfImage(false));
            EXPECT_EQ(plate.wrong(isLeft), 0);
        }
}

// OpenSceneGraph gives it the size of the camera's viewport in the first frame.
TEST(CutoutChanges, OfATextureWithoutASizeThatIsRenderedToAreSeenInEveryFrame) {
    for (const bool programmed : {false, true}) {
        Plate plate;
        if (programmed)
            plate.state().setAttribute(fragmentProgram(program));
        else
            plate.testAlpha();
        const osg::ref_ptr<osg::Texture2D> texture = halfTexture(false);
        texture->setImage(nullptr);
        texture->setInternalFormat(GL_RGBA);
        const osg::ref_ptr<osg::Camera> into = cameraInto(*texture);
        into->setClearColor(osg::Vec4(1.0f, 1.0f, 1.0f, 1.0f));
        plate.scene.root->addChild(into);
        plate.state().setTextureAttributeAndModes(0, texture);
        EXPECT_EQ(plate.wrong(isAll), 0);
        EXPECT_EQ(plate.wrong(isAll), 0);
        into->setClearColor(osg::Vec4(1.0f, 1.0f, 1.0f, 0.0f));
        EXPECT_EQ(plate.wrong(isNone), 0);
    }
}

TEST(CutoutChanges, OfATextureThatHoldsNothingAreNoneToVolumesEither) {
    for (const osg::ref_ptr<osg::Image>& image :
         {osg::ref_ptr<osg::Image>(), osg::ref_ptr<osg::Image>(new osg::Image)}) {
        Plate plate(new gnomon::ShadowVolumeTechnique);
        plate.testAlpha();
        plate.state().setTextureAttributeAndModes(0, new osg::Texture2D(image));
        EXPECT_EQ(plate.wrong(isAll), 0);
        EXPECT_EQ(plate.technique->diagnose(), std::vector<std::string>());
    }
}

TEST(CutoutChanges, OfATextureThatOpenGlHoldsThoughItHasNoImageStay) {
    Plate plate;
    plate.testAlpha();
    const osg::ref_ptr<osg::Texture2D> texture = halfTexture(false);
    plate.state().setTextureAttributeAndModes(0, texture);
    EXPECT_EQ(plate.wrong(isLeft), 0);
    texture->setImage(nullptr);
    texture->setTextureSize(0, 0);
    EXPECT_EQ(plate.wrong(isLeft), 0);
}

TEST(CutoutChanges, OfATextureWithoutImagesMakeOpenSceneGraphSayNothing) {
    struct Listener : osg::NotifyHandler {
        void notify(osg::NotifySeverity, const char* text) override { heard += text; }
        std::string heard;
    };
    for (const osg::ref_ptr<osg::Texture>& texture :
         {osg::ref_ptr<osg::Texture>(new osg::Texture2D), osg::ref_ptr<osg::Texture>(new osg::TextureCubeMap)}) {
        Plate plate;
        plate.testAlpha();
        plate.state().setTextureAttributeAndModes(0, texture);
        const osg::ref_ptr<osg::NotifyHandler> before = osg::getNotifyHandler();
        const osg::ref_ptr<Listener> listener = new Listener;
        osg::setNotifyHandler(listener);
        EXPECT_EQ(plate.wrong(isAll), 0);
        osg::setNotifyHandler(before);
        EXPECT_EQ(listener->heard.find("pixelFormat"), std::string::npos) << listener->heard;
    }
}
