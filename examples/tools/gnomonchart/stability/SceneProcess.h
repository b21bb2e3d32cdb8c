// SPDX-License-Identifier: MIT
#pragma once
#include "StabilityChild.h"

#include <chrono>

namespace gnomon::examples {

/// The parent's side of one scene: a child at work, and what it has told so far.
class SceneProcess {
public:
    /// @param rows  the scene's rows, a contender each, which are filled; they must outlive this.
    /// @throws std::runtime_error, one sentence, if no process can be started.
    SceneProcess(const StabilityPlan& plan, const StabilityScene& scene, StabilityRow* rows);
    ~SceneProcess();
    SceneProcess(const SceneProcess&) = delete;
    SceneProcess& operator=(const SceneProcess&) = delete;

    /// To be polled for reading.
    int descriptor() const { return _descriptor; }
    /// Takes what the child has written; when it has ended before its work, the cell that it was at is marked, and another
    /// goes on.
    void read();
    /// Ends a child that has been at one cell for too long, and goes on after it.
    void watch();
    bool done() const { return _done; }
    /// Cells that are done, all contenders.
    std::size_t cells() const { return _cells; }
    std::string doing() const;

private:
    void start(const StabilityPlace& from);
    void runChild(const StabilityPlace& from, int into);
    void take(const std::string& line);
    void put(const StabilityCell& cell);
    void endFilm();
    /// The child is gone. @param failure  "crashed" or "hung"
    void goOn(const std::string& failure, const std::string& message);
    int reap();

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

} // namespace gnomon::examples
