// SPDX-License-Identifier: MIT
#include "OtherProcess.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <sys/wait.h>

namespace gnomon::examples {

bool Ending::isRefusal() const { return WIFEXITED(status) && WEXITSTATUS(status) == 1; }

Ending runCommand(const std::string& command, const std::function<bool(const std::string& line)>& hears) {
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    if (!pipe) throw std::runtime_error("no other process can be started.");
    Ending ending;
    char* line = nullptr;
    std::size_t room = 0;
    bool goesOn = true;
    for (ssize_t size = 0; goesOn && (size = getline(&line, &room, pipe)) > 0;) {
        ending.said.append(line, static_cast<std::size_t>(size));
        const bool isWhole = line[size - 1] == '\n';
        if (hears) goesOn = hears(std::string(line, static_cast<std::size_t>(isWhole ? size - 1 : size)));
    }
    std::free(line);
    ending.status = pclose(pipe);
    return ending;
}

std::string shellWord(const std::string& word) {
    std::string text = "'";
    for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

std::string thisProgram() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

std::string after(const std::string& word, const std::string& text) {
    const std::size_t at = text.rfind(word);
    if (at == std::string::npos) return "";
    const std::size_t begin = at + word.size();
    return text.substr(begin, text.find('\n', begin) - begin);
}

} // namespace gnomon::examples
