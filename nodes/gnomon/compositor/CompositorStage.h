// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CompositorOptions.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/SavedFrame.h>
#include <gnomon/compositor/VastLeaves.h>
#include <gnomon/gl/GlState.h>

#include <osg/RenderInfo>
#include <osg/Viewport>
#include <osgUtil/RenderStage>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

class MaterialHistory;

/// What a stage draws since its frame was saved, where some of it is clear in parts.
struct DrawnSince {
    osg::ref_ptr<SavedFrame> frame;
    int number = 0;                  ///< of the bin that saved it.
    std::vector<DrawnLeaf> hiding{}; ///< leaves that hide what is behind, where they do, see LateReceivers.
};

/// What a CompositorStage is made of.
struct DrawnStage {
    std::vector<DrawnLeaf> leaves; ///< that it has drawn before, in order.
    CompositorOptions options;
    bool stencilIsZero;                ///< it is known to be.
    std::size_t bitsOfLights;          ///< how many stencil bits marks take, 2 to 8; others are counters.
    const DrawnSince* since = nullptr; ///< what stood before the first of the leaves; null: what the stage clears to.
};

/// One stage while the compositor draws in it: what was drawn before, and what its framebuffer offers.
class CompositorStage {
public:
    /// In a stage that can be composed in, see whyNeverComposed().
    /// @param materials  what the leaves' materials left for each other; must outlive this.
    CompositorStage(osg::RenderInfo& renderInfo, osgUtil::RenderStage& stage, DrawnStage drawn,
                    MaterialHistory& materials);

    /// One step, cut to `bounds`, from and back to OpenGL's defaults.
    template <typename Step>
    void pass(const ScreenRect& bounds, Step step) const {
        CleanState cleanState(state, stage.getViewport());
        const PixelRect pixels = pixelsWithin(bounds, *stage.getViewport());
        ScreenPass screen(
            renderInfo, pixels, [this] { return channels(); }, counters, pattern);
        step(screen);
    }
    void clear(unsigned stencil, const ScreenRect& bounds) const;
    /// Before marks: what others left in these bits would be taken for marks wherever leaves are drawn again.
    void clearLeftovers(unsigned stencil) const;

    /// Those that the leaves write; if they write none, as catchers of shadows do, the stage's.
    Channels channels() const;

    osg::RenderInfo& renderInfo;
    osg::State& state;
    osgUtil::RenderStage& stage;
    const std::vector<DrawnLeaf> leaves;
    const CompositorOptions options;
    MaterialHistory& materials; ///< of the leaves.
    const bool stencilIsZero;
    const StencilPattern pattern; ///< its bit is not among `bits`.
    bool hasStencil = false, hasAlpha = false;
    std::vector<unsigned> bits;    ///< of the stencil buffer, those that are free, the highest first.
    unsigned counters = 0;         ///< some of them, see ScreenPass::counters(); 0 if there are none.
    std::vector<VastLeaf> vast;    ///< see VastLeaf; TrueDepths puts them right.
    unsigned vastBit = 0;          ///< for it; not among `bits`.
    const DrawnSince* const since; ///< see DrawnStage.
    unsigned hidingBit = 0;        ///< set where its leaves hide what was saved; 0: there are none. Not among `bits`.

private:
    mutable std::optional<Channels> _channels; ///< once asked for.
};

/// Takes the state sets of the leaf drawn last off the stack, as osgUtil does before positional state.
void popLeafState(osg::State& state, osgUtil::RenderLeaf*& previous);

/// State sets and matrices as osgUtil leaves them when it has drawn a leaf.
void pushLeafState(osg::State& state, const osgUtil::RenderLeaf& leaf);

/// The cause for diagnose() in a core profile.
constexpr const char* coreProfileRefused =
    "this is a core profile context, in which nothing is drawn. Ask for a compatibility profile; with GLX, leave "
    "osg::GraphicsContext::Traits::glContextVersion at 1.0.";

/// Why nothing can be composed in this stage, whatever its framebuffer, as a cause for diagnose(); empty if all is well.
std::string whyNeverComposed(const osg::State& state, const osgUtil::RenderStage& stage);
/// The same by what is drawn into.
std::string whyNotComposed(const CompositorStage& draw);

} // namespace gnomon
