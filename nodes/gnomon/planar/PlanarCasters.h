// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/RecentCache.h>
#include <gnomon/casters/CasterMesh.h>
#include <gnomon/casters/Casters.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <osg/Geometry>
#include <osg/Referenced>

#include <cstddef>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// A surface lies in a plane if it is level and no farther from it than this share of its drawable's radius, half the diagonal
/// of its box: a millimetre of a floor of 16 m. It receives, and so does not cast. One measure for both, and for all units.
constexpr double flatness = 1e-4;

/// Triangles that are drawn alike, flattened.
struct PlanarPart {
    osg::ref_ptr<osg::Geometry> geometry;
    bool crossing;                 ///< they cross the plane and must be cut there; else they are wholly above it.
    bool solid;                    ///< they bound solids: those turned away from the light need not be drawn.
    glm::dmat4 sceneFromMesh{1.0}; ///< see PlacedMesh.
    bool mirrored = false;         ///< the same.
    double thickness = 0.0;        ///< height up to which vertices of what crosses the plane count as lying in it.
};

/// A mesh as it is drawn wherever it is, in one or two parts. Never changed.
struct PlanarMesh : public osg::Referenced {
    /// @param findSolids  look for solids (closedParts()): takes longer than all the rest, and halves the drawing.
    PlanarMesh(const CasterMesh& mesh, bool findSolids, unsigned frame);

    const osg::ref_ptr<const CasterMesh> mesh;
    const bool knowsSolids;
    const unsigned firstFrame;     ///< in which it was made.
    std::vector<PlanarPart> parts; ///< in the mesh's frame.

protected:
    ~PlanarMesh() override = default;
};

/// What of a mesh is above one plane, without the triangles in the plane. Never changed.
struct PlanarParts : public osg::Referenced {
    /// Each triangle for itself. @param plane  unit normal, scene.
    PlanarParts(const PlacedMesh& placed, const glm::dvec4& plane, bool findSolids, unsigned frame);
    /// As a whole, cut by the plane if a triangle reaches below it or lies in it.
    PlanarParts(const PlacedMesh& placed, const glm::dvec4& plane, const glm::dvec3& low, const glm::dvec3& high,
                const PlanarMesh& whole);

    bool madeFrom(const PlacedMesh& placed) const {
        return mesh == placed.mesh && sceneFromMesh == placed.sceneFromMesh;
    }

    const osg::ref_ptr<const CasterMesh> mesh;
    const glm::dmat4 sceneFromMesh;
    osg::ref_ptr<const PlanarMesh> whole; ///< null if each triangle was looked at.
    bool knowsSolids;
    unsigned firstFrame; ///< in which its triangles were looked at.
    std::vector<PlanarPart> parts;
    glm::dvec3 low, high;  ///< bounds of all parts, in the scene.
    double highest = 0.0;  ///< greatest height above the plane.
    glm::dvec2 lying{0.0}; ///< least and greatest height of what lies in the plane by flatness.

protected:
    ~PlanarParts() override = default;
};

/// The casters that reach above one plane, ready to be drawn flattened: made once a revision and plane, never changed.
/// Triangles in the plane and under it are left out.
class PlanarCasters : public osg::Referenced {
public:
    /// Of no mesh yet.
    /// @param groupPlane  unit normal, group frame.
    PlanarCasters(const Casters& casters, const glm::dvec4& groupPlane);
    /// The next one of the layers' meshes.
    void add(const osg::ref_ptr<const PlanarParts>& more);

    bool madeFrom(const Casters& casters, const glm::dvec4& groupPlane) const {
        return _source == casters.retired() && isOf(groupPlane);
    }
    bool isOf(const glm::dvec4& groupPlane) const { return _groupPlane == groupPlane; }
    /// True if no view will ask for these any more.
    bool isRetired() const { return *_source; }
    /// True if in another frame than that of their making solids are to be looked for.
    bool seeksSolids(unsigned frame) const;
    /// Of a mesh where it is; null if it is none of these.
    osg::ref_ptr<const PlanarParts> find(const PlacedMesh& placed) const;
    /// The same, if it is at this place among the layers' meshes.
    osg::ref_ptr<const PlanarParts> at(std::size_t place, const PlacedMesh& placed) const;
    std::size_t size() const { return _meshes.size(); } ///< meshes.
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

    std::vector<PlanarPart> parts;
    osg::Vec3d origin;     ///< of the scene, group frame.
    glm::dvec4 plane;      ///< in the scene.
    glm::dvec3 low, high;  ///< bounds of all parts, in the scene.
    bool crosses = false;  ///< some part crosses the plane.
    double highest = 0.0;  ///< greatest height above the plane.
    glm::dvec2 lying{0.0}; ///< least and greatest height of what lies in the plane by flatness.

protected:
    ~PlanarCasters() override = default;

private:
    Casters::Retired _source;
    glm::dvec4 _groupPlane;
    std::vector<osg::ref_ptr<const PlanarParts>> _meshes; ///< in the order of the layers.
};

/// The casters above the planes of a PlanarShadowNode, so that no view and no light makes them again, nor what of them has
/// not changed.
///
/// Threads
/// - Any number.
class PlanarCasterCache {
public:
    /// The casters above a plane. It searches for solids in those meshes that were asked for in an earlier frame.
    /// @param groupPlane  see PlanarCasters.
    /// @param frame       the frame that asks.
    /// @param most        how many it keeps.
    osg::ref_ptr<PlanarCasters> of(const Casters& casters, const glm::dvec4& groupPlane, unsigned frame,
                                   std::size_t most);
    /// Drops those that no view will ask for.
    void letGo();
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

private:
    void dropUnused();
    osg::ref_ptr<PlanarCasters> make(const Casters& casters, const glm::dvec4& groupPlane, unsigned frame);
    osg::ref_ptr<const PlanarMesh> wholeOf(const CasterMesh& mesh, unsigned frame);

    mutable OpenThreads::Mutex _mutex;
    RecentCache<osg::ref_ptr<PlanarCasters>> _entries;
    std::unordered_map<const CasterMesh*, osg::ref_ptr<const PlanarMesh>> _wholes; ///< of bodies, which these hold.
};

} // namespace gnomon
