// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/onterrain/TerrainOutcome.h>

#include <osg/BoundingBox>

namespace gnomon {

/// How shadows are to be found.
struct TerrainSettings {
    bool asBoxes = false; ///< by bounding boxes, as published; else by `method`.
    TerrainMethod method = TerrainMethod::hull;
    double error = 0.0;
    osg::BoundingBoxd box; ///< of the only object, if it is cast as a box; invalid: found from each.

    bool operator==(const TerrainSettings& other) const {
        return asBoxes == other.asBoxes && method == other.method && error == other.error &&
               box._min == other.box._min && box._max == other.box._max;
    }
};

} // namespace gnomon
