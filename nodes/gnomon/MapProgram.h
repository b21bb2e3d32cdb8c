// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MapQuad.h>
#include <gnomon/ProgramJob.h>

namespace gnomon {

/// A light's maps, as programs of a view's drawables find them: see visibility.glsl.
class MapProgram : public ProgramJob {
public:
    /// Of no maps: all of the light arrives. @param unit  of textures.
    explicit MapProgram(unsigned unit);
    MapProgram(const MapQuad& quad, const glm::dmat4& sceneFromEye, unsigned unit);

    std::string drawAhead(osg::RenderInfo& renderInfo) const override;

protected:
    ~MapProgram() override = default;

private:
    std::optional<MapQuad> _quad;
};

/// The function that looks them up: GLSL 1.30.
/// @param filter  defines of map_filter.frag.
std::string visibilityFunction(const std::string& filter);

} // namespace gnomon
