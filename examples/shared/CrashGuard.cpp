// SPDX-License-Identifier: MIT
#include "CrashGuard.h"

#include <unistd.h>

namespace gnomon::examples {

std::string CrashGuard::_sentence;

CrashGuard::CrashGuard(const std::string& sentence) {
    _sentence = sentence + "\n";
    for (std::size_t i = 0; i < signals.size(); ++i) _before[i] = std::signal(signals[i], say);
}

CrashGuard::~CrashGuard() {
    for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], _before[i]);
}

void CrashGuard::say(int) {
    const ssize_t written = write(STDERR_FILENO, _sentence.data(), _sentence.size());
    _exit(written > 0 ? 1 : 2);
}

} // namespace gnomon::examples
