// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <string>

namespace gnomon::examples {

/// One line on a terminal: what is being done and how long the rest will take, as the work done so far tells. Nothing is
/// written where standard error is no terminal.
class ProgressLine {
public:
    /// @param work  all there is to do, in any unit.
    explicit ProgressLine(double work);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Since it was made.
    double seconds() const;
    /// @param done  of the work, so far.
    void show(double done, const std::string& doing);

private:
    std::chrono::steady_clock::time_point _start;
    double _work;
    bool _terminal;
};

/// "3 min 20 s", "45 s", "a while" where it cannot be told.
std::string durationText(double seconds);

} // namespace gnomon::examples
