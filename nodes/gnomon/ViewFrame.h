// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/CompositorOptions.h>
#include <gnomon/Export.h>
#include <gnomon/Mark.h>
#include <gnomon/ScreenRect.h>
#include <gnomon/ShadowLight.h>

#include <osg/BoundingBox>
#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Vec2d>
#include <osgUtil/RenderLeaf>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace gnomon {

class ShadowCasterGroup;

class Casters;
class ViewPrograms;

/// A drawable that casts, at one place.
struct CasterBox {
    const osg::Drawable* drawable; ///< As long as the frame's cull.
    osg::BoundingBoxd inGroup;     ///< Bounds of its triangles, group frame.
};
/// The boxes of those that have triangles, in the order in which a traversal meets them.
GNOMON_EXPORT std::vector<CasterBox> boxesOf(const Casters& casters);

/// A technique is asked about each kind of receivers apart.
enum class ReceiverKind {
    Usual,
    Displaced, ///< with a depth range or polygon offset.
    Late       ///< drawn after the opaque bins.
};

/// Tells the views of a technique apart, and in each the parts of its receivers: what techniques keep is found by it.
struct ViewKey {
    const void* stage = nullptr; ///< osgUtil's; its address alone. Null: no view.
    int part = 0;                ///< of the receivers.

    /// True if both tell of one view and one part.
    bool operator==(const ViewKey& other) const { return stage == other.stage && part == other.part; }
};

/// One view in one frame, as a technique sees it after cull. OSG's convention: row vectors, eye = group * eyeFromGroup.
struct GNOMON_EXPORT ViewFrame {
    osg::Matrixd eyeFromGroup;       ///< modelview of the ShadowCasterGroup.
    osg::Matrixd groupFromTechnique; ///< identity unless a transform stands between group and technique.
    osg::Matrixd projection;         ///< as drawn, near and far included.
    osg::Vec2d pixels;               ///< of the viewport.
    osg::Vec2d
        pushedBack; ///< what receives, by polygon offset: in pixels of its slope, and in steps of the depth buffer.
    const ShadowCasterGroup* group = nullptr; ///< Above the technique.
    CompositorOptions
        options; ///< of the ShadowCasterGroup; it skips what is untouched only if all groups in the view do.
    unsigned frameNumber = 0;                ///< For ShadowTechnique::report().
    double frameTime = 0.0;                  ///< seconds, see timeOf().
    ViewKey key;                             ///< Of this view and these receivers.
    ReceiverKind kind = ReceiverKind::Usual; ///< of `seen`.
    const LeafSet* receivers =
        nullptr; ///< `seen`, where that is not all that the view sees: of a named receiver, displaced or late; else null.
    std::size_t lights = 1;                       ///< whose shadows the group wants in the view.
    std::map<int, double> strengths;              ///< of these, see GroupLights.
    std::vector<const osgUtil::RenderLeaf*> seen; ///< leaves that can receive: those, or all of the view.
    /// Stands for `seen`: which drawables, with which bounds, where in eye space, and for movesReceivers. 0: not known, so that
    /// techniques find anew what they see.
    std::uint64_t seenValue = 0;
    bool movesReceivers = false; ///< Programs move some of `seen` out of their boxes, anywhere in the view.
    const ViewPrograms* drawn =
        nullptr; ///< Tells which casters the view draws, within prepare(); null if nobody knows.

    /// Takes the group's frame to clip space.
    osg::Matrixd clipFromGroup() const { return eyeFromGroup * projection; }
    /// Where a box and all that is behind it, as a light sees it, can be seen; nullopt if nowhere.
    /// @param inGroup  group frame, valid.
    std::optional<ScreenRect> boundsBehind(const osg::BoundingBoxd& inGroup, const ShadowLight& light) const;
};

} // namespace gnomon
