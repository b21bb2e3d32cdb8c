// SPDX-License-Identifier: MIT
// Shadow volumes with what a scene brings along: cones of spots, samples, blending, more lights, other techniques.
#include "IntoTexture.h"
#include "VolumeTrial.h"

#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gtest/gtest.h>

using gnomon::ShadowVolumeTechnique;
using test::Picture;
using test::Scene;
using test::TracedCase;

namespace {

const std::vector<test::Mesh> casters{test::box({-1.0, -1.0, 0.0}, {1.0, 1.0, 2.0}),
                                      test::sphere({2.5, 1.0, 1.0}, 0.8, 16)};
const test::View view = test::perspective({-5.0, -9.0, 7.0}, {0.0, 0.0, 0.3}, 160, 120);

TracedCase given(const osg::Vec4d& light) {
    TracedCase all{"a box and a ball", {test::square(6.0)}, light, view};
    all.meshes.insert(all.meshes.end(), casters.begin(), casters.end());
    return all;
}

/// A ground of small squares, for OpenGL lights vertices.
Scene underSpot(bool lit) {
    TracedCase all = given({-2.0, -1.0, 6.0, 1.0});
    test::Mesh ground;
    for (int i = 0; i < 48 * 48; ++i) {
        const test::Mesh tile =
            test::quad({i % 48 * 0.25 - 6.0, i / 48 * 0.25 - 6.0, 0.0}, {0.25, 0.0, 0.0}, {0.0, 0.25, 0.0});
        ground.insert(ground.end(), tile.begin(), tile.end());
    }
    all.meshes.front() = ground;
    Scene scene = all.build();
    scene.light->getLight()->setDirection({0.3f, 0.2f, -1.0f});
    scene.light->getLight()->setSpotCutoff(32.0f);
    if (!lit) scene.takeLightAway();
    return scene;
}

TEST(VolumeCompany, ASpotCastsWithinItsCone) {
    Scene shadowed = underSpot(true);
    shadowed.addShadow(new ShadowVolumeTechnique);
    const Picture lit = test::render(underSpot(true).root, view), dark = test::render(underSpot(false).root, view);
    const test::TruthComparison found =
        test::compare(test::render(shadowed.root, view), lit, dark, given({-2.0, -1.0, 6.0, 1.0}).truth());
    EXPECT_LE(found.wrong, 1.10 * found.floor + 5) << found;
    EXPECT_EQ(found.certain, 0) << found;
    EXPECT_EQ(found.neither, 0) << found;
    EXPECT_GT(found.shadowed, 150) << found;
    EXPECT_LT(found.pixels, 9000) << "beyond the cone nothing is lit: " << found;
}

Picture inSamples(const Scene& scene) {
    test::IntoTexture into(scene.root, view,
                           {GL_RGBA8, osg::Camera::PACKED_DEPTH_STENCIL_BUFFER, GL_DEPTH24_STENCIL8_EXT, 4});
    into.camera->frame();
    return into.camera->frame();
}

/// Four samples a pixel halve the error of one.
TEST(VolumeCompany, SeveralSamplesSmoothItsEdges) {
    const TracedCase all = given({1.0, 0.4, 1.2, 0.0});
    Scene shadowed = all.build(), dark = all.build();
    shadowed.addShadow(new ShadowVolumeTechnique);
    dark.takeLightAway();
    const Picture lit = inSamples(all.build()), unlit = inSamples(dark), cast = inSamples(shadowed);
    const test::CaseTrial single = test::drawVolume(all);
    const double one = test::shareOff(single.cast, single.lit, single.dark, all.truth()),
                 four = test::shareOff(cast, lit, unlit, all.truth());
    EXPECT_LT(four, 0.6 * one);
    EXPECT_GT(one, 0.01) << "there are edges";
}

TEST(VolumeCompany, BlendDarkensWhatRelightDoes) {
    const TracedCase all = given({1.0, 0.4, 1.2, 0.0});
    const test::CaseTrial relit = test::drawVolume(all);
    Scene blended = all.build();
    blended.addShadow(new ShadowVolumeTechnique);
    blended.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    const Picture blend = test::render(blended.root, view);
    int onlyRelit = 0, onlyBlended = 0;
    for (std::size_t i = 0; i < blend.pixels.size(); ++i) {
        const bool a = relit.cast.pixels[i] != relit.lit.pixels[i], b = blend.pixels[i] != relit.lit.pixels[i];
        onlyRelit += a && !b;
        onlyBlended += b && !a && relit.lit.pixels[i] != relit.dark.pixels[i];
    }
    EXPECT_EQ(onlyRelit, 0);
    EXPECT_EQ(onlyBlended, 0) << "where the light arrives at all";
    EXPECT_GT(blend.different(relit.lit), 500);
}

Scene underThree(const std::vector<osg::ref_ptr<gnomon::ShadowTechnique>>& techniques) {
    Scene scene = given({1.0, 0.4, 1.2, 0.0}).build();
    scene.light->getLight()->setDiffuse({0.3f, 0.2f, 0.1f, 1.0f});
    const osg::Vec4 more[] = {{-1.0f, 0.3f, 1.0f, 0.0f}, {0.5f, -2.0f, 5.0f, 1.0f}};
    for (int i = 0; i < 2; ++i) {
        osg::ref_ptr<osg::LightSource> light = new osg::LightSource;
        light->getLight()->setLightNum(i + 1);
        light->getLight()->setPosition(more[i]);
        light->getLight()->setAmbient({0.0f, 0.0f, 0.0f, 1.0f});
        light->getLight()->setDiffuse({0.1f, 0.2f, 0.3f, 1.0f});
        light->getLight()->setSpecular({0.0f, 0.0f, 0.0f, 1.0f});
        scene.root->addChild(light);
        scene.root->getOrCreateStateSet()->setMode(GL_LIGHT1 + static_cast<unsigned>(i), osg::StateAttribute::ON);
    }
    if (!techniques.empty()) scene.addShadow(techniques.front());
    for (std::size_t i = 1; i < techniques.size(); ++i) scene.group->addChild(techniques[i]);
    return scene;
}

/// Of three lights rays and volumes say the same but for edges, and what stands beside volumes takes nothing away.
TEST(VolumeCompany, ThreeLightsAndOtherTechniquesTakeNothingFromIt) {
    const auto picture = [](const std::vector<osg::ref_ptr<gnomon::ShadowTechnique>>& techniques) {
        return test::render(underThree(techniques).root, view);
    };
    const Picture plain = picture({}), traced = picture({new gnomon::TracedShadowTechnique}),
                  volume = picture({new ShadowVolumeTechnique});
    EXPECT_GT(traced.different(plain), 1000);
    EXPECT_LE(volume.different(traced), 40) << "of some 400 pixels with edges";
    EXPECT_LE(picture({new ShadowVolumeTechnique, test::planar()}).different(volume), 10);
    EXPECT_LE(picture({test::planar(), new ShadowVolumeTechnique, new gnomon::TracedShadowTechnique}).different(traced),
              40);
}

} // namespace
