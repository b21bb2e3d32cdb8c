// SPDX-License-Identifier: MIT
#include "Gnuplot.h"

#include "FigureSvg.h"
#include "InputFile.h"
#include "OutputFile.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <spawn.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace gnomon::examples {
namespace {

namespace fs = std::filesystem;

/// A folder beside the figure's files that goes when this does.
class DraftFolder {
public:
    DraftFolder(const std::string& folder, const std::string& name)
        : path(fs::path(folder) / ("." + name + "-" + std::to_string(getpid()))) {
        std::error_code error;
        if (!fs::create_directory(path, error) && !fs::is_directory(path))
            throw std::runtime_error(quoted(folder) + " is not writable: " + error.message() + ".");
    }
    ~DraftFolder() {
        std::error_code ignored;
        fs::remove_all(path, ignored);
    }
    DraftFolder(const DraftFolder&) = delete;
    DraftFolder& operator=(const DraftFolder&) = delete;

    const fs::path path;
};

/// Starts `gnuplot SCRIPT` in a folder; what it says goes to `log` there. @return an error's number, or 0.
int start(pid_t& id, const fs::path& folder, const std::string& script) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
    std::string words[] = {"gnuplot", "--default-settings", script};
    char* arguments[] = {words[0].data(), words[1].data(), words[2].data(), nullptr};
    const int error = posix_spawnp(&id, "gnuplot", &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

/// The first line that is not empty.
std::string complaint(const fs::path& log) {
    std::ifstream in(log);
    std::string line;
    while (line.empty() && std::getline(in, line)) continue;
    return line.empty() ? "it printed no message" : line;
}

void runGnuplot(const fs::path& folder, const std::string& script) {
    pid_t id = 0;
    int status = 0;
    if (start(id, folder, script) != 0)
        throw std::runtime_error("the figures need gnuplot, which cannot be started. Install gnuplot-nox.");
    while (waitpid(id, &status, 0) < 0 && errno == EINTR) continue;
    if (status != 0) throw std::runtime_error("gnuplot cannot draw " + script + ": " + complaint(folder / "log") + ".");
}

std::string bytesOf(const fs::path& file) { return fileBytes(file).value_or(""); }

} // namespace

void drawScript(const std::string& name, const FigureScript& script, const std::string& folder) {
    const DraftFolder draft(folder, name);
    const auto file = [&](const char* ending) { return (fs::path(folder) / (name + ending)).string(); };
    OutputFile((draft.path / (name + ".gnuplot")).string()).write(script.text);
    runGnuplot(draft.path, name + ".gnuplot");
    OutputFile(file(".gnuplot")).write(script.text);
    OutputFile(file(".svg")).write(figureSvg(bytesOf(draft.path / (name + ".svg")), name, script.markers));
    OutputFile(file(".png")).write(bytesOf(draft.path / (name + ".png")));
}

void drawFigure(const Figure& figure, const CurveStyles& styles, const std::string& folder) {
    drawScript(figure.name, figureScript(figure, styles), folder);
}

} // namespace gnomon::examples
