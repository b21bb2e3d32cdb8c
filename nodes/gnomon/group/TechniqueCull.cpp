// SPDX-License-Identifier: MIT
// ShadowTechnique: its part of a cull traversal.
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowTechnique.h>
#include <gnomon/base/FrameDiagnosis.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/group/ShadowBin.h>

#include <osg/GraphicsContext>
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

/// Asks OpenGL where this thread may, so that the first frame is right; else the draw traversal does.
void learnQuads(osgUtil::CullVisitor& cull) {
    const osg::GraphicsContext* context = cull.getState() ? cull.getState()->getGraphicsContext() : nullptr;
    if (context && context->isCurrent()) learnQuadCut();
}

} // namespace

void ShadowTechnique::enlist(osgUtil::CullVisitor& cull) {
    const unsigned frame = frameOf(cull);
    osgUtil::RenderStage* stage = cull.getCurrentRenderBin()->getStage();
    beginFrame(frame, timeOf(cull), stage);
    const GroupAbove above = groupAbove(cull.getNodePath());
    if (!above.group) {
        report(frame,
               "there is no ShadowCasterGroup above this node. Make it a child of the group that holds the casters.");
        return;
    }
    if (cull.getViewport() != stage->getViewport()) {
        report(frame, "a nested camera above this node has a viewport of its own, where the shadow would be drawn in "
                      "the wrong place. Set that camera's render order to PRE_RENDER or POST_RENDER.");
        return;
    }
    EnlistedTechnique entry;
    entry.technique = this;
    entry.group = above.group;
    entry.groupFromTechnique = above.groupFromTechnique;
    entry.eyeFromGroup = osg::Matrixd::inverse(above.groupFromTechnique) * *cull.getModelViewMatrix();
    entry.projection = cull.getProjectionMatrix();
    entry.viewPoint = cull.getReferenceViewPoint();
    entry.lodScale = cull.getLODScale();
    entry.mask = (cull.getTraversalMask() & cull.getNodeMaskOverride()) ? ~0u : cull.getTraversalMask();
    entry.state = cull.getCurrentStateGraph();
    entry.frameNumber = frame;
    entry.frameTime = timeOf(cull);
    learnQuads(cull);
    ShadowBin::of(stage).enlist(entry);
}

void ShadowTechnique::traverse(osg::NodeVisitor& visitor) {
    if (osgUtil::CullVisitor* cull = visitor.asCullVisitor()) enlist(*cull);
    osg::Geode::traverse(visitor);
}

} // namespace gnomon
