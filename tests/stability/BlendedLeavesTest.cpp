// SPDX-License-Identifier: MIT
// A sheet that blends, clear in parts, as the leaves of trees and the wires of fences are drawn: late, by the alpha of a texture. What
// is seen of it receives, and what is seen through it does. Expected: of four pictures without Gnomon, sheet and ground lit or
// not, the one that the place of each shadow asks for.
#include "Trial.h"

#include <gnomon/ShadowSpec.h>
#include <osg/AlphaFunc>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Image>
#include <osg/Material>
#include <osg/Scissor>
#include <osg/Stencil>
#include <osg/Texture2D>

#include <array>
#include <cmath>
#include <functional>

using namespace test;

namespace {

GNOMON_BY(BlendedLeaves, By::Traced, By::Map, By::Volume, By::SmoothTraced, By::SmoothVolume);

constexpr double half = 4.0;
constexpr int size = 128;
constexpr double sheetHeight = 0.5,
                 casterHeight = 2.0; // the sun stands at 45 degrees over +x: a shadow is as far to -x
constexpr double casterWest = -0.6, casterEast = 1.4, casterNorth = 1.5;
constexpr std::array<unsigned char, 4> alphas = {0, 100, 178, 255}; // clear, less than a half, more, and opaque

/// Stripes along y, each of one alpha, a unit wide.
osg::ref_ptr<osg::Texture2D> stripes() {
    const osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(alphas.size()), 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    for (std::size_t i = 0; i < alphas.size(); ++i) {
        std::fill_n(image->data(unsigned(i)), 3, static_cast<unsigned char>(255));
        image->data(unsigned(i))[3] = alphas[i];
    }
    const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
    texture->setFilter(osg::Texture::MIN_FILTER, osg::Texture::NEAREST);
    texture->setFilter(osg::Texture::MAG_FILTER, osg::Texture::NEAREST);
    for (const auto wrap : {osg::Texture::WRAP_S, osg::Texture::WRAP_T}) texture->setWrap(wrap, osg::Texture::REPEAT);
    return texture;
}

/// Of no clear parts.
osg::ref_ptr<osg::Image> opaqueImage() {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(int(alphas.size()), 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    std::fill_n(image->data(), image->getTotalSizeInBytes(), static_cast<unsigned char>(255));
    return image;
}

double alphaAt(double x) {
    const double along = x / 4.0 - std::floor(x / 4.0);
    return alphas[std::size_t(along * 4.0)] / 255.0;
}

/// Over all of the view, as wide as high; of half the ground's colour.
osg::ref_ptr<osg::Geode> sheet(double height = sheetHeight) {
    const osg::ref_ptr<osg::Geode> geode =
        node(quad({-half, -half, height}, {2 * half, 0, 0}, {0, 2 * half, 0}), "sheet");
    osg::Geometry& geometry = *geode->getDrawable(0)->asGeometry();
    const osg::ref_ptr<osg::Vec2Array> places = new osg::Vec2Array;
    for (const osg::Vec3& vertex : *static_cast<osg::Vec3Array*>(geometry.getVertexArray()))
        places->push_back({vertex.x() / 4.0f, 0.5f});
    geometry.setTexCoordArray(0, places, osg::Array::BIND_PER_VERTEX);
    osg::StateSet& set = *geode->getOrCreateStateSet();
    set.setTextureAttributeAndModes(0, stripes());
    set.setMode(GL_BLEND, osg::StateAttribute::ON);
    set.setRenderingHint(osg::StateSet::TRANSPARENT_BIN);
    return geode;
}

/// The root's material with this share of what it reflects of the sun.
void reflect(osg::Node& node, float share) {
    const osg::ref_ptr<osg::Material> material = new osg::Material;
    material->setAmbient(osg::Material::FRONT_AND_BACK, {1.0f, 1.0f, 1.0f, 1.0f});
    material->setDiffuse(osg::Material::FRONT_AND_BACK, {share, share, share, 1.0f});
    node.getOrCreateStateSet()->setAttributeAndModes(material);
}

using Dressed = std::function<void(Scene& scene, osg::Geode& sheet)>;
void nothing(Scene&, osg::Geode&) {}

struct Leafy {
    Scene scene;
    osg::ref_ptr<osg::Geode> sheet, ground, caster;
};

Leafy build(const Dressed& change = nothing) {
    Leafy leafy{groundScene({quad({casterWest, -casterNorth, casterHeight}, {casterEast - casterWest, 0, 0},
                                  {0, 2 * casterNorth, 0})}),
                sheet(), nullptr, nullptr};
    leafy.ground = find(*leafy.scene.root, "ground")->asGeode();
    leafy.caster = leafy.scene.content->getChild(1)->asGeode();
    leafy.scene.content->addChild(leafy.sheet);
    change(leafy.scene, *leafy.sheet);
    return leafy;
}

/// With shadows of the caster alone.
Leafy withShadow(gnomon::ShadowCasterGroup::Composite composite, const Dressed& change = nothing) {
    Leafy leafy = build(change);
    leafy.scene.addShadow(castingTechnique());
    leafy.scene.group->setCasters({leafy.caster});
    leafy.scene.group->setComposite(composite);
    return leafy;
}

constexpr auto relit = gnomon::ShadowCasterGroup::RELIGHT, blended = gnomon::ShadowCasterGroup::BLEND;

/// Without Gnomon.
Picture picture(bool sheetLit, bool groundLit, const Dressed& change = nothing) {
    Leafy leafy = build(change);
    reflect(*leafy.sheet, sheetLit ? 1.0f : 0.0f);
    reflect(*leafy.ground, groundLit ? 1.0f : 0.0f);
    return render(leafy.scene.root, fromAbove(half, size));
}

/// Whether the caster's shadow falls there at a height; nullopt within `edge` pixels of its edge.
std::optional<bool> isShadowed(double x, double y, double height, double edge) {
    const double fallen = casterHeight - height, pixel = edge * 2.0 * half / size;
    const double inside = std::min({x + fallen - casterWest, casterEast - x - fallen, casterNorth - std::abs(y)});
    return std::abs(inside) < pixel ? std::nullopt : std::optional<bool>(inside > 0.0);
}

/// What a pixel shows: of an alpha, and shadowed at the sheet and at the ground, or not.
struct Place {
    std::size_t at;
    double alpha;
    bool onSheet, onGround;
    bool hides() const { return alpha >= 0.5; }
};

/// Those of which it can be told: off the edges of shadows and beside the caster.
std::vector<Place> places() {
    std::vector<Place> all;
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            const double x = ((column + 0.5) / size * 2.0 - 1.0) * half, y = ((row + 0.5) / size * 2.0 - 1.0) * half;
            const auto onSheet = isShadowed(x, y, sheetHeight, 2.0), onGround = isShadowed(x, y, 0.0, 2.0),
                       onCaster = isShadowed(x, y, casterHeight, 2.0);
            if (onSheet && onGround && onCaster && !*onCaster)
                all.push_back({std::size_t(row * size + column), alphaAt(x), *onSheet, *onGround});
        }
    return all;
}

/// Relit: each pixel has the bits of the picture that its place asks for.
::testing::AssertionResult isRelit(const Picture& seen, const Dressed& change) {
    const Picture of[2][2] = {{picture(false, false, change), picture(false, true, change)},
                              {picture(true, false, change), picture(true, true, change)}};
    int wrong = 0, shadowed = 0;
    for (const Place& place : places()) {
        const bool loses = place.onSheet && place.hides();
        shadowed += loses;
        wrong += seen.pixels[place.at] != of[!loses][!place.onGround].pixels[place.at];
    }
    if (wrong == 0 && shadowed > 500) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << wrong << " pixels are wrong; " << shadowed << " of leaves are shadowed";
}

/// Grey values, ± 2: a byte is rounded by the ground's factor, the blending and the sheet's factor.
int wrongInGrey(const Picture& seen, double sheet, double shadowedGround) {
    int wrong = 0;
    for (const Place& place : places()) {
        const double mixed = place.alpha * sheet + (1.0 - place.alpha) * (place.onGround ? shadowedGround : litGround);
        const double expected = mixed * (place.onSheet && place.hides() ? 0.5 : 1.0);
        wrong += std::abs(double(seen.pixels[place.at] & 0xff) - expected) > 2.0;
    }
    return wrong;
}

/// Where the sheet receives nothing: pixels that are not as with its light, and the ground's own shadow.
int wrongUnlessLit(const Dressed& change) {
    Leafy leafy = withShadow(relit, change);
    const Picture seen = render(leafy.scene.root, fromAbove(half, size)), lit = picture(true, true, change),
                  dark = picture(true, false, change);
    int wrong = 0;
    for (const Place& place : places())
        wrong += seen.pixels[place.at] != (place.onGround ? dark : lit).pixels[place.at];
    return wrong;
}

void writeNoDepth(Scene&, osg::Geode& sheet) {
    sheet.getOrCreateStateSet()->setAttributeAndModes(new osg::Depth(osg::Depth::LESS, 0.0, 1.0, false));
}

} // namespace

