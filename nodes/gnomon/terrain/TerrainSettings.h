// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/TerrainShadowOptions.h>
#include <gnomon/onterrain/TerrainOutcome.h>

#include <osg/BoundingBox>

namespace gnomon {

/// A technique's options, as the search for shadows takes them.
struct TerrainSettings {
    /// @param given  of the only object, if it is cast as a box.
    TerrainSettings(const TerrainShadowOptions& options = {}, const osg::BoundingBoxd& given = {})
        : asBoxes(options.method == TerrainShadowOptions::BOX),
          method(options.method == TerrainShadowOptions::DRAPE ? TerrainMethod::drape : TerrainMethod::hull),
          error(options.error),
          box(given) {}

    bool asBoxes; ///< by bounding boxes, as published; else by `method`.
    TerrainMethod method;
    double error;
    osg::BoundingBoxd box; ///< invalid: found from each object.

    bool operator==(const TerrainSettings& other) const {
        return asBoxes == other.asBoxes && method == other.method && error == other.error &&
               box._min == other.box._min && box._max == other.box._max;
    }
};

} // namespace gnomon
