// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <csignal>
#include <string>

namespace gnomon::examples {

/// While it lives, a crash prints one sentence and ends the program: readers of old formats trust their input.
class CrashGuard {
public:
    explicit CrashGuard(const std::string& sentence);
    ~CrashGuard();
    CrashGuard(const CrashGuard&) = delete;
    CrashGuard& operator=(const CrashGuard&) = delete;

private:
    static constexpr std::array<int, 4> signals = {SIGSEGV, SIGABRT, SIGFPE, SIGBUS};

    static void say(int);

    static std::string _sentence;
    std::array<void (*)(int), signals.size()> _before{};
};

} // namespace gnomon::examples
