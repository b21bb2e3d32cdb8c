// SPDX-License-Identifier: MIT
#include "SyntheticChart.h"

#include <OutputFile.h>

#include <cmath>

namespace test {

using namespace gnomon::examples;
using gnomon::metrics::ShadowMetrics;

const char* const hostileTitle = "Room <script>document.title='hacked'</script> & \"lamp\"";

namespace {

struct Scene {
    const char *name, *title;
    std::size_t triangles;
    double frame; ///< ms
    double scale; ///< how much farther errors are off than in the first.
    bool flat;    ///< planar shadows can be used.
};

const std::vector<Scene> scenes = {{"boxes", "Sphere and box on a ground", 2500, 4, 1.0, true},
                                   {"town", "Flat town of 400 boxes", 5000, 6, 2.5, true},
                                   {"hills", "Terrain of 200,000 triangles", 200000, 15, 1.8, false},
                                   {"room", hostileTitle, 40000, 8, 1.4, true},
                                   {"tree", "Tree with many small leaves", 300000, 25, 3.0, true}};

struct Technique {
    const char *kit, *name;
    double fixed, perFrame; ///< ms added: at all, and per ms of the scene's frame; half of it only if the light moves.
    double error;           ///< px, at size 1024.
    std::vector<int> sizes; ///< of a map; one of 0: it has none.
    bool keeps;             ///< what it found, while the light rests.
};

const std::vector<Technique> techniques = {
    {"Gnomon", "planar", 0.3, 0.10, 0.45, {0}, false},
    {"Gnomon", "map", 0.8, 0.45, 1.1, {256, 512, 1024, 2048, 4096}, true},
    {"Gnomon", "map bicubic", 1.1, 0.45, 0.8, {512, 1024, 2048, 4096}, true},
    {"Gnomon", "traced", 28.0, 0.20, 0.43, {0}, false},
    {"Gnomon", "box", 0.1, 0.01, 40.0, {0}, false},
    {"osgShadow", "ShadowMap", 3.0, 0.9, 3.2, {256, 512, 1024, 2048, 4096}, false},
    {"osgShadow", "SoftShadowMap", 7.0, 0.9, 4.1, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "ParallelSplitShadowMap", 9.0, 2.2, 1.6, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "StandardShadowMap", 3.4, 1.0, 2.9, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "MinimalShadowMap", 3.6, 1.0, 1.9, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "MinimalCullBoundsShadowMap", 3.7, 1.0, 1.8, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "MinimalDrawBoundsShadowMap", 6.5, 1.1, 1.5, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "LightSpacePerspectiveShadowMapCB", 3.9, 1.0, 1.3, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "LightSpacePerspectiveShadowMapDB", 6.7, 1.1, 1.2, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "ViewDependentShadowMap", 5.0, 1.3, 1.7, {512, 1024, 2048, 4096}, false},
    {"osgShadow", "ShadowTexture", 2.0, 0.5, 6.0, {512, 1024, 2048}, false}};

std::size_t pixels(double share) { return static_cast<std::size_t>(std::lround(share * 400000.0)); }

/// From -1 to 1, the same for the same seed: a measurement's noise.
double noise(std::size_t seed) { return std::sin(12.9898 * static_cast<double>(seed)); }

AddedTime spread(double ms, std::size_t seed) {
    const double median = ms * (1.0 + 0.06 * noise(seed));
    return {0.93 * median, median, 1.08 * median};
}

ChartCost costOf(const Scene& scene, const Technique& technique, int size, std::size_t seed) {
    const double texels = 1e-6 * size * size, geometry = technique.perFrame * scene.frame;
    const double moving = technique.fixed + geometry + texels, steady = technique.keeps ? 0.6 + 0.1 * geometry : moving;
    ChartCost cost;
    cost.first = 30.0 + 3.0 * moving;
    cost.steadyWall = spread(steady, seed);
    cost.steadyProcessor = spread(1.7 * steady, seed + 1);
    cost.movingWall = spread(moving, seed + 2);
    cost.movingProcessor = spread(1.7 * moving, seed + 3);
    cost.memory = 4.0 * texels;
    cost.draws = static_cast<unsigned>(scene.triangles / 100);
    cost.passes = size ? 2 : 1;
    cost.triangles = cost.passes * scene.triangles;
    return cost;
}

ShadowMetrics errorsOf(double boundary, std::size_t seed) {
    ShadowMetrics m;
    m.agreeing = m.facing = 410000;
    m.certain = 400000;
    const double wrong = 0.002 * boundary;
    m.causes.halo = pixels(0.3 * wrong);
    m.causes.erosion = pixels(0.4 * wrong);
    m.causes.acne = pixels(0.2 * wrong * std::abs(noise(seed)));
    m.causes.peterPanning = pixels(0.15 * wrong);
    m.causes.leak = pixels(0.05 * wrong);
    m.headline.falseShadow = m.causes.halo + m.causes.acne;
    m.headline.falseLit = m.causes.erosion + m.causes.peterPanning + m.causes.leak;
    m.headline.shadow = pixels(0.2) - m.headline.falseLit;
    m.headline.lit = m.certain - m.headline.shadow - m.headline.falseShadow - m.headline.falseLit;
    m.raw = m.headline;
    m.boundary.emplace();
    m.boundary->mean = 0.4 * boundary;
    m.boundary->p95 = boundary;
    m.boundary->max = 9.0 * boundary;
    m.pointSun.all = 0.01 * boundary;
    return m;
}

std::string settingOf(int size) { return size ? "size " + std::to_string(size) : "defaults"; }

ChartPoint pointOf(const Scene& scene, const Technique& technique, int size, std::size_t seed) {
    ChartPoint point;
    point.scene = scene.name;
    point.kit = technique.kit;
    point.technique = technique.name;
    point.setting = std::string(technique.name) == "traced" ? "<b>best</b> of all" : settingOf(size);
    if (size) point.settings = {{"size", std::to_string(size)}};
    const double coarse = size ? 1024.0 / size : 1.0;
    point.cost = costOf(scene, technique, size, seed);
    point.errors = errorsOf(std::max(0.42, scene.scale * technique.error * coarse * (1.0 + 0.1 * noise(seed))), seed);
    point.shadedRmse = 0.004 * point.errors->boundary->p95;
    point.flickerEnergy = 0.001 * point.errors->boundary->p95;
    point.picture = "pictures/" + std::to_string(seed) + ".png";
    point.overlay = "pictures/" + std::to_string(seed) + "-errors.png";
    return point;
}

/// Some fail, some are catastrophic, some lack numbers; one of osgShadow's wins.
void spoil(ChartPoint& point) {
    if (point.technique == "ShadowTexture" && point.scene == "room") {
        ChartPoint failed;
        failed.scene = point.scene;
        failed.kit = point.kit;
        failed.technique = point.technique;
        failed.setting = point.setting;
        failed.settings = point.settings;
        failed.failure = "It ended by signal 11 <b>at once</b>.";
        point = failed;
    } else if (point.technique == "ViewDependentShadowMap" && point.scene == "tree") {
        point.errors->catastrophes.lostShadow = true;
        point.notes = {"OpenGL said: \"invalid <enumerant>\"."};
    } else if (point.technique == "box" && point.scene != "hills") {
        point.errors->catastrophes.allLit = true;
        point.errors->boundary.reset();
    } else if (point.technique == "MinimalShadowMap" && point.setting == "size 4096" && point.scene == "room") {
        point.cost->steadyWall = {0.19, 0.2, 0.21};
        point.errors->boundary->p95 = 0.43;
    }
}

void addPoints(ChartResults& results, const Scene& scene, const Technique& technique) {
    if (!scene.flat && std::string(technique.name) == "planar") return;
    for (const int size : technique.sizes) {
        results.points.push_back(pointOf(scene, technique, size, results.points.size()));
        spoil(results.points.back());
    }
}

osg::ref_ptr<osg::Image> plain(unsigned char red, unsigned char green, unsigned char blue) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(120, 80, 1, GL_RGB, GL_UNSIGNED_BYTE);
    const unsigned char colour[] = {red, green, blue};
    for (unsigned i = 0; i < 3 * 120 * 80; ++i) image->data()[i] = colour[i % 3];
    return image;
}

void write(const osg::Image& image, const std::filesystem::path& path) {
    if (path.has_extension()) OutputFile(path.string()).write(image);
}

} // namespace

