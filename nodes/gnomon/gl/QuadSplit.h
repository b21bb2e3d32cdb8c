// SPDX-License-Identifier: MIT
#pragma once
#include <osg/State>

namespace gnomon {

/// Along which diagonal a driver cuts quads into triangles. OpenGL leaves it open, and a quad that is not flat shows it.
/// The defaults are what most drivers do: the last vertex is in both triangles.
///
/// Mesa's llvmpipe cuts quads of glDrawArrays() from the first vertex to the third if all that is drawn with them is in
/// view, else from the second to the fourth; from indices and from display lists always the latter.
struct QuadSplit {
    bool secondToFourth = true;       ///< GL_QUADS from indices and display lists; else from the first to the third.
    bool arraysSecondToFourth = true; ///< The same of arrays, where all is in view.
    bool stripSecondToThird =
        false;         ///< GL_QUAD_STRIP, in the order of its vertices; else from the first to the fourth.
    bool lists = true; ///< OpenSceneGraph draws from display lists in this context.
};

/// The split of the driver of a context that is current. Found once a context by the depth of bent quads.
/// Leaves OpenGL and the osg::State as they are. Without framebuffer objects it gives the defaults.
QuadSplit foundQuadSplit(osg::State& state);
/// The same where the context is not current, for example in a cull beside the draw thread. Gives the defaults until
/// foundQuadSplit() has been called for the context.
QuadSplit knownQuadSplit(const osg::State& state);

} // namespace gnomon
