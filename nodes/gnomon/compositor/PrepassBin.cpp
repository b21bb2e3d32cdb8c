// SPDX-License-Identifier: MIT
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/MaterialHistory.h>
#include <gnomon/compositor/PrepassBin.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/GlState.h>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr int lowestNumber = std::numeric_limits<int>::min();
constexpr const char* binName = "gnomon::PrepassBin";
constexpr const char* stateName = "gnomon programs";

const bool registered = [] {
    osgUtil::RenderBin::addRenderBinPrototype(binName, new PrepassBin);
    return true;
}();

const PrepassBin* find(osgUtil::RenderStage& stage) {
    for (const auto& [number, bin] : stage.getRenderBinList())
        if (const auto* prepass = dynamic_cast<const PrepassBin*>(bin.get())) return prepass;
    return nullptr;
}

PrepassBin& binOf(osgUtil::RenderStage& stage) {
    for (int number = lowestNumber;; ++number) {
        auto* bin = dynamic_cast<PrepassBin*>(stage.find_or_insert(number, binName));
        if (bin) return *bin;
    }
}

/// OpenGL's programs keep uniforms: that nothing is to be found must be said, too.
osg::ref_ptr<osg::StateSet> nothingInstead(const osg::StateSet& shown) {
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->setName(stateName);
    state->addUniform(new osg::Uniform("gnomon_maps", 0));
    const osg::Uniform* unit = shown.getUniform("gnomon_map");
    if (unit) state->addUniform(new osg::Uniform(*unit)); // a sampler of another kind than that of unit 0
    return state;
}

} // namespace

/// With a stage that is reset or goes; nobody else may say that its techniques are gone.
PrepassBin::~PrepassBin() {
    osgUtil::RenderStage* stage = _job.mark ? getStage() : nullptr;
    if (!stage || stage->referenceCount() == 0) return;
    const osg::StateSet* shown = _job.programMark()->state.get();
    if (stage->getStateSet() == shown) stage->setStateSet(nothingInstead(*shown));
}

void PrepassBin::show(const std::vector<ShadowJob>& jobs, osgUtil::RenderStage& stage) {
    const auto isFor = [](const ShadowJob& job) { return job.programMark() != nullptr; };
    const auto job = std::find_if(jobs.begin(), jobs.end(), isFor);
    if (job == jobs.end()) return;
    const osg::StateSet* before = stage.getStateSet();
    const bool isFree = !before || before->getName() == stateName;
    if (!isFree)
        return job->report("programs cannot read the maps, because the render stage has a state set of its "
                           "own. Remove it with osgUtil::RenderBin::setStateSet(nullptr).");
    if (std::any_of(job + 1, jobs.end(), isFor))
        job->report("programs can read the maps of one light only. Name that light with "
                    "ShadowCasterGroup::setLights() or setLightSources().");
    osg::StateSet* state = job->programMark()->state.get();
    state->setName(stateName);
    stage.setStateSet(state);
    binOf(stage)._job = *job;
}

void PrepassBin::saveColors(osgUtil::RenderStage& stage) { binOf(stage)._colors = std::make_unique<FrameColorCopy>(); }

FrameColorCopy* PrepassBin::savedColors(osgUtil::RenderStage& stage) {
    const PrepassBin* prepass = find(stage);
    return prepass ? prepass->_colors.get() : nullptr;
}

void PrepassBin::watch(osgUtil::RenderStage& stage) { binOf(stage); }

bool PrepassBin::followsDefault(osgUtil::RenderStage& stage) {
    const PrepassBin* prepass = find(stage);
    return prepass && prepass->_followsDefault;
}

void PrepassBin::drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    osg::State& state = *renderInfo.getState();
    if (isCoreProfile(state)) {
        if (_job.mark) _job.report(coreProfileRefused);
    } else {
        if (_colors || _job.mark) drawAhead(renderInfo, previous);
        _followsDefault = MaterialHistory::isDefault(state);
    }
    osgUtil::RenderBin::drawImplementation(renderInfo, previous);
}

void PrepassBin::drawAhead(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    osg::State& state = *renderInfo.getState();
    MaterialHistory materials(state, *getStage());
    popLeafState(state, previous);
    if (_colors) {
        const CleanState clean(state, getStage()->getViewport());
        if (!_colors->save(state, *getStage()->getViewport())) _colors.reset();
    }
    if (_job.mark) {
        forgetArrays(state);
        const CleanState clean(state, getStage()->getViewport());
        const std::string cause = _job.programMark()->drawAhead(renderInfo);
        _job.report(cause);
        forgetArrays(state);
    }
    materials.restore();
}

} // namespace gnomon
