// SPDX-License-Identifier: MIT
#include "Race.h"
#include "StageViewer.h"

#include <osg/GLExtensions>
#include <osgUtil/RenderStage>
#include <osgViewer/Renderer>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <malloc.h>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>
#include <string>
#include <unistd.h>

namespace gnomon::examples {
namespace {

constexpr int warmUp = 12;                          // frames: from the ninth on auto has chosen for what moves
constexpr double cameraStep = 0.5, lightStep = 1.0; // degrees a frame

/// Times by rounds.
struct Times {
    std::vector<double> wall, processor;
    void add(const FrameTime& time) {
        wall.push_back(time.wall);
        processor.push_back(time.processor);
    }
};

double residentMiB() {
    malloc_trim(0); // what others freed is not this one's
    std::ifstream file("/proc/self/statm");
    double all = 0.0, resident = 0.0;
    file >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

/// Triangles, lines and points that reach OpenGL's rasteriser before clipping, in one frame.
std::size_t primitivesOf(StageViewer& viewer) {
    osg::GraphicsContext& context = *viewer.viewer().getCamera()->getGraphicsContext();
    context.makeCurrent();
    const auto& gl = *context.getState()->get<osg::GLExtensions>();
    GLuint query = 0, count = 0;
    gl.glGenQueries(1, &query);
    gl.glBeginQuery(GL_PRIMITIVES_GENERATED, query);
    viewer.draw();
    gl.glEndQuery(GL_PRIMITIVES_GENERATED);
    gl.glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
    gl.glDeleteQueries(1, &query);
    return count;
}

unsigned stagesOf(const osgUtil::RenderStage& stage) {
    unsigned count = 1;
    for (const auto& before : stage.getPreRenderList()) count += stagesOf(*before.second);
    for (const auto& after : stage.getPostRenderList()) count += stagesOf(*after.second);
    return count;
}

/// Cameras that drew in the last frame, the view's own with them.
unsigned passesOf(StageViewer& viewer) {
    auto* renderer = dynamic_cast<osgViewer::Renderer*>(viewer.viewer().getCamera()->getRenderer());
    return renderer ? stagesOf(*renderer->getSceneView(0)->getRenderStage()) : 0;
}

/// One contender on its track. Motions: 0 the camera's, 1 the light's.
struct Runner {
    std::unique_ptr<StageViewer> viewer;
    std::array<Times, 2> times;
    std::array<std::optional<PredictedTime>, 2> expected;
    double first = 0.0, memory = 0.0;
    std::size_t draws = 0, primitives = 0;
    unsigned passes = 0;
    std::string failure;

    std::optional<PredictedTime> expectedNow(std::size_t motion) const {
        const std::vector<ShadowDecision> decisions = viewer->staging().decisions();
        if (decisions.empty()) return std::nullopt;
        const ShadowCandidate& chosen = decisions.front().chosen;
        return PredictedTime{chosen.spec, motion == 0 ? chosen.flying : chosen.moving};
    }

    FrameTime draw(const ChartScene& scene, std::size_t motion, int round) {
        viewer->setCamera(motion == 0 ? movedCamera(scene, cameraStep * round) : scene.camera);
        if (motion == 1) viewer->staging().setLight(movedLight(scene, lightStep * round));
        return viewer->time();
    }

    void start(const Contender& contender, const ChartScene& scene, const ShaderCache& shaders) {
        shaders.empty();
        const double before = residentMiB();
        viewer = std::make_unique<StageViewer>(contender.stage(scene, Look::SHADED), scene.camera,
                                               StageViewer::Colour::BYTES);
        first = viewer->time().wall;
        for (int round = -warmUp; round < 0; ++round) draw(scene, 0, round);
        memory = residentMiB() - before;
        const std::size_t drawn = drawCalls();
        draw(scene, 0, 0);
        draws = drawCalls() - drawn;
        primitives = primitivesOf(*viewer);
        passes = passesOf(*viewer);
    }
};

/// Runs `step`; a runner that fails is out of the race.
template <typename Step>
void guarded(Runner& runner, const Step& step) {
    if (!runner.failure.empty()) return;
    try {
        step(runner);
    } catch (const std::exception& error) {
        runner.failure = error.what();
        runner.viewer.reset();
    }
}

class Track {
public:
    Track(const ChartScene& scene, const std::vector<Contender>& contenders, int frames, const ShaderCache& shaders)
        : _scene(scene), _frames(frames), _runners(contenders.size() + 1) {
        guarded(_runners[0], [&](Runner& r) { r.start(plainContender(), _scene, shaders); });
        for (std::size_t i = 0; i < contenders.size(); ++i)
            guarded(_runners[i + 1], [&](Runner& r) { r.start(contenders[i], _scene, shaders); });
    }

    void run(const std::function<bool(int, int)>& progress) {
        const int all = 2 * _frames + warmUp; // the camera's motion goes on from the start
        for (int round = 0; round < all && progress(round, all); ++round) {
            if (round < _frames)
                draw(0, round + 1, true);
            else
                draw(1, round - _frames, round >= _frames + warmUp);
        }
    }

    RaceResults results() const {
        RaceResults results;
        const Runner& plain = _runners[0];
        if (!plain.failure.empty()) throw std::runtime_error("the plain scene cannot be drawn: " + plain.failure);
        results.frame = quartiles(plain.times[0].wall).median;
        for (std::size_t i = 1; i < _runners.size(); ++i) results.contenders.push_back(resultOf(_runners[i], plain));
        return results;
    }

private:
    void draw(std::size_t motion, int round, bool isTimed) {
        each(round, [&](Runner& runner) {
            const FrameTime time = runner.draw(_scene, motion, round);
            if (isTimed) runner.times[motion].add(time);
            runner.expected[motion] = runner.expectedNow(motion);
        });
    }

    /// In another order each round, the same in every run: nobody always runs after the same.
    template <typename Step>
    void each(int round, const Step& step) {
        std::vector<std::size_t> order(_runners.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::shuffle(order.begin(), order.end(), std::mt19937(static_cast<unsigned>(round)));
        for (const std::size_t i : order) guarded(_runners[i], step);
    }

    static AddedTime added(const std::vector<double>& with, const std::vector<double>& without) {
        std::vector<double> differences;
        for (std::size_t i = 0; i < std::min(with.size(), without.size()); ++i)
            differences.push_back(with[i] - without[i]);
        const Quartiles q = quartiles(differences);
        return {q.q1, q.median, q.q3};
    }

    static RaceResult resultOf(const Runner& runner, const Runner& plain) {
        if (!runner.failure.empty()) return {std::nullopt, runner.failure, {}, {}};
        const auto& [steady, moving] = runner.times;
        if (steady.wall.empty() || moving.wall.empty()) return {};
        ChartCost cost;
        cost.first = runner.first - plain.first;
        cost.steadyWall = added(steady.wall, plain.times[0].wall);
        cost.steadyProcessor = added(steady.processor, plain.times[0].processor);
        cost.movingWall = added(moving.wall, plain.times[1].wall);
        cost.movingProcessor = added(moving.processor, plain.times[1].processor);
        cost.memory = std::max(0.0, runner.memory - plain.memory);
        cost.draws = static_cast<unsigned>(runner.draws);
        cost.passes = runner.passes;
        cost.triangles = runner.primitives;
        return {cost, "", runner.expected[0], runner.expected[1]};
    }

    const ChartScene& _scene;
    const int _frames;
    std::vector<Runner> _runners; // the plain scene is the first
};

} // namespace

namespace fs = std::filesystem;

ShaderCache::ShaderCache() {
    std::string name = (fs::temp_directory_path() / "gnomonchart-XXXXXX").string();
    if (!mkdtemp(name.data())) {
        setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
        return;
    }
    _folder = name;
    setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);
    setenv("MESA_SHADER_CACHE_DIR", name.c_str(), 1);
}

ShaderCache::~ShaderCache() {
    std::error_code ignored;
    if (!_folder.empty()) fs::remove_all(_folder, ignored);
}

/// Mesa keeps a folder for its own bookkeeping, with a folder in it for every first two digits of a shader's hash.
void ShaderCache::empty() const {
    std::error_code ignored;
    if (_folder.empty()) return;
    for (const fs::directory_entry& cache : fs::directory_iterator(_folder, ignored))
        for (const fs::directory_entry& shaders : fs::directory_iterator(cache, ignored))
            if (shaders.is_directory(ignored)) fs::remove_all(shaders, ignored);
}

RaceResults race(const ChartScene& scene, const std::vector<Contender>& contenders, int frames,
                 const ShaderCache& shaders, const std::function<bool(int done, int all)>& progress) {
    Track track(scene, contenders, frames, shaders);
    track.run(progress);
    return track.results();
}

} // namespace gnomon::examples
