// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ScreenBounds.h>

#include <osg/Referenced>
#include <osg/RenderInfo>

namespace gnomon {

/// One technique's share of one view: marks, in draw, the pixels that one light does not reach.
class GNOMON_EXPORT MarkJob : public osg::Referenced {
public:
    /// Where marks can fall; everything the compositor does is cut to it.
    ScreenRect screenBounds{{-1.0, -1.0}, {1.0, 1.0}};

    /// Sets `markBit` in the stencil buffer where the light does not reach. Colour and depth stay as they are; of the
    /// other stencil bits only `scratchBit` may be used, and is zero before and after.
    /// Called with a clean OpenGL state: no program, no texture, no stencil test, depth test off, colour writes off.
    virtual void mark(osg::RenderInfo& renderInfo, unsigned markBit, unsigned scratchBit) const = 0;

protected:
    ~MarkJob() override = default;
};

} // namespace gnomon
