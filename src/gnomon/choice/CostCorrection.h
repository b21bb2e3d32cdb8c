// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <deque>

namespace gnomon {

/// Corrects predicted times of one kind of work by what frames take. A few odd frames change nothing.
class CostCorrection {
public:
    static constexpr double range = 4.0;       ///< factor() is within 1 / range … range.
    static constexpr double hysteresis = 1.25; ///< smaller errors of a prediction are let be.

    /// Takes one frame. Times that are no numbers above 0 do not count.
    /// @param predicted  without correction. Both in one unit.
    /// @return true if factor() has changed.
    bool add(double measured, double predicted);
    /// What a predicted time is to be multiplied by. 1 until three frames agree on something else.
    double factor() const { return _factor; }

    /// True once as many frames have been taken as factor() needs.
    bool isKnown() const;

private:
    std::deque<double> _ratios; ///< of the frames that came last.
    double _factor = 1.0;
};

} // namespace gnomon
