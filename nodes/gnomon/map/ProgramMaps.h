// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/ProgramVisibilityJob.h>
#include <gnomon/map/MapLookupPass.h>

namespace gnomon {

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
