// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/map/LightShadowMaps.h>
#include <gnomon/map/MapCasters.h>
#include <gnomon/mapfit/SeenEdges.h>
#include <gnomon/terrain/GroundRevision.h>

#include <glm/vec4.hpp>

#include <string>
#include <vector>

namespace gnomon {

/// What a decision is about: one light's shadow in one view.
struct ShadowInView {
    const ViewFrame& view;
    const ShadowLight& light;
    const Casters& casters; ///< a decision alone asks for their meshes.
    glm::dvec4 towards;     ///< the light, group frame: w = 0 and length 1, or w = 1.
};

/// The least change of a channel that can be seen.
constexpr double leastContrast = 2.0 / 255.0;

/// True if nobody could see that the receivers lose a light: with all that are fainter it gives them less than two of 255
/// steps of any channel.
bool isFaint(const ShadowInView& shadow);

/// Why depths do not tell where casters' shadows fall; empty if they do.
std::string whyCoarse(const ShadowInView& shadow);

/// Why casters need a technique that knows their textures, and why they need one that draws them; empty if they do not.
std::string whyCutOut(const Casters& casters);
std::string whyDrawnCutOut(const Casters& casters);

/// What a named receiver is like as terrain.
struct TerrainFacts {
    std::string obstacle; ///< empty: a TerrainShadowGeode draws all of the shadow.
    double off = 0.0;     ///< of a hull's shadow in plan: 95 % of its edges lie within this distance; group's unit.
};

/// Terrain that was looked at last, so that it is read once a revision.
///
/// Threads one at a time.
class TerrainKnowledge {
public:
    /// @param receiver  that the technique names.
    TerrainFacts of(const ShadowInView& shadow, const Selection& receiver);

private:
    osg::ref_ptr<const GroundRevision> _drawn;
};

/// Edges of a light's shadow that are in sight in one view, found once for all maps that are thought of.
class MapEdges {
public:
    /// @param boxes  of the casters. @param forecast  of as few maps as can be.
    MapEdges(const ShadowInView& shadow, const MapCasters& boxes, const MapForecast& forecast);

    /// As they are looked up in these maps. None where no place that is seen is in a map.
    EdgeWidths in(const MapForecast& forecast) const;

private:
    glm::dmat4 _clipFromScene;
    glm::dvec2 _pixels;
    std::vector<SeenPlace> _places;
    std::vector<Contact> _contacts;
    double _cell = 0.0; ///< pixels that a contact stands for.
};

} // namespace gnomon
