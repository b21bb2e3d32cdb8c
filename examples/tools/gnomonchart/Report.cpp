// SPDX-License-Identifier: MIT
#include "Report.h"

#include <gnomon_report.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::examples {

void writeReport(const std::string& folder) {
    std::cout.flush();
    int ends[2];
    if (pipe(ends) != 0)
        throw std::runtime_error(std::string("the report cannot be made: ") + std::strerror(errno) + ".");
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[0], STDIN_FILENO);
        close(ends[0]);
        close(ends[1]);
        execlp(PYTHON3, PYTHON3, "-", folder.c_str(), static_cast<char*>(nullptr));
        execlp("python3", "python3", "-", folder.c_str(), static_cast<char*>(nullptr));
        _exit(127);
    }
    close(ends[0]);
    const auto before = std::signal(SIGPIPE, SIG_IGN); // where Python cannot be started
    const std::size_t length = std::strlen(report_py);
    for (std::size_t at = 0; child > 0 && at < length;) {
        const ssize_t written = write(ends[1], report_py + at, length - at);
        if (written < 0 && errno != EINTR) break;
        at += written > 0 ? static_cast<std::size_t>(written) : 0;
    }
    close(ends[1]);
    int status = -1;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
    std::signal(SIGPIPE, before);
    if (child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 127))
        throw std::runtime_error("the report needs Python, which cannot be started. Install python3.");
    if (status != 0) throw std::runtime_error("the report could not be made; the results are kept.");
}

} // namespace gnomon::examples
