// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"

namespace gnomon::examples {

/// How a technique is drawn: the same in every figure of one run.
struct CurveStyle {
    const char* colour; ///< "#rrggbb"
    int shape;          ///< gnuplot's number of the hollow marker; one more is the filled one.
};

/// Gnomon's techniques in colours that colour-blind readers can tell apart (Okabe and Ito, 2008), those of others in
/// greys; within either, neighbours differ by shape.
class CurveStyles {
public:
    explicit CurveStyles(const ChartResults& results);
    CurveStyle of(const std::string& kit, const std::string& technique) const;

private:
    std::vector<std::pair<std::string, std::string>> _ours, _theirs;
};

} // namespace gnomon::examples
