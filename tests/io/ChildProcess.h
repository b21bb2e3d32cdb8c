// SPDX-License-Identifier: MIT
#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <sys/types.h>
#include <vector>

namespace gnomon::testing {

/// Until `done` holds, at most `time`. @return whether it does.
bool waitFor(std::chrono::milliseconds time, const std::function<bool()>& done);

/// A program that runs beside the test, and ends with this at the latest.
class ChildProcess {
public:
    /// @param keepOpen  a file descriptor that the program gets, too; -1: none.
    ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& folder,
                 const std::vector<std::string>& environment = {}, int keepOpen = -1);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Its exit status, 128 + signal if one ended it; nullopt if it still runs after `limit`.
    std::optional<int> ended(std::chrono::milliseconds limit);
    /// Sends it SIGINT, as Ctrl-C does.
    void interrupt();

private:
    pid_t _id = -1;
    std::optional<int> _status;
};

} // namespace gnomon::testing
