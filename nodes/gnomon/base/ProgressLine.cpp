// SPDX-License-Identifier: MIT
#include <gnomon/ProgressLine.h>

#include <cstdio>
#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace gnomon {
namespace {

bool isTerminal() {
#if defined(_WIN32)
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(STDERR_FILENO) != 0;
#endif
}

} // namespace

ProgressLine::ProgressLine(const std::string& what, double after)
    : _what(what), _after(after), _terminal(isTerminal()) {}

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
