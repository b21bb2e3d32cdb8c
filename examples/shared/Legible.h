// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Camera>

namespace gnomon::examples {

/// Keeps text what it is where osgviewer's keys turn the scene into a wire frame, or take its lights or textures away.
void keepLegible(osg::StateSet& set);

/// Puts a dark veil before all that is drawn so far and behind what `camera`, of osgViewer's help, draws.
void darkenBehind(osg::Camera& camera);

} // namespace gnomon::examples
