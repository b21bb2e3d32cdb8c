// SPDX-License-Identifier: MIT
#include <gnomon/ShadowTechnique.h>
#include <gnomon/base/FrameReport.h>
#include <gnomon/compositor/DrawWatch.h>
#include <gnomon/group/ShadowProbe.h>

namespace gnomon {

ShadowTechnique::ShadowTechnique() : _diagnosis(new FrameDiagnosis) { setCullingActive(false); }

ShadowTechnique::~ShadowTechnique() = default;

ShadowTechnique::ShadowTechnique(const ShadowTechnique& other, const osg::CopyOp& copyOp)
    : osg::Geode(other, copyOp), _receiver(other._receiver, other), _diagnosis(new FrameDiagnosis) {
    setCullingActive(false);
}

osg::ref_ptr<DrawWatch> ShadowTechnique::watch(const ViewFrame&, bool) const { return nullptr; }

bool ShadowTechnique::isLit(const ShadowProbe& probe, const glm::dvec3& point) const {
    return probe.reachesFrom(point);
}

osg::ref_ptr<const osg::Referenced> ShadowTechnique::answersFor(const ShadowProbe&) const { return nullptr; }

std::vector<std::string> ShadowTechnique::diagnose() const { return _diagnosis->all(); }

FrameReport ShadowTechnique::reportIn(unsigned frame) const { return {_diagnosis, describe(), frame}; }

void ShadowTechnique::report(unsigned frame, const std::string& cause) const { reportIn(frame)(cause); }

void ShadowTechnique::beginFrame(unsigned frame, const void* view) const { _diagnosis->begin(frame, view); }

std::string ShadowTechnique::describe() const { return described(*this); }

std::vector<Selection> ShadowTechnique::namedParts() const {
    if (!hasReceiver()) return {};
    return {getReceiver()};
}

} // namespace gnomon
