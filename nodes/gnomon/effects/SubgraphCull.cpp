// SPDX-License-Identifier: MIT
#include <gnomon/ShadowTechnique.h>
#include <gnomon/base/BoxAbout.h>
#include <gnomon/effects/SubgraphCull.h>

#include <osg/OcclusionQueryNode>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

/// State sets on the way from the root to `graph`.
std::vector<const osg::StateSet*> stateSetsTo(const osgUtil::StateGraph* graph) {
    std::vector<const osg::StateSet*> sets;
    for (; graph; graph = graph->_parent)
        if (graph->getStateSet()) sets.push_back(graph->getStateSet());
    std::reverse(sets.begin(), sets.end());
    return sets;
}

} // namespace

SubgraphCull::SubgraphCull(osgUtil::CullVisitor& cull, osg::Group& group, const osg::Matrixd& eyeFromGroup, Keep keep)
    : osgUtil::CullVisitor(cull) {
    startFrom(cull);
    if (keep == Keep::All) setCullingMode(NO_CULLING);
    pushViewport(cull.getViewport());
    pushProjectionMatrix(cull.getProjectionMatrix());
    pushModelViewMatrix(createOrReuseMatrix(eyeFromGroup), osg::Transform::ABSOLUTE_RF);
    for (const osg::StateSet* set : stateSetsTo(cull.getCurrentStateGraph())) pushStateSet(set);
    for (unsigned i = 0; i < group.getNumChildren(); ++i) group.getChild(i)->accept(*this);
    popModelViewMatrix();
    popProjectionMatrix();
    popViewport();
}

void SubgraphCull::startFrom(osgUtil::CullVisitor& cull) {
    setComputeNearFarMode(DO_NOT_COMPUTE_NEAR_FAR);
    setFrameStamp(const_cast<osg::FrameStamp*>(cull.getFrameStamp()));
    setDatabaseRequestHandler(cull.getDatabaseRequestHandler());
    setImageRequestHandler(cull.getImageRequestHandler());
    setUserData(cull.getUserData());
    setRenderInfo(cull.getRenderInfo());
    for (osg::Node* node : cull.getNodePath()) pushOntoNodePath(node);
    osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
    stage->setViewport(cull.getCurrentRenderStage()->getViewport());
    stage->setCamera(cull.getCurrentCamera());
    setStateGraph(new osgUtil::StateGraph);
    setRenderStage(stage);
}

std::vector<DrawnLeaf> SubgraphCull::leaves() {
    return leavesBelow(*getRenderStage(), std::numeric_limits<int>::max());
}

std::vector<DrawnLeaf> SubgraphCull::sortedLeaves() {
    getRenderStage()->sort();
    return leaves();
}

void SubgraphCull::apply(osg::Geode& node) {
    if (!dynamic_cast<ShadowTechnique*>(&node)) osgUtil::CullVisitor::apply(node);
}

/// Its query is the frame's own.
void SubgraphCull::apply(osg::OcclusionQueryNode& node) { apply(static_cast<osg::Group&>(node)); }

bool isSubgraphCull(const osg::NodeVisitor& visitor) { return dynamic_cast<const SubgraphCull*>(&visitor) != nullptr; }

osg::BoundingBoxd boxOf(const osgUtil::RenderLeaf& leaf, const osg::Matrixd& frameFromLocal) {
    return boxAbout(leaf._drawable->getBoundingBox(), frameFromLocal);
}

void includeInDepths(osgUtil::CullVisitor& cull, const osg::BoundingBoxd& inEye, bool near) {
    const bool computed = cull.getComputeNearFarMode() != osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR;
    if (!computed || !inEye.valid() || cull.getCalculatedFarPlane() < cull.getCalculatedNearPlane()) return;
    cull.setCalculatedFarPlane(std::max(cull.getCalculatedFarPlane(), -inEye.zMin()));
    if (near) cull.setCalculatedNearPlane(std::min(cull.getCalculatedNearPlane(), -inEye.zMax()));
}

} // namespace gnomon
