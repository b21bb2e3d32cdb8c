// SPDX-License-Identifier: MIT
// arl_terrain: a town on mountains, in a window or a picture; its shadows by TerrainShadowGeode.
#include "ElevationFile.h"
#include "OutputFile.h"
#include "RunningSun.h"
#include "ScenePicture.h"
#include "SceneWindow.h"
#include "TownOptions.h"
#include "TownScene.h"

#include <filesystem>
#include <iostream>

namespace {

using namespace gnomon;
using namespace gnomon::examples;

/// Draws a town into memory.
class TownPictures {
public:
    /// @throws std::runtime_error, one sentence, if there is no OpenGL.
    explicit TownPictures(TownScene& town);

    osg::ref_ptr<osg::Image> draw();
    /// Morning, noon and evening, with each technique: NAME-TECHNIQUE.png.
    /// @throws std::runtime_error, one sentence, if the folder cannot be made or written to.
    void report(const std::filesystem::path& folder);

private:
    TownScene& _town;
    ScenePicture _picture;
};

struct TimeOfDay {
    const char* name;
    double hour;
};
constexpr TimeOfDay times[] = {{"morning", 8.0}, {"noon", 12.0}, {"evening", 16.0}};

TownPictures::TownPictures(TownScene& town) : _town(town), _picture(town.view(), town.setup()) {}

osg::ref_ptr<osg::Image> TownPictures::draw() { return _picture.draw(); }

void TownPictures::report(const std::filesystem::path& folder) {
    requireFolder(folder);
    for (const std::string& technique : townTechniques()) {
        _town.setup().cast({parseShadowSpec(technique)});
        for (const TimeOfDay& time : times) {
            OutputFile file((folder / (std::string(time.name) + "-" + technique + ".png")).string());
            _town.setHour(time.hour);
            file.write(*draw());
        }
    }
}

void tell(const TownScene& town) {
    for (const std::string& cause : town.setup().diagnose()) std::cerr << "arl_terrain: note: " << cause << std::endl;
}

void writePicture(TownScene& town, OutputFile& file) {
    const osg::ref_ptr<osg::Image> picture = TownPictures(town).draw();
    tell(town);
    file.write(*picture);
}

int show(TownScene& town, double sunSpeed) {
    TownControls controls(town);
    const osg::ref_ptr<Hud> hud = new Hud([&] { return controls.describe(); });
    const osg::ref_ptr<osgGA::GUIEventHandler> keys = new KeyHandler<TownControls>(townKeys(), controls, *hud);
    const WindowNames names = {"arl_terrain", "shows a town's shadows on terrain.", "--out IMAGE"};
    SceneWindow window(names, town.view(), town.setup(), *hud, *keys);
    runSun(window, sunSpeed, [&](double seconds) { controls.passTime(seconds / 3600.0); });
    return window.run();
}

int run(osg::ArgumentParser& arguments) {
    const TownOptions options = readTownOptions(arguments);
    if (options.help) return std::cout << townHelp(), 0;
    std::optional<OutputFile> picture;
    if (!options.out.empty()) picture.emplace(options.out).requireImage();
    TownScene town(options.view, options.hour, *readElevation(options.elevation, "arl_terrain"), options.plan);
    if (picture) return writePicture(town, *picture), 0;
    if (!options.report.empty()) return TownPictures(town).report(options.report), 0;
    return show(town, options.sunSpeed);
}

} // namespace

int main(int argc, char** argv) { return gnomon::examples::runProgram("arl_terrain", argc, argv, run); }
