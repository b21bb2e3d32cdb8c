// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/planar/PlanarParts.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>
#include <functional>
#include <vector>

namespace gnomon {

/// The casters that reach above one plane, ready to be drawn flattened: made once a revision and plane, never changed.
/// Triangles in the plane are left out, and those under it unless asked for.
class PlanarCasters : public osg::Referenced {
public:
    /// Makes or finds the parts of a mesh above a plane of the scene.
    using Source = std::function<osg::ref_ptr<const PlanarParts>(const PlacedMesh& placed, const glm::dvec4& plane)>;

    /// @param groupPlane  unit normal, group frame.
    /// @param under       keep what lies under the plane, too.
    PlanarCasters(const CasterLayers& layers, const glm::dvec4& groupPlane, bool under, const Source& source);

    bool madeFrom(const CasterLayers& layers, const glm::dvec4& groupPlane, bool under) const {
        return _layers == layers.retired() && isOf(groupPlane, under);
    }
    bool isOf(const glm::dvec4& groupPlane, bool under) const { return _groupPlane == groupPlane && _under == under; }
    /// True if no view will ask for these any more.
    bool isRetired() const { return *_layers; }
    /// True if in another frame than that of their making solids are to be looked for.
    bool seeksSolids(unsigned frame) const;
    /// Of a mesh where it is; null if it is none of these.
    osg::ref_ptr<const PlanarParts> find(const PlacedMesh& placed) const;
    /// The same, if it is at this place among the layers' meshes.
    osg::ref_ptr<const PlanarParts> at(std::size_t place, const PlacedMesh& placed) const;
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

    std::vector<PlanarPart> parts;
    glm::dvec4 plane;     ///< in the scene.
    glm::dvec3 low, high; ///< bounds of all parts, in the scene.
    bool crosses = false; ///< some part crosses the plane.
    double highest = 0.0; ///< greatest height above the plane.

protected:
    ~PlanarCasters() override = default;

private:
    void add(const PlanarParts& more);

    CasterLayers::Retired _layers;
    glm::dvec4 _groupPlane;
    bool _under;
    std::vector<osg::ref_ptr<const PlanarParts>> _meshes; ///< in the order of the layers.
};

} // namespace gnomon
