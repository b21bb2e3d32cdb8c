// SPDX-License-Identifier: MIT
// Whatever states receivers have, alone or beside others: a lit pixel keeps every bit, a shadowed one loses just its
// light.
#include "ReceiverCases.h"

#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/ClipNode>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/Fog>
#include <osg/FrontFace>
#include <osg/LightModel>
#include <osg/LogicOp>
#include <osg/Material>
#include <osg/MatrixTransform>
#include <osg/PolygonOffset>
#include <osg/Scissor>
#include <osg/ShadeModel>
#include <osg/TexEnv>
#include <osg/TexGen>
#include <osg/Texture2D>

using namespace test;

namespace {

using A = osg::StateAttribute;
constexpr auto bothFaces = osg::Material::FRONT_AND_BACK;

osg::Geometry& geometry(osg::Geode& geode) { return *geode.getDrawable(0)->asGeometry(); }
osg::StateSet& stateOf(osg::Node& node) { return *node.getOrCreateStateSet(); }

osg::ref_ptr<osg::Texture2D> texels(int seed, GLenum format = GL_RGB) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(8, 8, 1, format, GL_UNSIGNED_BYTE);
    for (unsigned i = 0; i < image->getTotalSizeInBytes(); ++i)
        image->data()[i] = static_cast<unsigned char>(40 + (i * 37 + static_cast<unsigned>(seed)) % 200);
    osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
    texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
    return texture;
}

void texture(osg::Geode& receiver, unsigned unit, float size, GLenum format = GL_RGB) {
    osg::ref_ptr<osg::Vec2Array> coordinates = new osg::Vec2Array;
    for (const osg::Vec3& v : *static_cast<osg::Vec3Array*>(geometry(receiver).getVertexArray()))
        coordinates->push_back(osg::Vec2(v.x(), v.y()) / size);
    geometry(receiver).setTexCoordArray(unit, coordinates);
    stateOf(receiver).setTextureAttributeAndModes(unit, texels(static_cast<int>(unit) * 11, format));
}

osg::ref_ptr<osg::Material> material(const osg::Vec4& ambient, const osg::Vec4& diffuse) {
    osg::ref_ptr<osg::Material> result = new osg::Material;
    result->setAmbient(bothFaces, ambient);
    result->setDiffuse(bothFaces, diffuse);
    return result;
}

osg::ref_ptr<osg::Material> shiny(float shininess) {
    const auto result = material({0.5f, 0.5f, 0.5f, 1.0f}, {0.5f, 0.4f, 0.3f, 1.0f});
    result->setSpecular(bothFaces, {0.8f, 0.9f, 1.0f, 1.0f});
    result->setShininess(bothFaces, shininess);
    return result;
}

void textured(TwoReceivers& scene) { texture(*scene.right, 0, 1.5f); }

void multiTextured(TwoReceivers& scene) {
    texture(*scene.left, 0, 3.0f);
    texture(*scene.right, 0, 1.5f);
    texture(*scene.right, 1, 4.0f);
    stateOf(*scene.right).setTextureAttributeAndModes(1, new osg::TexEnv(osg::TexEnv::ADD));
}

/// Texture coordinates from eye space: they depend on the modelview under which the attribute is applied.
void textureFromEyeSpace(TwoReceivers& scene) {
    osg::ref_ptr<osg::TexGen> generated = new osg::TexGen;
    generated->setMode(osg::TexGen::EYE_LINEAR);
    stateOf(*scene.right).setTextureAttributeAndModes(0, texels(5));
    stateOf(*scene.right).setTextureAttributeAndModes(0, generated);
}

void vertexColoured(TwoReceivers& scene) {
    osg::Geometry& left = geometry(*scene.left);
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array;
    for (unsigned i = 0; i < left.getVertexArray()->getNumElements(); ++i) {
        const auto share = [i](unsigned factor) { return static_cast<float>(i * factor % 13) / 13.0f; };
        colors->push_back({share(3), share(5), share(7), 1.0f});
    }
    left.setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    const auto tracking = material({1.0f, 1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 1.0f, 1.0f});
    tracking->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    stateOf(*scene.left).setAttributeAndModes(tracking);
}

