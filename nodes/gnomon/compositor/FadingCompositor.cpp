// SPDX-License-Identifier: MIT
#include <gnomon/compositor/FadingCompositor.h>
#include <gnomon/compositor/FoundEdges.h>
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/ShadowJob.h>

#include <algorithm>
#include <optional>

namespace gnomon {

namespace {

std::vector<Jobs> fadingOf(const MarkedLights& lights) {
    std::vector<Jobs> fading;
    for (const MarkedLight& light : lights)
        if (!light.fading.empty()) fading.push_back(light.fading);
    return fading;
}

StencilMarks::MarkFading markBy(const LightShares& shares) {
    return [&shares](const ShadowJob& job, unsigned bit) { shares.mark(job, bit); };
}

/// @param lost  the light is.
void weighOne(const MarkedLight& light, bool lost, const LightShares& shares, ScreenPass& screen) {
    if (!light.fading.empty()) {
        screen.stencilEqual(light.fadingBit, light.bits(), 0);
        shares.multiplyAlpha(*light.fading.front(), lost, screen);
    }
    if (lost)
        screen.stencilEqual(0, light.bits(), 0);
    else if (light.hardBit)
        screen.stencilAny(light.hardBit);
    if (lost || light.hardBit) screen.setAlpha(0.0f);
}

} // namespace

FadingCompositor::FadingCompositor(const CompositorStage& draw) : _draw(draw), _marks(draw, true) {}

/// Multiplies alpha by the share that arrives, too; that of a job which finds edges becomes the share.
StencilMarks::MarkFading FadingCompositor::markWeighed() const {
    return [this](const ShadowJob& job, unsigned bit) {
        std::optional<FoundEdges> edges;
        if (job.findsEdges) edges.emplace(_draw, job, bit);
        _draw.pass(job.mark->screenBounds, [&](ScreenPass& screen) {
            edges ? screen.beginAlpha() : screen.multiplyAlpha();
            screen.ask(ScreenPass::Want::Touched, bit);
            job.report(edges ? edges->draw(screen) : job.mark->draw(screen));
        });
    };
}

void FadingCompositor::relight(const Jobs& wanted) const {
    const MarkedLights lights = _marks.lightsOf(wanted);
    const Jobs jobs = jobsOf(lights);
    if (jobs.empty()) return;
    const ScreenRect bounds = screenBoundsOf(jobs);
    Leaves leaves = leavesToReplay(_draw, jobs, bounds);
    const Leaves aside = setAside(leaves, jobs);
    const bool weighsAtOnce = jobs.size() == 1 && jobs.front()->fades() && aside.empty();
    _marks.clearLeftovers(bitsOf(lights));
    const LightShares shares(_draw, weighsAtOnce ? std::vector<Jobs>() : fadingOf(lights), _marks.firstBit());
    const Weights weights{lights, shares, weighsAtOnce};
    if (weighsAtOnce) _draw.pass(bounds, [](ScreenPass& screen) { screen.setAlpha(1.0f); });
    _marks.mark(lights, weighsAtOnce ? markWeighed() : markBy(shares));
    if (!aside.empty()) darkenAside(aside, weights, jobs);
    mix(leaves, weights, jobs);
    _draw.pass(bounds, [](ScreenPass& screen) { screen.setAlpha(1.0f); });
    _draw.clear(bitsOf(lights), bounds);
}

/// Takes out of `leaves` those that cannot be mixed. What receives nothing and is not drawn over others stays as it is.
FadingCompositor::Leaves FadingCompositor::setAside(Leaves& leaves, const Jobs& jobs) const {
    LeafReplay::Overlay overlay;
    overlay.lightUniforms = lightUniformsOf(jobs);
    LeafReplay judge(_draw, overlay);
    Leaves aside, mixed;
    for (const ReplayedLeaf& leaf : leaves) {
        if (leaf.isBehind) continue;
        const auto ofLens = [&leaf](const ShadowJob* job) { return job->isOfLens(*leaf.entry.leaf); };
        const bool laidOver = leaf.lost == 0 && !std::all_of(jobs.begin(), jobs.end(), ofLens);
        const bool hides = isOpaque(leaf.entry.leaf->_parent) || (leaf.lost && jobs.front()->hidingOnly);
        if (!hides || laidOver)
            aside.push_back(leaf);
        else if (leaf.lost)
            (!leaf.isCatcher && judge.canBeRelit(leaf.entry, leaf.lost) ? mixed : aside).push_back(leaf);
    }
    leaves = mixed;
    return aside;
}

/// What cannot be mixed keeps its colour, times the factor where it lost light; no light bit stays set there.
void FadingCompositor::darkenAside(const Leaves& aside, const Weights& weights, const Jobs& jobs) const {
    const ScreenRect bounds = screenBoundsOf(jobs);
    Leaves kept, darkened;
    const unsigned faded = _marks.fadedBit();
    for (const ReplayedLeaf& leaf : aside) (leaf.lost && faded ? darkened : kept).push_back(leaf);
    if (!kept.empty()) writeWhereSeen(_draw, kept, {0, bitsOf(weights.lights), _marks.scratchBit()}, bounds);
    if (darkened.empty()) return;
    writeWhereSeen(_draw, darkened, {faded, faded, faded}, bounds);
    multiplyByFactor(weights, jobs.front()->dark, bounds);
    _draw.clear(faded, wholeScreen); // leaves are not cut to the bounds
    if (!keptBy<StageVerdict>(_draw.stage).askToName()) return;
    for (const ReplayedLeaf& leaf : darkened)
        reportAll(jobs,
                  "no part of a light can be taken from '" + nameOf(*leaf.entry.leaf) +
                      "', because it is unlit, blends, writes no depth or no colour, or its program does not read "
                      "gl_LightSource. Its colour is multiplied by setDark() (dark=) instead. Light it with OpenGL, or "
                      "leave it out of the "
                      "receiver.");
}

void FadingCompositor::multiplyByFactor(const Weights& weights, float factor, const ScreenRect& bounds) const {
    weigh(weights, 0, bounds);
    _draw.pass(bounds, [&](ScreenPass& screen) {
        screen.stencilAny(_marks.fadedBit());
        screen.fadeAlpha(factor);
        screen.takeStencil(_marks.fadedBit(), bitsOf(weights.lights) | _marks.fadedBit());
        screen.multiplyColorByAlpha();
    });
}

void FadingCompositor::mix(const Leaves& leaves, const Weights& weights, const Jobs& jobs) const {
    const MarkedLights& lights = weights.lights;
    if (lights.size() > 1) {
        weigh(weights, 0, screenBoundsOf(jobs));
        _draw.pass(screenBoundsOf(jobs), [&](ScreenPass& screen) {
            screen.stencilAny(bitsOf(lights));
            screen.multiplyColorByAlpha();
        });
    }
    for (unsigned lost = 1; lost < (1u << lights.size()); ++lost) {
        const ScreenRect bounds = boundsWithout(lights, lost);
        if (isEmpty(bounds)) continue;
        if (!weights.areInAlpha) weigh(weights, lights.size() == 1 ? 0 : lost, bounds);
        replay(leaves, lights, lost, bounds, jobs);
    }
}

/// Adds what the leaves look like without the lights of `lost` (bit i: lights[i]); of one light, mixes it in.
void FadingCompositor::replay(const Leaves& leaves, const MarkedLights& lights, unsigned lost, const ScreenRect& bounds,
                              const Jobs& jobs) const {
    LeafReplay::Overlay overlay;
    overlay.bounds = bounds;
    const MarkedLights dark = subsetOf(lights, lost);
    for (const MarkedLight& light : dark)
        if (!light.isMixed()) overlay.test |= light.bits();
    overlay.stencilFunction =
        overlay.test ? GL_EQUAL : GL_NOTEQUAL; // every light of `lost`, as far as one test can tell
    overlay.reference = overlay.test;
    if (!overlay.test) overlay.test = bitsOf(lights);
    overlay.equalDepth = true;
    overlay.color = lights.size() == 1 ? LeafReplay::Color::Mix : LeafReplay::Color::Add;
    overlay.lightUniforms = lightUniformsOf(jobs);
    LeafReplay replay(_draw, overlay);
    unsigned lostNumbers = 0;
    for (const MarkedLight& light : dark) lostNumbers |= 1u << light.number;
    TouchTest touches(bounds, jobs.front()->moved.get());
    for (const ReplayedLeaf& leaf : leaves)
        if (!_draw.options.skipsUntouched || touches(*leaf.entry.leaf))
            replay.draw(leaf.entry, leaf.lost & lostNumbers);
}

/// Where pixels can lose all of these lights; with a light of two bits in use, which one stencil test cannot ask for,
/// where they can lose any of all lights.
ScreenRect FadingCompositor::boundsWithout(const MarkedLights& lights, unsigned lost) const {
    const bool mixed = std::any_of(lights.begin(), lights.end(), [](const auto& light) { return light.isMixed(); });
    return mixed ? screenBoundsOf(jobsOf(lights)) : commonBounds(subsetOf(lights, lost));
}

/// Alpha becomes the share of each pixel that sees all lights but those of `lost`.
void FadingCompositor::weigh(const Weights& weights, unsigned lost, const ScreenRect& bounds) const {
    _draw.pass(bounds, [&](ScreenPass& screen) {
        screen.setAlpha(1.0f);
        for (std::size_t i = 0; i < weights.lights.size(); ++i)
            weighOne(weights.lights[i], lost & (1u << i), weights.shares, screen);
    });
}

/// What the marks of these jobs, which share `bit`, take of the light multiplies alpha.
void FadingCompositor::addBlended(const Jobs& jobs, const LightShares& shares, unsigned bit) const {
    for (const ShadowJob* job : jobs) {
        _marks.add(*job, bit, job == jobs.front(), markBy(shares));
        writeWhereSeen(_draw, notOfLens(*job, _draw.leaves), {0, bit, _marks.scratchBit()}, job->mark->screenBounds);
    }
    _draw.pass(screenBoundsOf(jobs), [&](ScreenPass& screen) {
        screen.stencilAny(bit);
        if (jobs.front()->fades())
            shares.multiplyAlpha(*jobs.front(), false, screen);
        else
            screen.setAlpha(0.0f);
    });
}

void FadingCompositor::blend(const Jobs& jobs, float dark) const {
    const ScreenRect bounds = screenBoundsOf(jobs);
    const unsigned bit = _marks.firstBit();
    _marks.clearLeftovers(bit);
    const auto weighsAtOnce = [&](const ShadowJob& job) {
        const auto isOfLight = [&job](const ShadowJob* other) { return other->light == job.light; };
        return job.fades() && !job.receiverNamed && notOfLens(job, _draw.leaves).empty() &&
               (job.findsEdges ? jobs.size() : std::size_t(std::count_if(jobs.begin(), jobs.end(), isOfLight))) == 1;
    };
    Jobs atOnce;
    std::vector<Jobs> apart, lookedUp;
    for (const ShadowJob* job : jobs) {
        const auto hasSame = [job](const Jobs& known) {
            return known.front()->light == job->light && areOnTheSame(*known.front(), *job);
        };
        const auto same = std::find_if(lookedUp.begin(), lookedUp.end(), hasSame);
        if (weighsAtOnce(*job))
            atOnce.push_back(job);
        else if (!job->fades())
            apart.push_back({job});
        else if (same != lookedUp.end())
            same->push_back(job);
        else
            lookedUp.push_back({job});
    }
    const LightShares shares(_draw, lookedUp, bit);
    _draw.pass(bounds, [](ScreenPass& screen) { screen.setAlpha(1.0f); });
    apart.insert(apart.end(), lookedUp.begin(), lookedUp.end());
    const bool isLone = atOnce.size() + apart.size() == 1;
    for (const ShadowJob* job : atOnce) {
        _marks.add(*job, bit, true, markWeighed());
        if (!isLone) _draw.clear(bit, job->mark->screenBounds);
    }
    for (const Jobs& together : apart) {
        addBlended(together, shares, bit);
        if (!isLone) _draw.clear(bit, screenBoundsOf(together));
    }
    _draw.pass(bounds, [&](ScreenPass& screen) {
        if (isLone) screen.stencilAny(bit); // elsewhere alpha is 1
        screen.fadeAlpha(dark);
        screen.multiplyColorByAlpha();
        screen.setAlpha(1.0f);
    });
    if (isLone) _draw.clear(bit, bounds);
}

} // namespace gnomon
