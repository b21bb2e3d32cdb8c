// SPDX-License-Identifier: MIT
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/StencilMarks.h>

#include <algorithm>
#include <bitset>
#include <map>

namespace gnomon {
namespace {

std::string nameOf(const MarkedLight& light) { return "light " + std::to_string(light.number); }

/// Writes the depths of its triangles where they are nearer than what stands.
void writeDepths(osg::State& state, const VastLeaf& leaf) {
    const DepthPlacement placement = depthPlacementOf(leaf.entry.leaf->_parent);
    const osg::Vec2f offset(polygonOffsetOf(leaf.entry.leaf->_parent));
    state.applyProjectionMatrix(nullptr);
    state.applyModelViewMatrix(nullptr);
    glDepthFunc(GL_LESS);
    glDepthRange(placement.nearest, placement.farthest);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(offset.x(), offset.y());
    glBegin(GL_TRIANGLES);
    for (const glm::vec4& corner : leaf.corners) glVertex4f(corner.x, corner.y, corner.z, corner.w);
    glEnd();
    glPolygonOffset(0.0f, 0.0f);
    glDisable(GL_POLYGON_OFFSET_FILL);
    glDepthRange(0.0, 1.0);
}

} // namespace

bool areOnTheSame(const ShadowJob& a, const ShadowJob& b) {
    if (a.receiverNamed != b.receiverNamed) return false;
    if (!a.receiverNamed) return a.isOfLens(*b.projection);
    return a.receivers == b.receivers || (a.receivers && b.receivers && *a.receivers == *b.receivers);
}

void reportAll(const Jobs& jobs, const std::string& cause) {
    for (const ShadowJob* job : jobs) job->report(cause);
}

ScreenRect screenBoundsOf(const Jobs& jobs) {
    ScreenRect all = jobs.front()->mark->screenBounds;
    for (const ShadowJob* job : jobs) all = united(all, job->mark->screenBounds);
    return all;
}

std::vector<LightUniform> lightUniformsOf(const Jobs& jobs) {
    std::vector<LightUniform> all;
    for (const ShadowJob* job : jobs) all.insert(all.end(), job->lightUniforms.begin(), job->lightUniforms.end());
    return all;
}

TrueDepths::TrueDepths(const CompositorStage& draw, const ScreenRect& bounds) : _draw(draw), _bounds(bounds) {
    if (_draw.vast.empty()) return;
    const unsigned bit = _draw.vastBit;
    if (!_draw.stencilIsZero) _draw.clear(bit, _bounds);
    std::vector<ReplayedLeaf> leaves;
    for (const VastLeaf& leaf : _draw.vast) leaves.push_back({leaf.entry});
    writeWhereSeen(_draw, leaves, {bit, bit, 0}, _bounds);
    _draw.pass(_bounds, [&](ScreenPass& screen) {
        screen.stencilEqual(bit, bit, 0);
        screen.writeFarDepth();
        for (const VastLeaf& leaf : _draw.vast) writeDepths(screen.state(), leaf); // depths are written after that quad
    });
}

/// The leaf alone, as it was drawn: it was what one saw there.
TrueDepths::~TrueDepths() {
    if (_draw.vast.empty()) return;
    const unsigned bit = _draw.vastBit;
    _draw.pass(_bounds, [&](ScreenPass& screen) {
        screen.stencilEqual(bit, bit, 0);
        screen.writeFarDepth();
    });
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = overlay.test = bit;
    overlay.color = LeafReplay::Color::None;
    overlay.bounds = _bounds;
    {
        LeafReplay replay(_draw, overlay);
        for (const VastLeaf& leaf : _draw.vast) replay.draw(leaf.entry);
    }
    _draw.clear(bit, _bounds);
}

Jobs MarkedLight::jobs() const {
    Jobs all = hard;
    all.insert(all.end(), fading.begin(), fading.end());
    return all;
}

unsigned bitsOf(const MarkedLights& lights) {
    unsigned bits = 0;
    for (const MarkedLight& light : lights) bits |= light.bits();
    return bits;
}

Jobs jobsOf(const MarkedLights& lights) {
    Jobs all;
    for (const MarkedLight& light : lights)
        for (const ShadowJob* job : light.jobs()) all.push_back(job);
    return all;
}

MarkedLights subsetOf(const MarkedLights& lights, unsigned subset) {
    MarkedLights part;
    for (std::size_t i = 0; i < lights.size(); ++i)
        if (subset & (1u << i)) part.push_back(lights[i]);
    return part;
}

ScreenRect commonBounds(const MarkedLights& lights) {
    ScreenRect bounds = wholeScreen;
    for (const MarkedLight& light : lights) bounds = common(bounds, screenBoundsOf(light.jobs()));
    return bounds;
}

std::size_t stencilBitsFor(const std::vector<ShadowJob>& jobs) {
    constexpr int blended = -1;            // no light: all that blends shares a bit
    std::map<int, std::bitset<2>> lights;  // which kinds of marks each has: hard, fading
    std::map<int, const ShadowJob*> first; // that fades, of each
    bool together = false, fading = false;
    for (const ShadowJob& job : jobs) {
        if (job.programMark()) continue;
        const int number = job.relight ? job.light : blended;
        std::bitset<2>& kinds = lights[number];
        together = together || kinds.any() || job.receiverNamed;
        const ShadowJob* other = job.fades() ? first.emplace(number, &job).first->second : nullptr;
        kinds.set(job.fades() && (!job.relight || areOnTheSame(*other, job)));
        fading = fading || job.fades();
    }
    const auto isMixed = [](const auto& light) { return light.second.all(); };
    const auto mixed = static_cast<std::size_t>(std::count_if(lights.begin(), lights.end(), isMixed));
    return std::clamp<std::size_t>(lights.size(), 1, mostRelitLights) + mixed +
           (fading ? 2 : together || lights.size() > 1);
}

StencilMarks::StencilMarks(const CompositorStage& draw, bool fades) : _draw(draw), _fades(fades) {
    for (const unsigned bit : draw.bits)
        if (!(bit & draw.counters)) _lightBits.push_back(bit);
    _scratch = takeLast();
    _faded = fades ? takeLast() : 0;
}

/// One is left for the lights.
unsigned StencilMarks::takeLast() {
    if (_lightBits.size() < 2) return 0;
    const unsigned bit = _lightBits.back();
    _lightBits.pop_back();
    return bit;
}

MarkedLights StencilMarks::lightsOf(const Jobs& wanted) const {
    MarkedLights lights;
    for (const ShadowJob* job : wanted) {
        const auto isOfJob = [job](const MarkedLight& known) { return known.number == job->light; };
        auto light = std::find_if(lights.begin(), lights.end(), isOfJob);
        if (light == lights.end()) {
            lights.emplace_back().number = job->light;
            light = lights.end() - 1;
        }
        const bool fades = _fades && job->fades();
        const bool shares = fades && (light->fading.empty() || areOnTheSame(*light->fading.front(), *job));
        if (fades && !shares)
            job->report(
                "other receivers have smooth edges of the same light already, so these edges are hard. Name the same "
                "receiver for all techniques of a light, or for none; what has a polygon offset or a depth range is "
                "another.");
        (shares ? light->fading : light->hard).push_back(job);
    }
    for (; lights.size() > mostRelitLights; lights.pop_back())
        reportAll(
            lights.back().jobs(),
            nameOf(lights.back()) + " casts no shadow, because at most " + std::to_string(mostRelitLights) +
                " lights can be relit in this view. Set BLEND (composite=blend), which takes any number of lights.");
    std::vector<unsigned> unused = _lightBits;
    const auto lacksBits = [&](MarkedLight& light) { return !assignBits(light, unused); };
    lights.erase(std::remove_if(lights.begin(), lights.end(), lacksBits), lights.end());
    std::sort(lights.begin(), lights.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    return lights;
}

bool StencilMarks::assignBits(MarkedLight& light, std::vector<unsigned>& unused) const {
    const std::size_t needed = (light.hard.empty() ? 0u : 1u) + (light.fading.empty() ? 0u : 1u);
    if (unused.size() < needed) {
        reportAll(light.jobs(),
                  nameOf(light) + " casts no shadow, because too few stencil bits are left. Leave more out of "
                                  "CompositorOptions::reservedStencilBits, or set BLEND (composite=blend), which takes "
                                  "any number of lights.");
        return false;
    }
    const auto take = [&unused] {
        const unsigned bit = unused.front();
        unused.erase(unused.begin());
        return bit;
    };
    if (!light.hard.empty()) light.hardBit = take();
    if (!light.fading.empty()) light.fadingBit = take();
    return true;
}

void StencilMarks::mark(const MarkedLights& lights, const MarkFading& fading) const {
    for (const MarkedLight& light : lights) {
        for (const ShadowJob* job : light.hard) add(*job, light.hardBit, job == light.hard.front());
        for (const ShadowJob* job : light.fading) add(*job, light.fadingBit, job == light.fading.front(), fading);
    }
}

/// The first job of a light without a named receiver marks its bit directly; any other goes through the scratch bit.
void StencilMarks::add(const ShadowJob& job, unsigned bit, bool fresh, const MarkFading& fading) const {
    if (fresh && !job.receiverNamed) return addUngated(job, bit, fading);
    if (!_scratch) {
        job.report(oneBitLeft);
        return;
    }
    addUngated(job, _scratch, fading);
    if (job.receiverNamed)
        gate(job, bit);
    else
        transfer(job, _scratch, bit);
    _draw.clear(_scratch, job.mark->screenBounds);
}

void StencilMarks::addUngated(const ShadowJob& job, unsigned bit, const MarkFading& fading) const {
    const TrueDepths depths(_draw, job.mark->screenBounds);
    if (fading && job.fades()) return fading(job, bit);
    _draw.pass(job.mark->screenBounds, [&](ScreenPass& screen) {
        screen.ask(ScreenPass::Want::Blocked, bit);
        job.report(job.mark->draw(screen));
    });
}

/// Hands marks on where the receiver is what one sees: its own leaves, drawn again, pass only at the depth that stands.
void StencilMarks::gate(const ShadowJob& job, unsigned bit) const {
    if (_draw.since && job.receivers->size() == _draw.since->hiding.size())
        return transfer(job, _scratch | _draw.hidingBit, bit);
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = _scratch | bit;
    overlay.test = _scratch;
    overlay.write = bit;
    overlay.equalDepth = true;
    overlay.color = LeafReplay::Color::None;
    overlay.hidingOnly = job.hidingOnly;
    overlay.bounds = job.mark->screenBounds;
    overlay.mark = job.mark.get();
    LeafReplay replay(_draw, overlay);
    TouchTest touches(job.mark->screenBounds, job.moved.get());
    for (const DrawnLeaf& entry : _draw.leaves)
        if (job.isNamed(entry.leaf) && touches(*entry.leaf)) replay.draw(entry);
}

/// Where all bits of `from` are set.
void StencilMarks::transfer(const ShadowJob& job, unsigned from, unsigned bit) const {
    _draw.pass(job.mark->screenBounds, [&](ScreenPass& screen) {
        screen.stencilEqual(from | bit, from, bit);
        screen.drawQuad();
    });
}

} // namespace gnomon
