// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Mark.h>
#include <gnomon/ScreenPass.h>
#include <gnomon/gl/FrameDepths.h>

#include <osg/Referenced>
#include <osg/StateSet>

#include <memory>
#include <string>

namespace gnomon {

/// Finds what share of a pixel the light reaches where marks end.
///
/// A side of a volume and the surface that is seen are planes on the screen, the one by its own depths, the other by those of the
/// frame. Where they meet the shadow ends, if the pixel beyond is of the same surface and marked otherwise. So it does at a line of
/// what is drawn flat. Elsewhere, as between two volumes or at the edge of what is seen, all of the pixel is as its middle.
///
/// Cost     a fragment a pixel to find where marks end, and one to use it; the sides or lines once more, of which only pixels where
///          marks end are shaded.
/// Limits   what is narrower than a pixel, and holds no pixel's middle, is not there. Near a corner a share may be off by a tenth.
/// Threads  one a context.
class MarkEdges : public osg::Referenced {
public:
    enum class Of {
        Sides, ///< of volumes, as placeVolumes() has them.
        Lines  ///< about triangles, as shaderProgram() has them with "#define CLIP\n".
    };
    explicit MarkEdges(Of of);

    /// In a framebuffer whose colour, alpha and stencil are all 0: draws where edges cut pixels, as cuts.frag has it.
    /// @param marks  a texture, texel on pixel: alpha is 0 where the mark is.
    /// @return a cause, as Mark::draw().
    std::string find(ScreenPass& pass, const Mark& mark, unsigned marks) const;
    /// Draws the share that arrives as alpha, where that is not all of the light. @param cuts  found before, a texture.
    std::string draw(ScreenPass& pass, unsigned marks, unsigned cuts) const;

    void resizeGLObjectBuffers(unsigned maxSize);
    void releaseGLObjects(osg::State* state) const;

protected:
    ~MarkEdges() override = default;

private:
    const Of _of;
    const osg::ref_ptr<osg::StateSet> _ends, _cuts, _shares;
    const std::shared_ptr<FrameDepths> _seen = FrameDepths::shared();
};

} // namespace gnomon
