// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <string>
#include <vector>

namespace gnomon {

/// A way to draw a shadow, as an AutoShadowTechnique has judged it for one light in one view.
struct ShadowCandidate {
    /// Specification string that gives it, without composite. "none": no shadow at all.
    std::string spec;
    double error = 0.0; ///< Predicted error of the shadow's edge: 95th percentile, pixels.
    /// Counted work as a time that it adds to a frame, milliseconds, as the scene moves now. It tells candidates apart: on another
    /// machine all are faster or slower.
    double time = 0.0;
    double still = 0.0;   ///< The same of a frame in which nothing moves.
    double flying = 0.0;  ///< The same of a frame in which the view moves alone, over many frames.
    double moving = 0.0;  ///< The same of a frame in which the light moves.
    std::string obstacle; ///< Why it cannot be used here. Empty if it can.
};

/// The choice of an AutoShadowTechnique for one light and one kind of receivers in one view, and its reason.
struct GNOMON_EXPORT ShadowDecision {
    int light = 0; ///< OpenGL light number.
    /// Kind of the receivers. Empty: those of the opaque bins. Others are "with a depth range or polygon offset" or "drawn late",
    /// in a transparent bin. The shadow on them is drawn apart, by a choice of its own.
    std::string receivers;
    ShadowCandidate chosen; ///< What is drawn.
    /// Which part of the rule fired: "the cheapest that keeps 1 px: its volumes have some 16 sides".
    std::string reason;
    bool keepsBudget = true; ///< False if no candidate keeps the error that is asked for.
    unsigned decisions = 0;  ///< How often the candidates have been compared so far, for this light and view.
    unsigned changes = 0;    ///< How often another candidate was chosen since the first.
    std::vector<ShadowCandidate> candidates; ///< All candidates, the usable ones first, by their times.

    /// Light and receivers: "light 0", or "light 0, receivers drawn late".
    std::string subject() const;
    /// In a line: "light 0: volume, predicted 0.5 px and 1.2 ms; the cheapest that keeps 1 px: …".
    std::string text() const;
};

} // namespace gnomon
