// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/RecentCache.h>
#include <gnomon/terrain/GroundRevision.h>
#include <gnomon/terrain/TileUpdates.h>

#include <OpenThreads/Mutex>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

class ShadowCasterGroup;
struct ViewFrame;

/// What one frame draws of one light.
struct TerrainFrame {
    TileUpdates::List tiles;
    TileUpdates::Bitmaps bitmaps;    ///< see TileUpdates::bitmapsIn().
    std::vector<std::string> causes; ///< why some are missing, or not of the method that was asked for.
    glm::dvec3 origin{0.0};          ///< that tiles are about, group frame.
    bool fromAbove = false;          ///< nothing of the ground that is turned away is seen.
};

/// All shadows of one light, to be asked for places.
struct TerrainAnswer : public osg::Referenced {
    osg::ref_ptr<const GroundRevision> drawn;
    TileUpdates::List tiles; ///< without meshes.
    glm::dvec3 origin{0.0};

    /// Whether a place is under one of the shadows in plan. @param place  group frame.
    bool covers(const glm::dvec2& place) const;

protected:
    ~TerrainAnswer() override = default;
};

/// The casters that a TerrainShadowGeode met, in tiles, and their shadows, so that nothing is found twice.
///
/// Threads any number; one at a time finds new ones.
class TerrainShadowCache {
public:
    /// @param casters  of the view's group, now.
    /// @param number   the light's.
    TerrainFrame frame(const ViewFrame& view, const CasterDrawables& casters, const TerrainPlace& place, int number,
                       const glm::dvec4& light, const TerrainSettings& settings);
    /// Of any light; what is drawn is not touched.
    osg::ref_ptr<const TerrainAnswer> answer(const ShadowCasterGroup& group, const CasterDrawables& casters,
                                             const TerrainPlace& place, const glm::dvec4& light,
                                             const TerrainSettings& settings);
    /// Drops what is of retired casters.
    void letGo();
    unsigned found() const; ///< how many tiles' shadows, so far.
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    struct Town {
        const ShadowCasterGroup* group; ///< to be told apart from others only.
        const void* stage;              ///< of the view that had it last; null for a query.
        osg::ref_ptr<const GroundRevision> drawn;
        CasterTiles casters;
        std::map<int, TileUpdates> lights;
    };
    Town* findTown(const ShadowCasterGroup& group, const CasterDrawables& casters, const void* stage, bool asBoxes);
    Town& townOf(const ShadowCasterGroup& group, const CasterDrawables& casters, const void* stage,
                 const TerrainPlace& place, bool asBoxes);
    static void addLimits(const ViewFrame& view, const Town& town, const TileUpdates& tiles,
                          std::vector<std::string>& causes);

    mutable OpenThreads::Mutex _mutex;
    RecentCache<std::unique_ptr<Town>> _towns;
    unsigned _found = 0; ///< By towns that are gone, too.
};

} // namespace gnomon
