// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/SoftMarkJob.h>
#include <gnomon/map/MapDebugView.h>

namespace gnomon {

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

} // namespace gnomon
