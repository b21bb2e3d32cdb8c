// SPDX-License-Identifier: MIT
#include "ChildProcess.h"

#include <csignal>
#include <fcntl.h>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace gnomon::testing {

using std::chrono::milliseconds;

bool waitFor(milliseconds time, const std::function<bool()>& done) {
    using Clock = std::chrono::steady_clock;
    for (const Clock::time_point end = Clock::now() + time; Clock::now() < end;
         std::this_thread::sleep_for(milliseconds(20)))
        if (done()) return true;
    return done();
}

namespace {

std::vector<char*> pointers(const std::vector<std::string>& words) {
    std::vector<char*> result;
    for (const std::string& word : words) result.push_back(const_cast<char*>(word.c_str()));
    result.push_back(nullptr);
    return result;
}

/// In the child: ends with the test, says what it says into files of its folder.
[[noreturn]] void become(const std::vector<std::string>& command, const std::filesystem::path& folder,
                         const std::vector<std::string>& environment) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    const std::string said = std::filesystem::path(command[0]).filename().string() + ".err";
    const int out = chdir(folder.c_str()) == 0 ? open(said.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600) : -1;
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    for (const std::string& variable : environment) putenv(const_cast<char*>(variable.c_str()));
    execvp(command[0].c_str(), pointers(command).data());
    _exit(127);
}

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::filesystem::path& folder,
                           const std::vector<std::string>& environment, int keepOpen) {
    _id = fork();
    if (_id < 0) throw std::runtime_error("no process can be made");
    if (_id > 0) return;
    if (keepOpen >= 0) fcntl(keepOpen, F_SETFD, 0);
    become(command, folder, environment);
}

ChildProcess::~ChildProcess() {
    if (ended(milliseconds(0))) return;
    kill(_id, SIGTERM);
    if (ended(milliseconds(2000))) return;
    kill(_id, SIGKILL);
    ended(milliseconds(10000));
}

std::optional<int> ChildProcess::ended(milliseconds time) {
    waitFor(time, [this] {
        int how = 0;
        if (!_status && waitpid(_id, &how, WNOHANG) == _id)
            _status = WIFEXITED(how) ? WEXITSTATUS(how) : 128 + WTERMSIG(how);
        return _status.has_value();
    });
    return _status;
}

void ChildProcess::interrupt() { kill(_id, SIGINT); }

} // namespace gnomon::testing
