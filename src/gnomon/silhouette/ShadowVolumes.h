// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/silhouette/SilhouetteMesh.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon {

/// From the light to a place, of a lamp with its length; else of length 1.
inline glm::dvec3 awayFrom(const glm::dvec4& light, const glm::dvec3& place) {
    return light.w * place - glm::dvec3(light);
}

/// The volumes behind the parts of a mesh as seen from a light, ready to be drawn.
///
/// A vertex is a place and how far it goes on, away from the light, in lengths of awayFrom(): below 0 to infinity. Of the
/// surface that casts it is 0, or what terminatorOffset() says.
struct ShadowVolumes {
    /// Of one part: its sides. What closes them, see appendLightCap() and appendDarkCap().
    struct Part {
        unsigned first = 0, count = 0;     ///< in `corners`.
        unsigned firstEdge = 0, edges = 0; ///< in `outline`.
        bool grazed = false;               ///< a side lies in the plane of a face that the light grazes.
        unsigned mostOver = 0;             ///< not more of its volumes hold any one point.
        glm::dvec4 end{0.0};               ///< see nearestEnd().
    };
    /// An edge of the surface that casts, which is to its left as seen from the light.
    struct Outline {
        unsigned from, to;
    };

    glm::dvec4 light{0.0};
    /// How often each triangle casts: 1, -1 turned round, or 0. One more at the end is 0.
    std::vector<std::int8_t> weights;
    std::vector<glm::vec4> vertices;
    std::vector<unsigned> corners; ///< three a triangle, counter-clockwise from outside.
    std::vector<Outline> outline;
    std::vector<Part> parts; ///< as the mesh's.
};

/// @param light   in the mesh's frame; w is 0 and the direction has length 1, or w is 1.
/// @param planes  see endPlanes().
/// @param into    whose memory is used again.
///
/// Cost  a pass over the triangles and the edges, in parallel; the rest is linear in the outlines.
void findShadowVolumes(const SilhouetteMesh& mesh, const glm::dvec4& light, const std::vector<glm::dvec4>& planes,
                       ShadowVolumes& into);

/// Triangles that close the volumes of a part, counter-clockwise from outside, with vertices as ShadowVolumes has them.
struct VolumeCaps {
    std::vector<glm::vec4> vertices;
    std::vector<unsigned> corners;
};
/// The surface that casts.
void appendLightCap(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, VolumeCaps& into);
/// Those of its triangles that have moved: the light sees as much of them, but they are not in the surface that is seen.
void appendRim(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, VolumeCaps& into);
/// The end. A sun's that goes to infinity ends in a point.
void appendDarkCap(const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index, VolumeCaps& into);

/// Planes at which volumes may end: all that receives is on the side to which each unit normal points, with a margin.
///
/// @param low,high  bounds of all that receives; none if they are not finite.
std::vector<glm::dvec4> endPlanes(const glm::dvec3& low, const glm::dvec3& high);

/// The plane at which the volume of what is within a box is shortest; (0, 0, 0, 0) if it must not end.
/// @param light  w is 0 and the direction has length 1, or w is 1.
glm::dvec4 nearestEnd(const std::vector<glm::dvec4>& planes, const glm::dvec3& low, const glm::dvec3& high,
                      const glm::dvec4& light);

/// How far, in lengths of the way from the light, a place's volume goes to the plane; 0 beyond it. Of (0, 0, 0, 0) -1.
double lengthTo(const glm::dvec4& plane, const glm::dvec3& place, const glm::dvec4& light);

/// Where the lines of sight of a view begin, and what is cut off before its near plane.
struct SightStart {
    /// @param clipFromMesh  can be inverted.
    /// @param low,high      bounds of the mesh: the eye of an orthographic view is taken to be far beyond them.
    SightStart(const glm::dmat4& clipFromMesh, const glm::dvec3& low, const glm::dvec3& high);

    glm::dvec4 towardsEye;           ///< homogeneous, see eyeIn().
    glm::dvec3 eye;                  ///< in the mesh's frame.
    std::vector<glm::dvec3> cutAway; ///< corners of what is before the near plane.
};

/// How many volumes of a part the eye is in; nullopt if that is not certain, or does not suffice.
///
/// Lines of sight that begin outside all volumes, or in a known number of them, enter and leave volumes through their sides
/// alone, and through rims (z-pass, with depths clamped at the near plane). That holds if no caster is cut away before the near plane, and no
/// end is seen from below. Else the volumes must be closed, and are counted from behind (z-fail).
///
/// @param mayBeCut  something of the part's bounds is before the near plane.
///
/// Cost  a look at the part's bounds; of one between the light and the eye, or about the near plane, at its triangles.
std::optional<int> volumesHolding(const SightStart& start, const SilhouetteMesh& mesh, const ShadowVolumes& volumes,
                                  std::size_t index, bool mayBeCut);

/// Whether a surface of a part that casts, but for rims, can be seen from behind: the eye is on one side of it, the light on
/// the other.
/// Never of a closed part, unless the eye or a lamp may be inside.
/// @param mayBeCut  see volumesHolding().
bool mayShowBack(const SightStart& start, const SilhouetteMesh& mesh, const ShadowVolumes& volumes, std::size_t index,
                 bool mayBeCut);

} // namespace gnomon
