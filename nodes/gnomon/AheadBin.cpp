// SPDX-License-Identifier: MIT
#include <gnomon/AheadBin.h>
#include <gnomon/ProgramJob.h>
#include <gnomon/ScreenPass.h>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

constexpr int lowestNumber = std::numeric_limits<int>::min();
constexpr const char* binName = "gnomon::AheadBin";
constexpr const char* stateName = "gnomon programs";

const bool registered = [] {
    osgUtil::RenderBin::addRenderBinPrototype(binName, new AheadBin);
    return true;
}();

AheadBin& binOf(osgUtil::RenderStage& stage) {
    for (int number = lowestNumber;; ++number) {
        auto* bin = dynamic_cast<AheadBin*>(stage.find_or_insert(number, binName));
        if (bin) return *bin;
    }
}

/// OpenGL's programs keep uniforms: nothing must be said, too.
osg::ref_ptr<osg::StateSet> nothingToFind() {
    osg::ref_ptr<osg::StateSet> state = new osg::StateSet;
    state->addUniform(new osg::Uniform("gnomon_maps", 0));
    return state;
}

} // namespace

void AheadBin::show(const std::vector<ShadowJob>& jobs, osgUtil::RenderStage& stage) {
    const auto isFor = [](const ShadowJob& job) { return job.programMarks() != nullptr; };
    const auto job = std::find_if(jobs.begin(), jobs.end(), isFor);
    const osg::StateSet* before = stage.getStateSet();
    const bool isFree = !before || before->getName() == stateName;
    if (job == jobs.end()) {
        if (before && isFree) stage.setStateSet(nothingToFind());
        return;
    }
    if (!isFree)
        return job->technique->report(job->frameNumber,
                                      "cannot show its maps to programs: the stage that is drawn has a "
                                      "state of its own, set by osgUtil::RenderBin::setStateSet().");
    if (std::any_of(job + 1, jobs.end(), isFor))
        job->technique->report(job->frameNumber, "shows programs the maps of one light alone: name it with "
                                                 "ShadowCasterGroup::setLights() or setLightSources().");
    osg::StateSet* state = job->programMarks()->state.get();
    state->setName(stateName);
    stage.setStateSet(state);
    binOf(stage)._job = *job;
}

void AheadBin::drawImplementation(osg::RenderInfo& renderInfo, osgUtil::RenderLeaf*& previous) {
    if (_job.marks) {
        const CleanState clean(*renderInfo.getState(), getStage()->getViewport());
        const std::string cause = _job.programMarks()->drawAhead(renderInfo);
        if (!cause.empty()) _job.technique->report(_job.frameNumber, cause);
    }
    osgUtil::RenderBin::drawImplementation(renderInfo, previous);
}

} // namespace gnomon
