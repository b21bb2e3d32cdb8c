// SPDX-License-Identifier: MIT
#pragma once
#include <osg/State>

namespace gnomon {

/// Along which diagonal the driver cuts GL_QUADS. OpenGL leaves it open, and a quad that is not flat shows it: NVIDIA's (580)
/// cuts from the first corner to the third, and Mesa's from the second to the fourth, in lists and by indices.
/// Both cut those of a strip from the first corner to the fourth. A process has one driver.
bool cutsQuadsFromFirst();

/// Finds it out by a bent quad, once a context, which is current. Leaves OpenGL as it is.
void findQuadCut(osg::State& state);

} // namespace gnomon