TEST_P(BlendedLeaves, ReceiveWhereTheyHideMoreThanTheyShow) {
    Leafy leafy = withShadow(relit);
    EXPECT_TRUE(isRelit(render(leafy.scene.root, fromAbove(half, size)), nothing));
}

TEST_P(BlendedLeaves, ReceiveThoughTheyWriteNoDepth) {
    Leafy leafy = withShadow(relit, writeNoDepth);
    EXPECT_TRUE(isRelit(render(leafy.scene.root, fromAbove(half, size)), writeNoDepth));
}

/// A map reaches for the leaves, too, and not for what leaves depth alone.
TEST_P(BlendedLeaves, ReceiveWithoutDepthBesideWhatIsDrawnLateWithIt) {
    const Dressed beside = [](Scene& scene, osg::Geode& sheet) {
        writeNoDepth(scene, sheet);
        const osg::ref_ptr<osg::Geode> post = node(quad({3.2, 3.2, 0.2}, {0.6, 0, 0}, {0, 0.6, 0}), "post");
        post->getOrCreateStateSet()->setRenderBinDetails(9, "RenderBin");
        scene.root->addChild(post);
    };
    Leafy leafy = withShadow(relit, beside);
    EXPECT_TRUE(isRelit(render(leafy.scene.root, fromAbove(half, size)), beside));
}

