// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MapQuad.h>
#include <gnomon/SoftMarkJob.h>

namespace gnomon {

/// Marks of one light in one view: where the light's maps hold something nearer to it than what is seen.
class MapMark : public MarkJob {
public:
    MapQuad quad;

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;

protected:
    ~MapMark() override = default;
};

/// The same with soft edges.
class SoftMapMark : public SoftMarkJob {
public:
    MapQuad quad;

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    std::string markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    std::string drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const override;

protected:
    ~SoftMapMark() override = default;
};

} // namespace gnomon
