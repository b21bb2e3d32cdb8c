// SPDX-License-Identifier: MIT
// Soft edges: each pixel is the average, weighted by the share of each light that arrives, of renders made without Gnomon.
#include <support/DiscShadow.h>
#include <support/Picture.h>
#include <support/Scene.h>

#include <gtest/gtest.h>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/PolygonOffset>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

using namespace test;

namespace {

const View view = perspective({-6.0, -10.0, 8.0}, {0.0, 0.0, 0.0}, 200, 150);
const std::vector<Mesh> things = {box({-1.0, -1.0, 0.0}, {1.0, 1.0, 1.5}), sphere({2.0, 2.0, 1.5}, 0.8, 12)};
const osg::Vec4 white(1.0f, 1.0f, 1.0f, 1.0f);

/// @param dark   bit i: light i without its diffuse.
/// @param share  of white, each light's diffuse: with several of 0.6 what is lit saturates.
Scene build(int lights, unsigned dark, float share) {
    Scene scene = groundScene(things, 6.0, {1.0, 0.3, 1.2, 0.0});
    const auto diffuse = [&](int i) {
        return dark & (1u << i) ? osg::Vec4() : osg::Vec4(share, share / 2, share / 3, 1);
    };
    scene.light->getLight()->setDiffuse(diffuse(0));
    const osg::Vec4 suns[] = {{}, {-1.0f, 0.5f, 1.0f, 0.0f}, {0.3f, -1.0f, 1.2f, 0.0f}};
    for (int i = 1; i < lights; ++i) {
        osg::ref_ptr<osg::LightSource> light = new osg::LightSource;
        light->getLight()->setLightNum(i);
        light->getLight()->setPosition(suns[i]);
        light->getLight()->setAmbient({0.05f, 0.0f, 0.0f, 1.0f});
        light->getLight()->setDiffuse(diffuse(i));
        scene.root->addChild(light);
        scene.root->getOrCreateStateSet()->setMode(GL_LIGHT0 + static_cast<unsigned>(i), osg::StateAttribute::ON);
    }
    return scene;
}

osg::ref_ptr<DiscShadow> disc(double x, double y, double inner, double outer, int light = -1) {
    osg::ref_ptr<DiscShadow> result = new DiscShadow({x, y}, inner, outer);
    result->size.set(view.width, view.height);
    if (light >= 0) result->lights = {light};
    return result;
}

using Discs = std::vector<osg::ref_ptr<DiscShadow>>;

int channel(std::uint32_t pixel, int i) { return static_cast<int>(pixel >> (8 * i) & 0xffu); }

/// Largest difference of a channel from the weighted average; and whether pixels that all light reaches are untouched.
struct Errors {
    double largest = 0.0;
    int litChanged = 0, alphaLost = 0, shaded = 0;
};

/// Share of light i that arrives: the product of its discs', which overlap in no test as one would see it.
double shareOf(const Discs& discs, int light, int x, int y) {
    double share = 1.0;
    for (const auto& each : discs)
        if (each->lights.empty() || each->lights.count(light)) share *= each->arriving(x, y);
    return share;
}

Errors compare(const Picture& actual, const std::vector<Picture>& renders, const Discs& discs, int lights) {
    Errors errors;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            std::vector<double> weights;
            for (unsigned dark = 0; dark < renders.size(); ++dark) {
                double weight = 1.0;
                for (int i = 0; i < lights; ++i) {
                    const double share = shareOf(discs, i, x, y);
                    weight *= dark & (1u << i) ? 1.0 - share : share;
                }
                weights.push_back(weight);
            }
            errors.shaded += weights[0] < 1.0;
            errors.litChanged += weights[0] == 1.0 && actual.at(x, y) != renders[0].at(x, y);
            errors.alphaLost += channel(actual.at(x, y), 3) != 255;
            for (int i = 0; i < 3; ++i) {
                double expected = 0.0;
                for (unsigned dark = 0; dark < renders.size(); ++dark)
                    expected += weights[dark] * channel(renders[dark].at(x, y), i);
                errors.largest = std::max(errors.largest, std::abs(expected - channel(actual.at(x, y), i)));
            }
        }
    return errors;
}

