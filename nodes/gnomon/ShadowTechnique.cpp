// SPDX-License-Identifier: MIT
#include <gnomon/LightProbe.h>
#include <gnomon/ShadowBin.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowTechnique.h>

#include <OpenThreads/ScopedLock>
#include <osg/Transform>
#include <osgUtil/CullVisitor>

#include <algorithm>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

unsigned frameOf(const osg::NodeVisitor& visitor) {
    return visitor.getFrameStamp() ? visitor.getFrameStamp()->getFrameNumber() : visitor.getTraversalNumber();
}

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

ShadowTechnique::ShadowTechnique() { setCullingActive(false); }

ShadowTechnique::ShadowTechnique(const ShadowTechnique& other, const osg::CopyOp& copyOp)
    : osg::Geode(other, copyOp), _receiver(other._receiver) {
    setCullingActive(false);
}

void ShadowTechnique::traverse(osg::NodeVisitor& visitor) {
    if (osgUtil::CullVisitor* cull = visitor.asCullVisitor()) enlist(*cull);
    osg::Geode::traverse(visitor);
}

bool ShadowTechnique::isLit(const LightProbe& probe, const glm::dvec3& point) const { return probe.reachesFrom(point); }

std::vector<std::string> ShadowTechnique::diagnose() const {
    Lock lock(_causesMutex);
    return _causes;
}

void ShadowTechnique::report(unsigned frame, const std::string& cause) const {
    const std::string sentence = describe() + " " + cause;
    Lock lock(_causesMutex);
    if (frame != _causesFrame) return;
    if (std::find(_causes.begin(), _causes.end(), sentence) != _causes.end()) return;
    _causes.push_back(sentence);
    OSG_INFO << "gnomon: " << sentence << std::endl;
}

void ShadowTechnique::beginFrame(unsigned frame, const void* view) const {
    Lock lock(_causesMutex);
    if (frame != _causesFrame || _causesViews.count(view)) {
        _causesFrame = frame;
        _causes.clear();
        _causesViews.clear();
    }
    _causesViews.insert(view);
}

std::string ShadowTechnique::describe() const {
    return std::string(className()) + (getName().empty() ? "" : " '" + getName() + "'");
}

} // namespace gnomon
