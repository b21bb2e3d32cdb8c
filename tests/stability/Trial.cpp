// SPDX-License-Identifier: MIT
#include "Trial.h"

#include <gnomon/ShadowMapTechnique.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>

#include <algorithm>

namespace test {
namespace {

using gnomon::ShadowCasterGroup;

By casting = By::Planar;

/// Pixels from an edge to where a picture must be right.
int edgeReach(const Truth& truth) { return casting == By::Map ? truth.mapEdge : 1; }
/// True if what faces away from the light is in shadow, as its own.
bool shadowsWhatFacesAway() { return casting == By::Traced || casting == By::Map || casting == By::Volume; }

::testing::AssertionResult judged(const Comparison& found) {
    if (found.wrongInside == 0 && found.wrongAtEdge == 0) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << found.wrongInside << " pixels away from edges are wrong, "
                                         << found.wrongAtEdge << " at edges are neither lit nor dark";
}

template <typename Technique>
osg::ref_ptr<gnomon::ShadowTechnique> smoothly() {
    osg::ref_ptr<Technique> technique = new Technique;
    technique->setEdges(Technique::SMOOTH);
    return technique;
}

void blendToBlack(Scene& scene) {
    scene.group->setComposite(ShadowCasterGroup::BLEND);
    scene.group->setDark(0.0f);
}

} // namespace

ByTechnique::ByTechnique() { casting = GetParam(); }
ByTechnique::~ByTechnique() { casting = By::Planar; }

std::ostream& operator<<(std::ostream& out, By technique) {
    constexpr const char* names[] = {"Planar", "Hull",         "Traced",       "Map",
                                     "Volume", "SmoothPlanar", "SmoothTraced", "SmoothVolume"};
    return out << names[static_cast<int>(technique)];
}

osg::ref_ptr<gnomon::ShadowTechnique> castingTechnique(osg::Node* receiver) {
    if (casting == By::Planar) return planar(receiver);
    osg::ref_ptr<gnomon::ShadowTechnique> technique;
    if (casting == By::SmoothPlanar) {
        const osg::ref_ptr<gnomon::PlanarShadowNode> smooth = planar(receiver);
        smooth->setEdges(gnomon::PlanarShadowNode::SMOOTH);
        return smooth;
    }
    if (casting == By::SmoothTraced)
        technique = smoothly<gnomon::TracedShadowTechnique>();
    else if (casting == By::SmoothVolume)
        technique = smoothly<gnomon::ShadowVolumeTechnique>();
    else if (casting == By::Traced)
        technique = new gnomon::TracedShadowTechnique;
    else if (casting == By::Map)
        technique = new gnomon::ShadowMapTechnique;
    else if (casting == By::Volume)
        technique = new gnomon::ShadowVolumeTechnique;
    else
        technique = new gnomon::TerrainShadowGeode;
    if (receiver) technique->setReceiver({receiver});
    return technique;
}

Scene Trial::buildWithShadow() const {
    Scene result = build();
    result.addShadow(castingTechnique(casting != By::Planar ? find(*result.root, "ground") : nullptr));
    return result;
}

namespace {

Truth truthOf(const Trial& trial, const Change& change, const osg::Vec4d& lightOfRays) {
    Scene lit = trial.build(), dark = trial.build();
    dark.takeLightAway();
    for (Scene* scene : {&lit, &dark}) change(*scene);
    return {render(lit.root, trial.view), render(dark.root, trial.view),
            castRays(square(trial.half), trial.casters, lightOfRays, trial.view), trial.mapEdge};
}

void leave(Scene&) {}

} // namespace

Truth truthOf(const Trial& trial, const osg::Vec4d& lightOfRays) { return truthOf(trial, leave, lightOfRays); }
Truth truthOf(const Trial& trial, const Change& change) { return truthOf(trial, change, trial.light); }
Truth truthOf(const Trial& trial) { return truthOf(trial, leave); }

Picture black(const Picture& sizeOf) {
    Picture result = sizeOf;
    std::fill(result.pixels.begin(), result.pixels.end(), grey(0));
    return result;
}

::testing::AssertionResult shows(const Picture& actual, const Truth& truth) {
    return judged(compare(actual, truth.lit, truth.dark, truth.mask, edgeReach(truth)));
}

::testing::AssertionResult showsInBlack(const Picture& actual, const Truth& truth) {
    return judged(compare(actual, truth.lit, black(truth.lit), truth.mask, edgeReach(truth)));
}

::testing::AssertionResult same(const Picture& actual, const Picture& expected) {
    if (actual.pixels.size() != expected.pixels.size()) return ::testing::AssertionFailure() << "sizes differ";
    if (const int different = actual.different(expected))
        return ::testing::AssertionFailure() << different << " pixels differ";
    return ::testing::AssertionSuccess();
}

::testing::AssertionResult isRight(Scene& scene, const View& view, const Truth& truth) {
    Camera camera(scene.root, view);
    for (const char* frame : {"first", "second"})
        if (auto relit = shows(camera.frame(), truth); !relit) return relit << ", relit, " << frame << " frame";
    blendToBlack(scene);
    if (auto blended = showsInBlack(camera.frame(), truth); !blended) return blended << ", blended";
    return ::testing::AssertionSuccess();
}

::testing::AssertionResult isRight(const Trial& trial, const Change& change) {
    Scene scene = trial.buildWithShadow();
    change(scene);
    return isRight(scene, trial.view, truthOf(trial, change));
}

::testing::AssertionResult isRight(const Trial& trial) { return isRight(trial, leave); }

::testing::AssertionResult isUnshadowed(Scene& scene, const View& view, const Picture& lit, Ground turned) {
    Camera camera(scene.root, view);
    for (const char* frame : {"first", "second"})
        if (auto relit = same(camera.frame(), lit); !relit) return relit << ", relit, " << frame << " frame";
    if (shadowsWhatFacesAway() && turned == Ground::Away)
        return ::testing::AssertionSuccess(); // blends what shadows itself
    blendToBlack(scene);
    if (auto blended = same(camera.frame(), lit); !blended) return blended << ", blended";
    return ::testing::AssertionSuccess();
}

::testing::AssertionResult isUnshadowed(const Trial& trial) {
    Scene scene = trial.buildWithShadow();
    const Ground turned = trial.light.z() > 0.0 ? Ground::ToTheLight : Ground::Away;
    return isUnshadowed(scene, trial.view, render(trial.build().root, trial.view), turned);
}

} // namespace test
