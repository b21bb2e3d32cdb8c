// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/FrameDepths.h>
#include <gnomon/map/DepthMap.h>
#include <gnomon/map/MapPrograms.h>

#include <glm/mat4x4.hpp>
#include <osg/RenderInfo>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// How marks of maps find places in a view.
struct LookupPlaces {
    glm::dmat4 clipFromScene{1.0};           ///< as drawn; the scene is about the casters' origin.
    std::optional<glm::dmat4> coneFromScene; ///< of a spot: what is not in its cone gets no marks.
    glm::dvec2 pushedBack{0.0};              ///< see ViewFrame.
    double rounding = 0.0;                   ///< of the vertices that are drawn, see DrawnError.
};

/// A light's maps, and where less than all of the light can arrive in the view that they are for.
struct MapsInView {
    osg::ref_ptr<MapPrograms> programs;
    osg::ref_ptr<DepthMap> map;
    osg::ref_ptr<const MapPicture> picture;
    std::vector<glm::dvec2> outline; ///< see drawPolygon().
    ScreenRect bounds;

    /// Makes the map show its picture, unless it does. @return as Mark::draw().
    std::string show(osg::RenderInfo& renderInfo) const { return map->show(renderInfo, *picture, *programs); }
};

/// Marks of one light in one view: where less of it arrives than the pass wants, by what the depth buffer says is seen there, and
/// the light's maps.
class MapLookup : public Mark {
public:
    MapLookup(const ShadowMapOptions& options, const LookupPlaces& places, const MapsInView& maps);

    Kind kind() const override { return _options.fades() ? Kind::Fades : Kind::Hard; }
    /// Draws the map first, if that is due.
    std::string draw(ScreenPass& pass) const override;
    /// How the maps lie; of texels and cascades those of the first light alone.
    void drawDebugView(ScreenPass& pass, int before) const override;

protected:
    ~MapLookup() override = default;

private:
    MapUse use(bool shows) const;
    MapConstants constantsOf(const osg::State& state, const FrameDepths::Copy& copy, const glm::dvec4& wanted,
                             const PixelRect& pixels) const;
    glm::dvec4 drawnErrorOf(const osg::State& state, const glm::dmat4& sceneFromPixel) const;
    void drawPicture(osg::State& state, ScreenPass& pass, int before) const;

    const ShadowMapOptions _options;
    const LookupPlaces _places;
    const MapsInView _maps;
};

/// Marks of one spot in one view: what of all that is seen is not in its cone.
osg::ref_ptr<Mark> spotMark(const osg::ref_ptr<MapPrograms>& programs, const LookupPlaces& places);

/// A light's maps, as programs of a view's drawables find them: see visibility.glsl.
/// @param maps  none: all of the light arrives.
osg::ref_ptr<Mark> programMaps(int textureUnit, const std::optional<MapsInView>& maps, const glm::dmat4& sceneFromEye);

} // namespace gnomon
