// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/choice/ShadowWork.h>

#include <osg/RenderInfo>

#include <optional>

namespace gnomon {

/// What a unit of each kind of work takes, for each renderer that the program draws with: found once a run, by the file in
/// the user's cache. The first runs have a self-test each, and the file holds the least that any of them found.
///
/// Threads
/// - Any number.
class RendererCosts {
public:
    /// False if the environment variable GNOMON_AUTO_RATES is "fixed": nothing is measured, read or written.
    static bool areMeasured();
    /// Of the renderer that is current. The defaults if it cannot be measured.
    /// @param renderInfo  of a draw traversal, see measureCosts().
    static CostRates of(osg::RenderInfo& renderInfo);
    /// Of the renderer that was asked for last. nullopt before.
    static std::optional<CostRates> latest();
    /// The same before the first draw: of the renderer that another run used last, by the user's cache.
    static std::optional<CostRates> expected();
    /// Forgets all, as a new run does. For tests.
    static void forget();
};

} // namespace gnomon
