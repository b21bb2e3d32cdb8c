// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Selection.h>
#include <gnomon/casters/AlphaTest.h>

#include <osg/Matrixd>
#include <osg/NodeVisitor>

#include <map>
#include <optional>
#include <set>
#include <vector>

namespace osg {
class Array;
}

namespace gnomon {

/// Walks to the drawables that can cast: those of a Selection, without techniques, cameras, projections, text and
/// whatever turns or scales with the view (billboards, such AutoTransforms) or does not move with its parents (absolute
/// transforms). Extraction (CasterExtraction) and change detection (CasterFingerprint) share it, so that they agree on what
/// a caster is.
///
/// Cost    a visit of what is above and below the selected node; of all nodes where none is.
///
/// Of an LOD it takes the children shown at the nearest range that a loaded child has (by pixels: the largest), not
/// those that one view shows. The first matrix is that of the root: its own transform counts, its parents' do not.
class CasterVisitor : public osg::NodeVisitor {
public:
    void reset() override;
    void apply(osg::Node& node) override;
    void apply(osg::Drawable& drawable) override;
    void apply(osg::Geode& geode) override;
    void apply(osg::LOD& lod) override;
    void apply(osg::Transform& transform) override;
    void apply(osg::Billboard&) override {}
    void apply(osg::Camera&) override {}
    void apply(osg::Projection&) override {}

    /// The frame that is meant by the root's, where that is not the one that the visited node stands in. Default identity.
    void setRootFromVisited(const osg::Matrixd& matrix) { _matrices.assign(1, matrix); }

protected:
    explicit CasterVisitor(const Selection& selection);
    ~CasterVisitor() override = default;

    /// Called for each caster, once for each way down to it.
    virtual void applyCaster(osg::Drawable& drawable) = 0;
    /// From the frame of the drawable being visited to that of the root.
    const osg::Matrixd& rootFromLocal() const { return _matrices.back(); }
    /// Of the drawable being visited: nullopt, at no cost, if no state on the way to it switches one on.
    virtual std::optional<AlphaTest> alphaTest() const;
    /// What OpenSceneGraph's functors take for the vertices of a geometry; null if it has none.
    static const osg::Array* verticesOf(const osg::Geometry& geometry);
    /// Adds the arrays and primitive sets of a drawable that are read; the drawable itself if it is no geometry.
    static void holdSources(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources);

private:
    class OnTheWay;

    bool isRoot(const osg::Node& node) const { return _roots.count(const_cast<osg::Node*>(&node)) > 0; }
    void findWays();
    bool isOnTheWay(const osg::Node& node) const;
    bool goesTheOnlyWays(osg::Node& node);

    const std::vector<osg::ref_ptr<osg::Node>> _selected; ///< empty: everything.
    const std::set<osg::Node*> _roots;                    ///< the same, each once.
    std::vector<osg::Matrixd> _matrices;
    int _inside = 0;     ///< how often a selected node is on the way down.
    int _alphaTests = 0; ///< how many states on the way down switch an alpha test on.
    /// Of what is above the selected nodes, the children that lead to it; once for each of its places among them.
    std::map<const osg::Node*, std::vector<osg::Node*>> _ways;
};

} // namespace gnomon
