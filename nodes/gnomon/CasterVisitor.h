// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/Selection.h>

#include <osg/Matrixd>
#include <osg/NodeVisitor>

#include <vector>

namespace gnomon {

/// Walks to the drawables that can cast: those of a Selection, without techniques, cameras, billboards and absolute transforms.
/// Extraction (VertexTraverser) and change detection (CasterRevision) share it, so that they agree on what a caster is.
class GNOMON_EXPORT CasterVisitor : public osg::NodeVisitor {
public:
    void reset() override;
    void apply(osg::Node& node) override;
    void apply(osg::Geode& geode) override;
    void apply(osg::Billboard& billboard) override;
    void apply(osg::Transform& transform) override;
    void apply(osg::Camera& camera) override;

protected:
    explicit CasterVisitor(const Selection& selection);

    /// From the frame of the drawable being visited to that of the root.
    const osg::Matrixd& rootFromLocal() const { return _matrices.back(); }
    /// True once the selected node has been entered.
    bool selected() const { return _inside > 0; }

private:
    void enter(osg::Node& node);

    Selection _selection;
    std::vector<osg::Matrixd> _matrices;
    int _inside = 0;
};

} // namespace gnomon
