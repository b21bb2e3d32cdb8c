// SPDX-License-Identifier: MIT
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/auto/AutoChooser.h>
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/gl/DrawClock.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/LocalLight.h>
#include <gnomon/group/ViewFrame.h>

#include <algorithm>

namespace gnomon {
namespace {

/// The causes that another technique has for one frame, without its name.
std::vector<std::string> causesOf(const ShadowTechnique& technique) {
    const std::string start = technique.describe() + ": ";
    std::vector<std::string> causes = technique.diagnose();
    for (std::string& cause : causes)
        if (cause.rfind(start, 0) == 0) cause.erase(0, start.size());
    return causes;
}

/// 0 for what is no number above 0.
double within(double number, double least, double most) { return number > 0.0 ? std::clamp(number, least, most) : 0.0; }

} // namespace

AutoShadowOptions AutoShadowOptions::usable() const {
    return {within(error, leastError, mostError), within(time, leastTime, mostTime)};
}

AutoShadowTechnique::AutoShadowTechnique() : _chooser(new AutoChooser) {}

AutoShadowTechnique::AutoShadowTechnique(const AutoShadowTechnique& other, const osg::CopyOp& copyOp)
    : ShadowTechnique(other, copyOp), _options(other._options), _chooser(new AutoChooser) {}

AutoShadowTechnique::~AutoShadowTechnique() = default;

void AutoShadowTechnique::setError(double pixels) { setOptions({pixels, _options.time}); }

void AutoShadowTechnique::setTime(double milliseconds) { setOptions({_options.error, milliseconds}); }

std::vector<ShadowDecision> AutoShadowTechnique::lastDecision() const { return _chooser->lastDecision(); }

unsigned AutoShadowTechnique::passes() const { return _chooser->passes(); }

std::vector<osg::ref_ptr<MarkJob>> AutoShadowTechnique::prepare(const ViewFrame& view, const ShadowLight& light,
                                                                const FrameCasters& casters) const {
    const auto usable = localLight(light.inGroup, SceneFrame(osg::Vec3d()));
    if (!usable) {
        report(view.frameNumber, notUsable(light.inGroup));
        return {};
    }
    const AutoChooser::Drawn drawn =
        _chooser->choose({view, light, casters, casters.drawables(), *usable}, getReceiver(), _options);
    if (!drawn.cause.empty()) report(view.frameNumber, drawn.cause);
    if (drawn.shares.empty()) return {};
    ViewFrame here = view;
    here.groupFromTechnique = osg::Matrixd(); // planes are the group's
    const double from = drawn.timed ? processorMilliseconds() : 0.0;
    std::vector<osg::ref_ptr<MarkJob>> jobs;
    for (const auto& [technique, part] : drawn.shares) {
        technique->beginFrame(view.frameNumber, view.frameTime, view.stage);
        for (const osg::ref_ptr<MarkJob>& job : technique->prepare(here, light, part)) jobs.push_back(job);
    }
    if (drawn.timed) _chooser->prepared(view.stage, light.number, processorMilliseconds() - from);
    for (const osg::ref_ptr<MarkJob>& job : jobs) job->surfaces = drawn.surfaces;
    for (const auto& share : drawn.shares)
        for (const std::string& cause : causesOf(*share.technique)) report(view.frameNumber, cause);
    return jobs;
}

bool AutoShadowTechnique::takesDrawables() const { return _chooser->takesDrawables(); }

osg::ref_ptr<DrawWatch> AutoShadowTechnique::watch(const ViewFrame& view, bool alone) const {
    return _chooser->watch(view.stage, alone);
}

void AutoShadowTechnique::resizeGLObjectBuffers(unsigned maxSize) {
    ShadowTechnique::resizeGLObjectBuffers(maxSize);
    _chooser->forEach([maxSize](ShadowTechnique& inner) { inner.resizeGLObjectBuffers(maxSize); });
}

void AutoShadowTechnique::releaseGLObjects(osg::State* state) const {
    ShadowTechnique::releaseGLObjects(state);
    _chooser->forEach([state](ShadowTechnique& inner) { inner.releaseGLObjects(state); });
}

} // namespace gnomon
