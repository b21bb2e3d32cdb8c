// SPDX-License-Identifier: MIT
#include "Progress.h"

#include <cmath>
#include <iostream>
#include <unistd.h>

namespace gnomon::examples {
namespace {

constexpr const char* clearLine = "\r\033[K";

} // namespace

ProgressLine::ProgressLine(double work)
    : _start(std::chrono::steady_clock::now()), _work(work), _terminal(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
    if (_terminal) std::cerr << clearLine << std::flush;
}

double ProgressLine::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - _start).count();
}

void ProgressLine::show(double done, const std::string& doing) {
    if (!_terminal) return;
    const double left = seconds() * (_work - done) / done;
    std::cerr << clearLine << std::lround(100.0 * done / _work) << " %, " << durationText(left) << " left: " << doing
              << std::flush;
}

std::string durationText(double seconds) {
    if (!std::isfinite(seconds) || seconds < 0.0) return "a while";
    const long all = std::lround(seconds);
    const std::string rest = std::to_string(all % 60) + " s";
    return all < 60 ? rest : std::to_string(all / 60) + " min " + rest;
}

} // namespace gnomon::examples
