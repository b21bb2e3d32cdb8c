// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MarkJob.h>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <osg/Geometry>
#include <osg/StateSet>

#include <vector>

namespace gnomon {

struct ShadowPrisms;

/// Prisms over shadows on the ground, ready to be drawn: a geometry a layer. Never changed once made.
struct TerrainPrisms : public osg::Referenced {
    explicit TerrainPrisms(const ShadowPrisms& prisms);
    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;
    std::vector<osg::ref_ptr<osg::Geometry>> layers;
    glm::dvec3 low, high; ///< bounds, about the casters' origin.
};

/// Marks of one light in one view: all that stands in a prism. What of that is ground is for the compositor to tell, which
/// cuts the marks to the receiver.
class TerrainMark : public MarkJob {
public:
    osg::ref_ptr<const TerrainPrisms> prisms;
    osg::ref_ptr<const osg::StateSet> program; ///< see markProgram().
    glm::dmat4 clipFromPrisms{1.0};

    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;
    bool counts() const override { return true; }

protected:
    ~TerrainMark() override = default;
};

} // namespace gnomon