void shineSpecularly(TwoReceivers& scene) {
    scene.light->getLight()->setSpecular({0.9f, 0.8f, 0.7f, 1.0f});
    stateOf(*scene.left).setAttributeAndModes(shiny(6.0f));
    stateOf(*scene.right).setAttributeAndModes(shiny(12.0f));
}

osg::ref_ptr<osg::LightModel> lightModel(float ambient) {
    osg::ref_ptr<osg::LightModel> model = new osg::LightModel;
    model->setAmbientIntensity({ambient, ambient, ambient / 2.0f, 1.0f});
    return model;
}

void separateSpecular(TwoReceivers& scene) {
    shineSpecularly(scene);
    texture(*scene.right, 0, 2.0f);
    const auto model = lightModel(0.1f);
    model->setColorControl(osg::LightModel::SEPARATE_SPECULAR_COLOR);
    stateOf(*scene.right).setAttributeAndModes(model);
}

void localViewer(TwoReceivers& scene) {
    shineSpecularly(scene);
    const auto model = lightModel(0.1f);
    model->setLocalViewer(true);
    stateOf(*scene.left).setAttributeAndModes(model);
}

void ambientOfItsOwn(TwoReceivers& scene) { stateOf(*scene.right).setAttributeAndModes(lightModel(0.35f)); }

/// The right one shows its back, whose normals look down: OpenGL turns them, and takes the back's material.
void twoSided(TwoReceivers& scene) {
    osg::Geometry& right = geometry(*scene.right);
    auto& corners = *static_cast<osg::Vec3Array*>(right.getVertexArray());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3) std::swap(corners[i], corners[i + 1]);
    for (osg::Vec3& normal : *static_cast<osg::Vec3Array*>(right.getNormalArray())) normal = -normal;
    const auto both = material({1.0f, 1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 1.0f, 1.0f});
    both->setDiffuse(osg::Material::BACK, {0.2f, 0.8f, 0.4f, 1.0f});
    stateOf(*scene.right).setAttributeAndModes(both);
    const auto model = lightModel(0.1f);
    model->setTwoSided(true);
    stateOf(*scene.receivers).setAttributeAndModes(model);
}

void lightForcedOn(TwoReceivers& scene) {
    stateOf(*scene.right).setMode(GL_LIGHT0, A::ON | A::OVERRIDE | A::PROTECTED);
}

void lightingForcedOn(TwoReceivers& scene) {
    stateOf(*scene.left).setMode(GL_LIGHTING, A::ON | A::OVERRIDE | A::PROTECTED);
    lightForcedOn(scene);
}

/// All but the receivers are unlit.
void lightingOnlyHere(TwoReceivers& scene) {
    stateOf(*scene.root).setMode(GL_LIGHTING, A::OFF);
    stateOf(*scene.receivers).setMode(GL_LIGHTING, A::ON);
}

void otherLightOff(TwoReceivers& scene) { stateOf(*scene.left).setMode(GL_LIGHT1, A::OFF); }

void emitting(TwoReceivers& scene) {
    const auto glowing = material({1.0f, 1.0f, 1.0f, 1.0f}, {0.5f, 0.5f, 0.5f, 1.0f});
    glowing->setEmission(bothFaces, {0.2f, 0.1f, 0.3f, 1.0f});
    stateOf(*scene.right).setAttributeAndModes(glowing);
}

/// So bright that colours saturate in the light.
void saturating(TwoReceivers& scene) {
    scene.light->getLight()->setDiffuse({4.0f, 2.0f, 1.0f, 1.0f});
    texture(*scene.right, 0, 2.0f);
}

/// A pixel that the texture's alpha opens shows the background.
void alphaTested(TwoReceivers& scene) {
    texture(*scene.right, 0, 6.0f, GL_RGBA);
    stateOf(*scene.right).setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::GREATER, 0.4f));
}

