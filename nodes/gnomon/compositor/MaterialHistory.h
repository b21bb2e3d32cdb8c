// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/compositor/DrawnLeaves.h>

#include <osg/Material>
#include <osg/State>

#include <optional>
#include <unordered_map>
#include <vector>

namespace gnomon {

/// What osg::Materials and colours leave in OpenGL for those after them, so that a leaf drawn again finds what it found first,
/// and what is drawn later finds what it would find without the kit.
///
/// A drawable without colours has those of the one before it; by osgViewer's own material they are its ambient and diffuse.
/// Mesa (22.3) lets the ambient of the material before stand until the colour changes or something is drawn: the first things
/// of a stage have that of osg::State's default, as SceneView has applied it after the frame before.
class MaterialHistory {
public:
    /// Reads what stands now. Call it before anything else is drawn or popped.
    /// @param followsDefault  the stage began with osg::State's default material.
    MaterialHistory(osg::State& state, osgUtil::RenderStage& stage, bool followsDefault = false);

    /// Call it when the state of a leaf of the stage is applied once more.
    void leadTo(const osgUtil::RenderLeaf& leaf);
    /// As when this was made. Call it when all is drawn.
    void restore();

    /// True if osg::State's default material is the last that it has applied.
    static bool isDefault(osg::State& state);

private:
    /// What a drawable finds.
    struct Found {
        bool byDefault = false; ///< ambient is the default material's.
        osg::Vec4 color;
    };
    void find();
    void lead(const osg::Material& material, const Found& found);

    osg::State& _state;
    osgUtil::RenderStage& _stage;
    const bool _followsDefault;
    const osg::Material* const _material; ///< that stands; null if there is none.
    Found _now;
    std::optional<std::unordered_map<const osgUtil::RenderLeaf*, Found>> _found; ///< once asked for.
};

} // namespace gnomon
