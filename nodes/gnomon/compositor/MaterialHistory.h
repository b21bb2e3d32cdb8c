// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/DrawnLeaves.h>

#include <osg/Material>
#include <osg/State>

#include <optional>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// What osg::Materials leave in OpenGL for those after them, so that leaves drawn again find what they found first.
///
/// osgViewer's own material lets the current colour be ambient and diffuse. Mesa (22.3) keeps what the material before it has
/// set beside, until something is drawn: the first things of a stage have osg::State's default ambient instead of their
/// colour, if they have no colour of their own, or just that of the material before.
class MaterialHistory {
public:
    /// Call it before anything else is drawn or popped. @param last  the leaf drawn last; null if there is none.
    MaterialHistory(osg::State& state, const std::vector<DrawnLeaf>& leaves, const osgUtil::RenderLeaf* last);

    /// Call it before the state of a leaf of `graph` is applied once more.
    void leadTo(const osgUtil::StateGraph& graph);
    /// As after the last leaf. Call it when all is drawn and popped.
    void restore();

    /// As before the first leaf of a stage.
    static void restoreDefault(osg::State& state);

private:
    void find(const std::vector<DrawnLeaf>& leaves);
    void lead(bool byDefault);
    void apply(const osg::Material& material);

    osg::State& _state;
    const osgUtil::StateGraph* const _last; ///< of the leaf drawn last.
    /// Those whose material tracks the current colour, and whether it follows the default with nothing drawn between.
    std::unordered_map<const osgUtil::StateGraph*, bool> _tracking;
    std::optional<bool> _lead; ///< the same of the one that is applied.
};

} // namespace gnomon
