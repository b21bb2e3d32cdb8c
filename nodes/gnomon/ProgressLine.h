// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <osg/Timer>

#include <atomic>
#include <string>

namespace gnomon {

/// Shows the progress of a long task as a line on stderr, if stderr is a terminal.
///
/// Threads
/// - Any number may call show().
class GNOMON_EXPORT ProgressLine {
public:
    /// Starts the clock.
    /// @param what   the task, as the line names it.
    /// @param after  seconds before the line appears. Default 1.
    explicit ProgressLine(const std::string& what, double after = 1.0);
    /// Removes the line.
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// Shows the finished share of the task, 0 … 1.
    void show(double share);

private:
    const std::string _what;
    const double _after;
    const bool _terminal;
    const osg::ElapsedTime _watch;
    std::atomic<int> _shown{-1};
};

} // namespace gnomon
