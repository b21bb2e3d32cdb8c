// SPDX-License-Identifier: MIT
#include "TownPictures.h"
#include "OutputFile.h"
#include "TownOptions.h"

namespace gnomon::examples {
namespace {

struct TimeOfDay {
    const char* name;
    double hour;
};
constexpr TimeOfDay times[] = {{"morning", 8.0}, {"noon", 12.0}, {"evening", 16.0}};

} // namespace

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

} // namespace gnomon::examples
