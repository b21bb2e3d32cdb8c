// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CasterMesh.h>
#include <gnomon/CasterPieces.h>
#include <gnomon/ShadowCasterGroup.h>

namespace gnomon {

/// What casts below a group as one view has it: asked for once, in the form that each technique takes.
class GroupCasters {
public:
    explicit GroupCasters(const ShadowCasterGroup& group) : _group(&group) {}

    /// All in one.
    const CasterMesh& mesh() const {
        if (!_mesh) _mesh = _group->casters();
        return *_mesh;
    }
    /// Drawable by drawable.
    const CasterPieces& pieces() const {
        if (!_pieces) _pieces = _group->pieces();
        return *_pieces;
    }

private:
    osg::ref_ptr<const ShadowCasterGroup> _group;
    mutable osg::ref_ptr<const CasterMesh> _mesh;
    mutable osg::ref_ptr<const CasterPieces> _pieces;
};

} // namespace gnomon
