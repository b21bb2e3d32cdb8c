// SPDX-License-Identifier: MIT
// Halos in pixels that can be counted, in colours that can be worked out.
#include "EffectPromises.h"

#include <gnomon/HaloNode.h>
#include <gnomon/HaloPulse.h>
#include <gnomon/PlanarReflectionNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <support/Panels.h>
#include <support/Scene.h>

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <osg/MatrixTransform>
#include <osg/Program>

#include <algorithm>
#include <cmath>

using namespace test;
using gnomon::HaloNode;
using gnomon::HaloPulse;

namespace {

/// 32 pixels a unit; the middle of the picture is (0, 0).
const View above = fromAbove(4.0);
const glm::dvec3 floorColor(200, 120, 40), modelColor(40, 200, 80);
/// llvmpipe blends 8-bit pixels in steps of 1/255, factors too: each of the two products may be off by one.
constexpr double rounding = 1.01;

Panel level(double x, double y, double half, double height, const std::string& name = "model",
            const glm::dvec3& color = modelColor) {
    return {{x - half, y - half, height}, {2.0 * half, 0.0, 0.0}, {0.0, 2.0 * half, 0.0}, glm::ivec3(color), name};
}

glm::dvec3 blended(const HaloNode& halo, const glm::dvec3& under) {
    const osg::Vec4f& c = halo.getColor();
    return double(c.w()) * 255.0 * glm::dvec3(c.x(), c.y(), c.z()) + (1.0 - double(c.w())) * under;
}

/// A floor, and a halo node with panels over it.
struct Watched {
    explicit Watched(const std::vector<Panel>& model, const std::vector<Panel>& others = {}) {
        root->addChild(node(level(0.0, 0.0, 8.0, 0.0, "floor", floorColor)));
        for (const Panel& panel : others) root->addChild(node(panel));
        for (const Panel& panel : model) halo->addChild(node(panel));
        root->addChild(halo);
    }
    Picture without() {
        const double scale = halo->getScale();
        const auto shape = halo->getShape();
        halo->setShape(HaloNode::WHOLE);
        halo->setScale(1.0);
        Picture picture = render(root, view);
        halo->setShape(shape);
        halo->setScale(scale);
        return picture;
    }
    Picture with() { return render(root, view); }

    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<HaloNode> halo = new HaloNode;
    View view = above;
};

/// Pixels where two pictures differ. Each must be one blend of the halo over what was there.
int blendedOnce(const HaloNode& halo, const Picture& with, const Picture& without) {
    int count = 0;
    for (int y = 0; y < with.height; ++y)
        for (int x = 0; x < with.width; ++x) {
            if (with.at(x, y) == without.at(x, y)) continue;
            const glm::dvec3 off = glm::abs(colorAt(with, x, y) - blended(halo, colorAt(without, x, y)));
            EXPECT_LE(std::max({off.x, off.y, off.z}), rounding) << x << " " << y;
            ++count;
        }
    return count;
}

int pixels(const Picture& picture, const glm::dvec3& color) {
    int count = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) count += colorAt(picture, x, y) == color;
    return count;
}

} // namespace

// A square of 32 × 32 pixels, twice as large: 64 × 64 less the square.
TEST(Halo, IsARimOfExactlyTheColourAndTheModelKeepsEveryBit) {
    Watched watched({level(0.0, 0.0, 0.5, 1.0)});
    watched.halo->setScale(2.0);
    const Picture with = watched.with(), without = watched.without();
    EXPECT_EQ(blendedOnce(*watched.halo, with, without), 64 * 64 - 32 * 32);
    EXPECT_EQ(pixels(with, modelColor), 32 * 32);
    EXPECT_NE(with.at(128 + 31, 128 + 31), without.at(128 + 31, 128 + 31));
    EXPECT_EQ(with.at(128 + 32, 128), without.at(128 + 32, 128));
    EXPECT_TRUE(watched.halo->diagnose().empty());
}

