// SPDX-License-Identifier: MIT
#include <gnomon/FrameCauses.h>
#include <gnomon/LightProbe.h>
#include <gnomon/ShadowBin.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowTechnique.h>

#include <osg/Transform>
#include <osgUtil/CullVisitor>

namespace gnomon {
namespace {

/// The nearest ShadowCasterGroup on the way to a technique, and the way from there.
struct GroupAbove {
    ShadowCasterGroup* group = nullptr;
    osg::Matrixd groupFromTechnique;
};

GroupAbove groupAbove(const osg::NodePath& path) {
    GroupAbove result;
    for (std::size_t i = path.size(); i-- > 0 && !result.group;) {
        result.group = dynamic_cast<ShadowCasterGroup*>(path[i]);
        if (!result.group) continue;
        const osg::NodePath below(path.begin() + static_cast<std::ptrdiff_t>(i) + 1, path.end());
        result.groupFromTechnique = osg::computeLocalToWorld(below, false);
    }
    return result;
}

} // namespace

void ShadowTechnique::enlist(osgUtil::CullVisitor& cull) {
    const unsigned frame = frameOf(cull);
    osgUtil::RenderStage* stage = cull.getCurrentRenderBin()->getStage();
    beginFrame(frame, stage);
    const GroupAbove above = groupAbove(cull.getNodePath());
    if (!above.group) {
        report(frame, "has no ShadowCasterGroup above it: make it a child of the group that holds the casters.");
        return;
    }
    if (cull.getViewport() != stage->getViewport()) {
        report(frame, "is under a nested camera with a viewport of its own, whose shadows would fall "
                      "elsewhere: set that camera's render order to PRE_RENDER or POST_RENDER.");
        return;
    }
    EnlistedTechnique entry;
    entry.technique = this;
    entry.group = above.group;
    entry.groupFromTechnique = above.groupFromTechnique;
    entry.eyeFromGroup = osg::Matrixd::inverse(above.groupFromTechnique) * *cull.getModelViewMatrix();
    entry.projection = cull.getProjectionMatrix();
    entry.frameNumber = frame;
    ShadowBin::of(stage).enlist(entry);
}

bool ShadowTechnique::hasGroupAbove(const osg::NodeVisitor& visitor) {
    return groupAbove(visitor.getNodePath()).group != nullptr;
}

ShadowTechnique::ShadowTechnique() : _diagnosis(new FrameCauses) { setCullingActive(false); }

ShadowTechnique::~ShadowTechnique() = default;

ShadowTechnique::ShadowTechnique(const ShadowTechnique& other, const osg::CopyOp& copyOp)
    : osg::Geode(other, copyOp), _receiver(other._receiver), _diagnosis(new FrameCauses) {
    setCullingActive(false);
}

void ShadowTechnique::traverse(osg::NodeVisitor& visitor) {
    if (osgUtil::CullVisitor* cull = visitor.asCullVisitor()) enlist(*cull);
    osg::Geode::traverse(visitor);
}

bool ShadowTechnique::isLit(const LightProbe& probe, const glm::dvec3& point) const { return probe.reachesFrom(point); }

osg::ref_ptr<const osg::Referenced> ShadowTechnique::answersFor(const LightProbe&) const { return nullptr; }

std::vector<std::string> ShadowTechnique::diagnose() const { return _diagnosis->all(); }

FrameCauses* ShadowTechnique::frameDiagnosis() const { return _diagnosis.get(); }

void ShadowTechnique::report(unsigned frame, const std::string& cause) const {
    _diagnosis->add(frame, describe(), cause);
}

void ShadowTechnique::beginFrame(unsigned frame, const void* view) const { _diagnosis->begin(frame, view); }

std::string ShadowTechnique::describe() const { return described(*this); }

} // namespace gnomon
