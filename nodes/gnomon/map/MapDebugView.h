// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/map/MapLookupPass.h>

namespace gnomon {

/// What is drawn over a picture to show how a light's maps lie: see ShadowMapTechnique::View.
enum class MapDebugView { Nothing, Map, Texels, Cascades };

/// Draws it; of texels and cascades those of the first light alone.
/// @param before  how many lights have been drawn.
void drawMapView(const MapLookupPass& quad, MapDebugView view, osg::RenderInfo& renderInfo, ScreenPass& pass,
                 int before);

} // namespace gnomon