void inVertexBuffers(TwoReceivers& scene) {
    for (osg::Geode* each : {scene.left.get(), scene.right.get()}) {
        geometry(*each).setUseDisplayList(false);
        geometry(*each).setUseVertexBufferObjects(true);
    }
}

void inClientArrays(TwoReceivers& scene) {
    for (osg::Geode* each : {scene.left.get(), scene.right.get()}) {
        geometry(*each).setUseDisplayList(false);
        geometry(*each).setUseVertexBufferObjects(false);
    }
}

void inListAndBuffer(TwoReceivers& scene) {
    vertexColoured(scene);
    geometry(*scene.right).setUseDisplayList(false);
    geometry(*scene.right).setUseVertexBufferObjects(true);
}

void foggy(TwoReceivers& scene) {
    osg::ref_ptr<osg::Fog> fog = new osg::Fog;
    fog->setMode(osg::Fog::EXP2);
    fog->setDensity(0.05f);
    fog->setColor({0.6f, 0.7f, 0.8f, 1.0f});
    stateOf(*scene.right).setAttributeAndModes(fog);
}

void logicOp(TwoReceivers& scene) { stateOf(*scene.right).setAttributeAndModes(new osg::LogicOp(osg::LogicOp::XOR)); }

void culled(TwoReceivers& scene) {
    stateOf(*scene.left).setAttributeAndModes(new osg::CullFace(osg::CullFace::BACK));
    stateOf(*scene.right).setAttributeAndModes(new osg::FrontFace(osg::FrontFace::CLOCKWISE));
    stateOf(*scene.right).setAttributeAndModes(new osg::CullFace(osg::CullFace::FRONT));
}

void flatShaded(TwoReceivers& scene) {
    shineSpecularly(scene);
    stateOf(*scene.left).setAttributeAndModes(new osg::ShadeModel(osg::ShadeModel::FLAT));
}

void maskedChannels(TwoReceivers& scene) {
    stateOf(*scene.right).setAttributeAndModes(new osg::ColorMask(true, false, true, true));
}

osg::ref_ptr<osg::ClipNode> clipBy(const osg::Vec4d& plane) {
    osg::ref_ptr<osg::ClipNode> node = new osg::ClipNode;
    node->addClipPlane(new osg::ClipPlane(0, plane));
    return node;
}

/// The plane would take all of the left one away.
void clipped(TwoReceivers& scene) {
    const auto clip = clipBy({1.0, 0.0, 0.0, -0.5});
    scene.receivers->replaceChild(scene.right, clip);
    clip->addChild(scene.right);
}

/// On both receivers, coplanar with them: offset towards the eye, without depth of its own.
osg::StateSet& addDecal(TwoReceivers& scene) {
    const osg::ref_ptr<osg::Geode> decal = node(moved(square(2.5), {0.0, -2.0, 0.0}), "decal");
    scene.receivers->addChild(decal);
    osg::StateSet& state = stateOf(*decal);
    state.setAttributeAndModes(material({0.2f, 0.6f, 0.1f, 1.0f}, {0.3f, 0.9f, 0.2f, 1.0f}));
    state.setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
    state.setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    return state;
}

void underDecal(TwoReceivers& scene) { addDecal(scene); }

void underDecalOfAnotherBin(TwoReceivers& scene) { addDecal(scene).setRenderBinDetails(3, "RenderBin"); }

void underGlowingDecal(TwoReceivers& scene) {
    osg::StateSet& state = addDecal(scene);
    state.setAttributeAndModes(new osg::BlendFunc(osg::BlendFunc::ONE, osg::BlendFunc::ONE));
    state.setRenderBinDetails(3, "RenderBin");
}

void inSeveralBins(TwoReceivers& scene) {
    stateOf(*scene.left).setRenderBinDetails(-1, "RenderBin");
    stateOf(*scene.right).setRenderBinDetails(5, "DepthSortedBin");
}

void inNestedBins(TwoReceivers& scene) {
    stateOf(*scene.receivers).setRenderBinDetails(4, "RenderBin");
    stateOf(*scene.right).setRenderBinDetails(-2, "DepthSortedBin");
}