TEST(Halo, OfOpacityOneHidesWhatIsBehind) {
    Watched watched({level(0.0, 0.0, 0.5, 1.0)});
    watched.halo->setScale(2.0);
    watched.halo->setColor({0.6f, 0.6f, 0.0f, 1.0f}); // a half of 255 may round either way
    const Picture with = watched.with();
    EXPECT_EQ(pixels(with, {153.0, 153.0, 0.0}), 64 * 64 - 32 * 32);
    EXPECT_EQ(pixels(with, modelColor), 32 * 32);
}

// Squares at x = -1 and 1: their box's centre is 0, so that twice as large they lie at -2 and 2; by parts they stay.
TEST(Halo, OfTheWholeMovesPartsApartAndOfPartsDoesNot) {
    Watched watched({level(-1.0, 0.0, 0.5, 1.0), level(1.0, 0.0, 0.5, 1.0)});
    watched.halo->setScale(2.0);
    Picture without = watched.without();
    EXPECT_EQ(blendedOnce(*watched.halo, watched.with(), without), 2 * (64 * 64 - 16 * 32))
        << "x = 1 … 3: the inner half of each square covers its halo";
    watched.halo->setShape(HaloNode::PARTS);
    EXPECT_EQ(blendedOnce(*watched.halo, watched.with(), without), 2 * (64 * 64 - 32 * 32));
}

// Halos of 64 × 64 pixels whose places are 16 pixels apart: 80 × 64 in all, less the two squares' 48 × 32.
TEST(Halo, BlendsAPixelUnderManyTrianglesOnce) {
    Watched watched({level(-0.25, 0.0, 0.5, 1.0), level(0.25, 0.0, 0.5, 1.5)});
    watched.halo->setShape(HaloNode::PARTS);
    watched.halo->setScale(2.0);
    EXPECT_EQ(blendedOnce(*watched.halo, watched.with(), watched.without()), 80 * 64 - 48 * 32);
}

TEST(Halo, OfPixelsIsTheDiscSweptAlongTheModelsOutline) {
    Watched watched({{{-1.0, -0.7, 1.0}, {1.9, 0.6, 0.0}, {-0.4, 1.3, 0.0}, glm::ivec3(modelColor), "slanted"},
                     {{1.5, 1.0, 1.0}, {0.6, 0.0, 0.0}, {0.0, 0.05, 0.0}, glm::ivec3(modelColor), "thin"}});
    const Picture without = watched.without();
    watched.halo->setShape(HaloNode::PIXELS);
    for (const int width : {0, 1, 3, 8}) {
        watched.halo->setWidth(width);
        const Picture with = watched.with();
        const auto isModel = [&](int x, int y) {
            return x >= 0 && y >= 0 && x < 256 && y < 256 && colorAt(without, x, y) == modelColor;
        };
        int wrong = 0, rim = 0;
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x) {
                bool near = false;
                for (int dy = -width; dy <= width; ++dy)
                    for (int dx = -width; dx <= width; ++dx)
                        near = near || (dx * dx + dy * dy <= width * width && isModel(x + dx, y + dy));
                const bool expected = near && !isModel(x, y);
                rim += expected;
                wrong += expected != (with.at(x, y) != without.at(x, y));
            }
        EXPECT_EQ(wrong, 0) << width;
        EXPECT_EQ(blendedOnce(*watched.halo, with, without), rim) << width;
    }
}

TEST(Halo, IsHiddenByWhatStandsBeforeIt) {
    for (const auto shape : {HaloNode::WHOLE, HaloNode::PIXELS}) {
        Watched watched({level(0.0, 0.0, 0.5, 1.0)}, {level(1.0, 0.0, 1.0, 3.0, "post", {1.0, 2.0, 3.0})});
        watched.halo->setScale(2.0);
        const Picture without = watched.without();
        watched.halo->setShape(shape);
        watched.halo->setWidth(8);
        const Picture with = watched.with();
        EXPECT_GT(blendedOnce(*watched.halo, with, without), 300);
        EXPECT_EQ(pixels(with, {1.0, 2.0, 3.0}), 64 * 64);
        EXPECT_EQ(pixels(with, modelColor), pixels(without, modelColor));
    }
}

