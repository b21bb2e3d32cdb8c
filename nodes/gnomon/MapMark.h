// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MapView.h>
#include <gnomon/SoftMarkJob.h>

namespace gnomon {

/// Marks of one light in one view: where the light's maps hold something nearer to it than what is seen.
template <class Job>
class MapMarkOf : public Job {
public:
    MapQuad quad;
    MapView view = MapView::Nothing;

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override {
        return markBelow(0.5, renderInfo, pass, bit);
    }
    bool hasView() const override { return view != MapView::Nothing; }
    void drawView(osg::RenderInfo& renderInfo, ScreenPass& pass, int before) const override {
        drawMapView(quad, view, renderInfo, pass, before);
    }

protected:
    ~MapMarkOf() override = default;

    std::string markBelow(double share, osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
        pass.stencilEqual(bit, 0, bit);
        return quad.draw(renderInfo, pass, share);
    }
};

using MapMark = MapMarkOf<MarkJob>;

/// The same with soft edges.
class SoftMapMark : public MapMarkOf<SoftMarkJob> {
public:
    std::string markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    std::string drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const override;

protected:
    ~SoftMapMark() override = default;
};

} // namespace gnomon
