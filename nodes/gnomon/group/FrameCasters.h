// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casting.h>

#include <utility>

namespace gnomon {

/// What casts below a group as one view has it, with the levels of detail that it shows: asked for once, in the form that
/// each technique takes.
class FrameCasters {
public:
    FrameCasters(const ShadowCasterGroup& group, CasterView view) : _group(&group), _view(std::move(view)) {}

    /// True if these are of the group, as the view has it.
    bool areOf(const ShadowCasterGroup& group, const CasterView& view) const {
        return _group == &group && _view.eyeFromGroup == view.eyeFromGroup && _view.projection == view.projection &&
               _view.lodScale == view.lodScale && _view.viewPoint == view.viewPoint && _view.mask == view.mask;
    }

    /// Some of them, as if they were all.
    FrameCasters part(const CasterLayers& some) const {
        FrameCasters result(*_group, _view);
        result._layers = &some;
        return result;
    }
    const ShadowCasterGroup& group() const { return *_group; }

    /// As meshes.
    const CasterLayers& layers() const {
        if (!_layers) _layers = _group->casters(&_view);
        return *_layers;
    }
    /// Drawable by drawable.
    const CasterDrawables& drawables() const {
        if (!_pieces) _pieces = _layers ? _layers->pieces : _group->drawables(&_view);
        return *_pieces;
    }

private:
    osg::ref_ptr<const ShadowCasterGroup> _group;
    const CasterView _view;
    mutable osg::ref_ptr<const CasterLayers> _layers;
    mutable osg::ref_ptr<const CasterDrawables> _pieces;
};

} // namespace gnomon