TEST(Halo, IsOneColourWhateverTheModelIsDrawnWith) {
    Watched watched({level(0.0, 0.0, 0.5, 1.0)});
    watched.halo->setScale(2.0);
    const Picture plain = watched.with();
    osg::ref_ptr<osg::Program> program = new osg::Program;
    program->addShader(new osg::Shader(osg::Shader::VERTEX, "void main() { gl_Position = ftransform(); }"));
    program->addShader(new osg::Shader(osg::Shader::FRAGMENT,
                                       "void main() { gl_FragColor = vec4(40.0, 200.0, 80.0, 255.0) / 255.0; }"));
    watched.halo->getOrCreateStateSet()->setAttribute(program);
    EXPECT_EQ(watched.with().different(plain), 0);
}

TEST(Halo, OfAModelOutOfSightIsSeen) {
    Watched watched({level(4.6, 0.0, 0.5, 1.0)}); // the view ends at 4, the square begins at 4.1
    watched.halo->setScale(2.0);
    EXPECT_EQ(blendedOnce(*watched.halo, watched.with(), watched.without()), 13 * 64) << "3.6 … 4: 12.8 pixels";
}

TEST(Halo, IsTheSameUnderTransformsFarAwayAndWithComputedNearAndFar) {
    Watched watched({level(0.0, 0.0, 0.5, 1.0), level(1.5, 1.0, 0.25, 2.0)});
    watched.halo->setScale(1.5);
    const Picture here = watched.with();
    const osg::Matrixd away = osg::Matrixd::translate(4.5e6, -5.4e6, 3.3e2);
    osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(away);
    place->addChild(watched.root);
    View there = above;
    there.view = osg::Matrixd::inverse(away) * above.view;
    EXPECT_EQ(render(place, there).different(here), 0);
    Camera camera(watched.root, above);
    camera.viewer().getCamera()->setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_BOUNDING_VOLUMES);
    EXPECT_EQ(camera.frame().different(here), 0);
}

TEST(Halo, LeavesDepthStencilAndOpenGlAsTheyWere) {
    for (const auto shape : {HaloNode::WHOLE, HaloNode::PIXELS}) {
        Watched watched({level(0.0, 0.0, 0.5, 1.0)});
        watched.halo->setShape(shape);
        expectNothingIsLeft(watched.root, above, [&](bool on) {
            watched.halo->setWidth(on ? 3 : 0);
            watched.halo->setScale(on ? 2.0 : 1.0);
        });
    }
}

