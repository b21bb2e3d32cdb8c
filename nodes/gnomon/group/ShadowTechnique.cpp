// SPDX-License-Identifier: MIT
#include <gnomon/ShadowReport.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/group/ShadowProbe.h>

#include <osg/NodeVisitor>

namespace gnomon {
namespace {

class Asker : public osg::NodeVisitor {
public:
    Asker() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) { setNodeMaskOverride(~0u); }
    void apply(osg::Geode& geode) override {
        if (const auto* technique = dynamic_cast<const ShadowTechnique*>(&geode))
            reports.push_back(technique->lastReport());
    }
    std::vector<ShadowReport> reports;
};

} // namespace

ShadowTechnique::ShadowTechnique() : _diagnosis(new FrameDiagnosis) { setCullingActive(false); }

ShadowTechnique::~ShadowTechnique() = default;

ShadowTechnique::ShadowTechnique(const ShadowTechnique& other, const osg::CopyOp& copyOp)
    : osg::Geode(other, copyOp), _receiver(other._receiver, other), _diagnosis(new FrameDiagnosis) {
    setCullingActive(false);
}

osg::ref_ptr<DrawWatch> ShadowTechnique::watch(const ViewFrame&) const { return nullptr; }

bool ShadowTechnique::shadowsSurface(const ViewFrame&, const osgUtil::RenderLeaf&) const { return true; }

std::string ShadowTechnique::flawOn(const ViewFrame&, const osgUtil::RenderLeaf&) const { return {}; }

bool ShadowTechnique::isLit(const ShadowProbe& probe, const glm::dvec3& point) const {
    return probe.reachesFrom(point);
}

osg::ref_ptr<const osg::Referenced> ShadowTechnique::answersFor(const ShadowProbe&) const { return nullptr; }

std::vector<std::string> ShadowTechnique::diagnose() const { return _diagnosis->all(); }

FrameReport ShadowTechnique::reportIn(unsigned frame) const { return {_diagnosis, describe(), frame}; }

void ShadowTechnique::report(unsigned frame, const std::string& cause) const { reportIn(frame)(cause); }

void ShadowTechnique::beginFrame(unsigned frame, double time, const void* view) const {
    if (_diagnosis->begin(frame, time, view) && isRecorded()) _diagnosis->beginWork(frame, passes());
}

ShadowReport ShadowTechnique::lastReport() const {
    const FrameWork work = _diagnosis->work();
    ShadowReport report;
    report.technique = describe();
    report.causes = _diagnosis->known();
    if (!work.known) return report;
    report.frame = work.frame;
    report.lights = work.lights;
    report.marks = work.marks;
    report.pixels = work.pixels;
    report.passes = passes() - work.passesBefore;
    report.cull = work.cull;
    report.draw = work.draw;
    report.decisions = lastDecision();
    return report;
}

bool ShadowTechnique::isRecorded() const { return _diagnosis->isRecorded(); }

void ShadowTechnique::record(const FrameWork& work) const { _diagnosis->addWork(work); }

std::string ShadowTechnique::describe() const { return described(*this); }

std::vector<Selection> ShadowTechnique::namedParts() const {
    if (!hasReceiver()) return {};
    return {getReceiver()};
}

std::vector<ShadowReport> shadowReports(osg::Node& scene) {
    Asker asker;
    scene.accept(asker);
    return asker.reports;
}

} // namespace gnomon