/// The right one has no colours of its own, and takes what was drawn with before.
void colouredByOthers(TwoReceivers& scene) {
    static_cast<osg::Vec4Array*>(geometry(*scene.left).getColorArray())->front() = {0.2f, 0.5f, 0.8f, 1.0f};
    static_cast<osg::Vec4Array*>(geometry(*scene.screen).getColorArray())->front() = {1.0f, 0.0f, 0.0f, 1.0f};
    geometry(*scene.right).setColorArray(nullptr);
    const auto tracking = material({1.0f, 1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 1.0f, 1.0f});
    tracking->setColorMode(osg::Material::AMBIENT_AND_DIFFUSE);
    stateOf(*scene.right).setAttributeAndModes(tracking);
}

void clippedWithAllElse(TwoReceivers& scene) {
    const auto clip = clipBy({-1.0, 0.0, 0.0, 6.5});
    const osg::ref_ptr<osg::Group> all = scene.content;
    scene.root->replaceChild(all, clip);
    clip->addChild(all);
    scene.content = clip;
}

void scissored(TwoReceivers& scene) { stateOf(*scene.right).setAttributeAndModes(new osg::Scissor(20, 10, 110, 95)); }

/// The left one protects its material; the right one's yields to what stands above it.
void overridden(TwoReceivers& scene) {
    const osg::Vec4 white(1.0f, 1.0f, 1.0f, 1.0f);
    stateOf(*scene.receivers).setAttributeAndModes(material(white, {0.3f, 0.9f, 0.3f, 1.0f}), A::ON | A::OVERRIDE);
    stateOf(*scene.left).setAttributeAndModes(material(white, {0.9f, 0.3f, 0.3f, 1.0f}), A::ON | A::PROTECTED);
    stateOf(*scene.right).setAttributeAndModes(material(white, {0.3f, 0.3f, 0.9f, 1.0f}), A::ON | A::OVERRIDE);
    stateOf(*scene.receivers).setMode(GL_LIGHT1, A::OFF | A::OVERRIDE);
    stateOf(*scene.right).setMode(GL_LIGHT1, A::ON | A::PROTECTED);
}

/// State sets on the way down and on the drawable itself.
void nested(TwoReceivers& scene) {
    foggy(scene);
    osg::ref_ptr<osg::Group> between = new osg::Group;
    scene.receivers->replaceChild(scene.right, between);
    between->addChild(scene.right);
    stateOf(*between).setAttributeAndModes(shiny(3.0f));
    geometry(*scene.right).getOrCreateStateSet()->setAttributeAndModes(lightModel(0.3f));
}

void scaledReceiver(TwoReceivers& scene) {
    osg::ref_ptr<osg::MatrixTransform> transform = new osg::MatrixTransform(osg::Matrixd::scale(2.0, 0.5, 4.0));
    for (osg::Vec3& v : *static_cast<osg::Vec3Array*>(geometry(*scene.right).getVertexArray()))
        v = {v.x() / 2.0f, v.y() * 2.0f, v.z() / 4.0f};
    scene.receivers->replaceChild(scene.right, transform);
    transform->addChild(scene.right);
    stateOf(*transform).setMode(GL_NORMALIZE, A::ON);
}

void depthRange(TwoReceivers& scene) {
    stateOf(*scene.right).setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.1, 1.0));
}

void depthLessOrEqual(TwoReceivers& scene) {
    stateOf(*scene.right).setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL));
}

void offsetBack(TwoReceivers& scene) { stateOf(*scene.right).setAttributeAndModes(new osg::PolygonOffset(1.0f, 1.0f)); }

void offsetForward(TwoReceivers& scene) {
    stateOf(*scene.right).setAttributeAndModes(new osg::PolygonOffset(-2.0f, -20.0f));
}

void offsetBoth(TwoReceivers& scene) {
    stateOf(*scene.receivers).setAttributeAndModes(new osg::PolygonOffset(1.0f, 1.0f));
}

