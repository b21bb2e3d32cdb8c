// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/AutoShadowOptions.h>
#include <gnomon/ShadowTechnique.h>

#include <memory>
#include <vector>

namespace gnomon {

class AutoChooser;

/// Casts shadows by one of the other techniques, that keeps an error and is as cheap as any.
///
/// Take it if you do not want to choose. Take one of the others if you know which: it then never changes.
///
///     osg::ref_ptr<gnomon::AutoShadowTechnique> shadow = new gnomon::AutoShadowTechnique;
///     shadow->setError(0.4); // optional: pixels
///     group->addChild(shadow);
///
/// Candidates
/// - No shadow at all, if none could be seen, or if RELIGHT would change no channel by 2/255.
/// - All but the first with hard or smooth edges.
/// - TerrainShadowGeode with HULL, if a terrain is named as receiver and does not shadow itself.
/// - ShadowMapTechnique, with all sizes, numbers of cascades and filters.
/// - ShadowVolumeTechnique and TracedShadowTechnique, if no caster is clear in part.
/// - A candidate whose shadow would be wrong here is never chosen. ShadowCandidate::obstacle says why.
/// The rule
/// - The error of each candidate is predicted from the shadow's edges in sight. Its work is counted: casters, triangles, texels,
///   pixels. Work is weighed as the time that the processor and the renderer take together.
/// - Of those that keep the error and take up to a quarter more than the cheapest, or on a graphics card half a millisecond more,
///   the most accurate is taken. So edges are smooth where that costs little.
/// - lastDecision() gives the candidates, with the choice and its reason.
/// - The choice follows from facts of the scene and of its last frames: two runs of a program choose alike.
/// Changes
/// - A scene that stands still is judged once, and once more if the light or a caster comes to rest.
/// - In a scene that moves, candidates are judged again once the view, the light or the casters' bounds have changed by an
///   eighth, after 16 to 64 frames at the earliest, and after 128 to 512 in any case. At once where the one that is drawn would
///   become wrong.
/// - The candidate that is drawn is judged as if it took and erred a tenth less. So two that are alike do not take turns.
/// Cost
/// - In a frame without change: a look at the view, the light and the drawables in sight.
/// - A decision: a few visits of casters and receivers. In motion three frames share it; each part takes as long as a frame of the
///   scene, or two. The candidate that is drawn costs what it costs alone.
/// Needs
/// - The needs of the chosen technique.
/// Limits
/// - It leaves the group's composite as it is. BLEND is cheaper.
/// - A change of the choice costs the first frame of the technique that takes over.
/// - Penumbras are never chosen. Use ShadowMapTechnique with SOFT edges for them.
/// - Each light keeps the error alone.
/// - ShadowQuery answers by rays.
/// Threads
/// - Any number of cull and draw threads. Set properties between frames.
///
/// In a file (.osgt, .osgb, .osgx), properties left out have their defaults:
///
///     gnomon::AutoShadowTechnique {
///       UniqueID 2
///       Error 0.4
///     }
class GNOMON_EXPORT AutoShadowTechnique : public ShadowTechnique {
public:
    /// A technique with the default budget.
    AutoShadowTechnique();
    /// Copies the properties.
    AutoShadowTechnique(const AutoShadowTechnique& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY);
    META_Node(gnomon, AutoShadowTechnique)

    /// Sets the budget. AutoShadowOptions::usable() says what becomes of values out of range.
    void setOptions(const AutoShadowOptions& options) { _options = options.usable(); }
    /// See setOptions().
    const AutoShadowOptions& getOptions() const { return _options; }
    /// See AutoShadowOptions::error.
    void setError(double pixels);
    /// See AutoShadowOptions::error.
    double getError() const { return _options.error; }

    /// The choices in the view that was drawn last, in the order of the lights' numbers. A light has one choice for the
    /// receivers of the opaque bins, which comes first. Receivers that are drawn late have one more, and so has each depth
    /// range and polygon offset; ShadowDecision::receivers names them. The camera that was drawn last counts.
    /// Empty before the first frame, and if no light or no caster was there.
    std::vector<ShadowDecision> lastDecision() const override;
    /// That of all techniques which it has chosen so far.
    unsigned passes() const override;

    /// Decides if need be, and asks the chosen technique. See ShadowTechnique::prepare().
    std::vector<osg::ref_ptr<Mark>> prepare(const ViewFrame& view, const ShadowLight& light,
                                            const Casters& casters) const override;

    /// See ShadowTechnique::letGo().
    void letGo() const override;
    /// Learns who draws. See ShadowTechnique::watch().
    osg::ref_ptr<DrawWatch> watch(const ViewFrame& view) const override;
    /// Registers the technique with the compositor in a cull traversal.
    void traverse(osg::NodeVisitor& visitor) override;

    /// Prepares OpenGL objects for more contexts, as osg::Node does.
    void resizeGLObjectBuffers(unsigned maxSize) override;
    /// Releases OpenGL objects, as osg::Node does.
    void releaseGLObjects(osg::State* state = nullptr) const override;

    /// True: it takes maps where casters draw themselves.
    bool drawsCasters() const override { return true; }

protected:
    ~AutoShadowTechnique() override;

private:
    AutoShadowOptions _options;
    std::unique_ptr<AutoChooser> _chooser;
};

} // namespace gnomon
