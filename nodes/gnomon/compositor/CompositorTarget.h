// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/WorkFramebuffer.h>

#include <optional>
#include <vector>

namespace gnomon {

/// What composing needs of the framebuffer that it is done in.
struct TargetNeeds {
    ScreenRect bounds = wholeScreen; ///< nothing is drawn outside.
    unsigned reserved = 0;           ///< stencil bits that are the application's.
    std::size_t stencilBits = 0;     ///< beside those.
    bool alpha = false;
    bool depth = true;       ///< that of the framebuffer.
    bool ownStencil = false; ///< nobody else's marks may be touched.
};

/// The needs of these jobs alone.
TargetNeeds needsOf(const std::vector<ShadowJob>& jobs);

/// What the compositor draws into, while it does: the framebuffer that is bound, its first colour buffer alone; or where
/// that lacks what is needed, one of its own in that one's place (WorkFramebuffer).
class CompositorTarget {
public:
    /// Call where no state set is on the stack, in a compatibility profile.
    CompositorTarget(osg::State& state, const osg::Viewport& viewport, const TargetNeeds& needs);

    /// True if it is one of its own: no stencil bit is anyone else's, and all are 0.
    bool isOwn() const { return _own && _own->isBound(); }
    /// True if depths are to be drawn first.
    bool lacksDepth() const { return isOwn() && !_own->hasDepth(); }

private:
    const FirstColorBuffer _colors;
    std::optional<WorkFramebuffer> _own;
};

} // namespace gnomon
