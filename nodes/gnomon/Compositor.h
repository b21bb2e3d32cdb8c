// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/LeafReplay.h>
#include <gnomon/ReplayFilter.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowBin.h>

#include <map>
#include <vector>

namespace gnomon {

/// What a ShadowBin does in draw: marks, takes light away where marked, and leaves the stencil bits it used at zero.
class Compositor {
public:
    /// @param leaves  what the stage drew before, in order.
    /// @param clean   the stencil buffer is known to be zero.
    Compositor(osg::RenderInfo& renderInfo, osgUtil::RenderStage& stage, std::vector<StageLeaf> leaves, bool clean);

    void compose(const std::vector<ShadowJob>& jobs);

private:
    using Jobs = std::vector<const ShadowJob*>;
    struct Bits {
        std::vector<unsigned> lights;
        unsigned scratch = 0;
    };
    /// Jobs of the lights that are dark in one relight pass, and the bits that say so.
    struct Combination {
        unsigned bits;
        Jobs jobs;
        ScreenRect bounds;
    };

    bool canMark(const ShadowJob& job) const;
    bool composeDirectly(const Jobs& jobs);
    void relight(const Jobs& wanted);
    static void blendInstead(const Jobs& jobs, std::map<float, Jobs>& blended);
    void blend(const Jobs& jobs, float dark);

    std::map<int, unsigned> assignBits(const Jobs& jobs) const;
    Combination combine(const Jobs& jobs, const std::map<int, unsigned>& bitOf, unsigned subset) const;
    void replay(const Combination& combination, unsigned lightBits);
    void replay(const std::vector<ReplayedLeaf>& leaves, LeafReplay::Overlay overlay, const Jobs& jobs);

    void mark(const Jobs& jobs, const std::map<int, unsigned>& bitOf);
    void markOne(const ShadowJob& job, unsigned bit, bool fresh);
    void markInto(const ShadowJob& job, unsigned bit);
    void gate(const ShadowJob& job, unsigned bit);
    void transfer(const ShadowJob& job, unsigned bit);
    void resetMarked(unsigned where, const ScreenRect& bounds);
    void clear(unsigned bits, const ScreenRect& bounds);

    osg::RenderInfo& _renderInfo;
    osg::State& _state;
    osgUtil::RenderStage& _stage;
    std::vector<StageLeaf> _leaves;
    Bits _bits;
    unsigned _stencilBits = 0;
    bool _clean;
};

} // namespace gnomon
