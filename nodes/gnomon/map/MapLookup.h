// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ScreenPass.h>
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/gl/FrameCopies.h>
#include <gnomon/map/DepthMap.h>

#include <glm/mat4x4.hpp>
#include <osg/RenderInfo>

#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Marks of one light in one view: where less of it arrives than the pass wants, by what the depth buffer says is seen there, and
/// the light's maps.
class MapLookup : public Mark {
public:
    osg::ref_ptr<MapPrograms> programs;
    osg::ref_ptr<DepthMap> map;
    osg::ref_ptr<const MapPicture> picture;
    ShadowMapOptions settings;
    std::vector<glm::dvec2> outline;         ///< of where less than all of the light can arrive: see drawPolygon().
    glm::dmat4 clipFromScene{1.0};           ///< as drawn; the scene is about the casters' origin.
    glm::dvec2 pushedBack{0.0};              ///< see ViewFrame.
    double rounding = 0.0;                   ///< of the vertices that are drawn, see DrawnError.
    std::optional<glm::dmat4> coneFromScene; ///< of a spot: what is not in its cone gets no fragments.

    Kind kind() const override { return isSoft() || isSmooth() ? Kind::Fades : Kind::Hard; }
    /// Draws the map first, if that is due.
    std::string draw(ScreenPass& pass) const override;
    bool canDarken() const override { return true; }
    bool hasView() const override { return settings.view != ShadowMapOptions::NOTHING; }
    /// How the maps lie; of texels and cascades those of the first light alone.
    void drawView(ScreenPass& pass, int before) const override;
    /// Makes the map show its picture, unless it does. @return as draw().
    std::string showMap(osg::RenderInfo& renderInfo) const { return map->show(renderInfo, *picture, *programs); }

protected:
    ~MapLookup() override = default;

private:
    /// True if edges are wider than the filter, see MapSpread.
    bool isSoft() const { return settings.edges == ShadowMapOptions::SOFT; }
    /// True if they are a pixel wide.
    bool isSmooth() const {
        return settings.edges == ShadowMapOptions::SMOOTH && settings.filter != ShadowMapOptions::NEAREST;
    }
    std::string mapDefines() const;
    void setConstants(osg::State& state, const FrameDepthCopy::Copy& copy, const glm::dvec4& wanted,
                      const PixelRect& pixels) const;
    glm::dvec4 wantedBy(const ScreenPass& pass) const;
    glm::dvec4 drawnErrorOf(const osg::State& state, const glm::dmat4& sceneFromPixel) const;
    void drawPicture(osg::State& state, ScreenPass& pass, int before) const;
};

/// Marks of one spot in one view: what of all that is seen is not in its cone.
osg::ref_ptr<Mark> spotMark(const MapLookup& lookup);
/// A light's maps, as programs of a view's drawables find them: see visibility.glsl. Without maps all of the light arrives.
osg::ref_ptr<Mark> programMaps(const MapLookup& lookup, const glm::dmat4& sceneFromEye);

/// The function that looks them up: GLSL 1.30.
std::string visibilityFunction(ShadowMapOptions::Filter filter);

} // namespace gnomon
