// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/RecentCache.h>
#include <gnomon/terrain/GroundRevision.h>
#include <gnomon/terrain/HullTiles.h>

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
    HullTiles::List tiles;
    std::vector<std::string> causes; ///< why some are missing, or not the caster's own.
    glm::dvec3 origin{0.0};          ///< that tiles are about, group frame.
    bool fromAbove = false;          ///< no line of sight to the ground comes out of the ground.
};

/// All shadows of one light, to be asked for places.
struct TerrainAnswer : public osg::Referenced {
    osg::ref_ptr<const GroundRevision> drawn;
    std::vector<HullSolids> tiles;

    /// Whether a place of the ground is in one of the shadows. @param place  group frame.
    bool holds(const glm::dvec3& place) const;

protected:
    ~TerrainAnswer() override = default;
};

/// One of the lights of a view.
struct GroundLight {
    int number;
    glm::dvec4 place; ///< ground's frame: w = 0 the way towards a sun of length 1, w = 1 a lamp's place.
};

/// The casters that a TerrainShadowGeode met, in tiles, and their shadows, so that nothing is found twice.
///
/// Threads any number; one at a time finds new ones.
class TerrainShadowCache {
public:
    /// @param casters  of the view's group, now.
    TerrainFrame frame(const ViewFrame& view, const Casters& casters, const Selection& terrain,
                       const GroundLight& light, bool asBoxes);
    /// Of any light; what is drawn is not touched.
    osg::ref_ptr<const TerrainAnswer> answer(const ShadowCasterGroup& group, const Casters& casters,
                                             const Selection& terrain, const glm::dvec4& light, bool asBoxes);
    /// Drops what is of retired casters.
    void letGo();
    unsigned found() const; ///< how many tiles' shadows, so far.
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    /// Who asks: a view, or a query, whose key names none.
    struct Asker {
        const ShadowCasterGroup& group;
        ViewKey view;
        bool asBoxes;
        bool isLoose; ///< the ground may be drawn beside its place.
    };
    struct Town {
        Town(const ShadowCasterGroup& of, bool asBoxes) : group(&of), casters(asBoxes) {}
        const ShadowCasterGroup* group; ///< to be told apart from others only.
        ViewKey view;                   ///< that had it last.
        osg::ref_ptr<const GroundRevision> drawn;
        std::unique_ptr<const HullGround> ground; ///< of `drawn`.
        CasterTiles casters;
        std::map<int, HullTiles> lights;
    };
    Town* findTown(const ShadowCasterGroup& group, const Casters& casters, const ViewKey& view, bool asBoxes);
    Town& townOf(const Asker& asker, const Casters& casters, const Selection& terrain);

    mutable OpenThreads::Mutex _mutex;
    RecentCache<std::unique_ptr<Town>> _towns;
    unsigned _found = 0; ///< By towns that are gone, too.
};

} // namespace gnomon
