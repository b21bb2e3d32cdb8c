// SPDX-License-Identifier: MIT
#define HWY_COMPILE_ALL_ATTAINABLE // the one without SIMD, too
#include <cmath>
#include <cstdint>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "gnomon/ShadowKernel.cpp"
#include <hwy/foreach_target.h>

#include <gnomon/ShadowKernel-inl.h>

#if HWY_ONCE
#include <atomic>

namespace gnomon {

namespace {

HWY_EXPORT(kernel);

/// Those that this machine can run, worst first.
const std::vector<ShadowKernel>& kernels() {
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

std::atomic<const ShadowKernel*>& chosen() {
    static std::atomic<const ShadowKernel*> one{&kernels().back()};
    return one;
}

} // namespace

const ShadowKernel& shadowKernel() { return *chosen(); }

std::vector<std::string> shadowKernels() {
    std::vector<std::string> names;
    for (const ShadowKernel& kernel : kernels()) names.emplace_back(kernel.instructions);
    return names;
}

void chooseShadowKernel(const std::string& instructions) {
    for (const ShadowKernel& kernel : kernels())
        if (kernel.instructions == instructions) chosen() = &kernel;
}

} // namespace gnomon
#endif
