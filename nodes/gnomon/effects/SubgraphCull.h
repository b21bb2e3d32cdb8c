// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Convert.h>
#include <gnomon/compositor/DrawnLeaves.h>

#include <osgUtil/CullVisitor>

#include <vector>

namespace gnomon {

/// Culls a group's children once more, as seen from another place, while another cull traversal stands at that group,
/// and keeps the leaves, apart from those that the frame draws. State, projection and settings are those of that
/// traversal. Left out are shadow techniques and cameras; what other nodes draw besides their children (mirror images,
/// halos) is not drawn.
class SubgraphCull : public osgUtil::CullVisitor {
public:
    enum class Keep { InView, All };
    /// @param cull  its near and far planes stay as they are. @param keep  which leaves.
    SubgraphCull(osgUtil::CullVisitor& cull, osg::Group& group, const osg::Matrixd& eyeFromGroup, Keep keep);
    const char* libraryName() const override { return "gnomon"; }
    const char* className() const override { return "SubgraphCull"; }

    /// In any order. During the cull.
    std::vector<DrawnLeaf> leaves();
    /// In the order in which a stage would draw them. After the whole cull.
    std::vector<DrawnLeaf> sortedLeaves();

    using osgUtil::CullVisitor::apply;
    void apply(osg::Geode& node) override;
    void apply(osg::Camera&) override {}
    void apply(osg::OcclusionQueryNode& node) override;

protected:
    ~SubgraphCull() override = default;

private:
    void startFrom(osgUtil::CullVisitor& cull);
};

/// True within the traversal of a SubgraphCull.
bool isSubgraphCull(const osg::NodeVisitor& visitor);

/// The box about a leaf's drawable in another frame; invalid if the drawable has none.
osg::BoundingBoxd boxOf(const osgUtil::RenderLeaf& leaf, const osg::Matrixd& frameFromLocal);

/// Lets the far plane that OSG computes, and if `near` the near one, take in what lies in a box in eye space.
void includeInDepths(osgUtil::CullVisitor& cull, const osg::BoundingBoxd& inEye, bool near);

} // namespace gnomon
