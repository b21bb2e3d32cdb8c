// SPDX-License-Identifier: MIT
#include "Program.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <sys/wait.h>

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

} // namespace gnomon::testing
