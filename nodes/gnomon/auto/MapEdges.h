// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoView.h>
#include <gnomon/map/MapCasters.h>
#include <gnomon/map/MapForecast.h>
#include <gnomon/mapfit/SeenEdges.h>

#include <optional>
#include <vector>

namespace gnomon {

/// Places of one view that a light shines on, found once for all maps that are thought of.
class MapEdges {
public:
    /// @param boxes  of the casters. @param forecast  of as few maps as can be.
    MapEdges(const AutoView& view, const MapCasters& boxes, const MapForecast& forecast);

    /// Pixels that most edges are wide, for one of the side of a map; see EdgeWidths::usual(). Nothing where no place that
    /// is seen is in a map.
    std::optional<double> widthOf(const MapForecast& forecast) const;

private:
    glm::dmat4 _clipFromScene;
    glm::dvec2 _pixels;
    std::vector<SeenPlace> _places;
};

} // namespace gnomon
