// SPDX-License-Identifier: MIT
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/StencilMarks.h>
#include <gnomon/compositor/TrueDepths.h>

namespace gnomon {

ScreenRect boundsOf(const Jobs& jobs) {
    ScreenRect all = jobs.front()->mark->screenBounds;
    for (const ShadowJob* job : jobs) all = united(all, job->mark->screenBounds);
    return all;
}

std::vector<LightUniform> lightUniformsOf(const Jobs& jobs) {
    std::vector<LightUniform> all;
    for (const ShadowJob* job : jobs) all.insert(all.end(), job->lightUniforms.begin(), job->lightUniforms.end());
    return all;
}

/// The first job of a light without a named receiver marks its bit directly; any other goes through the scratch bit.
void StencilMarks::add(const ShadowJob& job, unsigned bit, bool fresh, Pixels pixels) const {
    if (fresh && !job.receiverNamed) return addUngated(job, bit, pixels);
    if (!_scratch) {
        job.report("a named receiver, or a second technique for the same light, needs two stencil bits, but "
                   "only one is left. Leave at least two out of CompositorOptions::reservedStencilBits.");
        return;
    }
    addUngated(job, _scratch, pixels);
    if (job.receiverNamed)
        gate(job, bit);
    else
        transfer(job, bit);
    _draw.clear(_scratch, job.mark->screenBounds);
}

void StencilMarks::addUngated(const ShadowJob& job, unsigned bit, Pixels pixels) const {
    const TrueDepths depths(_draw, job.mark->screenBounds);
    _draw.pass(job.mark->screenBounds, [&](ScreenPass& screen) {
        const bool touched = pixels != Pixels::Half && job.fades();
        if (touched && pixels == Pixels::Weighed) screen.multiplyAlpha();
        screen.ask(touched ? ScreenPass::Want::Touched : ScreenPass::Want::Blocked, bit);
        job.report(job.mark->draw(screen));
    });
}

/// Hands marks on where the receiver is what one sees: its own leaves, drawn again, pass only at the depth that stands.
void StencilMarks::gate(const ShadowJob& job, unsigned bit) const {
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
    TouchTest touches(job.mark->screenBounds);
    for (const DrawnLeaf& entry : _draw.leaves)
        if (job.isNamed(entry.leaf) && touches(*entry.leaf)) replay.draw(entry);
}

void StencilMarks::transfer(const ShadowJob& job, unsigned bit) const {
    _draw.pass(job.mark->screenBounds, [&](ScreenPass& screen) {
        screen.stencilEqual(_scratch | bit, _scratch, bit);
        screen.drawQuad();
    });
}

} // namespace gnomon
