// SPDX-License-Identifier: MIT
#pragma once
#include "ChartResults.h"
#include "Contender.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

namespace gnomon::examples {

/// Mesa's cache of compiled shaders, in a folder of this object's own that goes with it: what a run measures does not
/// depend on runs before it, and the user's cache stays as it is. Make it before the first OpenGL context of the process;
/// one that comes later changes nothing.
class ShaderCache {
public:
    ShaderCache();
    ~ShaderCache();
    ShaderCache(const ShaderCache&) = delete;
    ShaderCache& operator=(const ShaderCache&) = delete;

    /// The next context compiles all of its shaders anew.
    void empty() const;

private:
    std::filesystem::path _folder; ///< empty: none could be made, and Mesa does without.
};

/// Calls that draw, handed to OpenGL by this process since it began: vertices, elements and display lists, each part of a
/// multi-draw as one. A program that links this stands between every library and OpenGL, so that whoever draws is counted
/// alike. What is compiled into a display list counts when the list is called, as one.
std::size_t drawCalls();

/// What one contender of a race came to.
struct RaceResult {
    std::optional<ChartCost> cost; ///< none if it could not be staged or drawn, or the race was stopped at once.
    std::string failure;           ///< then why.
    /// Of a contender that chooses: what it expected of its choice in the last frame of either motion.
    std::optional<PredictedTime> steady, moving;
};

struct RaceResults {
    double frame = 0.0; ///< ms, wall: median of a steady frame without shadows.
    std::vector<RaceResult> contenders;
};

/// Times contenders against the scene without shadows, frame by frame in turns: one process, a context a viewer, glFinish
/// at both ends of each frame. What a contender adds is the difference to the plain frame of the same round.
///
/// First frame   of a fresh context: shaders are compiled in it, textures made. The cache of shaders is emptied before.
/// Steady        the camera goes half a degree a frame about the scene, nothing else changes.
/// Moving        the light goes a degree a frame.
/// Memory        growth of the process's resident set by the contender's context, viewer and first frames, beyond the
///               plain viewer's: on OSMesa that holds the textures, too.
/// Draws         calls that draw, and triangles handed to OpenGL, in one steady frame after twelve. Passes  cameras that draw in it.
///
/// @param frames    of each of the two motions, after twelve to warm up: those of the camera's motion are drawn at the start.
/// @param progress  called before each round with rounds done and to do; false stops the race, and what it has counts.
RaceResults race(const ChartScene& scene, const std::vector<Contender>& contenders, int frames,
                 const ShaderCache& shaders, const std::function<bool(int done, int all)>& progress);

} // namespace gnomon::examples
