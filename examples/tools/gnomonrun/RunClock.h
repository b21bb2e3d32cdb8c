// SPDX-License-Identifier: MIT
#pragma once
#include "FrameTime.h"

#include <chrono>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

namespace gnomon::examples {

/// "2.4 ms".
inline std::string millisecondsText(double time) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f ms", time);
    return text;
}

/// How long frames took, by what was drawn in them. The first few after a change do not count: they compile and settle.
class RunClock {
public:
    void start(const std::string& drawn) {
        if (drawn != _drawn) _since = 0;
        _drawn = drawn;
        _start = Clock::now();
    }

    void stop() {
        const std::chrono::duration<double, std::milli> took = Clock::now() - _start;
        if (_since++ >= settling) _milliseconds[_drawn].push_back(took.count());
    }

    /// A line each: the median in ms, and what it is more than without shadow. Empty if nothing counted.
    std::vector<std::string> lines() const {
        std::vector<std::string> lines;
        const auto none = _milliseconds.find("none");
        for (const auto& [drawn, times] : _milliseconds) {
            const double median = quartiles(times).median;
            std::string line =
                drawn + ": " + millisecondsText(median) + " a frame, median of " + std::to_string(times.size());
            if (none != _milliseconds.end() && drawn != "none")
                line += ", " + millisecondsText(median - quartiles(none->second).median) + " of it for shadows";
            lines.push_back(line);
        }
        return lines;
    }

private:
    using Clock = std::chrono::steady_clock;

    static constexpr int settling = 3; // frames: OSG keeps two scene views, each of which compiles in its first

    std::map<std::string, std::vector<double>> _milliseconds;
    std::string _drawn;
    Clock::time_point _start;
    int _since = 0; ///< frames since something else was drawn.
};

} // namespace gnomon::examples
