// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/casters/CasterMesh.h>

namespace gnomon {

/// What casts below a group as one view has it: asked for once, in the form that each technique takes.
class FrameCasters {
public:
    explicit FrameCasters(const ShadowCasterGroup& group) : _group(&group) {}

    /// All in one.
    const CasterMesh& mesh() const {
        if (!_mesh) _mesh = _group->casters();
        return *_mesh;
    }
    /// Drawable by drawable.
    const CasterDrawables& drawables() const {
        if (!_pieces) _pieces = _group->drawables();
        return *_pieces;
    }

private:
    osg::ref_ptr<const ShadowCasterGroup> _group;
    mutable osg::ref_ptr<const CasterMesh> _mesh;
    mutable osg::ref_ptr<const CasterDrawables> _pieces;
};

} // namespace gnomon
