// SPDX-License-Identifier: MIT
#include "Program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace gnomon::testing {

namespace fs = std::filesystem;
namespace {

std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return result + "'";
}

int statusOf(int ended) { return WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended); }

} // namespace

std::string Ending::lastLine() const {
    std::istringstream lines(err);
    std::string line, last;
    while (std::getline(lines, line)) last = line;
    return last;
}

Ending runProgram(const std::string& program, const std::vector<std::string>& arguments, const fs::path& folder,
                  int seconds) {
    const TemporaryFolder said;
    std::string command =
        "cd " + quoted(folder) + " && exec timeout " + std::to_string(seconds) + " " + quoted(program);
    for (const std::string& argument : arguments) command += " " + quoted(argument);
    command += " >" + quoted(said.path() / "out") + " 2>" + quoted(said.path() / "err") + " </dev/null";
    Ending ending;
    ending.status = statusOf(std::system(command.c_str()));
    ending.out = readFile(said.path() / "out");
    ending.err = readFile(said.path() / "err");
    return ending;
}

Ending runGnomonshot(const std::vector<std::string>& arguments, const fs::path& folder) {
    return runProgram(GNOMONSHOT, arguments, folder);
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "gnomon-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder can be made");
    _path = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(_path, ignored);
}

std::vector<std::string> TemporaryFolder::list() const {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(_path)) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
}

void TemporaryFolder::write(const std::string& name, const std::string& bytes) const {
    std::ofstream(_path / name, std::ios::binary) << bytes;
}

std::string readFile(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string refusal(const std::string& program, const std::vector<std::string>& arguments,
                    const TemporaryFolder& folder, bool alone) {
    const std::vector<std::string> before = folder.list();
    std::vector<std::string> all = {"DISPLAY=", program};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const Ending ending = runProgram("env", all, folder.path());
    const std::string line = ending.lastLine(), prefix = fs::path(program).filename().string() + ": ";
    EXPECT_EQ(ending.status, 1) << ending.err;
    if (alone) EXPECT_EQ(ending.out + ending.err, line + "\n");
    EXPECT_EQ(folder.list(), before) << "nothing is left behind";
    EXPECT_EQ(line.substr(0, prefix.size()), prefix) << ending.err;
    EXPECT_EQ(line.substr(line.size() - std::min<std::size_t>(line.size(), 1)), ".") << line;
    return line.substr(std::min(line.size(), prefix.size()));
}

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
