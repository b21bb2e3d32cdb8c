// SPDX-License-Identifier: MIT
#include "StabilityScene.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <iostream>
#include <memory>
#include <poll.h>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace gnomon::examples {
namespace {

using nlohmann::ordered_json;

constexpr int pollMilliseconds = 200;
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

/// The parent's side of one scene: a child at work, and what it has told so far.
class SceneProcess {
public:
    /// @param rows  the scene's rows, a contender each, which are filled; they must outlive this.
    /// @throws std::runtime_error, one sentence, if no process can be started.
    SceneProcess(const StabilityPlan& plan, const StabilityScene& scene, StabilityRow* rows)
        : _plan(plan), _scene(scene), _rows(rows) {
        for (std::size_t i = 0; i < plan.contenders.size(); ++i) _rows[i].cells.resize(scene.values.size());
        start({});
    }
    ~SceneProcess() {
        if (_id > 0) {
            kill(_id, SIGKILL);
            reap();
        }
    }
    SceneProcess(const SceneProcess&) = delete;
    SceneProcess& operator=(const SceneProcess&) = delete;

    /// To be polled for reading.
    int descriptor() const { return _descriptor; }
    bool done() const { return _done; }
    /// Cells that are done, all contenders.
    std::size_t cells() const { return _cells; }
    std::string doing() const {
        if (_place.contender >= _plan.contenders.size()) return _scene.id;
        return _scene.id + ": " + _plan.contenders[_place.contender].contender.technique;
    }

    /// Takes what the child has written; when it has ended before its work, the cell that it was at is marked, and another
    /// goes on.
    void read() {
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

    /// Ends a child that has been at one cell for too long, and goes on after it.
    void watch() {
        const double waited = std::chrono::duration<double>(std::chrono::steady_clock::now() - _since).count();
        if (_id < 0 || std::max(processorSeconds(_id) - _spent, waited / wallSeconds) < _plan.seconds) return;
        kill(_id, SIGKILL);
        reap();
        goOn("hung", "it took more than " + valueText(_plan.seconds) + " s of processor time");
    }

private:
    void start(const StabilityPlace& from) {
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
    void runChild(const StabilityPlace& from, int into) {
#ifdef __linux__
        prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
        std::signal(SIGINT, SIG_IGN); // the parent ends it
        std::signal(SIGTERM, SIG_DFL);
        int status = 0;
        try {
            measureScene(_plan, _scene, from, _rows[from.contender].settings, [&](const ordered_json& line) {
                writeAll(into, line.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
            });
        } catch (const std::exception& failure) {
            std::cerr << _scene.id << ": " << failure.what() << std::endl;
            status = 1;
        }
        _exit(status); // without destructors of what is the parent's
    }

    int reap() {
        int status = 0;
        while (waitpid(_id, &status, 0) < 0 && errno == EINTR) continue;
        close(_descriptor);
        _id = _descriptor = -1;
        return status;
    }

    void take(const std::string& line) {
        const ordered_json told = ordered_json::parse(line);
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

    void put(const StabilityCell& cell) {
        _rows[_place.contender].cells[static_cast<std::size_t>(_place.value)] = cell;
        _begun = false;
        ++_place.value;
        ++_cells;
    }

    void endFilm() {
        _place.value = int(_scene.values.size());
        _filming = false;
    }

    /// The child is gone. @param failure  "crashed" or "hung"
    void goOn(const std::string& failure, const std::string& message) {
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

    const StabilityPlan& _plan;
    const StabilityScene& _scene;
    StabilityRow* _rows;
    pid_t _id = -1;
    int _descriptor = -1;
    std::string _pending;                         ///< of a line.
    StabilityPlace _place;                        ///< where the child is.
    bool _begun = false;                          ///< and not done there
    bool _filming = false;                        ///< after all values
    std::chrono::steady_clock::time_point _since; ///< the child was heard of last
    double _spent = 0.0;                          ///< its processor time then, s
    std::size_t _cells = 0;
    int _idle = 0; ///< children in a row that ended without having begun anything
    bool _done = false;
};

std::vector<StabilityRow> rowsOf(const StabilityPlan& plan) {
    std::vector<StabilityRow> rows;
    for (const StabilityScene& scene : plan.scenes)
        for (const Entrant& entry : plan.contenders) {
            const Contender& contender = entry.contender;
            rows.push_back(
                {scene.id, contender.kit, contender.technique, contender.setting, contender.settings, {}, {}});
        }
    return rows;
}

class Runner {
public:
    Runner(const StabilityPlan& plan, std::vector<StabilityRow>& rows) : _plan(plan), _rows(rows) {}

    template <typename Progress>
    bool run(const Progress& progress) {
        while (true) {
            fill();
            if (_processes.empty()) return true;
            if (!progress(cells(), _processes.front()->doing())) return false;
            turn();
        }
    }

private:
    void fill() {
        for (; _next < _plan.scenes.size() && _processes.size() < std::max(1u, _plan.workers); ++_next)
            _processes.push_back(std::make_unique<SceneProcess>(_plan, _plan.scenes[_next],
                                                                _rows.data() + _next * _plan.contenders.size()));
    }

    void turn() {
        std::vector<pollfd> polled;
        for (const auto& process : _processes) polled.push_back({process->descriptor(), POLLIN, 0});
        const int ready = poll(polled.data(), polled.size(), pollMilliseconds);
        for (std::size_t i = 0; i < _processes.size(); ++i)
            ready > 0 && polled[i].revents ? _processes[i]->read() : _processes[i]->watch();
        const auto isDone = [this](const std::unique_ptr<SceneProcess>& process) {
            if (process->done()) _finished += process->cells();
            return process->done();
        };
        _processes.erase(std::remove_if(_processes.begin(), _processes.end(), isDone), _processes.end());
    }

    std::size_t cells() const {
        std::size_t sum = _finished;
        for (const auto& process : _processes) sum += process->cells();
        return sum;
    }

    const StabilityPlan& _plan;
    std::vector<StabilityRow>& _rows;
    std::vector<std::unique_ptr<SceneProcess>> _processes;
    std::size_t _next = 0, _finished = 0;
};

} // namespace

StabilityResults runStability(const StabilityPlan& plan,
                              const std::function<bool(std::size_t, const std::string&)>& progress) {
    StabilityResults results;
    results.made = plan.made;
    results.scenes.assign(plan.scenes.begin(), plan.scenes.end()); // their text
    results.rows = rowsOf(plan);
    if (plan.contenders.empty()) return results;
    results.complete = Runner(plan, results.rows).run(progress);
    return results;
}

} // namespace gnomon::examples
