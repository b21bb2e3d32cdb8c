// SPDX-License-Identifier: MIT
#include "SceneProcess.h"

#include "StabilityResults.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <iostream>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace gnomon::examples {
namespace {

using nlohmann::json;

constexpr double wallSeconds = 20.0; // that a second of processor time may take, on a loaded machine or while it sleeps
constexpr int mostIdle = 2;          // children that end before their first cell: the scene itself is at fault then

void writeAll(int into, const std::string& text) {
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t written = write(into, text.data() + done, text.size() - done);
        if (written < 0 && errno != EINTR) _exit(2); // nobody listens any more
        if (written > 0) done += static_cast<std::size_t>(written);
    }
}

/// Why a child is gone.
std::string endOf(int status) {
    if (WIFSIGNALED(status)) return std::string("the process ended by the signal ") + strsignal(WTERMSIG(status));
    return "the process ended with status " + std::to_string(WEXITSTATUS(status));
}

/// Processor time of a child so far, s.
double processorSeconds(pid_t id) {
    clockid_t clock{};
    timespec time{};
    if (clock_getcpuclockid(id, &clock) != 0 || clock_gettime(clock, &time) != 0) return 0.0;
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

} // namespace

SceneProcess::SceneProcess(const StabilityPlan& plan, const StabilityScene& scene, StabilityRow* rows)
    : _plan(plan), _scene(scene), _rows(rows) {
    for (std::size_t i = 0; i < plan.contenders.size(); ++i) _rows[i].cells.resize(scene.values.size());
    start({});
}

SceneProcess::~SceneProcess() {
    if (_id > 0) {
        kill(_id, SIGKILL);
        reap();
    }
}

void SceneProcess::start(const StabilityPlace& from) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe can be made: " + std::string(strerror(errno)) + ".");
    std::cout.flush();
    const pid_t id = fork();
    if (id < 0) throw std::runtime_error("no process can be started: " + std::string(strerror(errno)) + ".");
    if (id == 0) {
        close(ends[0]);
        runChild(from, ends[1]);
    }
    close(ends[1]);
    _id = id;
    _descriptor = ends[0];
    _pending.clear();
    _place = from;
    _begun = _filming = false;
    _since = std::chrono::steady_clock::now();
    _spent = 0.0;
}

/// Never returns.
void SceneProcess::runChild(const StabilityPlace& from, int into) {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
    std::signal(SIGINT, SIG_IGN); // the parent ends it
    std::signal(SIGTERM, SIG_DFL);
    int status = 0;
    try {
        measureScene(_plan, _scene, from, _rows[from.contender].settings, [&](const json& line) {
            writeAll(into, line.dump(-1, ' ', false, json::error_handler_t::replace) + "\n");
        });
    } catch (const std::exception& failure) {
        std::cerr << _scene.id << ": " << failure.what() << std::endl;
        status = 1;
    }
    _exit(status); // without destructors of what is the parent's
}

int SceneProcess::reap() {
    int status = 0;
    while (waitpid(_id, &status, 0) < 0 && errno == EINTR) continue;
    close(_descriptor);
    _id = _descriptor = -1;
    return status;
}

void SceneProcess::read() {
    char bytes[4096];
    const ssize_t count = ::read(_descriptor, bytes, sizeof bytes);
    if (count < 0 && errno == EINTR) return;
    if (count <= 0) {
        const int status = reap();
        const bool ended = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !_begun && !_filming;
        ended ? void(_done = true) : goOn("crashed", endOf(status));
        return;
    }
    _pending.append(bytes, static_cast<std::size_t>(count));
    for (std::size_t end = _pending.find('\n'); end != std::string::npos; end = _pending.find('\n')) {
        take(_pending.substr(0, end));
        _pending.erase(0, end + 1);
    }
}

void SceneProcess::watch() {
    const double waited = std::chrono::duration<double>(std::chrono::steady_clock::now() - _since).count();
    if (_id < 0 || std::max(processorSeconds(_id) - _spent, waited / wallSeconds) < _plan.seconds) return;
    kill(_id, SIGKILL);
    reap();
    goOn("hung", "it took more than " + valueText(_plan.seconds) + " s of processor time");
}

void SceneProcess::take(const std::string& line) {
    const json told = json::parse(line);
    StabilityRow& row = _rows[_place.contender];
    _since = std::chrono::steady_clock::now();
    _spent = processorSeconds(_id);
    if (told.contains("begin")) {
        _place = {told["begin"][0].get<std::size_t>(), told["begin"][1].get<int>()};
        _begun = true;
        _idle = 0;
    } else if (told.contains("cell")) {
        put(cellOf(told["cell"]));
    } else if (told.contains("settings")) {
        told["settings"].get_to(row.settings);
        _begun = false;
    } else if (told.contains("film")) {
        _place.value = told["film"][1].get<int>();
        _filming = true;
    } else if (told.contains("flicker")) {
        row.flicker = flickerOf(told["flicker"]);
        endFilm();
    }
}

void SceneProcess::put(const StabilityCell& cell) {
    _rows[_place.contender].cells[static_cast<std::size_t>(_place.value)] = cell;
    _begun = false;
    ++_place.value;
    ++_cells;
}

void SceneProcess::endFilm() {
    _place.value = int(_scene.values.size());
    _filming = false;
}

void SceneProcess::goOn(const std::string& failure, const std::string& message) {
    const int values = int(_scene.values.size());
    const bool idle = !_begun && !_filming && ++_idle >= mostIdle; // cannot even begin: the whole row is lost
    StabilityCell cell;
    cell.failure = failure;
    cell.message = message;
    const bool wholeRow = idle || (_begun && _place.value < 0);
    if (_filming) {
        _rows[_place.contender].cells[static_cast<std::size_t>(_place.value)] = cell; // it is not right in motion
        endFilm();
    } else if (_begun || idle) {
        const int last = wholeRow ? values - 1 : _place.value;
        for (_place.value = std::max(_place.value, 0); _place.value <= last;) put(cell);
    }
    if (_place.value >= values) _place = {_place.contender + 1, -1};
    if (_place.contender >= _plan.contenders.size())
        _done = true;
    else
        start(_place);
}

std::string SceneProcess::doing() const {
    if (_place.contender >= _plan.contenders.size()) return _scene.id;
    return _scene.id + ": " + _plan.contenders[_place.contender].contender.technique;
}

} // namespace gnomon::examples
