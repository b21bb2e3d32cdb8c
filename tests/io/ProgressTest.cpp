// SPDX-License-Identifier: MIT
// The line of progress, written by a process of its own whose stderr is a terminal or a pipe.
#include <gnomon/ProgressLine.h>
#include <gtest/gtest.h>

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

std::string onTerminal(double after) {
    int terminal = -1;
    const pid_t child = forkpty(&terminal, nullptr, nullptr, nullptr);
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

TEST(ProgressLine, GrowsOnATerminalAndIsGoneAtTheEnd) {
    const std::string blanks(std::string("builds").size() + 8, ' ');
    EXPECT_EQ(onTerminal(0.0), "\rbuilds: 0 %\rbuilds: 25 %\rbuilds: 50 %\r" + blanks + "\r");
}

TEST(ProgressLine, IsNotShownOfWhatIsDoneSooner) { EXPECT_EQ(onTerminal(100.0), ""); }

TEST(ProgressLine, IsNeverWrittenToAPipe) { EXPECT_EQ(onPipe(0.0), ""); }

} // namespace
