// SPDX-License-Identifier: MIT
// gnomonrun: a program that somebody else built, with shadows.
#include "OutputFile.h"
#include "RunOptions.h"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using namespace gnomon::examples;

using Words = std::vector<std::string>;

constexpr int notStarted = 127; // as a shell has it
constexpr int signalled = 128;  // and the number of the signal

/// A file that the program's library writes to; gone with this.
class ReportFile {
public:
    ReportFile() {
        char name[] = "/tmp/gnomonrun.XXXXXX";
        const int file = mkstemp(name);
        if (file < 0) throw std::runtime_error("no file can be made in /tmp. Make room there.");
        close(file);
        _name = name;
    }
    ~ReportFile() { unlink(_name.c_str()); }
    ReportFile(const ReportFile&) = delete;
    ReportFile& operator=(const ReportFile&) = delete;

    const std::string& name() const { return _name; }
    std::set<std::string> lines() const {
        std::set<std::string> result;
        std::ifstream in(_name);
        for (std::string line; std::getline(in, line);) result.insert(line);
        return result;
    }

private:
    std::string _name;
};

/// Before what a list in the environment holds already.
void putFirst(const char* list, const std::string& entry) {
    const char* before = std::getenv(list);
    setenv(list, (before && *before ? entry + ":" + before : entry).c_str(), 1);
}

/// Has the loader take the library into the program to come. It takes a blank for the end of a path in LD_PRELOAD, but not in
/// LD_LIBRARY_PATH.
/// @throws std::runtime_error if the library is not there, or the loader would take its folder for two.
void preload() {
    namespace fs = std::filesystem;
    const fs::path here = fs::read_symlink("/proc/self/exe").parent_path();
    for (const char* way : {GNOMON_PRELOADS}) {
        if (!fs::exists(here / way)) continue;
        const fs::path library = fs::canonical(here / way), folder = library.parent_path();
        if (folder.string().find_first_of(":;") != std::string::npos)
            throw std::runtime_error(
                "'" + library.string() +
                "' cannot be loaded into a program, because its path holds a colon or a semicolon. "
                "Put Gnomon's programs into a folder without.");
        putFirst("LD_LIBRARY_PATH", folder);
        return putFirst("LD_PRELOAD", library.filename());
    }
    throw std::runtime_error("gnomonrun_preload.so is missing. Install Gnomon's programs anew.");
}

[[noreturn]] void become(const Words& command) {
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str())); // exec changes nothing
    words.push_back(nullptr);
    execvp(words.front(), words.data());
    std::cerr << "gnomonrun: " << command.front() << " cannot be started: " << std::strerror(errno) << "." << std::endl;
    _exit(notStarted);
}

/// @return its exit status; `signalled` + signal if one ended it.
int runWithLibrary(const Words& command, const Words& options, const ReportFile& report) {
    preload();
    const pid_t id = fork();
    if (id < 0) throw std::runtime_error(std::string("no process can be started: ") + std::strerror(errno) + ".");
    if (id == 0) {
        setenv(optionsVariable, joined(options).c_str(), 1);
        setenv(reportVariable, report.name().c_str(), 1);
        become(command);
    }
    std::signal(SIGINT, SIG_IGN); // it is the program's
    int status = 0;
    while (waitpid(id, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : signalled + WTERMSIG(status);
}

/// Why no shadow can have been seen; empty if frames were drawn. @param status  of the program's end, as a shell has it.
std::string whyUnreached(const std::string& program, int status, const std::set<std::string>& met) {
    if (met.count(metFrame) && met.count(metScene)) return "";
    if (status > signalled) return program + " was ended by signal " + std::to_string(status - signalled) + ".";
    if (!met.count(metProgram))
        return program + " cannot be reached: it is linked statically, or runs with the rights of another user.";
    if (!met.count(metScene) && !met.count(metFrame) && met.count(metSceneView))
        return program + " cannot be reached: it draws by osgUtil::SceneView, without a viewer.";
    if (!met.count(metScene) && !met.count(metFrame) && !met.count(metOsg))
        return program + " cannot be reached: it needs no library of OpenSceneGraph, or has it linked in statically.";
    if (!met.count(metScene))
        return program + " gave no scene to osgViewer::View::setSceneData(), so there was nothing to shadow.";
    return program + " ended before it drew a frame.";
}

int run(const Words& options, const Words& command) {
    const ReportFile report;
    const int status = runWithLibrary(command, options, report);
    const std::string cause = status == notStarted ? "" : whyUnreached(command.front(), status, report.lines());
    if (!cause.empty()) std::cerr << "gnomonrun: " << cause << std::endl;
    return status == 0 && !cause.empty() ? 1 : status;
}

int start(osg::ArgumentParser& arguments, const Words& options, const Words& command) {
    const RunOptions read = readRunOptions(arguments);
    if (read.help) {
        std::cout << runHelp();
        return 0;
    }
    if (command.empty())
        throw std::invalid_argument("no program is given. Write gnomonrun OPTION... -- PROGRAM ARGUMENT...");
    for (const std::string& word : command) noteInput(word); // those of them that are files
    if (!read.out.empty()) OutputFile(read.out).requireImage();
    if (std::filesystem::exists(read.compare) && !std::filesystem::is_directory(read.compare))
        throw std::invalid_argument("--compare " + read.compare + " is not a folder. Give a folder's name.");
    return run(options, command);
}

} // namespace

int main(int argc, char** argv) {
    const Words words(argv, argv + argc);
    const auto border = std::find(words.begin(), words.end(), "--");
    const Words options(words.begin(), border), command(border == words.end() ? border : border + 1, words.end());
    const auto run = [&](osg::ArgumentParser& arguments) { return start(arguments, options, command); };
    return gnomon::examples::runProgram("gnomonrun", options, run);
}
