// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>
#include <gnomon/volume/LightVolumes.h>

#include <glm/mat4x4.hpp>

#include <map>
#include <optional>
#include <vector>

namespace gnomon {

/// The volumes of one mesh in one view.
struct MeshInView {
    osg::ref_ptr<const LightVolumes> volumes;
    glm::dmat4 clipFromMesh{1.0};
    osg::ref_ptr<const VolumeGeometry> caps; ///< null: none are needed.
};

/// A part whose volume can be seen.
struct SeenPart {
    std::size_t mesh; ///< among those in view.
    unsigned part;
    std::optional<int> holding; ///< see volumesHolding().
    bool showsBack;             ///< see mayShowBack().
    CapRanges caps;             ///< without `holding`; of what shows its back, the surface that casts in any case.
};

/// Volumes that are counted together: not more of them hold any one point than a counter can count.
struct VolumeRound {
    /// Sides, those of parts apart that have one in the plane of a face that the light grazes.
    struct Sides {
        std::vector<VolumeGeometry::Range> usual, grazed;
    };
    /// Of one mesh: sides to count from the eye, and from behind; for those light caps, others that may be seen from either
    /// side, and dark caps; and of what is counted from the eye surfaces that cast, which do not count where they are seen
    /// from behind.
    struct Share {
        Sides entered, left;
        std::vector<VolumeGeometry::Range> lightCaps, bothCaps, darkCaps, backs;
    };
    std::map<std::size_t, Share> shares; ///< by mesh.
    int holding = 0;                     ///< those counted from the eye that the eye is in.
};

/// What a view needs of the volumes of one light.
struct SeenVolumes {
    std::vector<MeshInView> meshes;
    std::vector<SeenPart> parts;
    ScreenRect bounds{}; ///< where they can be seen.

    /// @param capacity  what a counter can count to, 1 or more.
    std::vector<VolumeRound> rounds(unsigned capacity) const;
    /// How long the longest step of a vertex's floats is where it is seen at its nearest, in pixels.
    /// @param width  of the viewport, pixels. @param near  least w of what is seen.
    double vertexStep(double width, double near) const;
    /// True if a counter may pass its range.
    bool overflow(unsigned capacity) const;
};

/// @return nullopt if none can be seen.
std::optional<SeenVolumes> seenVolumes(const std::vector<osg::ref_ptr<LightVolumes>>& all,
                                       const glm::dmat4& clipFromScene);

} // namespace gnomon
