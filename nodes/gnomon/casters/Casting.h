// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/Fingerprint.h>
#include <gnomon/casters/DrawnAlpha.h>

#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Program>
#include <osg/StateSet>
#include <osg/Vec3>
#include <osg/Vec4d>
#include <osg/Viewport>
#include <osg/ref_ptr>

#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon {

class PathState;

/// How a group's casters are judged by what is drawn of them.
struct CastingRule {
    float opaqueFrom = 0.0f; ///< Alpha from which on a blending drawable casts, 0 … 1. 0: all cast.
};

/// A clip plane by OpenGL's number. Kept is what has no negative distance from it.
using NumberedPlane = std::pair<unsigned, osg::Vec4d>;

/// What the states on the way to a drawable leave of it as a caster: what is not drawn casts nothing.
///
/// - Nothing of what is drawn at the far plane, as skies are; of what only adds to colours, or hides less of them than
///   CastingRule::opaqueFrom; of what is culled on both sides, drawn as lines or points, masked away, cut off by an empty
///   scissor box, or stippled to less than half.
/// - Of what has an alpha test or blends, the parts that pass the test, or have an alpha of CastingRule::opaqueFrom.
/// - What clip planes leave.
/// - Of what a program discards, nobody knows what is left but who draws it.
///
/// Light is not the camera: a face culled for the eye casts, and so does what a scissor box keeps out of a picture.
///
/// Limits
/// - Of a program's alpha it knows nothing. It counts as unknown where a test is on, or in a transparent bin; else as 1.
/// - A ClipPlane of a state set, without a ClipNode, is taken as given in the drawable's own frame.
struct Casting {
    bool casts = true;             ///< False if nothing of it does.
    bool ownDrawn = false;         ///< Only drawing it tells which parts are clear. Each triangle may be in part.
    float ownFrom = 0.0f;          ///< The alpha from which on it casts where it is drawn without a test. 0: all does.
    std::optional<AlphaTest> test; ///< Which parts are clear. nullopt: none, or ownDrawn.
    std::vector<NumberedPlane> clips; ///< Planes that cut it, root frame.
    std::optional<unsigned> restart;  ///< Index that ends a primitive; ~0u: the largest of the list's type.

    /// True if it casts by all its triangles, though some may be clear in part.
    bool isWhole() const { return casts && !test && clips.empty(); }
    /// Mixes in everything that decides what is left of a drawable.
    void mix(const osg::Drawable& drawable, Fingerprint& into) const;
    /// Adds the objects that mix() identifies by address.
    void hold(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) const;
};

/// Finds the casting of drawables during one visit of a graph, in which no state changes.
class CastingJudge {
public:
    /// Without a rule, all cast whole: what is wanted is what there is.
    void setRule(const std::optional<CastingRule>& rule) { _rule = rule; }
    /// True if a state set may keep part of what is below it from casting, or from being read as it is.
    bool mayMatter(const osg::StateSet& set);
    /// The casting of the drawable at the end of a path, by the states along it and above it (by first parents).
    /// @param planes  clip planes where they lie in the root's frame; of two with one number the last one counts.
    Casting of(const osg::NodePath& path, const osg::Drawable& drawable, const osg::Matrixd& rootFromLocal,
               const std::vector<NumberedPlane>& planes);
    /// A new visit begins.
    void reset();

private:
    /// What the state alone says.
    struct Resolved;
    const Resolved& resolved(const PathState& state);
    bool discards(const osg::Program& program);
    bool discards(const PathState& state);

    std::optional<CastingRule> _rule;
    std::map<const osg::Program*, bool> _programs; ///< whether they discard.
    std::vector<const osg::StateSet*> _sets;       ///< of _resolved: drawables of one state mostly follow each other.
    std::shared_ptr<const Resolved> _resolved;
};

/// The view that nodes choose by what they show: levels of detail by its eye, scale and pixels; and how it is drawn.
struct CasterView {
    osg::Matrixd eyeFromGroup;            ///< modelview at the ShadowCasterGroup.
    osg::Matrixd projection;              ///< near and far do not matter.
    osg::ref_ptr<osg::Viewport> viewport; ///< null: nothing is chosen by pixels.
    osg::Vec3 viewPoint;                  ///< eye space; elsewhere than the eye where a camera inherits it.
    float lodScale = 1.0f;                ///< of the cull.
    const void* key = nullptr;            ///< any address that tells views apart.
    osg::Node::NodeMask mask = ~0u;       ///< of the cull: it draws a node if they share a bit.
    std::vector<NumberedPlane> planes{};  ///< clip planes of all the view, group frame.
};

} // namespace gnomon
