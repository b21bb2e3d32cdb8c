// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoView.h>
#include <gnomon/auto/ConvexBodies.h>

#include <osg/Vec4d>

#include <string>
#include <vector>

namespace gnomon {

/// The planes on which all of a light's shadow in a view falls, or why it does not all fall on planes.
struct FlatReceivers {
    std::vector<osg::Vec4d>
        planes;           ///< group frame, normals to the light's side; only those that something stands above.
    LeafSet leaves;       ///< that lie in planes, those above which nothing stands among them.
    std::string obstacle; ///< empty: a PlanarShadowNode of these planes draws all of the shadow.

    /// True if no receiver gets any shadow.
    bool nothing() const { return planes.empty() && obstacle.empty(); }
};

/// @param bodies  of the view's casters; those that are asked for are found.
FlatReceivers findFlatReceivers(const AutoView& view, ConvexBodies& bodies);

/// FlatReceivers::leaves of a view that is known to have no obstacle.
LeafSet findFlatLeaves(const AutoView& view, ConvexBodies& bodies);

} // namespace gnomon
