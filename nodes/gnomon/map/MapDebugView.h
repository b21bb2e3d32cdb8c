// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowMapOptions.h>
#include <gnomon/map/MapLookupPass.h>

namespace gnomon {

/// Draws over a picture how a light's maps lie; of texels and cascades those of the first light alone.
/// @param before  how many lights have been drawn.
void drawMapView(const MapLookupPass& quad, ShadowMapOptions::View view, osg::RenderInfo& renderInfo, ScreenPass& pass,
                 int before);

} // namespace gnomon
