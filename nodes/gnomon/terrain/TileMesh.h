// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/overlay/ShadowDecals.h>

#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/RenderInfo>

#include <vector>

namespace gnomon {

struct ShadowPrisms;

/// Prisms over shadows on the ground, or decals on it, ready to be drawn.
class TileMesh : public osg::Referenced {
public:
    TileMesh();
    /// In place of those before, in the same buffers. Not while they are drawn.
    void set(const ShadowPrisms& prisms);
    void set(const ShadowDecals& decals); ///< as a layer.

    unsigned triangles() const { return _ends.empty() ? 0 : _ends.back() / 3; }
    unsigned layers() const { return static_cast<unsigned>(_ends.size()); }
    void draw(osg::RenderInfo& renderInfo, unsigned firstLayer, unsigned count) const;
    void resizeGLObjectBuffers(unsigned maxSize) { _geometry->resizeGLObjectBuffers(maxSize); }
    void releaseGLObjects(osg::State* state) const { _geometry->releaseGLObjects(state); }

    glm::dvec3 low{0.0}, high{0.0}; ///< bounds, about the casters' origin.
    unsigned mostOver = 0;          ///< see ShadowPrisms.

protected:
    ~TileMesh() override = default;

private:
    template <typename Shadows, typename Append>
    void setFrom(const Shadows& of, Append append);
    osg::Vec3Array& vertices();
    osg::DrawElementsUInt& corners();
    osg::ref_ptr<osg::Geometry> _geometry;
    std::vector<unsigned> _ends; ///< of each layer among the corners.
};

} // namespace gnomon
