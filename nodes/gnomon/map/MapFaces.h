// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/map/MapCasters.h>
#include <gnomon/map/MapRequest.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon {

/// What of a scene is seen in one view.
struct SeenScene {
    glm::dmat4 clipFromScene{0.0}, eyeFromScene{0.0};
    glm::dvec2 pixels{0.0};             ///< of the view, across and up.
    std::uint64_t receiversValue = 0;   ///< see ViewFrame::seenValue.
    std::vector<PlacedBox> receivers{}; ///< boxes of these.

    /// True if these are of one view and the same receivers; false if those are not known.
    bool isAs(const SeenScene& other) const {
        return receiversValue != 0 && receiversValue == other.receiversValue && clipFromScene == other.clipFromScene &&
               eyeFromScene == other.eyeFromScene && pixels == other.pixels;
    }
};

/// True if what is flat, a ground for one, may stand between the light and a place that is seen: not if all of those are on the
/// light's side of it, or in it. Of all that is level, each way, the one nearest to the light says so for all.
bool anyIsBetween(const MapCasters& casters, const glm::dvec4& light, const std::vector<PlacedBox>& receivers);
/// True if what is not flat touches something flat on the side that is turned away from the light: a map lights it a little along
/// there.
bool anyTouchesBehind(const MapCasters& casters, const glm::dvec4& light);

/// What the maps of one light must hold for one view: where the light, the casters and what is seen are, whatever was drawn before.
class MapFaces {
public:
    /// What darkens the same places: all that is not flat, or something flat, a ground for one.
    struct Blocker {
        MapOutline outline;    ///< of what it can darken, were all edges hard.
        HalfSpaces halfSpaces; ///< that hold what it can darken: what is flat darkens what is beyond it.
    };
    /// What a layer of the casters can darken.
    struct Outlines {
        MapOutline unflats;            ///< all together.
        std::vector<MapOutline> flats; ///< one by one, as in MapLayer::flats; none where they do not cast.
    };
    /// One direction that the light looks in, and what casts there.
    struct Side {
        LightFrame frame;
        Outlines still; ///< of those that stand still.
        std::vector<Blocker> blockers;
    };
    /// What one map is needed for: of a side, and one part of what is seen.
    struct Face {
        const Side* side;
        std::size_t part; ///< of a sun see viewPart(); of a lamp 1 is what is near it, if one map cannot hold all.
        MapOutline reach, needed;    ///< what the blockers can darken; what of that is seen.
        MapOutline held;             ///< what the map must hold for that.
        double nearestBlocker = 0.0; ///< depth of the nearest of what darkens any of it.
        double texel = 0.0;          ///< side of the largest that is no larger than any pixel of it, see TexelDensity.
        std::optional<MapFit> fit{}; ///< of the map that is drawn: LightShadowMaps keeps it here.

        Face(const Side& of, std::size_t itsPart)
            : side(&of), part(itsPart), reach(of.frame), needed(of.frame), held(of.frame) {}
        void clear() { reach = needed = held = MapOutline(side->frame); }
    };

    static constexpr int largestTexture = 16384; ///< texels on a side: what OpenGL has in most places.

    /// Begins anew. @param flats  see flatsCast().
    void begin(const MapRequest& request, bool flats);
    /// Of other casters, as seen from the same light.
    void takeCasters(const MapCasters& casters);
    /// True if begin() would look the same ways for these casters.
    bool haveSameSides(const CasterLayers& casters) const;
    /// Looks from elsewhere, or at something else.
    void see(SeenScene seen) { _seen = std::move(seen); }
    /// Finds what is needed there. @param texels  on a map's side: what soft edges reach depends on it.
    void find(int texels);
    /// Finds Face::held once more, with other texels.
    void findHeld(Face& face, int texels) const;

    /// What they are of.
    const MapRequest& request() const { return _request; }
    const SeenScene& seen() const { return _seen; }
    /// True if casters that are flat, as grounds are, cast, too.
    bool flatsCast() const { return _flats; }
    /// From a lamp to the nearest caster: nothing that is nearer is dark.
    double clearance();
    /// Half sides of a box about the origin that holds what a face's map draws: no further than the map and the widest drawable.
    glm::dvec3 reachOf(const Face& face) const;
    /// Half-spaces of what is looked up in a face's map.
    HalfSpaces placesOf(const Face& face) const;

    std::vector<Face> each; ///< of each side one a part; of a lamp's side two.

private:
    Outlines outlinesOf(const MapLayer& layer, const LightFrame& frame) const;
    bool areThin(const LightFrame& frame) const;
    void findBlockers(Side& side) const;
    void findSplits();
    double pixelsATexel(double distance) const;
    void findFace(Face& face, const HalfSpaces& halfSpaces, int texels) const;
    void findLamp(Face& far, Face& near, int texels);
    void addNeeded(Face& face, const Blocker& blocker, HalfSpaces halfSpaces, TexelDensity& pixels) const;

    MapRequest _request;
    bool _flats = false;
    std::optional<double> _clearOfStill; ///< see clearance().
    std::vector<Side> _sides;
    SeenScene _seen;
    int _cascades = 0;           ///< maps that a sun is to have, which change seldom; 0 until that is known.
    std::vector<double> _splits; ///< of what is seen: see cascadeSplits().
};

} // namespace gnomon
