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

    /// The defaults of CostRates, times these.
    CostRates rates() const;
    /// One line a ratio: "call 1.5". The text is the same in every locale.
    std::string text() const;
    /// Reads text(). nullopt unless all ratios are there, each from 10⁻⁴ to 10⁴.
    static std::optional<CostRatios> parse(const std::string& text);
    /// With each ratio brought to 10⁻⁴ … 10⁴; NaN becomes 1.
    CostRatios clamped() const;
};

} // namespace gnomon