TEST(Halo, IsTheSameOverWhatOthersLeftInTheStencilBuffer) {
    for (const auto shape : {HaloNode::WHOLE, HaloNode::PIXELS}) {
        Watched watched({level(0.0, 0.0, 0.5, 1.0)});
        watched.halo->setShape(shape);
        watched.halo->setScale(2.0);
        watched.halo->setWidth(3);
        const Picture usual = watched.with();
        Camera camera(watched.root, above);
        osg::Camera& settings = *camera.viewer().getCamera();
        settings.setClearMask(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
        settings.setClearStencil(0xff);
        EXPECT_EQ(camera.frame().different(usual), 0) << shape;
    }
}

TEST(Halo, NeedsOneStencilBitAndSaysSoWhereThereIsNone) {
    Watched watched({level(0.0, 0.0, 0.5, 1.0)});
    watched.halo->setScale(2.0);
    const Picture without = watched.without();
    expectOneBitIsEnough(watched.root, *watched.halo, above, without);
}

// Sun at 45°, a lit ground that mirrors half of what it sees, a caster with a halo: each does what it does alone.
TEST(Halo, StandsBesideShadowAndMirrorInOneScene) {
    const View from = perspective({0.0, -9.0, 9.0}, {0.0, 0.0, 0.0}, 240, 180);
    for (const auto composite : {gnomon::ShadowCasterGroup::RELIGHT, gnomon::ShadowCasterGroup::BLEND}) {
        Scene lit = groundScene({});
        osg::Node* floor = find(*lit.root, "ground");
        osg::ref_ptr<HaloNode> halo = new HaloNode;
        halo->addChild(node(box({-0.5, -0.5, 1.0}, {0.5, 0.5, 2.0}), "caster"));
        lit.content->addChild(halo);
        osg::ref_ptr<gnomon::PlanarReflectionNode> mirror = new gnomon::PlanarReflectionNode;
        mirror->addChild(lit.content);
        mirror->setSurface({floor});
        mirror->setReflectance({0.5f, 0.5f, 0.5f});
        lit.root->replaceChild(lit.content, mirror);
        lit.content = mirror;
        const Picture mirrored = render(lit.root, from);
        lit.addShadow(planar(floor));
        lit.group->setComposite(composite);
        const Picture shadowed = render(lit.root, from);
        EXPECT_GT(shadowed.different(mirrored), 300);
        halo->setScale(1.3);
        const Picture all = render(lit.root, from);
        EXPECT_GT(blendedOnce(*halo, all, shadowed), 300);
        EXPECT_TRUE(halo->diagnose().empty() && mirror->diagnose().empty());
    }
}

// t = 0.1 … 3.1 a tenth a frame; sin 3.2 is negative.
TEST(HaloPulse, GrowsAndShrinksOnceInThirtyOneFrames) {
    Watched watched({level(0.0, 0.0, 0.5, 1.0)});
    const osg::ref_ptr<HaloPulse> pulse = new HaloPulse(0.5);
    watched.halo->setUpdateCallback(pulse);
    Camera camera(watched.root, above);
    camera.frame();
    EXPECT_EQ(watched.halo->getScale(), 1.0);
    pulse->start();
    for (int frame = 1; frame <= 31; ++frame) {
        camera.frame();
        EXPECT_NEAR(watched.halo->getScale(), 1.0 + 0.5 * std::sin(0.1 * frame), 1e-12) << frame;
        EXPECT_TRUE(pulse->isRunning());
    }
    camera.frame();
    EXPECT_EQ(watched.halo->getScale(), 1.0);
    EXPECT_FALSE(pulse->isRunning());
}

TEST(HaloNode, RefusesWhatIsNoNumberAndKeepsToItsRanges) {
    const osg::ref_ptr<HaloNode> halo = new HaloNode;
    halo->setScale(1.5);
    halo->setScale(NAN);
    EXPECT_EQ(halo->getScale(), 1.5);
    halo->setScale(0.3);
    EXPECT_EQ(halo->getScale(), 1.0);
    halo->setWidth(99);
    EXPECT_EQ(halo->getWidth(), 8);
    halo->setWidth(-1);
    EXPECT_EQ(halo->getWidth(), 0);
    halo->setColor({NAN, 0.0f, 0.0f, 0.0f});
    EXPECT_EQ(halo->getColor(), osg::Vec4f(0.8f, 0.8f, 0.0f, 0.3f));
    halo->setShape(static_cast<HaloNode::Shape>(77));
    EXPECT_EQ(halo->getShape(), HaloNode::WHOLE);
    const osg::ref_ptr<HaloNode> copy = static_cast<HaloNode*>(halo->clone(osg::CopyOp::SHALLOW_COPY));
    EXPECT_EQ(copy->getWidth(), 0);
}

// 2 s - 1 times the children's: see HaloNode::computeBound().
TEST(HaloNode, BoundFollowsItsScale) {
    const osg::ref_ptr<HaloNode> halo = new HaloNode;
    halo->addChild(node(test::box({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0})));
    const double own = std::sqrt(3.0);
    for (const double scale : {1.0, 1.5, 4.0, 2.0}) {
        halo->setScale(scale);
        EXPECT_NEAR(halo->getBound().radius(), (2.0 * scale - 1.0) * own, 1e-5);
    }
}
