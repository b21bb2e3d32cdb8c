// SPDX-License-Identifier: MIT
#include <gnomon/compositor/Compositor.h>
#include <gnomon/compositor/FadingCompositor.h>
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/PrepassBin.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/gl/FrameDepths.h>

#include <algorithm>
#include <iterator>
#include <optional>

namespace gnomon {
namespace {

/// Jobs that share a lens: what is seen through one, another that is laid over it must not take for its own.
std::vector<Jobs> byLens(const Jobs& jobs) {
    std::vector<Jobs> lenses;
    for (const ShadowJob* job : jobs) {
        const auto same = [job](const Jobs& lens) { return lens.front()->isOfLens(*job->projection); };
        const auto lens = std::find_if(lenses.begin(), lenses.end(), same);
        (lens == lenses.end() ? lenses.emplace_back() : *lens).push_back(job);
    }
    return lenses;
}

/// Those of all marks that may look at depths.
PixelRect pixelsLookedAt(const std::vector<ShadowJob>& jobs, const osg::Viewport& viewport) {
    std::optional<ScreenRect> bounds;
    for (const ShadowJob& job : jobs)
        if (!job.programMark() && (job.findsEdges || job.mark->kind() != Mark::Kind::Counts))
            bounds = bounds ? united(*bounds, job.mark->screenBounds) : job.mark->screenBounds;
    return bounds ? wholeQuads(pixelsWithin(*bounds, viewport), viewport) : PixelRect();
}

constexpr const char* backgroundNotKnown =
    "an opaque object in this view blends over colours that the camera does not clear, in a multisampled framebuffer "
    "object, so the shadow blends instead of relighting. Draw that object in a bin above 8, or set BLEND "
    "(composite=blend).";
constexpr const char* testsStencil =
    "an opaque object in this view has a stencil test of its own, so the shadow blends "
    "instead of relighting. Draw that object in a bin above 8, or set BLEND (composite=blend).";
constexpr const char* testsStencilLate =
    "an object in a bin above 8 has a stencil test of its own, so the shadow on all that is drawn there blends instead "
    "of relighting. Set BLEND (composite=blend).";
constexpr const char* leavesNotSaved =
    "what is clear in parts is drawn above bin 8 in a multisampled framebuffer object, so the shadow on all that is "
    "drawn there blends instead of relighting. Draw it in a bin below 8 by an osg::AlphaFunc, or set BLEND "
    "(composite=blend).";

} // namespace

/// Unless it has a named receiver or something of another view lies over it.
bool needsNoMarks(const ShadowJob& job, const std::vector<DrawnLeaf>& leaves) {
    return !job.relight && !job.receiverNamed && job.mark->canDarken && notOfLens(job, leaves).empty();
}

Compositor::Compositor(const CompositorStage& draw) : _draw(draw), _marks(_draw, false) {}

void Compositor::compose(const std::vector<ShadowJob>& jobs, const std::vector<osg::ref_ptr<ViewEffect>>& effects) {
    const auto draw = [&](ViewEffect::Turn turn) {
        for (const osg::ref_ptr<ViewEffect>& effect : effects)
            if (effect->turn() == turn) effect->draw(_draw);
        FrameDepths::forget(_draw.state);
    };
    FrameDepths::begin(_draw.state, pixelsLookedAt(jobs, *_draw.stage.getViewport()));
    Jobs relit;
    std::map<float, Jobs> blended;
    for (const ShadowJob& job : jobs) {
        if (job.programMark()) continue;
        if (job.relight)
            relit.push_back(&job);
        else if (job.dark < 1.0f) // a factor of 1 changes nothing
            blended[job.dark].push_back(&job);
    }
    if (!relit.empty()) relightAny(relit, blended);
    draw(ViewEffect::Turn::BeforeBlending);
    for (const auto& [dark, group] : blended)
        for (const Jobs& ofLens : byLens(group)) blendAny(ofLens, dark);
    draw(ViewEffect::Turn::Last);
    drawDebugViews(jobs);
}

void Compositor::drawDebugViews(const std::vector<ShadowJob>& jobs) const {
    int drawn = 0;
    for (const ShadowJob& job : jobs)
        if (job.mark->hasDebugView)
            _draw.pass(wholeScreen, [&](ScreenPass& screen) { job.mark->drawDebugView(screen, drawn++); });
}

void Compositor::blendAny(const Jobs& jobs, float dark) {
    if (darkenDirectly(jobs, dark)) return;
    if (areFading(jobs))
        FadingCompositor(_draw).blend(jobs, dark);
    else if (!composeDirectly(jobs))
        blend(jobs, dark);
}

/// The shortest way for a single job that can.
bool Compositor::darkenDirectly(const Jobs& jobs, float dark) const {
    const ShadowJob& job = *jobs.front();
    if (jobs.size() > 1 || !_draw.vast.empty() || !needsNoMarks(job, _draw.leaves)) return false;
    _draw.pass(job.mark->screenBounds, [&](ScreenPass& screen) {
        screen.ask(ScreenPass::Want::Factor, 0, dark);
        job.report(job.mark->draw(screen));
    });
    return true;
}

/// In the cheapest way that is right.
void Compositor::relightAny(const Jobs& jobs, std::map<float, Jobs>& blended) {
    const bool fading = areFading(jobs);
    if (!fading && composeDirectly(jobs)) return;
    if (isModeOn(_draw.leaves, GL_STENCIL_TEST))
        blendInstead(jobs, blended, jobs.front()->hidingOnly ? testsStencilLate : testsStencil);
    else if (!fading && !isBackgroundKnown() && readsBack(_draw.leaves))
        blendInstead(jobs, blended, _draw.since ? leavesNotSaved : backgroundNotKnown);
    else if (fading)
        FadingCompositor(_draw).relight(jobs);
    else
        relight(jobs);
}

/// True if any of them fades, and the framebuffer can hold them.
bool Compositor::areFading(const Jobs& jobs) const {
    bool fading = false;
    const bool hasObjects = _draw.state.get<osg::GLExtensions>()->isFrameBufferObjectSupported;
    for (const ShadowJob* job : jobs) {
        if (!job->fades()) continue;
        fading = true;
        if (!hasObjects)
            job->report("this OpenGL makes no framebuffer objects, so the shadow's edges are hard. Use OpenGL 3.0 or "
                        "later.");
        else if (!_draw.hasAlpha)
            job->report("this framebuffer has no alpha bits, so the shadow's edges are hard. Ask for 8 with "
                        "osg::DisplaySettings::setMinimumNumAlphaBits(8) before the window is made.");
    }
    return fading && hasObjects && _draw.hasAlpha;
}

/// A leaf with a stencil test of its own cannot be drawn again under ours, nor can one that blends with what is not known.
void Compositor::blendInstead(const Jobs& jobs, std::map<float, Jobs>& blended, const std::string& cause) {
    for (const ShadowJob* job : jobs) {
        if (job->mark->relightsOnly) continue;
        if (job->dark < 1.0f) blended[job->dark].push_back(job);
        job->report(cause);
    }
}

/// The short way for a single job: the leaves of its named receiver are drawn again at the depth that stands, and take
/// the light away themselves. Possible unless some other leaf shows on a relit receiver.
bool Compositor::composeDirectly(const Jobs& wanted) {
    const ShadowJob& job = *wanted.front();
    if (wanted.size() > 1 || !job.receiverNamed || _draw.since) return false;
    const bool relit = job.relight;
    const ScreenRect& bounds = job.mark->screenBounds;
    std::vector<ReplayedLeaf> leaves = leavesToReplay(_draw, wanted, bounds);
    const auto other = [&job](const ReplayedLeaf& leaf) { return !job.isNamed(leaf.entry.leaf); };
    const auto unfit = [&](const ReplayedLeaf& leaf) { return other(leaf) || !isPlain(leaf.entry.leaf->_parent); };
    if (relit && std::any_of(leaves.begin(), leaves.end(), unfit)) return false;
    if (!relit && (isModeOn(_draw.leaves, GL_COLOR_LOGIC_OP) || !notOfLens(job, _draw.leaves).empty())) return false;
    leaves.erase(std::remove_if(leaves.begin(), leaves.end(), other), leaves.end());
    const unsigned bit = _marks.firstBit();
    _draw.clearLeftovers(bit);
    _marks.addUngated(job, bit);
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_NOTEQUAL;
    overlay.test = overlay.write = bit; // back to 0 where drawn: a pixel loses its light once
    overlay.equalDepth = true;
    overlay.hidingOnly = job.hidingOnly;
    overlay.bounds = bounds;
    overlay.mark = job.mark.get();
    if (!relit) {
        overlay.color = LeafReplay::Color::Factor;
        overlay.factor = job.dark;
        for (ReplayedLeaf& leaf : leaves) leaf.lost = 0;
    }
    replay(leaves, overlay, wanted);
    _draw.clear(bit, bounds);
    return true;
}

void Compositor::relight(const Jobs& wanted) {
    const MarkedLights lights = _marks.lightsOf(wanted);
    const unsigned lightBits = bitsOf(lights);
    const Jobs jobs = jobsOf(lights);
    if (jobs.empty()) return;
    const ScreenRect bounds = screenBoundsOf(jobs);
    _marks.clearLeftovers(lightBits);
    _marks.mark(lights);
    if (jobs.front()->hidingOnly && !darkenUnlit(jobs, lightBits)) return _draw.clear(lightBits, bounds);
    resetMarked(lightBits, bounds);
    std::vector<ReplayedLeaf> catchers;
    for (unsigned lost = 1; lost < (1u << lights.size()); ++lost) replay(subsetOf(lights, lost), lightBits, catchers);
    if (!catchers.empty()) darken(catchers, lightBits, jobs);
    _draw.clear(lightBits, bounds);
}

/// What blends and cannot lose a light takes the factor where it hides what is behind, once, and its marks go: drawn again in
/// its own colour, it would be mixed with what is behind.
/// @return whether marks are left: something else loses a light.
bool Compositor::darkenUnlit(const Jobs& jobs, unsigned lightBits) {
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_NOTEQUAL;
    overlay.test = overlay.write = lightBits;
    overlay.equalDepth = overlay.hidingOnly = true;
    overlay.bounds = screenBoundsOf(jobs);
    overlay.color = LeafReplay::Color::Factor;
    overlay.factor = jobs.front()->dark;
    overlay.lightUniforms = lightUniformsOf(jobs);
    LeafReplay replay(_draw, overlay);
    const osgUtil::StateGraph* graph = nullptr; // leaves of one state mostly follow each other
    unsigned lost = 0;
    bool darkens = false, left = false;
    for (const ReplayedLeaf& leaf : leavesToReplay(_draw, jobs, overlay.bounds)) {
        if (!leaf.lost) continue;
        if (leaf.entry.leaf->_parent != graph || leaf.lost != lost) {
            graph = leaf.entry.leaf->_parent;
            lost = leaf.lost;
            darkens = !leaf.isCatcher && !isOpaque(graph) && !replay.canBeRelit(leaf.entry, lost);
            if (darkens) reportNotRelit(*leaf.entry.leaf, jobs);
        }
        left = left || !darkens;
        if (darkens) replay.draw(leaf.entry);
    }
    return left;
}

/// What shows where a catcher is seen loses the light by the factor.
void Compositor::darken(const std::vector<ReplayedLeaf>& catchers, unsigned lightBits, const Jobs& jobs) const {
    const ScreenRect bounds = screenBoundsOf(jobs);
    const unsigned seen = _marks.scratchBit();
    if (!seen) return reportAll(jobs, oneBitLeft);
    writeWhereSeen(_draw, catchers, {seen, seen, seen}, bounds);
    _draw.pass(bounds, [&](ScreenPass& screen) {
        screen.stencilEqual(0, lightBits, seen);
        screen.drawQuad();
        screen.takeStencil(seen, seen);
        screen.multiplyColor(jobs.front()->dark);
    });
    _draw.clear(seen, wholeScreen); // leaves are not cut to the bounds
    for (const ReplayedLeaf& leaf : catchers) reportNotRelit(*leaf.entry.leaf, jobs);
}

/// Draws pixels anew that lose these lights and no others.
void Compositor::replay(const MarkedLights& dark, unsigned lightBits, std::vector<ReplayedLeaf>& catchers) {
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = bitsOf(dark);
    overlay.test = lightBits;
    overlay.bounds = commonBounds(dark);
    const Jobs jobs = jobsOf(dark);
    if (isEmpty(overlay.bounds)) return;
    const std::vector<ReplayedLeaf> leaves = leavesToReplay(_draw, jobs, overlay.bounds);
    replay(leaves, overlay, jobs);
    std::copy_if(leaves.begin(), leaves.end(), std::back_inserter(catchers),
                 [](const ReplayedLeaf& leaf) { return leaf.isCatcher && leaf.lost; });
}

void Compositor::replay(const std::vector<ReplayedLeaf>& leaves, LeafReplay::Overlay overlay, const Jobs& jobs) {
    overlay.unlit = jobs.front()->dark;
    overlay.lightUniforms = lightUniformsOf(jobs);
    LeafReplay replay(_draw, overlay);
    for (const ReplayedLeaf& leaf : leaves) replay.draw(leaf.entry, leaf.lost);
    const osgUtil::StateGraph* named = nullptr; // leaves of one state, which share the cause, mostly follow each other
    for (const osgUtil::RenderLeaf* leaf : replay.notRelit())
        if (leaf->_parent != named && reportNotRelit(*leaf, jobs)) named = leaf->_parent;
}

/// @return whether any of them does.
bool Compositor::reportNotRelit(const osgUtil::RenderLeaf& leaf, const Jobs& jobs) const {
    if (!keptBy<StageVerdict>(_draw.stage).askToName()) return false;
    bool reported = false;
    for (const ShadowJob* job : jobs)
        if (job->isReceiver(leaf) && job->mark->canReach(leaf)) {
            reported = true;
            job->report(
                "no light can be taken from '" + nameOf(leaf) +
                "', because it is unlit or writes no colour, or its program does not read gl_LightSource. Its colour "
                "is multiplied by setDark() (dark=) instead. Light it with OpenGL, name the uniform of its light "
                "with ShadowCasterGroup::addLightUniform(), or leave it out of the receiver.");
        }
    return reported;
}

void Compositor::blend(const Jobs& jobs, float dark) {
    const unsigned bit = _marks.firstBit();
    const ScreenRect bounds = screenBoundsOf(jobs);
    MarkedLight all;
    all.hard = jobs;
    all.hardBit = bit;
    _marks.clearLeftovers(bit);
    _marks.mark({all});
    for (const ShadowJob* job : jobs)
        writeWhereSeen(_draw, notOfLens(*job, _draw.leaves), {0, bit, _marks.scratchBit()}, bounds);
    _draw.pass(bounds, [&](ScreenPass& screen) {
        screen.takeStencil(bit, bit);
        screen.multiplyColor(dark);
    });
}

void Compositor::writeBackground(ScreenPass& screen) const {
    if (FrameColorCopy* saved = _draw.since ? &_draw.since->frame->colors() : PrepassBin::savedColors(_draw.stage)) {
        screen.beginReplace();
        saved->draw(_draw.state);
        screen.endMix();
    } else
        screen.writeColor(_draw.stage.getClearColor());
}

/// Interlaced stereo clears colours once for both eyes.
bool Compositor::isBackgroundKnown() const {
    if (_draw.since) return _draw.since->frame->hasColors();
    return (_draw.stage.getClearMask() & GL_COLOR_BUFFER_BIT) || _draw.pattern.value ||
           PrepassBin::savedColors(_draw.stage);
}

/// Before a full redraw: nothing stands where marked. A leaf that blends with nothing must find the background there.
void Compositor::resetMarked(unsigned where, const ScreenRect& bounds) const {
    _draw.pass(bounds, [&](ScreenPass& screen) {
        screen.stencilAny(where);
        if (readsBack(_draw.leaves)) writeBackground(screen);
        if (_draw.since)
            _draw.since->frame->drawDepths(screen);
        else
            screen.writeFarDepth();
    });
}

} // namespace gnomon