TEST_P(BlendedLeaves, TakeTheFactorUnderBlend) {
    for (const Dressed& change : {Dressed(nothing), Dressed(writeNoDepth)}) {
        Leafy leafy = withShadow(blended, change);
        EXPECT_EQ(wrongInGrey(render(leafy.scene.root, fromAbove(half, size)), litGround, 0.5 * litGround), 0);
    }
}

/// White, and not to be relit.
TEST_P(BlendedLeaves, ThatAreUnlitTakeTheFactorOnceAndAreNamed) {
    const Dressed unlit = [](Scene&, osg::Geode& sheet) {
        sheet.getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    };
    Leafy leafy = withShadow(relit, unlit);
    EXPECT_EQ(wrongInGrey(render(leafy.scene.root, fromAbove(half, size)), 255.0, shadowedGround), 0);
}

/// Loaders hint at the transparent bin; programs forget to.
TEST_P(BlendedLeaves, InAnOpaqueBinAreNamed) {
    Leafy leafy = withShadow(relit, [](Scene&, osg::Geode& sheet) {
        sheet.getOrCreateStateSet()->setRenderingHint(osg::StateSet::OPAQUE_BIN);
    });
    const auto* technique = dynamic_cast<gnomon::ShadowTechnique*>(leafy.scene.group->getChild(1));
    ASSERT_NE(technique, nullptr);
    render(leafy.scene.root, fromAbove(half, size));
    const std::vector<std::string> causes = technique->diagnose();
    EXPECT_TRUE(std::any_of(causes.begin(), causes.end(), [](const std::string& cause) {
        return cause.find("'sheet' blends by an alpha that differs from place to place") != std::string::npos;
    }));
}

/// Two passes, as careful modellers draw leaves: what is opaque with depth, then the rest.
TEST_P(BlendedLeaves, OfAPassForLowAlphasReceiveNothing) {
    const Dressed lowOnly = [](Scene&, osg::Geode& sheet) {
        sheet.getOrCreateStateSet()->setAttributeAndModes(new osg::AlphaFunc(osg::AlphaFunc::LESS, 0.5f));
    };
    EXPECT_EQ(wrongUnlessLit(lowOnly), 0);
}