class ReceiverStates : public testing::TestWithParam<ReceiverParam> {};

} // namespace

TEST_P(ReceiverStates, LitPixelsKeepEveryBitAndShadowedOnesLoseJustThisLight) { expectExact(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    Shading, ReceiverStates,
    testing::Combine(testing::Values(ReceiverCase{"Textured", textured}, ReceiverCase{"MultiTextured", multiTextured},
                                     ReceiverCase{"TextureFromEyeSpace", textureFromEyeSpace},
                                     ReceiverCase{"VertexColoured", vertexColoured},
                                     ReceiverCase{"Specular", shineSpecularly},
                                     ReceiverCase{"SpecularUnderALamp", shineSpecularly, true},
                                     ReceiverCase{"SeparateSpecularColour", separateSpecular},
                                     ReceiverCase{"LocalViewer", localViewer},
                                     ReceiverCase{"AmbientOfItsOwn", ambientOfItsOwn},
                                     ReceiverCase{"TwoSided", twoSided}, ReceiverCase{"Emitting", emitting},
                                     ReceiverCase{"Saturating", saturating}, ReceiverCase{"Foggy", foggy},
                                     ReceiverCase{"FlatShaded", flatShaded}),
                     testing::Values(0, 1)),
    caseName);

INSTANTIATE_TEST_SUITE_P(Modes, ReceiverStates,
                         testing::Combine(testing::Values(ReceiverCase{"LightForcedOn", lightForcedOn},
                                                          ReceiverCase{"LightingForcedOn", lightingForcedOn},
                                                          ReceiverCase{"LightingOnlyHere", lightingOnlyHere},
                                                          ReceiverCase{"OtherLightOff", otherLightOff},
                                                          ReceiverCase{"Overridden", overridden},
                                                          ReceiverCase{"Nested", nested},
                                                          ReceiverCase{"ScaledReceiver", scaledReceiver}),
                                          testing::Values(0, 1)),
                         caseName);

INSTANTIATE_TEST_SUITE_P(
    Pixels, ReceiverStates,
    testing::Combine(testing::Values(ReceiverCase{"AlphaTested", alphaTested}, ReceiverCase{"LogicOp", logicOp},
                                     ReceiverCase{"Culled", culled}, ReceiverCase{"MaskedChannels", maskedChannels},
                                     ReceiverCase{"Clipped", clipped}, ReceiverCase{"Scissored", scissored},
                                     ReceiverCase{"DepthLessOrEqual", depthLessOrEqual},
                                     ReceiverCase{"DepthRange", depthRange, false, false},
                                     ReceiverCase{"OffsetBack", offsetBack, false, false},
                                     ReceiverCase{"OffsetForward", offsetForward, false, false},
                                     ReceiverCase{"OffsetBoth", offsetBoth, false, false}),
                     testing::Values(0, 1)),
    caseName);

INSTANTIATE_TEST_SUITE_P(Order, ReceiverStates,
                         testing::Combine(testing::Values(ReceiverCase{"UnderDecal", underDecal},
                                                          ReceiverCase{"UnderDecalOfAnotherBin",
                                                                       underDecalOfAnotherBin},
                                                          ReceiverCase{"UnderGlowingDecal", underGlowingDecal},
                                                          ReceiverCase{"InSeveralBins", inSeveralBins},
                                                          ReceiverCase{"InNestedBins", inNestedBins},
                                                          ReceiverCase{"ColouredByOthers", colouredByOthers},
                                                          ReceiverCase{"ClippedWithAllElse", clippedWithAllElse}),
                                          testing::Values(0, 1)),
                         caseName);

INSTANTIATE_TEST_SUITE_P(Arrays, ReceiverStates,
                         testing::Combine(testing::Values(ReceiverCase{"InVertexBuffers", inVertexBuffers},
                                                          ReceiverCase{"InClientArrays", inClientArrays},
                                                          ReceiverCase{"InListAndBuffer", inListAndBuffer}),
                                          testing::Values(0, 1)),
                         caseName);
