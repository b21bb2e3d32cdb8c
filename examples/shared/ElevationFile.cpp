// SPDX-License-Identifier: MIT
#include "ElevationFile.h"
#include "InputFile.h"

#include <algorithm>
#include <stdexcept>

namespace gnomon::examples {
namespace {

constexpr FileKind elevation{"an elevation model", "tif.gdal, asc.gdal, hgt.gdal, vrt.gdal, …"};

constexpr ReadMethod fields{[](osgDB::Registry& registry, const std::string& name) {
    return registry.readHeightField(name, registry.getOptions());
}};

bool isLevelAtZero(const osg::HeightField& field) {
    const auto& heights = field.getHeightList();
    return std::all_of(heights.begin(), heights.end(), [](float height) { return height == 0.0f; });
}

} // namespace

osg::ref_ptr<osg::HeightField> readElevation(const std::string& file, const std::string& program) {
    ReadResult result = readFile(file, program, elevation, fields);
    osg::ref_ptr<osg::HeightField> field = result.getHeightField();
    if (!field || field->getNumColumns() < 2 || field->getNumRows() < 2)
        throw std::runtime_error(damagedSentence(file, elevation));
    if (isLevelAtZero(*field))
        throw std::runtime_error(quoted(file) +
                                 " has the height 0 everywhere. The data that it refers to may be missing or damaged.");
    return field;
}

} // namespace gnomon::examples
