// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <osg/Timer>

#include <atomic>
#include <string>

namespace gnomon {

/// A line on stderr that grows while something takes long, and is gone at the end. Only a terminal shows it.
class GNOMON_EXPORT ProgressLine {
public:
    /// @param after  seconds before which nothing is shown.
    explicit ProgressLine(const std::string& what, double after = 1.0);
    ~ProgressLine();
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;

    /// @param share  of the whole, 0 … 1. May be called from several threads at once.
    void show(double share);

private:
    const std::string _what;
    const double _after;
    const bool _terminal;
    const osg::ElapsedTime _watch;
    std::atomic<int> _shown{-1};
};

} // namespace gnomon
