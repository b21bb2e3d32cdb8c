// SPDX-License-Identifier: MIT
#define HWY_COMPILE_ALL_ATTAINABLE // the one without SIMD, too
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gnomon/simd/ShadowKernel.cpp"
#include <hwy/foreach_target.h>

#include <gnomon/simd/ShadowKernel-inl.h>

#if HWY_ONCE
namespace gnomon {

namespace {

HWY_EXPORT(kernel);

} // namespace

const std::vector<ShadowKernel>& shadowKernels() {
    static const std::vector<ShadowKernel> all = [] {
        std::vector<ShadowKernel> found;
        const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets(); // best first
        for (auto target = targets.rbegin(); target != targets.rend(); ++target) {
            hwy::SetSupportedTargetsForTest(*target);
            hwy::GetChosenTarget().Update(hwy::SupportedTargets());
            found.push_back(HWY_DYNAMIC_DISPATCH(kernel)());
        }
        hwy::SetSupportedTargetsForTest(0);
        return found;
    }();
    return all;
}

} // namespace gnomon
#endif
