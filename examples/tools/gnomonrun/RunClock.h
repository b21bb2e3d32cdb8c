// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <map>
#include <string>
#include <vector>

namespace gnomon::examples {

/// "2.4 ms".
std::string millisecondsText(double time);

/// How long frames took, by what was drawn in them. The first few after a change do not count: they compile and settle.
class RunClock {
public:
    void start(const std::string& drawn);
    void stop();

    /// A line each: the median in ms, and what it is more than without shadow. Empty if nothing counted.
    std::vector<std::string> lines() const;

private:
    using Clock = std::chrono::steady_clock;

    std::map<std::string, std::vector<double>> _milliseconds;
    std::string _drawn;
    Clock::time_point _start;
    int _since = 0; ///< frames since something else was drawn.
};

} // namespace gnomon::examples
