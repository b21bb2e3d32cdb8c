// SPDX-License-Identifier: MIT
#pragma once
#include <cerrno>
#include <chrono>
#include <cmath>
#include <iostream>
#include <string>
#include <unistd.h>

namespace gnomon::examples {

/// One line on a terminal: what is being done and how long the rest will take, as the work done so far tells. Where standard
/// error is no terminal, a line a minute.
class TimeLeft {
public:
    /// @param work  all there is to do, in any unit. @param after  seconds without a line, on a terminal.
    explicit TimeLeft(double work, double after = 0.0) : _work(work), _next(_terminal ? after : 60.0) {}
    ~TimeLeft() {
        if (_terminal && _isShown) std::cerr << clearLine << std::flush;
    }
    TimeLeft(const TimeLeft&) = delete;
    TimeLeft& operator=(const TimeLeft&) = delete;

    /// Since it was made.
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - _start).count(); }
    /// @param done  of the work, so far.
    void show(double done, const std::string& doing) {
        if (!(seconds() >= _next)) return;
        if (!_terminal) _next = seconds() + 60.0;
        _isShown = true;
        const std::string left = text(seconds() * (_work - done) / done);
        std::cerr << (_terminal ? clearLine : program_invocation_short_name + std::string(": "))
                  << (done > 0.0 ? std::to_string(std::lround(100.0 * done / _work)) + " %, " + left + " left: " : "")
                  << doing << (_terminal ? "" : "\n") << std::flush;
    }

private:
    static constexpr const char* clearLine = "\r\033[K";

    /// "3 min 20 s", "45 s", "a while" where it cannot be told.
    static std::string text(double seconds) {
        if (!std::isfinite(seconds) || seconds < 0.0) return "a while";
        const long all = std::lround(seconds);
        const std::string rest = std::to_string(all % 60) + " s";
        return all < 60 ? rest : std::to_string(all / 60) + " min " + rest;
    }

    const std::chrono::steady_clock::time_point _start = std::chrono::steady_clock::now();
    const double _work;
    const bool _terminal = isatty(STDERR_FILENO) != 0;
    double _next; ///< when a line is written next, seconds.
    bool _isShown = false;
};

} // namespace gnomon::examples
