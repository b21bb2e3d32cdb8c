// SPDX-License-Identifier: MIT
#include <gnomon/onterrain/TerrainOutcome.h>

namespace gnomon {

const char* sentence(TerrainOutcome outcome) {
    switch (outcome) {
    case TerrainOutcome::fan:
        return "its shadow is one polygon.";
    case TerrainOutcome::draped:
        return "its shadow lies on the ground's triangles.";
    case TerrainOutcome::block:
        return "its shadow is that of its bounding box, which is its own.";
    case TerrainOutcome::boxed:
        return "its shadow is that of its bounding box, whose outline differs from the caster's in this light. Use "
               "hull "
               "or drape.";
    case TerrainOutcome::steep:
        return "draped instead, because the ground falls off nearly as steeply as the light. The shadow is right, but "
               "takes longer.";
    case TerrainOutcome::rough:
        return "draped instead, because the ground between the corners is off the polygon, or a slanting wall stands "
               "in the ground. The shadow is right, but takes longer.";
    case TerrainOutcome::noFan:
        return "draped instead, because a ray meets no ground or the polygon would overlap itself. The shadow is "
               "right, but takes longer.";
    case TerrainOutcome::lightBelow:
        return "no shadow, because the light is below the horizon or in the ground. Raise the light.";
    case TerrainOutcome::lightInside:
        return "all the ground is dark, because the light is inside the caster. Move the light out of it.";
    case TerrainOutcome::edgeOn:
        return "no shadow, because the light meets the caster edge on or there is no light. Move the light.";
    case TerrainOutcome::turnedAway:
        return "no shadow of its own, because the faces turned to the light cast it.";
    case TerrainOutcome::buried:
        return "no shadow, because the caster is in the ground. Raise the caster.";
    case TerrainOutcome::noGround:
        break;
    }
    return "no shadow, because it meets no ground. Extend the terrain, or raise the light.";
}

} // namespace gnomon