/// The nearer of two hides the other, and both are drawn in their order.
TEST_P(BlendedLeaves, BehindOthersShowThroughThemAsTheyWere) {
    const Dressed another = [](Scene& scene, osg::Geode&) {
        const osg::ref_ptr<osg::Geode> lower = sheet(0.25);
        lower->setName("lower");
        scene.root->addChild(lower); // outside the group: it receives all the same
    };
    Leafy leafy = withShadow(relit, another);
    const Picture seen = render(leafy.scene.root, fromAbove(half, size)), lit = picture(true, true, another),
                  dark = picture(false, false, another);
    int wrong = 0, shadowed = 0;
    for (const Place& place : places()) {
        if (place.alpha < 1.0) continue; // else the lower one's own shadow counts
        shadowed += place.onSheet;
        wrong += seen.pixels[place.at] != (place.onSheet ? dark : lit).pixels[place.at];
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(shadowed, 100);
}

/// As osg::State has it: a texture above that overrides the leaves' own.
TEST_P(BlendedLeaves, AreClearByATextureThatOverridesTheirs) {
    const Dressed overridden = [](Scene& scene, osg::Geode& sheet) {
        static_cast<osg::Texture2D&>(*sheet.getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE))
            .setImage(opaqueImage());
        const osg::ref_ptr<osg::Group> above = new osg::Group;
        above->getOrCreateStateSet()->setTextureAttributeAndModes(
            0, stripes(), osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
        scene.content->removeChild(&sheet);
        above->addChild(&sheet);
        scene.content->addChild(above);
    };
    Leafy leafy = withShadow(relit, overridden);
    EXPECT_TRUE(isRelit(render(leafy.scene.root, fromAbove(half, size)), overridden));
}

/// Of one alpha then, as glass is: what is behind shines through.
TEST_P(BlendedLeaves, WhoseTextureIsOffReceiveAsWithoutIt) {
    const Dressed glass = [](Scene&, osg::Geode& sheet) {
        sheet.getStateSet()->setTextureMode(0, GL_TEXTURE_2D, osg::StateAttribute::OFF);
        const osg::ref_ptr<osg::Material> material = new osg::Material;
        material->setDiffuse(osg::Material::FRONT_AND_BACK, {0.8f, 0.8f, 0.8f, 0.6f});
        sheet.getStateSet()->setAttributeAndModes(material);
    };
    Leafy leafy = withShadow(relit, glass), lit = build(glass), dark = build(glass);
    reflect(*dark.ground, 0.0f);
    const Picture seen = render(leafy.scene.root, fromAbove(half, size)),
                  expected[] = {render(lit.scene.root, fromAbove(half, size)),
                                render(dark.scene.root, fromAbove(half, size))};
    int wrong = 0;
    for (const Place& place : places()) wrong += seen.pixels[place.at] != expected[place.onGround].pixels[place.at];
    EXPECT_EQ(wrong, 0);
}

/// Both images have been changed as often as the other: their counts are the same.
TEST_P(BlendedLeaves, WhoseTextureGetsAnotherImageAreClearByThat) {
    Leafy leafy = withShadow(relit);
    auto& texture =
        static_cast<osg::Texture2D&>(*leafy.sheet->getStateSet()->getTextureAttribute(0, osg::StateAttribute::TEXTURE));
    const osg::ref_ptr<osg::Image> striped = texture.getImage(), opaque = opaqueImage();
    ASSERT_EQ(striped->getModifiedCount(), opaque->getModifiedCount());
    texture.setImage(opaque);
    Camera camera(leafy.scene.root, fromAbove(half, size));
    camera.frame();
    texture.setImage(striped);
    EXPECT_TRUE(isRelit(camera.frame(), nothing));
}

/// A test that keeps them from the frame: nothing is darkened where they would be.
TEST_P(BlendedLeaves, ThatTheirOwnStencilTestHidesLeaveNoShadow) {
    const Dressed hidden = [](Scene&, osg::Geode& sheet) {
        const osg::ref_ptr<osg::Stencil> never = new osg::Stencil;
        never->setFunction(osg::Stencil::EQUAL, 1, 1);
        sheet.getStateSet()->setAttributeAndModes(never);
    };
    for (const auto composite : {relit, blended}) {
        Leafy leafy = withShadow(composite, hidden);
        const Picture seen = render(leafy.scene.root, fromAbove(half, size));
        const double dark = composite == relit ? shadowedGround : litGround / 2;
        int wrong = 0;
        for (const Place& place : places())
            wrong += std::abs(double(seen.pixels[place.at] & 0xff) - (place.onGround ? dark : litGround)) > 1.0;
        EXPECT_EQ(wrong, 0) << composite;
    }
}

/// A user interface that tests no depth, in the bin after theirs: nothing is darkened there, and nothing drawn over it.
TEST_P(BlendedLeaves, LieBelowWhatTheNextBinDraws) {
    const Dressed covered = [](Scene& scene, osg::Geode&) {
        const osg::ref_ptr<osg::Geode> panel = node(quad({-half, -half, 0.0}, {half, 0, 0}, {0, 2 * half, 0}), "panel");
        panel->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
        panel->getStateSet()->setMode(GL_DEPTH_TEST, osg::StateAttribute::OFF);
        panel->getStateSet()->setRenderBinDetails(11, "RenderBin");
        scene.root->addChild(panel);
    };
    for (const auto composite : {relit, blended}) {
        Leafy leafy = withShadow(composite, covered);
        const Picture seen = render(leafy.scene.root, fromAbove(half, size));
        int wrong = 0;
        for (int row = 0; row < size; ++row)
            for (int column = 0; column < size / 2; ++column) wrong += (seen.at(column, row) & 0xffffff) != 0xffffff;
        EXPECT_EQ(wrong, 0) << composite;
    }
}

/// OSG then puts the scissor's box, once nothing is cut any more, to another place than the view.
TEST_P(BlendedLeaves, BesideWhatHasAScissorShowWhatIsBehindAsItIsNow) {
    const Dressed cut = [](Scene& scene, osg::Geode&) {
        scene.content->getChild(1)->getOrCreateStateSet()->setAttributeAndModes(new osg::Scissor(0, 0, size, size));
    };
    Leafy leafy = withShadow(relit, cut);
    leafy.ground->setNodeMask(0);
    Camera camera(leafy.scene.root, fromAbove(half, size));
    camera.frame();
    leafy.ground->setNodeMask(~0u);
    for (int frame = 2; frame < 4; ++frame) EXPECT_TRUE(isRelit(camera.frame(), cut)) << frame;
}

TEST_P(BlendedLeaves, BehindTheGroundStayHiddenUnderOthers) {
    const Dressed another = [](Scene& scene, osg::Geode&) { scene.root->addChild(sheet(-0.25)); };
    Leafy leafy = withShadow(relit, another);
    EXPECT_TRUE(isRelit(render(leafy.scene.root, fromAbove(half, size)), another));
}

TEST_P(BlendedLeaves, ReceiveAgainOnceWhatHidThemIsGone) {
    Leafy leafy = withShadow(relit);
    const osg::ref_ptr<osg::Geode> roof = node(quad({-half, -half, 3.0}, {2 * half, 0, 0}, {0, 2 * half, 0}), "roof");
    leafy.scene.root->addChild(roof);
    Camera camera(leafy.scene.root, fromAbove(half, size));
    camera.frame();
    leafy.scene.root->removeChild(roof);
    EXPECT_TRUE(isRelit(camera.frame(), nothing));
}

/// Smoke without light, and signs that lie over all: they are no receivers if they hide the depth of nothing.
TEST_P(BlendedLeaves, ThatLeaveNoDepthAndAreUnlitOrTestNoneReceiveNothing) {
    for (const GLenum off : {GL_LIGHTING, GL_DEPTH_TEST}) {
        const Dressed change = [off](Scene& scene, osg::Geode& sheet) {
            writeNoDepth(scene, sheet);
            sheet.getStateSet()->setMode(off, osg::StateAttribute::OFF);
        };
        EXPECT_EQ(wrongUnlessLit(change), 0) << off;
    }
}

/// What a test of their own clears receives nothing; one that clears less than a half leaves the half.
TEST_P(BlendedLeaves, WithATestOfTheirOwnTakeTheFactorWhereTheyAreDrawn) {
    for (const auto function : {osg::AlphaFunc::GREATER, osg::AlphaFunc::NOTEQUAL}) {
        const bool few = function == osg::AlphaFunc::GREATER;
        Leafy leafy = withShadow(blended, [&](Scene&, osg::Geode& sheet) {
            sheet.getStateSet()->setAttributeAndModes(new osg::AlphaFunc(function, few ? 0.9f : 0.0f));
        });
        const Picture seen = render(leafy.scene.root, fromAbove(half, size));
        int wrong = 0;
        for (const Place& place : places()) {
            const bool hides = few ? place.alpha > 0.9 : place.hides();
            const double ground = place.onGround ? 0.5 * litGround : litGround; // the sheet's lit grey is the ground's
            const double alpha = few && !hides ? 0.0 : place.alpha;
            const double expected = (alpha * litGround + (1.0 - alpha) * ground) * (place.onSheet && hides ? 0.5 : 1.0);
            wrong += std::abs(double(seen.pixels[place.at] & 0xff) - expected) > 2.0;
        }
        EXPECT_EQ(wrong, 0) << function;
    }
}
