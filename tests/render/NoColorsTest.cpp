// SPDX-License-Identifier: MIT
// Things without colours and materials of their own take what OpenGL has left from before: in the first drawing and, so
// that only the light is missing, in the one without it.
#include <support/Oracle.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gnomon/ShadowMapTechnique.h>
#include <gtest/gtest.h>
#include <osg/Material>

#include <functional>

using namespace test;

namespace {

const View slanted = perspective({-6.0, -9.0, 6.0}, {0.0, 0.5, 0.0}, 160, 120);
const std::vector<Mesh> casters = {house({0.0, 0.0}, {2.0, 1.5, 1.0}, 30.0), box({-2.5, 1.0, 0.0}, {-1.5, 2.0, 1.5})};
const osg::Vec4d sun(1.0, 0.4, 1.2, 0.0);

osg::ref_ptr<osg::Material> material(float ambient) {
    osg::ref_ptr<osg::Material> result = new osg::Material;
    result->setAmbient(osg::Material::FRONT_AND_BACK, {ambient, ambient, ambient, 1.0f});
    return result;
}

/// As osgteapot's: OpenGL alone knows it, and it sets no colour; or as osgText's: it sets one.
class OwnBody : public osg::Drawable {
public:
    explicit OwnBody(const osg::Geometry& geometry, bool colored = false) : _geometry(&geometry), _colored(colored) {}
    OwnBody() = default;
    OwnBody(const OwnBody& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : osg::Drawable(other, copyOp), _geometry(other._geometry), _colored(other._colored) {}
    META_Object(test, OwnBody)

    void drawImplementation(osg::RenderInfo&) const override {
        const auto& vertices = static_cast<const osg::Vec3Array&>(*_geometry->getVertexArray());
        const auto& normals = static_cast<const osg::Vec3Array&>(*_geometry->getNormalArray());
        if (_colored) glColor3f(0.2f, 0.7f, 0.3f);
        glBegin(GL_TRIANGLES);
        for (unsigned i = 0; i < vertices.size(); ++i) {
            glNormal3fv(normals[i].ptr());
            glVertex3fv(vertices[i].ptr());
        }
        glEnd();
    }
    osg::BoundingBox computeBoundingBox() const override { return _geometry->getBoundingBox(); }

protected:
    ~OwnBody() override = default;

private:
    osg::ref_ptr<const osg::Geometry> _geometry;
    bool _colored = false;
};

struct Case {
    std::string name;
    std::function<void(Scene&)> change;
    bool byMap = false; ///< instead of by planar, which casts what it can read.
};
std::ostream& operator<<(std::ostream& out, const Case& given) { return out << given.name; }

osg::Node& childOf(Scene& scene, unsigned i) { return *scene.content->getChild(i); }

void paint(osg::Node& node, const osg::Vec4& color = {0.2f, 0.7f, 0.3f, 1.0f}) {
    osg::ref_ptr<osg::Vec4Array> overall = new osg::Vec4Array(1, &color);
    node.asGeode()->getDrawable(0)->asGeometry()->setColorArray(overall, osg::Array::BIND_OVERALL);
}

/// As osg::ShapeDrawable does: the colour is that of osg::Material.
void paintAllAsMaterials(Scene& scene) {
    for (unsigned i = 0; i < scene.content->getNumChildren(); ++i) paint(childOf(scene, i), {0.8f, 0.8f, 0.8f, 1.0f});
}

void drawByItself(osg::Node& node, bool displayList, bool colored = false) {
    osg::Geode& geode = *node.asGeode();
    const osg::ref_ptr<OwnBody> own = new OwnBody(*geode.getDrawable(0)->asGeometry(), colored);
    own->setUseDisplayList(displayList);
    geode.setDrawable(0, own);
}

void drawAllByThemselves(Scene& scene, bool displayList) {
    for (unsigned i = 0; i < scene.content->getNumChildren(); ++i) drawByItself(childOf(scene, i), displayList);
}

/// A box that is drawn before all others, and neither casts a shadow that is seen nor receives one.
osg::Node& addBefore(Scene& scene) {
    const osg::ref_ptr<osg::Node> aside = node(box({3.0, 0.0, -0.5}, {3.5, 0.5, -0.4}));
    scene.content->insertChild(0, aside);
    return *aside;
}

void paintVertices(osg::Node& node, bool displayList) {
    osg::Geometry& geometry = *node.asGeode()->getDrawable(0)->asGeometry();
    osg::ref_ptr<osg::Vec4Array> colors = new osg::Vec4Array(geometry.getVertexArray()->getNumElements());
    for (std::size_t i = 0; i < colors->size(); ++i) (*colors)[i].set(0.2f, i % 2 ? 0.7f : 0.1f, 0.3f, 1.0f);
    geometry.setColorArray(colors, osg::Array::BIND_PER_VERTEX);
    geometry.setUseDisplayList(displayList);
    geometry.setUseVertexBufferObjects(!displayList);
}

const Case cases[] = {
    {"AllOfThem", [](Scene&) {}},
    {"BesideOneWithAMaterial",
     [](Scene& scene) { childOf(scene, 1).getOrCreateStateSet()->setAttributeAndModes(material(0.5f)); }},
    {"BesideTwoWithMaterialsAndBins",
     [](Scene& scene) {
         childOf(scene, 1).getOrCreateStateSet()->setAttributeAndModes(material(0.5f));
         childOf(scene, 1).getStateSet()->setRenderBinDetails(-1, "RenderBin");
         childOf(scene, 2).getOrCreateStateSet()->setAttributeAndModes(material(0.7f));
         childOf(scene, 2).getStateSet()->setRenderBinDetails(1, "RenderBin");
     }},
    {"BesideOneWithColors", [](Scene& scene) { paint(childOf(scene, 1)); }},
    {"InTheMaterialsColor", paintAllAsMaterials},
    {"InTheMaterialsColorAndLate",
     [](Scene& scene) { // as DART's viewer has its shapes
         paintAllAsMaterials(scene);
         osg::StateSet& state = *scene.content->getOrCreateStateSet();
         state.setMode(GL_BLEND, osg::StateAttribute::ON);
         state.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
     }},
    {"OnAGroundThatDrawsItself", [](Scene& scene) { drawByItself(childOf(scene, 0), true); }},
    {"OfBodiesThatDrawThemselves", [](Scene& scene) { drawAllByThemselves(scene, false); }, true},
    {"OfBodiesInDisplayLists", [](Scene& scene) { drawAllByThemselves(scene, true); }, true},
    {"BeforeOneWithAColor", [](Scene& scene) { paint(childOf(scene, 2)); }},
    {"BeforeAGroundWithAColor",
     [](Scene& scene) {
         const osg::ref_ptr<osg::Node> ground = &childOf(scene, 0);
         scene.content->removeChild(ground);
         scene.content->addChild(ground);
         paint(*ground);
     }},
    {"AfterOneWithAColorAside", [](Scene& scene) { paint(addBefore(scene)); }},
    {"AfterOneWithColorsOfVerticesAside", [](Scene& scene) { paintVertices(addBefore(scene), false); }},
    {"AfterOneWithColorsInADisplayListAside", [](Scene& scene) { paintVertices(addBefore(scene), true); }},
    {"AfterOneThatSetsItsColorAside", [](Scene& scene) { drawByItself(addBefore(scene), false, true); }},
};

enum class Light { On, Dark, Relit, Blended };

/// Without any colour or material: osgViewer's lets colours be materials.
Scene build(const Case& given, Light light) {
    Scene scene = groundScene(casters, 8.0, sun);
    for (unsigned i = 0; i < scene.content->getNumChildren(); ++i)
        childOf(scene, i).asGeode()->getDrawable(0)->asGeometry()->setColorArray(nullptr);
    scene.root->getStateSet()->removeAttribute(osg::StateAttribute::MATERIAL);
    given.change(scene);
    if (light == Light::Dark) scene.takeLightAway();
    if (light < Light::Relit) return scene;
    if (given.byMap)
        scene.addShadow(new gnomon::ShadowMapTechnique);
    else
        scene.addShadow(planar());
    scene.group->setComposite(light == Light::Relit ? gnomon::ShadowCasterGroup::RELIGHT
                                                    : gnomon::ShadowCasterGroup::BLEND);
    return scene;
}

/// True if BLEND left half of each channel; OpenGL rounds.
bool isHalf(std::uint32_t actual, std::uint32_t lit) {
    for (int shift = 0; shift < 24; shift += 8)
        if (std::abs(2 * int(actual >> shift & 255u) - int(lit >> shift & 255u)) > 1) return false;
    return true;
}

/// Pixels that are neither as without a shadow nor half of that; of the ground, away from edges, those that are the wrong one.
int wronglyBlended(const Picture& actual, const Picture& lit, const Mask& mask) {
    int wrong = 0;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const bool same = actual.at(x, y) == lit.at(x, y), half = isHalf(actual.at(x, y), lit.at(x, y));
            const Seen seen = mask.atEdge(x, y, 2) ? Seen::Caster : mask.at(x, y);
            wrong += seen == Seen::LitReceiver ? !same : seen == Seen::ShadowedReceiver ? !half : !same && !half;
        }
    return wrong;
}

class NoColors : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Relit, NoColors, testing::ValuesIn(cases), testing::PrintToStringParamName());

} // namespace