Errors errorsOf(
    int lights, float share, const Discs& discs, gnomon::ShadowCasterGroup::Composite composite,
    const std::function<void(Scene&)>& change = [](Scene&) {}) {
    std::vector<Picture> renders;
    for (unsigned dark = 0; dark < (1u << lights); ++dark) {
        Scene scene = build(lights, dark, share);
        change(scene);
        renders.push_back(render(scene.root, view));
    }
    Scene scene = build(lights, 0, share);
    change(scene);
    for (const auto& each : discs) scene.addShadow(each);
    scene.group->setComposite(composite);
    return compare(render(scene.root, view), renders, discs, lights);
}

constexpr auto relight = gnomon::ShadowCasterGroup::RELIGHT;

} // namespace

// Two roundings: of alpha, and of the mix; each at most half of 1/255 of the difference, and the renders' own.
TEST(SoftEdges, OneLightIsMixedToTwoSteps) {
    const Errors errors = errorsOf(1, 0.7f, {disc(100.0, 75.0, 20.0, 60.0)}, relight);
    EXPECT_GT(errors.shaded, 5000);
    EXPECT_LE(errors.largest, 2.0);
    EXPECT_EQ(errors.litChanged, 0);
    EXPECT_EQ(errors.alphaLost, 0);
}

TEST(SoftEdges, TwoLightsAreWeighedToThreeStepsAlsoWhereTheySaturate) {
    for (const float share : {0.3f, 0.9f}) {
        const Errors errors =
            errorsOf(2, share, {disc(90.0, 75.0, 10.0, 50.0, 0), disc(120.0, 70.0, 15.0, 45.0, 1)}, relight);
        EXPECT_GT(errors.shaded, 5000);
        EXPECT_LE(errors.largest, 3.0) << share;
        EXPECT_EQ(errors.litChanged, 0);
        EXPECT_EQ(errors.alphaLost, 0);
    }
}

// Eight weights and as many roundings.
TEST(SoftEdges, ThreeLightsAreWeighedToFiveSteps) {
    const Errors errors = errorsOf(
        3, 0.25f, {disc(90.0, 75.0, 10.0, 50.0, 0), disc(120.0, 70.0, 15.0, 45.0, 1), disc(100.0, 95.0, 5.0, 40.0, 2)},
        relight);
    EXPECT_LE(errors.largest, 5.0);
    EXPECT_EQ(errors.litChanged, 0);
    EXPECT_EQ(errors.alphaLost, 0);
}

TEST(SoftEdges, AreLookedUpOnceALightHoweverManyLightsThereAre) {
    for (const int lights : {1, 2, 3}) {
        Scene scene = build(lights, 0, 0.25f);
        Discs discs;
        for (int i = 0; i < lights; ++i) scene.addShadow(discs.emplace_back(disc(90.0, 75.0, 10.0, 50.0, i)).get());
        scene.group->setComposite(relight);
        render(scene.root, view);
        for (const auto& each : discs) EXPECT_EQ(*each->draws, 1) << lights;
    }
}

TEST(SoftEdges, ALightWithHardEdgesStandsBesideOneWithSoft) {
    const Errors errors =
        errorsOf(2, 0.3f, {disc(90.0, 75.0, 10.0, 50.0, 0), disc(120.0, 70.0, 30.0, 30.0, 1)}, relight);
    EXPECT_LE(errors.largest, 3.0);
    EXPECT_EQ(errors.litChanged, 0);
}

