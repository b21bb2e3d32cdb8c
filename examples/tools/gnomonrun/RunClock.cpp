// SPDX-License-Identifier: MIT
#include "RunClock.h"
#include "FrameTime.h"

#include <cstdio>

namespace gnomon::examples {
namespace {

constexpr int settling = 3; // frames: OSG keeps two scene views, each of which compiles in its first

} // namespace

std::string millisecondsText(double time) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f ms", time);
    return text;
}

void RunClock::start(const std::string& drawn) {
    if (drawn != _drawn) _since = 0;
    _drawn = drawn;
    _start = Clock::now();
}

void RunClock::stop() {
    const std::chrono::duration<double, std::milli> took = Clock::now() - _start;
    if (_since++ >= settling) _milliseconds[_drawn].push_back(took.count());
}

std::vector<std::string> RunClock::lines() const {
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

} // namespace gnomon::examples
