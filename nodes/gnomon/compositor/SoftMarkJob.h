// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/MarkJob.h>

namespace gnomon {

/// A job whose edges are soft: each pixel knows what share of the light reaches it. mark() then marks what less than
/// half of the light reaches. Pixels at which nothing stands (far depth) get all of the light.
class SoftMarkJob : public MarkJob {
public:
    /// As mark(), wherever not all of the light arrives; with the share that does in the fragments' alpha. The pass's blending
    /// and colour mask stand.
    virtual std::string markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const = 0;

    /// What drawShare() puts into alpha.
    enum class Share { Arriving, Blocked };
    /// Draws over the pixels that markTouched() marks, and any others; `share` of the light, 0 … 1, in alpha; pixels whose
    /// alpha would be 1 may be left out. The pass's stencil test, blending and colour mask stand.
    virtual std::string drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const = 0;

protected:
    ~SoftMarkJob() override = default;
};

} // namespace gnomon