TEST(SoftEdges, OneLightMayHaveBothKindsOfEdges) {
    const Errors errors = errorsOf(1, 0.7f, {disc(90.0, 75.0, 10.0, 50.0), disc(120.0, 70.0, 30.0, 30.0)}, relight);
    EXPECT_LE(errors.largest, 2.0);
    EXPECT_EQ(errors.litChanged, 0);
}

TEST(SoftEdges, OfTwoLightsOneMayHaveBothKindsOfEdges) {
    const Errors errors = errorsOf(
        2, 0.3f, {disc(80.0, 75.0, 10.0, 50.0, 0), disc(110.0, 70.0, 30.0, 30.0, 0), disc(120.0, 80.0, 15.0, 45.0, 1)},
        relight);
    EXPECT_LE(errors.largest, 3.0);
    EXPECT_EQ(errors.litChanged, 0);
    EXPECT_EQ(errors.alphaLost, 0);
}

TEST(SoftEdges, BlendDarkensByTheShareOfTheFactor) {
    for (const float dark : {0.0f, 0.3f, 0.5f, 0.9f}) {
        const auto shadow = disc(100.0, 75.0, 20.0, 60.0);
        Scene scene = build(1, 0, 0.7f);
        const Picture lit = render(scene.root, view);
        scene.addShadow(shadow);
        scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
        scene.group->setDark(dark);
        const Picture actual = render(scene.root, view);
        double largest = 0.0;
        int litChanged = 0;
        for (int y = 0; y < view.height; ++y)
            for (int x = 0; x < view.width; ++x) {
                const double share = lit.at(x, y) == 0xff400000u ? 1.0 : shadow->arriving(x, y); // background: none
                litChanged += share == 1.0 && actual.at(x, y) != lit.at(x, y);
                for (int i = 0; i < 3; ++i) {
                    const double expected = channel(lit.at(x, y), i) * (dark + (1.0 - dark) * share);
                    largest = std::max(largest, std::abs(expected - channel(actual.at(x, y), i)));
                }
            }
        EXPECT_LE(largest, 2.0) << dark;
        EXPECT_EQ(litChanged, 0) << dark;
    }
}

TEST(SoftEdges, BlendMultipliesTheSharesOfSoftAndOfHardEdges) {
    const Discs shadows{disc(90.0, 75.0, 10.0, 50.0), disc(125.0, 70.0, 30.0, 30.0)};
    Scene scene = build(1, 0, 0.7f);
    const Picture lit = render(scene.root, view);
    for (const auto& shadow : shadows) scene.addShadow(shadow);
    scene.group->setComposite(gnomon::ShadowCasterGroup::BLEND);
    scene.group->setDark(0.0f);
    const Picture actual = render(scene.root, view);
    double largest = 0.0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            double share = 1.0;
            for (const auto& shadow : shadows) share *= lit.at(x, y) == 0xff400000u ? 1.0 : shadow->arriving(x, y);
            for (int i = 0; i < 3; ++i)
                largest = std::max(largest, std::abs(channel(lit.at(x, y), i) * share - channel(actual.at(x, y), i)));
        }
    EXPECT_LE(largest, 2.0);
}

namespace {

void unlit(Scene& scene) {
    find(*scene.root, "ground")->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
}

void unlitDecal(Scene& scene) {
    const osg::ref_ptr<osg::Geode> decal = node(square(3.0), "decal");
    osg::StateSet* state = decal->getOrCreateStateSet();
    state->setAttributeAndModes(new osg::PolygonOffset(-1.0f, -1.0f));
    state->setAttributeAndModes(new osg::Depth(osg::Depth::LEQUAL, 0.0, 1.0, false));
    state->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    scene.content->addChild(decal);
}

/// Pixels whose channels are farther from lit · (0.5 + 0.5 share) than 2, of those that `receiver` alone colours.
int wrongFaded(const std::function<void(Scene&)>& change, std::uint32_t colour, int lights) {
    Scene scene = build(lights, 0, 0.3f);
    change(scene);
    const Picture lit = render(scene.root, view);
    const auto shadow = disc(100.0, 75.0, 20.0, 60.0);
    scene.addShadow(shadow);
    const Picture actual = render(scene.root, view);
    EXPECT_EQ(shadow->diagnose().size(), 1u);
    int wrong = 0, faded = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            if (lit.at(x, y) != colour) continue;
            double none = 1.0;
            for (int i = 0; i < lights; ++i) none *= shadow->arriving(x, y);
            const double expected = channel(colour, 0) * (0.5 + 0.5 * none);
            wrong += std::abs(expected - channel(actual.at(x, y), 0)) > 2.0;
            faded += none < 1.0;
        }
    EXPECT_GT(faded, 1000);
    return wrong;
}

} // namespace

