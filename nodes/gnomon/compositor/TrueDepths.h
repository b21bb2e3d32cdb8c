// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ScreenRect.h>
#include <gnomon/compositor/CompositorStage.h>

namespace gnomon {

/// While it lives, the depths of a stage's vast leaves are right: their triangles, cut in double, are drawn where the leaf is
/// what one sees. Afterwards the leaf's own depths stand there again, to the bit. Nothing is done in stages without any.
class TrueDepths {
public:
    TrueDepths(const CompositorStage& draw, const ScreenRect& bounds);
    ~TrueDepths();
    TrueDepths(const TrueDepths&) = delete;
    TrueDepths& operator=(const TrueDepths&) = delete;

private:
    const CompositorStage& _draw;
    const ScreenRect _bounds;
};

} // namespace gnomon
