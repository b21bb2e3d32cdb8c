// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoView.h>
#include <gnomon/map/MapCasters.h>
#include <gnomon/map/MapForecast.h>
#include <gnomon/mapfit/EdgeWidths.h>

#include <vector>

namespace gnomon {

/// Edges of a light's shadow that are in sight in one view, found once for all maps that are thought of.
class MapEdges {
public:
    /// @param boxes  of the casters. @param forecast  of as few maps as can be.
    MapEdges(const AutoView& view, const MapCasters& boxes, const MapForecast& forecast);

    /// As they are looked up in these maps. None where no place that is seen is in a map.
    EdgeWidths in(const MapForecast& forecast) const;

private:
    glm::dmat4 _clipFromScene;
    glm::dvec2 _pixels;
    std::vector<SeenPlace> _places;
};

} // namespace gnomon
