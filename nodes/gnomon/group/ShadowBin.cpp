// SPDX-License-Identifier: MIT
#include <gnomon/compositor/Compositor.h>
#include <gnomon/compositor/PrepassBin.h>
#include <gnomon/compositor/SoftMarkJob.h>
#include <gnomon/group/ShadowBin.h>
#include <gnomon/group/ViewFrame.h>
#include <gnomon/group/ViewLights.h>

#include <OpenThreads/ScopedLock>
#include <osg/Notify>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <map>

namespace gnomon {
namespace {

constexpr int highestNumber = 8; // below 9, where osg::OcclusionQueryNode draws, and 10, the transparent bin
constexpr const char* binName = "gnomon::ShadowBin";

/// Makes the bin known to osgUtil, which creates bins by name.
const bool registered = [] {
    osgUtil::RenderBin::addRenderBinPrototype(binName, new ShadowBin);
    return true;
}();

/// @param casters  a CasterMesh, or CasterDrawables.
template <typename Casters>
bool areSome(const EnlistedTechnique& entry, const Casters& casters) {
    if (casters.invalidTriangles > 0)
        entry.technique->report(entry.frameNumber,
                                "invalid triangles are left out: " + std::to_string(casters.invalidTriangles) +
                                    ", the first in '" + casters.invalidNode +
                                    "'. Give every vertex finite coordinates and every index a vertex.");
    if (!casters.empty()) return true;
    if (entry.group->areCastersGone()) {
        entry.technique->report(entry.frameNumber, "nothing casts, because the node given to setCasters() of the "
                                                   "ShadowCasterGroup is gone. Add the casters to the scene, and name "
                                                   "them anew.");
        return false;
    }
    entry.technique->report(entry.frameNumber,
                            "nothing casts, because the ShadowCasterGroup '" + entry.group->getName() +
                                "' holds no triangles. Add the scene to the group, or check its setCasters().");
    return false;
}

bool hasCasters(const EnlistedTechnique& entry, const FrameCasters& casters) {
    return entry.technique->takesDrawables() ? areSome(entry, casters.drawables()) : areSome(entry, casters.mesh());
}

/// A receiver that is out of sight is nothing to report; one that can never be seen to receive is.
void reportNoReceiver(const EnlistedTechnique& entry, osgUtil::RenderStage& stage) {
    if (entry.technique->isReceiverGone())
        return entry.technique->report(entry.frameNumber, "the node given to setReceiver() is gone, because nothing "
                                                          "else kept it. Add the receiver to the scene, and name it "
                                                          "anew.");
    const std::string cause = whyMissing(entry.technique->getReceiver(), "receiver", *entry.group, stage);
    if (!cause.empty()) entry.technique->report(entry.frameNumber, cause);
}

ViewFrame viewOf(const EnlistedTechnique& entry, const osg::Viewport& viewport) {
    ViewFrame view;
    view.pixels = {viewport.width(), viewport.height()};
    view.eyeFromGroup = entry.eyeFromGroup;
    view.groupFromTechnique = entry.groupFromTechnique;
    view.projection = *entry.projection;
    view.group = entry.group.get();
    view.dark = entry.group->getDark();
    view.options = entry.group->getCompositorOptions();
    view.frameNumber = entry.frameNumber;
    return view;
}

ShadowJob jobFor(const EnlistedTechnique& entry, const ShadowLight& light) {
    ShadowJob job;
    job.report = entry.technique->reportIn(entry.frameNumber);
    job.light = light.number;
    job.relight = entry.group->getComposite() == ShadowCasterGroup::RELIGHT;
    job.dark = entry.group->getDark();
    job.projection = entry.projection;
    job.receiverNamed = entry.technique->hasReceiver();
    job.lightUniforms = entry.group->getLightUniforms();
    return job;
}

/// Stencil bits that the compositor takes: one a light, and a scratch bit; one more for lights that fade.
std::size_t ownBits(const std::vector<ShadowJob>& jobs) {
    if (std::none_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.marks->counts(); })) return 8;
    if (std::any_of(jobs.begin(), jobs.end(), [](const auto& job) { return job.softMarks(); }))
        return mostRelitLights + 2;
    std::set<int> lights;
    for (const ShadowJob& job : jobs) lights.insert(job.light);
    return std::min(lights.size(), mostRelitLights) + 1;
}

} // namespace

ShadowBin& ShadowBin::of(osgUtil::RenderStage* stage) {
    for (int number = highestNumber;; --number) {
        auto* bin = dynamic_cast<ShadowBin*>(stage->find_or_insert(number, binName));
        if (bin) return *bin;
    }
}

void ShadowBin::enlist(const EnlistedTechnique& technique) {
    _enlisted.push_back(technique);
    suit(technique.group->getCompositorOptions());
}

void ShadowBin::enlist(ViewEffect& effect, const CompositorOptions& options) {
    _effects.push_back(&effect);
    suit(options);
}