ChartResults syntheticChart() {
    ChartResults results;
    results.made = {{"command", "gnomonchart --out chart"},
                    {"date", "2026-11-21"},
                    {"renderer", "llvmpipe (made up)"},
                    {"processor", "2 cores of nothing"},
                    {"size", "800 × 600"}};
    results.complete = true;
    for (const Scene& scene : scenes) {
        results.scenes.push_back({scene.name,
                                  scene.title,
                                  scene.triangles,
                                  0.001,
                                  0.4,
                                  scene.frame,
                                  std::string("pictures/") + scene.name + "-truth.png",
                                  {{"light", "1,1,2,0"}}});
        for (const Technique& technique : techniques) addPoints(results, scene, technique);
    }
    return results;
}

void writePictures(const ChartResults& results, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder / "pictures");
    for (const ChartSceneResult& scene : results.scenes) write(*plain(0, 200, 0), folder / scene.truthPicture);
    for (const ChartPoint& point : results.points) {
        write(*plain(200, 0, 0), folder / point.picture);
        write(*plain(0, 0, 200), folder / point.overlay);
    }
}

ChartPoint chartPoint(const char* kit, const char* technique, const char* setting, double ms, double error) {
    ChartPoint point;
    point.scene = "boxes";
    point.kit = kit;
    point.technique = technique;
    point.setting = setting;
    point.cost.emplace();
    point.cost->steadyWall = point.cost->movingWall = {ms, ms, ms};
    point.errors.emplace().boundary.emplace().p95 = error;
    return point;
}

} // namespace test
