// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/LeafReplay.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowBin.h>

#include <map>
#include <vector>

namespace gnomon {

/// What a ShadowBin does in draw: marks, takes light away where marked, and leaves the stencil bits it used at zero.
class Compositor {
public:
    Compositor(osg::RenderInfo& renderInfo, osgUtil::RenderStage& stage, std::vector<StageLeaf> leaves);

    void compose(const std::vector<ShadowJob>& jobs);

private:
    using Jobs = std::vector<const ShadowJob*>;
    struct Bits {
        std::vector<unsigned> lights;
        unsigned scratch = 0;
    };
    /// Jobs of the lights that are dark in one relight pass, and the bits that say so.
    struct Combination {
        unsigned bits = 0;
        Jobs jobs;
        ScreenRect bounds;
    };

    void relight(const Jobs& jobs);
    void blend(const Jobs& jobs, float dark);
    void mark(const Jobs& jobs, const std::map<int, unsigned>& bitOf, const ScreenRect& bounds);
    void markOne(const ShadowJob& job, unsigned bit, bool fresh);
    void gate(const ShadowJob& job, unsigned bit);
    void transfer(const ShadowJob& job, unsigned bit);
    void clear(unsigned bits, const ScreenRect& bounds);
    void replay(const Combination& combination, unsigned lightBits);
    std::map<int, unsigned> assignBits(const Jobs& jobs) const;
    bool canMark(const ShadowJob& job) const;

    osg::RenderInfo& _renderInfo;
    osg::State& _state;
    osgUtil::RenderStage& _stage;
    std::vector<StageLeaf> _leaves;
    Bits _bits;
    unsigned _stencilBits = 0;
};

} // namespace gnomon
