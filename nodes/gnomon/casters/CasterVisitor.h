// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Selection.h>
#include <gnomon/base/Fingerprint.h>
#include <gnomon/casters/Casting.h>

#include <osg/AutoTransform>
#include <osg/CullStack>
#include <osg/Matrixd>
#include <osg/NodeVisitor>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gnomon {

/// Walks to the drawables that can cast: those of a Selection, without techniques, cameras, projections, text,
/// labels (AutoTransforms that keep their size on the screen) and what does not move with its parents (absolute
/// transforms). What turns with the view (billboards, other AutoTransforms) stands as that view draws it; without a view it is
/// left out. Extraction (CasterExtraction) and change detection (CasterFingerprint) share it, so that they agree on what
/// a caster is.
///
/// Cost    a visit of what is above and below the selected node; of all nodes where none is.
/// Limits  a cull callback that chooses what is shown is not asked.
///
/// For a view, an LOD and any other node chooses its children as in that view's cull: the visitor answers as a
/// CullVisitor would. Without a view, an LOD gives the children shown at the nearest range that a loaded child has (by
/// pixels: the largest). The first matrix is that of the root: its own transform counts, its parents' do not.
class CasterVisitor : public osg::NodeVisitor {
public:
    /// Which children of an LOD are visited.
    enum class Levels {
        Chosen, ///< those that the view shows; without a view the finest.
        All
    };

    void reset() override;
    void apply(osg::Node& node) override;
    void apply(osg::Drawable& drawable) override;
    void apply(osg::Geode& geode) override;
    void apply(osg::ClipNode& node) override;
    void apply(osg::LOD& lod) override;
    void apply(osg::Sequence& sequence) override;
    void apply(osg::Transform& transform) override;
    void apply(osg::Billboard& billboard) override;
    void apply(osg::Camera&) override {}
    void apply(osg::Projection&) override {}

    /// The frame that is meant by the root's, where that is not the one that the visited node stands in. Default identity.
    void setRootFromVisited(const osg::Matrixd& matrix) {
        _placements.assign(1, {matrix});
        _hiding.reset();
    }
    /// Takes levels of detail as a view does, whose group is the root. Default: no view.
    void setView(const CasterView& view);
    /// Leaves out what casts nothing by the states that it is drawn with. Default: all counts, and whole.
    void setRule(const CastingRule& rule) { _judge.setRule(rule); }
    /// Default Levels::Chosen.
    void setLevels(Levels levels) { _levels = levels; }
    /// Name of the first drawable that casts nothing by its states, as nameAlong() has it; empty if each casts.
    const std::string& leftOut() const { return _leftOut; }
    /// Stands for the drawables that were met under LODs and sequences, wherever they are.
    std::uint64_t choice() const { return _choice.value(); }
    /// Adds the arrays and primitive sets of a drawable that are read; the drawable itself if it is no geometry.
    static void holdSources(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources);

    osg::CullStack* asCullStack() override { return _atPixelLevels > 0 ? _cullStack.get() : nullptr; }
    const osg::CullStack* asCullStack() const override { return _atPixelLevels > 0 ? _cullStack.get() : nullptr; }
    osg::Vec3 getEyePoint() const override;
    osg::Vec3 getViewPoint() const override;
    float getDistanceToEyePoint(const osg::Vec3& place, bool useLODScale) const override;
    float getDistanceFromEyePoint(const osg::Vec3& place, bool useLODScale) const override;
    float getDistanceToViewPoint(const osg::Vec3& place, bool useLODScale) const override;

protected:
    explicit CasterVisitor(const Selection& selection);
    ~CasterVisitor() override = default;

    /// Called for each caster, once for each way down to it.
    virtual void applyCaster(osg::Drawable& drawable, const Casting& casting) = 0;
    /// Called in the same way for each that drawsItself(). A geometry may be both.
    virtual void applySelfDrawing(osg::Drawable&, const Casting&) {}
    /// From the frame of the drawable being visited to that of the root.
    const osg::Matrixd& rootFromLocal() const { return _placements.back().rootFromLocal; }
    /// Stands for rootFromLocal(). Found once for all that stands there.
    std::uint64_t placeValue() const;
    /// What its states leave of the drawable being visited: all, at no cost, if no state on the way to it may matter.
    virtual Casting castingOf(const osg::Drawable& drawable);
    /// Of the drawable being visited, in the view.
    virtual Hiding hiding() const;
    /// True while the drawable being visited is under an LOD or a sequence: it may go and come back.
    bool isOfLevels() const { return _atLevels > 0; }

private:
    class OnTheWay;

