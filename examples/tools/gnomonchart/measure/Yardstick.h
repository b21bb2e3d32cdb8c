// SPDX-License-Identifier: MIT
#pragma once
#include "../scenes/ChartScene.h"
#include "ChartResults.h"
#include "SceneTruth.h"
#include "StageViewer.h"

#include <metrics/ShadowMetrics.h>

namespace gnomon::examples {

/// What a renderer shows that asks one ray a pixel. @param lit  what these say, as TruthMaps::litCentre has it.
metrics::Visibility raysOf(const metrics::Mask& lit);

/// What is true of one scene: all that its contenders are measured against, made once.
///
/// Cost    34 rays a pixel, as many again for a round body, and 256 more with the disc.
class Yardstick {
public:
    /// @param withDisc  the truth of the sun's disc too; a lamp has none.
    /// @param seen      what rays see; null: the scene's content, without glass and where it blends with an alpha below a half.
    /// @throws see SceneTruth.
    Yardstick(const ChartScene& scene, bool withDisc, osg::Node* seen = nullptr);

    const ChartScene& scene() const { return _scene; }
    const SceneTruth& truth() const { return _truth; }
    const metrics::TruthMaps& maps() const { return _maps; }
    /// Two pictures without shadows, with the light and without, mixed by the lit share of each pixel. Drawn when first
    /// asked for.
    const ShadedPicture& shaded() const;
    /// R, see metrics::PixelSets.
    const metrics::Mask& agreeing() const { return _agreeing; }
    /// Contact reaches to a hundredth of the scene's radius.
    metrics::CauseLimits limits() const;
    /// Name, title, triangles, floors and view; the rest is left as it is.
    void describe(ChartSceneResult& into) const;

private:
    const ChartScene _scene;
    SceneTruth _truth;
    metrics::TruthMaps _maps;
    metrics::Mask _agreeing;
    mutable ShadedPicture _shaded;
};

} // namespace gnomon::examples
