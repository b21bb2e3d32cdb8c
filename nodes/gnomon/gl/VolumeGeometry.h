// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/TriangleClusters.h>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <osg/Geometry>
#include <osg/RenderInfo>

#include <vector>

namespace gnomon {

/// Makes ready what draws volumes: the program of shaderProgram("#define EXTRUDE\n"), which was applied before. Ends with
/// glFrontFace(GL_CCW).
/// @param light  in the frame of the vertices, homogeneous.
void placeVolumes(const osg::State& state, const glm::dmat4& clipFromVertices, const glm::dvec4& light);

/// Triangles of shadow volumes in buffers of their own: vertices as ShadowVolumes has them.
class VolumeGeometry : public osg::Referenced {
public:
    VolumeGeometry();
    /// In place of those before, in the same buffers. Not while they are drawn.
    void set(const std::vector<glm::vec4>& vertices, const std::vector<unsigned>& corners);

    /// Corners one after the other.
    struct Range {
        unsigned first, count;
    };
    void draw(osg::RenderInfo& renderInfo, const std::vector<Range>& ranges) const;
    void drawAll(osg::RenderInfo& renderInfo) const;
    void resizeGLObjectBuffers(unsigned maxSize) { _geometry->resizeGLObjectBuffers(maxSize); }
    void releaseGLObjects(osg::State* state) const { _geometry->releaseGLObjects(state); }

protected:
    ~VolumeGeometry() override = default;

private:
    const osg::ref_ptr<osg::Geometry> _geometry;
    const osg::ref_ptr<osg::Vec4Array> _vertices;
    const osg::ref_ptr<osg::DrawElementsUInt> _corners;
};

} // namespace gnomon
