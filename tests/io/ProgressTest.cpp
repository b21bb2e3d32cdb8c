// SPDX-License-Identifier: MIT
// The line of progress, written by a process of its own whose stderr is a terminal or a pipe.
#include <gnomon/ProgressLine.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <pty.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

namespace {

/// All that comes until the other end closes; on Linux a pseudo-terminal's then fails with EIO.
std::string readAll(int from) {
    std::string result;
    char bytes[256];
    for (ssize_t count; (count = read(from, bytes, sizeof bytes)) > 0;) result.append(bytes, std::size_t(count));
    close(from);
    return result;
}

void work(double after) {
    gnomon::ProgressLine progress("builds", after);
    for (const double share : {0.0, 0.25, 0.2, 0.25, 0.5}) progress.show(share);
}

/// What is written where stderr is a terminal; nullopt, with errno, where there is none to be had.
std::optional<std::string> onTerminal(double after) {
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
    if (child < 0) return std::nullopt;
    if (child == 0) {
        work(after);
        _exit(0);
    }
    const std::string said = readAll(terminal);
    waitpid(child, nullptr, 0);
    return said;
}

std::string onPipe(double after) {
    int ends[2];
    if (pipe(ends) != 0) return "there is no pipe";
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDERR_FILENO);
        work(after);
        _exit(0);
    }
    close(ends[1]);
    const std::string said = readAll(ends[0]);
    waitpid(child, nullptr, 0);
    return said;
}

#define GNOMON_ON_TERMINAL(said, after)                                                                                \
    const std::optional<std::string> said = onTerminal(after);                                                         \
    if (!said)                                                                                                         \
    GTEST_SKIP() << "forkpty() gives no pseudo-terminal (" << std::strerror(errno) << "); mount /dev/pts to run this"

TEST(ProgressLine, GrowsOnATerminalAndIsGoneAtTheEnd) {
    GNOMON_ON_TERMINAL(said, 0.0);
    const std::string blanks(std::string("builds").size() + 8, ' ');
    EXPECT_EQ(*said, "\rbuilds: 0 %\rbuilds: 25 %\rbuilds: 50 %\r" + blanks + "\r");
}

TEST(ProgressLine, IsNotShownOfWhatIsDoneSooner) {
    GNOMON_ON_TERMINAL(said, 100.0);
    EXPECT_EQ(*said, "");
}

TEST(ProgressLine, IsNeverWrittenToAPipe) { EXPECT_EQ(onPipe(0.0), ""); }

} // namespace
