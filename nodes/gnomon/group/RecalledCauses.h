// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/ShadowLight.h>
#include <gnomon/casters/CasterDrawables.h>

#include <osg/Object>
#include <osgUtil/RenderLeaf>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace gnomon {

/// One light in one view, of which something is asked for diagnose().
struct LitView {
    const ShadowCasterGroup& group;
    const ShadowLight& light;
    const CasterDrawables& casters;
    const std::vector<const osgUtil::RenderLeaf*>& receivers;
    const osg::Matrixd& eyeFromGroup;
};

/// Causes that take long to find, as a stage has found them before. The stage keeps them, see keptBy().
///
/// Cost    nothing where nothing has changed. Where something moves, one search every 60th frame.
class RecalledCauses : public osg::Object {
public:
    RecalledCauses() = default;
    RecalledCauses(const RecalledCauses& other, const osg::CopyOp& copyOp) : osg::Object(other, copyOp) {}
    META_Object(gnomon, RecalledCauses)

    /// Kinds of causes: of one asker, a light has one of each.
    enum class Kind { EnclosingNode, UnshadowedSurface, CoarseDepth };
    /// What a cause depends on besides casters and light.
    struct State {
        std::uint64_t seen = 0;     ///< of what is in view.
        std::uint64_t settings = 0; ///< a change of these is looked at in the same frame.
    };
    /// A cause for ShadowTechnique::report(); empty if there is none.
    /// @param who   what asks: an address, never followed.
    /// @param find  finds it anew.
    std::string causeOf(Kind kind, const void* who, const LitView& view, const State& state,
                        const std::function<std::string()>& find);

protected:
    ~RecalledCauses() override = default;

private:
    struct Known {
        Kind kind;
        const void* who;
        int number; ///< the light's, by which lights are told apart.
        std::uint64_t casters = 0;
        std::size_t pieces = 0;
        State state = {};
        osg::Vec4d light = {};
        unsigned frames = 0; ///< since it was looked for.
        std::string cause = {};
    };
    Known& knownOf(Kind kind, const void* who, int number);

    std::vector<Known> _known;
};

} // namespace gnomon
