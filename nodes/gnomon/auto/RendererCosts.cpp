// SPDX-License-Identifier: MIT
#include <gnomon/auto/RendererCosts.h>
#include <gnomon/auto/SelfTest.h>
#include <gnomon/choice/RatioFile.h>
#include <gnomon/gl/DrawClock.h>

#include <OpenThreads/Mutex>
#include <OpenThreads/ScopedLock>
#include <osg/Notify>

#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

/// Of one run.
struct Known {
    OpenThreads::Mutex mutex;
    std::map<std::string, CostRates> costs;
    std::optional<CostRates> latest;
};

Known& known() {
    static Known all;
    return all;
}

void tell(const std::string& trouble) {
    if (!trouble.empty()) OSG_WARN << "gnomon: " << trouble << std::endl;
}

/// @param folder  nullopt: nothing is kept.
CostRates find(osg::RenderInfo& renderInfo, const std::optional<std::filesystem::path>& folder,
               const std::string& renderer) {
    const std::optional<RatioFile> file =
        folder ? std::optional<RatioFile>(std::in_place, *folder, renderer) : std::nullopt;
    const RatioFile::Read kept = file ? file->read() : RatioFile::Read();
    tell(kept.trouble);
    if (kept.ratios && kept.ratios->tests >= CostRatios::enoughTests) {
        file->touch();
        return kept.ratios->rates();
    }
    const std::optional<CostRatios> measured = measureCosts(renderInfo);
    if (!measured) return {};
    const CostRatios least = kept.ratios ? measured->leastWith(*kept.ratios) : *measured;
    if (file) tell(file->write(least));
    return least.rates();
}

} // namespace

bool RendererCosts::areMeasured() {
    const char* asked = std::getenv("GNOMON_AUTO_RATES");
    return !asked || std::strcmp(asked, "fixed") != 0;
}

CostRates RendererCosts::of(osg::RenderInfo& renderInfo) {
    const std::string renderer = rendererName();
    Known& all = known();
    Lock lock(all.mutex); // another context's self-test would disturb this one
    const auto found = all.costs.find(renderer);
    const CostRates result = found != all.costs.end() ? found->second : find(renderInfo, userCache(), renderer);
    all.costs.emplace(renderer, result);
    all.latest = result;
    return result;
}

std::optional<CostRates> RendererCosts::latest() {
    Lock lock(known().mutex);
    return known().latest;
}

std::optional<CostRates> RendererCosts::expected() {
    if (const std::optional<CostRates> now = latest()) return now;
    const std::optional<std::filesystem::path> folder = userCache();
    const std::optional<CostRatios> kept = folder ? RatioFile::usedLast(*folder) : std::nullopt;
    return kept ? std::optional<CostRates>(kept->rates()) : std::nullopt;
}

void RendererCosts::forget() {
    Lock lock(known().mutex);
    known().costs.clear();
    known().latest.reset();
}

} // namespace gnomon
