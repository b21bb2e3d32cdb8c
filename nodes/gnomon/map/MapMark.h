// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/map/MapLookupPass.h>

namespace gnomon {

/// Draws over a picture how a light's maps lie; of texels and cascades those of the first light alone.
/// @param before  how many lights have been drawn.
void drawMapView(const MapLookupPass& quad, ShadowMapOptions::View view, osg::RenderInfo& renderInfo, ScreenPass& pass,
                 int before);

constexpr double allOfIt = 511.0 / 512.0; // of a light: less than that is a step of eight bits

/// Marks of one light in one view: where the light's maps hold something nearer to it than what is seen.
template <class Job>
class MapMarkOf : public Job {
public:
    MapLookupPass quad;
    ShadowMapOptions::View view = ShadowMapOptions::NOTHING;

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override {
        return markBelow(0.5, renderInfo, pass, bit);
    }
    bool canDarken() const override { return true; }
    std::string darken(osg::RenderInfo& renderInfo, ScreenPass& pass, float factor) const override {
        pass.beginMultiplyByColor();
        return quad.draw(renderInfo, pass, {quad.fades() ? allOfIt : 0.5, false, factor});
    }
    bool hasView() const override { return view != ShadowMapOptions::NOTHING; }
    void drawView(osg::RenderInfo& renderInfo, ScreenPass& pass, int before) const override {
        drawMapView(quad, view, renderInfo, pass, before);
    }

protected:
    ~MapMarkOf() override = default;

    std::string markBelow(double share, osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
        pass.stencilEqual(bit, 0, bit);
        return quad.draw(renderInfo, pass, {share, false, 1.0});
    }
};

using MapMark = MapMarkOf<MarkJob>;

/// The same with edges that fade.
class SoftMapMark : public MapMarkOf<SoftMarkJob> {
public:
    std::string markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    std::string drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const override;

protected:
    ~SoftMapMark() override = default;
};

/// Marks of one spot in one view: what of all that is seen is not in its cone.
class SpotMark : public MarkJob {
public:
    osg::ref_ptr<MapPrograms> resources;
    glm::dmat4 clipFromScene{1.0}; ///< as drawn.
    glm::dmat4 coneFromScene{1.0}; ///< see gnomon::coneFromScene().

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    bool relightsOnly() const override { return true; }

protected:
    ~SpotMark() override = default;
};

/// A light's maps, as programs of a view's drawables find them: see visibility.glsl.
class ProgramMaps : public ProgramVisibilityJob {
public:
    /// Of no maps: all of the light arrives. @param unit  of textures.
    explicit ProgramMaps(unsigned unit);
    ProgramMaps(const MapLookupPass& quad, const glm::dmat4& sceneFromEye, unsigned unit);

    std::string drawAhead(osg::RenderInfo& renderInfo) const override;

protected:
    ~ProgramMaps() override = default;

private:
    std::optional<MapLookupPass> _quad;
};

/// The function that looks them up: GLSL 1.30.
/// @param filter  defines of map_filter.frag.
std::string visibilityFunction(const std::string& filter);

} // namespace gnomon
