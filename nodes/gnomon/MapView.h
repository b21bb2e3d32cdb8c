// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MapQuad.h>

namespace gnomon {

/// What is drawn over a picture to show how a light's maps lie: see ShadowMapTechnique::View.
enum class MapView { Nothing, Map, Texels, Cascades };

/// Draws it; of texels and cascades those of the first light alone.
/// @param before  how many lights have been drawn.
void drawMapView(const MapQuad& quad, MapView view, osg::RenderInfo& renderInfo, ScreenPass& pass, int before);

} // namespace gnomon