void ShadowBin::suit(const CompositorOptions& options) {
    _options = _options.with(options);
    clearWithStage();
}

void ShadowBin::clearWithStage() {
    constexpr GLbitfield stencil = GL_STENCIL_BUFFER_BIT;
    osgUtil::RenderStage& stage = *getStage();
    const GLbitfield own = _addsClear ? stage.getClearMask() & ~stencil : stage.getClearMask();
    _stageClears = _options.reservedStencilBits == 0 && (own & GL_DEPTH_BUFFER_BIT) && stage.getClearStencil() == 0;
    _addsClear = _stageClears && !(own & stencil);
    stage.setClearMask(_stageClears ? own | stencil : own);
}

void ShadowBin::reset() {
    osgUtil::RenderBin::reset();
    setSortMode(getDefaultRenderBinSortMode());
    _enlisted.clear();
    _jobs.clear();
    _effects.clear();
    _options = {};
    _stageClears = _addsClear = false;
}

void ShadowBin::sortImplementation() {
    _jobs.clear();
    std::map<const ShadowCasterGroup*, FrameCasters> groups;
    const std::vector<DrawnLeaf> leaves = leavesBelow(*getStage(), getBinNum());
    for (const EnlistedTechnique& entry : _enlisted) {
        const FrameCasters& casters = groups.try_emplace(entry.group.get(), *entry.group).first->second;
        if (!hasCasters(entry, casters)) continue;
        const GroupLights found = lightsOf(*entry.group, entry.eyeFromGroup, *getStage());
        for (const std::string& cause : found.causes) entry.technique->report(entry.frameNumber, cause);
        prepare(entry, found.lights, casters, leaves);
    }
    PrepassBin::show(_jobs, *getStage());
    for (const osg::ref_ptr<ViewEffect>& effect : _effects) effect->prepare(*getStage(), leaves);
    sortAsAsked();
    osgUtil::RenderBin::sortImplementation();
}

/// Leaves that asked for a bin of this number got this one, which must sort as the kind they named.
void ShadowBin::sortAsAsked() {
    for (const osgUtil::StateGraph* graph : getStateGraphList())
        for (; graph; graph = graph->_parent) {
            const osg::StateSet* set = graph->getStateSet();
            if (!set || !set->useRenderBinDetails() || set->getBinNumber() != getBinNum()) continue;
            const osgUtil::RenderBin* kind = osgUtil::RenderBin::getRenderBinPrototype(set->getBinName());
            if (kind) setSortMode(kind->getSortMode());
        }
}

void ShadowBin::prepare(const EnlistedTechnique& entry, const std::vector<ShadowLight>& lights,
                        const FrameCasters& casters, const std::vector<DrawnLeaf>& leaves) {
    ViewFrame view = viewOf(entry, *getStage()->getViewport());
    std::set<const osgUtil::RenderLeaf*> receivers;
    if (entry.technique->hasReceiver()) {
        receivers = receiversAmong(leaves, entry.technique->getReceiver(), *getStage()->getInitialViewMatrix());
        view.receivers = &receivers;
    }
    if (view.receivers && receivers.empty()) {
        reportNoReceiver(entry, *getStage());
        return;
    }
    view.stage = getStage();
    view.options.filter = _options.filter; // as all who share this bin want it
    for (const DrawnLeaf& leaf : leaves)
        if (view.receivers ? receivers.count(leaf.leaf) > 0 : isSameLens(*leaf.leaf->_projection, *entry.projection))
            view.seen.push_back(leaf.leaf);
    for (const ShadowLight& light : lights) {
        ShadowJob job = jobFor(entry, light);
        job.receivers = receivers;
        for (const osg::ref_ptr<MarkJob>& marks : entry.technique->prepare(view, light, casters)) {
            job.marks = marks;
            _jobs.push_back(job);
        }
    }
}

void ShadowBin::drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    if (!isIdle()) {
        popLeafState(*renderInfo.getState(), previous);
        std::vector<DrawnLeaf> leaves = leavesBelow(*getStage(), getBinNum());
        const bool clean = _stageClears && !isModeOn(leaves, GL_STENCIL_TEST);
        Compositor(CompositorStage(renderInfo, *getStage(), std::move(leaves), _options, clean, ownBits(_jobs)))
            .compose(_jobs, _effects);
        renderInfo.getState()->decrementDynamicObjectCount();
    }
    osgUtil::RenderBin::drawImplementation(renderInfo, previous);
}

/// The leaves drawn again, and the casters, may be dynamic: the frame is not done with them before this bin is.
unsigned ShadowBin::computeNumberOfDynamicRenderLeaves() const {
    return osgUtil::RenderBin::computeNumberOfDynamicRenderLeaves() + (isIdle() ? 0u : 1u);
}

} // namespace gnomon
