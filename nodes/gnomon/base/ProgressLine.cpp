// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>

#include <cstdio>
#include <unistd.h>

namespace gnomon {

ProgressLine::ProgressLine(const std::string& what, double after)
    : _what(what), _after(after), _terminal(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
    if (_shown >= 0) std::fprintf(stderr, "\r%*s\r", int(_what.size()) + 8, "");
}

void ProgressLine::show(double share) {
    const int percent = static_cast<int>(100.0 * share);
    if (!_terminal || _watch.elapsedTime() < _after) return;
    int shown = _shown;
    while (percent > shown && !_shown.compare_exchange_weak(shown, percent)) {
    }
    if (percent <= shown) return;
    std::fprintf(stderr, "\r%s: %d %%", _what.c_str(), percent);
}

} // namespace gnomon
