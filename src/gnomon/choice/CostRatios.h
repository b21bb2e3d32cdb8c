// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/choice/ShadowWork.h>

#include <optional>
#include <string>

namespace gnomon {

/// How many times as long each kind of work takes here as where the defaults of CostRates hold.
struct CostRatios {
    double call = 1.0;
    double triangle = 1.0;
    double texel = 1.0;
    double tap = 1.0; ///< of pixels whose depth is copied or compared, too.
    double relit = 1.0;
    double filled = 1.0;
    double processor = 1.0; ///< of what the processor does by itself: rays and objects.
    unsigned tests = 1;     ///< self-tests that these are the least of, up to `enoughTests`.

    /// What else a machine does makes a self-test slower, and often for longer than it takes: so some runs have one each.
    static constexpr unsigned enoughTests = 5;

    /// The defaults of CostRates, times these.
    CostRates rates() const;
    /// One line a ratio: "call 1.5"; and one of the tests. The text is the same in every locale.
    std::string text() const;
    /// Reads text(). nullopt unless all are there, each ratio from 10⁻⁴ to 10⁴.
    static std::optional<CostRatios> parse(const std::string& text);
    /// With each ratio brought to 10⁻⁴ … 10⁴; NaN becomes 1.
    CostRatios clamped() const;
    /// The lesser of each ratio, of both's tests.
    CostRatios leastWith(const CostRatios& other) const;
};

} // namespace gnomon
