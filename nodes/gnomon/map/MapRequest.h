// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/ViewFrame.h>
#include <gnomon/map/MapCasters.h>
#include <gnomon/mapfit/MapFit.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <optional>
#include <tuple>
#include <vector>

namespace gnomon {

/// What ShadowMapOptions come to, of the maps themselves.
struct MapSettings {
    MapSettings() = default;
    explicit MapSettings(const ShadowMapOptions& options);

    int size = 0;             ///< most texels on a side.
    int cascades = 0;         ///< as ShadowMapOptions::cascades.
    bool blends = false;      ///< a comparison is of 2 × 2 texels, else of one.
    double widestTexel = 1.0; ///< pixels on a side, where it is widest; fewer only with more texels than size.
    double sunRadius = 0.0, lampRadius = 0.0; ///< half the size of a light, see softReach(); 0 unless edges are SOFT.
    double blurRadius = 0.0;                  ///< as ShadowMapOptions::radius; the same.

    auto all() const { return std::tie(size, cascades, blends, widestTexel, sunRadius, lampRadius, blurRadius); }
    bool operator==(const MapSettings& other) const { return all() == other.all(); }
};

/// What the maps of one light are of.
struct MapRequest {
    glm::dvec4 light{0.0};        ///< in the scene about the casters' origin, see lightInScene().
    std::optional<SpotCone> cone; ///< of a lamp that is a spot: nothing outside it is marked.
    osg::ref_ptr<const MapCasters> casters;
    MapSettings settings;

    static constexpr double widestRatio = 64.0; ///< of a lamp's distances: by what is nearer, edges are as wide.

    /// See softReach().
    double lightRadius(const LightFrame& frame) const;
    /// True if edges are wider than the filter makes them.
    bool isWide(const LightFrame& frame) const;
    /// How far edges of what blocks the light are spread where it is as far as that from the light.
    double softness(const LightFrame& frame, MapOutline blocker, double farthest) const;
};

/// True if the light stands still but for what floats make of it. @param widest  of the drawables, which a lamp may be within.
bool isSameLight(const MapRequest& one, const MapRequest& other, double widest);

/// Boxes of what is seen in a view, the largest first.
std::vector<PlacedBox> receiversOf(const ViewFrame& view, const glm::dmat4& eyeFromScene);

} // namespace gnomon