TEST(SoftEdges, UnlitReceiversAndDecalsAreDarkenedByTheFactorAndReported) {
    for (const int lights : {1, 2}) {
        EXPECT_EQ(wrongFaded(unlit, 0xffffffffu, lights), 0) << lights;
        EXPECT_EQ(wrongFaded(unlitDecal, 0xffffffffu, lights), 0) << lights;
    }
}

// A picture to be laid over another has an alpha of 0 where nothing stands.
TEST(SoftEdges, ABackgroundKeepsItsAlpha) {
    const auto draw = [](Scene& scene) {
        Camera camera(scene.root, view);
        camera.viewer().getCamera()->setClearColor({0.0f, 0.0f, 0.25f, 0.0f});
        return camera.frame();
    };
    for (const auto composite : {relight, gnomon::ShadowCasterGroup::BLEND})
        for (const int lights : {1, 2}) {
            Scene scene = build(lights, 0, 0.3f);
            const Picture lit = draw(scene);
            scene.addShadow(disc(100.0, 100.0, 20.0, 90.0));
            scene.addShadow(disc(100.0, 100.0, 10.0, 10.0));
            scene.group->setComposite(composite);
            const Picture actual = draw(scene);
            int background = 0, changed = 0, clear = 0;
            for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
                const bool stands = channel(lit.pixels[i], 3) == 255;
                background += !stands;
                changed += !stands && actual.pixels[i] != lit.pixels[i];
                clear += stands && channel(actual.pixels[i], 3) != 255;
            }
            EXPECT_GT(background, 1000);
            EXPECT_EQ(changed, 0) << lights << " lights, composite " << composite;
            EXPECT_EQ(clear, 0) << lights << " lights, composite " << composite;
        }
}

TEST(SoftEdges, NamedReceiverAloneReceives) {
    for (const int lights : {1, 2}) {
        Scene scene = build(lights, 0, 0.3f), gone = build(lights, (1u << lights) - 1, 0.3f);
        const Picture lit = render(scene.root, view), dark = render(gone.root, view);
        find(*gone.root, "ground")->setNodeMask(0);
        const auto shadow = disc(100.0, 75.0, 20.0, 60.0);
        shadow->setReceiver({find(*scene.root, "ground")});
        scene.addShadow(shadow);
        const Picture actual = render(scene.root, view);
        const Picture withoutGround = render(gone.root, view);
        int ground = 0, others = 0, wrong = 0;
        for (std::size_t i = 0; i < lit.pixels.size(); ++i) {
            const bool isGround = withoutGround.pixels[i] == 0xff400000u && lit.pixels[i] != 0xff400000u;
            const bool changed = actual.pixels[i] != lit.pixels[i];
            ground += isGround && changed;
            others += !isGround && changed;
            wrong += shadow->arriving(static_cast<int>(i) % view.width, static_cast<int>(i) / view.width) == 0.0 &&
                     isGround && actual.pixels[i] != dark.pixels[i];
        }
        EXPECT_GT(ground, 2000) << lights;
        EXPECT_EQ(others, 0) << lights;
        EXPECT_EQ(wrong, 0) << lights;
    }
}
