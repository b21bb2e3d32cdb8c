// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowLight.h>
#include <gnomon/casters/CasterDrawables.h>

#include <osg/Object>
#include <osgUtil/RenderLeaf>
#include <osgUtil/RenderStage>

#include <string>
#include <vector>

namespace gnomon {

/// Finds the node that keeps a light from nearly all that is seen, for diagnose(): a sky dome among the casters, for one.
/// The stage keeps what was found among its user objects.
///
/// A node is named if it holds nearly all receivers, stands between them and the light, and closes most other ways as well:
/// so neither a mountain at dusk nor a table is. Its drawables do not count as receivers.
///
/// Cost    nothing where nothing has changed; else, every 60th frame, a look at the casters' boxes. Rays, 128 of them, only
///         if a node holds the receivers.
/// Limits  receivers are taken by the boxes of the seven largest drawables in sight. Drawables below one node count together.
class EnclosingCasters : public osg::Object {
public:
    EnclosingCasters() = default;
    EnclosingCasters(const EnclosingCasters& other, const osg::CopyOp& copyOp) : osg::Object(other, copyOp) {}
    META_Object(gnomon, EnclosingCasters)

    /// The memory of a stage, made if it has none.
    static EnclosingCasters& of(osgUtil::RenderStage& stage);

    /// What is asked for one light in one view.
    struct View {
        const ShadowCasterGroup& group;
        const ShadowLight& light;
        const CasterDrawables& casters;
        const std::vector<const osgUtil::RenderLeaf*>& receivers;
        const osg::Matrixd& eyeFromGroup;
    };
    /// A cause for ShadowTechnique::report(); empty if there is no such node. Reads the graph: call in cull.
    std::string causeOf(const View& view);

protected:
    ~EnclosingCasters() override = default;

private:
    struct Known {
        const ShadowCasterGroup* group; ///< told apart by address alone, as the light's number tells lights apart.
        int number;
        std::uint64_t casters = 0;
        std::size_t pieces = 0, receivers = 0;
        osg::Vec4d light = {};
        unsigned frames = 0; ///< since it was looked for.
        std::string cause = {};
    };
    Known& knownOf(const View& view);

    std::vector<Known> _known;
};

} // namespace gnomon