TEST_P(NoColors, LoseTheLightAlone) {
    const Scene lit = build(GetParam(), Light::On), dark = build(GetParam(), Light::Dark),
                shadowed = build(GetParam(), Light::Relit);
    const Mask mask = castRays(square(8.0), casters, sun, slanted);
    Camera litCamera(lit.root, slanted), darkCamera(dark.root, slanted), camera(shadowed.root, slanted);
    for (int frame = 1; frame <= 4; ++frame) {
        const Picture actual = camera.frame();
        const Comparison found = compare(actual, litCamera.frame(), darkCamera.frame(), mask, GetParam().byMap ? 2 : 1);
        EXPECT_EQ(found.wrongInside, 0) << "frame " << frame;
        EXPECT_EQ(found.wrongAtEdge, 0) << "frame " << frame;
    }
    EXPECT_GT(mask.count(Seen::ShadowedReceiver), 300);
}

TEST_P(NoColors, LoseTheLightAloneIfShadowsComeLater) {
    const Scene lit = build(GetParam(), Light::On), dark = build(GetParam(), Light::Dark),
                shadowed = build(GetParam(), Light::Relit);
    const Mask mask = castRays(square(8.0), casters, sun, slanted);
    Camera litCamera(lit.root, slanted), darkCamera(dark.root, slanted), camera(shadowed.root, slanted);
    osg::Node& technique = *shadowed.group->getChild(1);
    for (int frame = 1; frame <= 4; ++frame) {
        technique.setNodeMask(frame < 3 ? 0u : ~0u);
        const Picture actual = camera.frame(), expected = litCamera.frame(), darkPicture = darkCamera.frame();
        if (frame < 3) continue;
        const Comparison found = compare(actual, expected, darkPicture, mask, GetParam().byMap ? 2 : 1);
        EXPECT_EQ(found.wrongInside + found.wrongAtEdge, 0) << "frame " << frame;
    }
}