    bool isRoot(const osg::Node& node) const { return _roots.count(const_cast<osg::Node*>(&node)) > 0; }
    void findWays();
    void enterState(const osg::Node& node);
    void enterPlace(const osg::Matrixd& matrix);
    void leavePlace();
    bool isOnTheWay(const osg::Node& node) const;
    bool mayMatterAbove();
    bool goesTheOnlyWays(osg::Node& node);
    void visitLevels(osg::LOD& lod);
    void enterCullStack(const osg::Matrixd& eyeFromLocal);
    void leaveCullStack();
    void visitTurning(osg::AutoTransform& transform);
    osg::Matrixd eyeFromHere() const { return eyeFrom(getNodePath().size()); }
    osg::Matrixd eyeFrom(std::size_t end) const;

    const std::vector<osg::ref_ptr<osg::Node>> _selected; ///< empty: everything.
    const std::set<osg::Node*> _roots;                    ///< the same, each once.
    struct Placement {
        osg::Matrixd rootFromLocal;
        mutable std::uint64_t value = 0; ///< that stands for it; 0 until asked for.
    };
    std::vector<Placement> _placements; ///< of the frames on the way down.
    Levels _levels = Levels::Chosen;
    std::optional<CasterView> _view;
    std::unique_ptr<osg::CullStack> _cullStack; ///< of the view; null until an LOD by pixels is met.
    int _atPixelLevels = 0;                     ///< how many of them are on the way down.
    std::vector<std::pair<std::size_t, osg::Matrixd>>
        _turned;       ///< where the path goes on below an AutoTransform, and the eye.
    int _atLevels = 0; ///< how many LODs and sequences are on the way down.
    Fingerprint _choice;
    int _inside = 0; ///< how often a selected node is on the way down.
    CastingJudge _judge;
    int _exceptions = 0;                ///< how many states on the way down may matter to it.
    const osg::Node* _front = nullptr;  ///< of the path for which the next holds.
    bool _exceptionAbove = false;       ///< whether a state above it may.
    std::vector<NumberedPlane> _planes; ///< of the view, and of ClipNodes on the way down, root frame.
    std::string _leftOut;
    int _hidden = 0;                       ///< how many nodes on the way down the view's mask leaves out.
    std::vector<HidingState> _states;      ///< of those on the way down; the first is of what is above.
    mutable std::optional<Hiding> _hiding; ///< by these, in this place, once asked for.
    /// Of what is above the selected nodes, the children that lead to it; once for each of its places among them.
    std::map<const osg::Node*, std::vector<osg::Node*>> _ways;
};

/// True if a frame turns the sense of triangles round.
bool mirrors(const osg::Matrixd& matrix);

/// Name of the last node of a path, or of the nearest named one above it; else its class name.
std::string nameAlong(const osg::NodePath& path);

/// Fingerprint of everything that CasterExtraction would read: which arrays and primitives, where, and their
/// modification counts. Two frames with the same value have the same casters, so nothing is extracted again.
///
/// Arrays are told apart by address. Compare a value only with one whose CasterMesh (or CasterExtraction) is still held:
/// it keeps the arrays it was made of, so that no later array can stand at the same place.
///
/// Cost    a visit of the casters' nodes; of their vertices where Follows::Each says so. No allocation once warm.
/// Limits  arrays and primitives changed in place must be dirty()'d, as OpenSceneGraph asks; a change of size or bounds
///         shows by itself, and so does any where there are neither lists nor buffers.
class CasterFingerprint : public CasterVisitor {
public:
    explicit CasterFingerprint(const Selection& selection = {});
    ~CasterFingerprint() override = default;
    META_NodeVisitor(gnomon, CasterFingerprint)

    void reset() override;
    std::uint64_t value() const { return _fingerprint.value(); }

    /// Of what CasterExtraction would read of one drawable.
    static std::uint64_t of(const osg::Drawable& drawable, const osg::Matrixd& rootFromLocal, const Casting& casting);
    /// The same, wherever it is. @param contents  see contentsOf(); 0 if its counts tell.
    static std::uint64_t ofGeometry(const osg::Drawable& drawable, const Casting& casting, std::uint64_t contents);
    /// Of a geometry, at a place. @param place  see placeValue().
    static std::uint64_t placed(std::uint64_t geometry, std::uint64_t place);

protected:
    void applyCaster(osg::Drawable& drawable, const Casting& casting) override {
        _fingerprint.mix(of(drawable, rootFromLocal(), casting));
    }

private:
    Fingerprint _fingerprint;
};

} // namespace gnomon
