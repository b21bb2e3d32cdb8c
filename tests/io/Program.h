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

/// How a program ended and what it said.
struct Ending {
    int status = -1; ///< exit status; 128 + signal if one ended it, 124 if it ran for too long.
    std::string out, err;

    /// Last line of err, without its end.
    std::string lastLine() const;
};

/// Runs a program as a shell would, in `folder`. @param seconds  that it may take.
Ending runProgram(const std::string& program, const std::vector<std::string>& arguments,
                  const std::filesystem::path& folder, int seconds = 60);
/// Runs gnomonshot so.
Ending runGnomonshot(const std::vector<std::string>& arguments, const std::filesystem::path& folder);

/// An empty folder that goes when this does.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return _path; }
    /// Names of all that is in it, sorted, hidden ones too.
    std::vector<std::string> list() const;
    void write(const std::string& name, const std::string& bytes) const;

private:
    std::filesystem::path _path;
};

std::string readFile(const std::filesystem::path& path);

/// Runs a program that refuses what it is asked, where it can have no window: its last line is one sentence after its name, it
/// ends with status 1 and leaves no file. @return the sentence. @param alone  nothing else is said.
std::string refusal(const std::string& program, const std::vector<std::string>& arguments,
                    const TemporaryFolder& folder, bool alone = true);

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
