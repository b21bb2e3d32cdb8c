// SPDX-License-Identifier: MIT
// Drawing again only what the marks can touch gives the picture of drawing everything again.
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/PolygonOffset>

using namespace test;

namespace {

const View slanted = perspective({-20.0, -28.0, 20.0}, {0.0, 0.0, 0.0}, 400, 300, 40.0, 1.0, 200.0);

/// A decal over the ground: drawn after it, offset towards the eye, depth not written.
void addDecal(Scene& scene) {
    const osg::ref_ptr<osg::Geode> decal = node(square(3.0), "decal");
    osg::StateSet* state = decal->getOrCreateStateSet();
    state->setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
    state->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    static_cast<osg::Vec4Array*>(decal->getDrawable(0)->asGeometry()->getColorArray())
        ->front()
        .set(1.0f, 0.0f, 0.0f, 1.0f);
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    scene.content->addChild(decal);
}

Scene build(bool named, bool groundLast, bool decal) {
    Scene scene = groundScene(town(6), 18.0);
    if (groundLast) {
        const osg::ref_ptr<osg::Node> ground = scene.content->getChild(0);
        scene.content->removeChild(0u, 1u);
        scene.content->addChild(ground);
    }
    if (decal) addDecal(scene);
    scene.addShadow(planar(named ? find(*scene.root, "ground") : nullptr));
    return scene;
}

Picture picture(bool named, bool groundLast, bool decal, bool filter) {
    const Scene scene = build(named, groundLast, decal);
    return render(filter ? scene.root.get() : test::unfiltered(scene.root), slanted);
}

} // namespace

TEST(ReplaySelection, FilteredIsUnfilteredBitForBit) {
    for (const bool named : {false, true})
        for (const bool groundLast : {false, true})
            for (const bool decal : {false, true})
                EXPECT_EQ(picture(named, groundLast, decal, true).different(picture(named, groundLast, decal, false)),
                          0)
                    << "named " << named << ", ground last " << groundLast << ", decal " << decal;
}

// Named, only the ground receives; else the decal does too, and as it is unlit, takes the factor in its own colour.
TEST(ReplaySelection, UnlitDecalOverTheReceiverStaysOverItsShadow) {
    const std::uint32_t red = 0xff0000ffu;
    for (const bool named : {false, true}) {
        Scene scene = build(named, false, true);
        const Picture shadowed = render(scene.root, slanted);
        scene.group->removeChildren(1, 1);
        const Picture lit = render(scene.root, slanted);
        EXPECT_GT(std::count(lit.pixels.begin(), lit.pixels.end(), red), 500);
        int lost = 0, faded = 0;
        for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
            if (lit.pixels[i] != red) continue;
            const std::uint32_t half = shadowed.pixels[i] & 0xffffff00u; // red 127 or 128: half of an odd byte
            faded += half == 0xff000000u && shadowed.pixels[i] != red;
            lost += half != 0xff000000u;
        }
        EXPECT_EQ(lost, 0) << "named " << named;
        EXPECT_EQ(faded > 100, !named) << faded;
    }
}