TEST_P(NoColors, AreAsWithoutShadowsWhereBlendDarkensNothing) {
    const Scene lit = build(GetParam(), Light::On), shadowed = build(GetParam(), Light::Blended);
    shadowed.group->setDark(0.5f);
    const Mask mask = castRays(square(8.0), casters, sun, slanted);
    Camera litCamera(lit.root, slanted), camera(shadowed.root, slanted);
    for (int frame = 1; frame <= 4; ++frame)
        EXPECT_EQ(wronglyBlended(camera.frame(), litCamera.frame(), mask), 0) << "frame " << frame;
}

TEST_P(NoColors, AreAsWithoutShadowsBesideMapsForPrograms) {
    const Scene lit = build(GetParam(), Light::On);
    Scene shadowed = build(GetParam(), Light::On);
    gnomon::ShadowMapOptions options;
    options.programUnit = 5; // maps are drawn before all else, and no program here reads them
    const osg::ref_ptr<gnomon::ShadowMapTechnique> technique = new gnomon::ShadowMapTechnique;
    technique->setOptions(options);
    shadowed.addShadow(technique);
    Camera litCamera(lit.root, slanted), camera(shadowed.root, slanted);
    for (int frame = 1; frame <= 4; ++frame)
        EXPECT_EQ(camera.frame().different(litCamera.frame()), 0) << "frame " << frame;
}
