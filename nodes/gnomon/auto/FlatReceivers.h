// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoView.h>
#include <gnomon/auto/ConvexBodies.h>

#include <osg/Vec4d>

#include <cstddef>
#include <memory>
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

/// FlatReceivers::leaves of a view, for as long as nothing in it moves.
///
/// Cost  in a frame: a look at each of them. They are collected anew only where OSG keeps them at other addresses.
class FlatLeaves {
public:
    using Leaves = std::vector<const osgUtil::RenderLeaf*>;

    FlatLeaves() = default;
    /// @param seen  see ViewFrame::seen. @param flat  some of them.
    FlatLeaves(const Leaves& seen, const LeafSet& flat);
    /// @param seen  of the same drawables in the same order.
    const std::shared_ptr<const LeafSet>& in(const Leaves& seen);

private:
    void take(const Leaves& seen);

    std::vector<std::size_t> _places; ///< among those that are seen.
    Leaves _leaves;                   ///< that stood there last.
    std::shared_ptr<const LeafSet> _set;
};

} // namespace gnomon
