// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/MatrixUniform.h>
#include <gnomon/base/Fingerprint.h>
#include <gnomon/base/ProgramText.h>
#include <gnomon/casters/DrawnAlpha.h>

#include <osg/Camera>
#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Program>
#include <osg/StateAttribute>
#include <osg/StateSet>
#include <osg/Vec3>
#include <osg/Vec4d>
#include <osg/Viewport>
#include <osg/ref_ptr>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace gnomon {

/// OpenGL's state as the sets along a path leave it, by OpenSceneGraph's rules of inheritance.
class PathState {
public:
    explicit PathState(const osg::NodePath& path) {
        for (const osg::Node* node : path) add(*node);
        if (path.empty()) return;
        std::size_t above = 0, ofViews = 0;
        for (const osg::Node* node = path.front(); node->getNumParents() > 0;) {
            node = node->getParent(0);
            add(*node, true);
            above += node->getStateSet() ? 1 : 0;
            if (isNested(node->asCamera())) ofViews = above;
        }
        _endOfViews = above;
        _views = ofViews;
    }

    /// Without the sets of nested cameras above the path, and of what is between them and the path.
    PathState ofMainGraph() const {
        PathState result = *this;
        const auto end = result._sets.begin() + long(_endOfViews);
        result._sets.erase(end - long(_views), end);
        result._views = 0;
        return result;
    }

    /// @param unset  where no state set gives the mode.
    bool isOn(osg::StateAttribute::GLMode mode, bool unset = false) const {
        return isOnBy([mode](const osg::StateSet& set) { return set.getMode(mode); }, unset);
    }
    bool isTextureOn(unsigned unit, osg::StateAttribute::GLMode mode) const {
        return isOnBy([=](const osg::StateSet& set) { return set.getTextureMode(unit, mode); });
    }
    /// Null if there is none, or one of another class.
    template <class Attribute>
    const Attribute* attribute(osg::StateAttribute::Type type, unsigned member = 0) const {
        return dynamic_cast<const Attribute*>(
            attributeBy([=](const osg::StateSet& set) { return set.getAttributePair(type, member); }));
    }
    /// Null if there is none.
    osg::StateAttribute* textureAttribute(osg::StateAttribute::Type type, unsigned unit = 0) const {
        return attributeBy([=](const osg::StateSet& set) { return set.getTextureAttributePair(unit, type); });
    }
    /// Texture units that any set speaks of.
    unsigned units() const {
        std::size_t most = 0;
        for (const osg::StateSet* set : _sets) most = std::max(most, set->getTextureModeList().size());
        return static_cast<unsigned>(most);
    }

    /// True if a program draws, whether its text is known or not.
    bool isProgrammed() const { return program() || hasUnseenProgram(); }
    /// True if an attribute in use may apply a program that is not known.
    bool hasUnseenProgram() const {
        for (const osg::StateSet* set : _sets)
            for (const auto& [key, pair] : set->getAttributeList()) {
                const auto& [type, member] = key;
                const auto same = [type = type, member = member](const osg::StateSet& other) {
                    return other.getAttributePair(type, member);
                };
                if (mayApplyProgram(*pair.first) && attributeBy(same) == pair.first.get()) return true;
            }
        return false;
    }
    /// The program in use, which may do anything; null if there is none.
    const osg::Program* program() const {
        const auto* program = attribute<osg::Program>(osg::StateAttribute::PROGRAM);
        return program && program->getNumShaders() > 0 ? program : nullptr;
    }

    /// Number of the render bin that it is drawn in.
    int bin() const {
        int number = 0;
        for (const osg::StateSet* set : _sets)
            if (set->useRenderBinDetails()) number = set->getBinNumber();
        return number;
    }

    /// The outermost first.
    const std::vector<const osg::StateSet*>& sets() const { return _sets; }

private:
    void add(const osg::Node& node, bool above = false) {
        if (node.getStateSet()) _sets.insert(above ? _sets.begin() : _sets.end(), node.getStateSet());
    }

    /// A main one has no parents. One that draws before the rest may be left without them for a while.
    static bool isNested(const osg::Camera* camera) {
        return camera && (camera->getNumParents() > 0 || camera->getRenderOrder() == osg::Camera::PRE_RENDER);
    }

    template <class Get>
    bool isOnBy(Get get, bool unset = false) const {
        osg::StateAttribute::GLModeValue now = unset ? osg::StateAttribute::ON : osg::StateAttribute::OFF;
        for (const osg::StateSet* set : _sets) {
            const osg::StateAttribute::GLModeValue given = get(*set);
            if (!(given & osg::StateAttribute::INHERIT) &&
                (!(now & osg::StateAttribute::OVERRIDE) || (given & osg::StateAttribute::PROTECTED)))
                now = given;
        }
        return now & osg::StateAttribute::ON;
    }

    template <class Get>
    osg::StateAttribute* attributeBy(Get get) const {
        const osg::StateSet::RefAttributePair* now = nullptr;
        for (const osg::StateSet* set : _sets) {
            const osg::StateSet::RefAttributePair* given = get(*set);
            if (given && (!now || !(now->second & osg::StateAttribute::OVERRIDE) ||
                          (given->second & osg::StateAttribute::PROTECTED)))
                now = given;
        }
        return now ? now->first.get() : nullptr;
    }

    std::vector<const osg::StateSet*> _sets; // outermost first
    std::size_t _endOfViews = 0, _views = 0; ///< of _sets, those of nested cameras: where they end, and how many.
};

/// Which sides of a caster's triangles hide what is behind them, in a view that draws it: their depth stands then.
enum class Hiding {
    Both,
    Fronts, ///< Back faces are culled.
    Neither ///< One sees through both, somewhere at least, or that is not known.
};

/// What decides that, as the state sets on a path leave it by OpenSceneGraph's rules of inheritance.
///
/// Something sees through what is drawn late and blends, has an alpha test, a clip plane, a stipple, a program that discards,
/// lines in place of triangles, or no plain depth; and through the culled side of a face.
class HidingState {
public:
    /// From the outermost set on.
    void apply(const osg::StateSet& set);
    /// @param mirrored  the drawable's frame turns triangles round, but OpenGL's sense of front and back stays.
    Hiding hiding(bool mirrored) const;

private:
    using Value = osg::StateAttribute::GLModeValue;
    using Attribute = osg::StateSet::RefAttributePair;

    Value _blend = 0, _alphaTest = 0, _cull = 0, _stipple = 0, _depthTest = osg::StateAttribute::ON;
    Value _clip[6] = {};
    bool _late = false;                      ///< drawn in bin 8 or later.
    bool _discards = false, _unseen = false; ///< by a program, whose text is known or not.
    const Attribute *_face = nullptr, *_front = nullptr, *_polygons = nullptr, *_depth = nullptr, *_program = nullptr;
};

/// How a group's casters are judged by what is drawn of them.
struct CastingRule {
    float opaqueFrom = 0.0f; ///< Alpha from which on parts of a blending drawable cast, 0 … 1. 0: all cast.
    float evenFrom = 0.0f;   ///< The same of a drawable that has one alpha all over, as glass and water have.
    /// Which clip planes cut casters.
    enum Clips {
        OfGraph, ///< Not those of a nested camera, or between it and the group, or in the eye's frame: they are its view's.
        All,
        None
    } clips = OfGraph;
    bool offsetsTerminator = true;         ///< See Casting::offsetsTerminator.
    std::vector<MatrixUniform> matrices{}; ///< By which programs project.
};

/// A clip plane by OpenGL's number. Kept is what has no negative distance from it.
using NumberedPlane = std::pair<unsigned, osg::Vec4d>;

/// What the states on the way to a drawable leave of it as a caster: what is not drawn casts nothing.
///
/// - Nothing of what is drawn at the far plane, as skies are; of what only adds to colours, or blends by one
///   alpha below CastingRule::evenFrom; of what is culled on both sides, drawn as lines or points, masked away, cut off by an empty
///   scissor box, or stippled to less than half.
/// - Of what has an alpha test or blends, the parts that pass the test, or have an alpha of CastingRule::opaqueFrom.
/// - What clip planes leave, as CastingRule::clips has it.
/// - Of what a program moves, all, where its arrays stand. Maps let the program draw it in its place: see
///   ProgramPlaces::castsWhereItMoves().
/// - Of what a program discards, or may discard where its text is not known, nobody knows what is left but who draws it. Of what
///   it discards by gl_FragCoord, or under a projection of its own that is not named, all.
///
/// Light is not the camera: a face culled for the eye casts, and so does what a scissor box keeps out of a picture.
///
/// Limits
/// - Of a program's alpha it knows nothing. It counts as unknown where a test is on, or in a transparent bin; else as 1.
/// - A ClipPlane of a state set, without a ClipNode, is taken as given in the drawable's own frame.
struct Casting {
    bool casts = true;             ///< False if nothing of it does.
    bool selfDrawn = false;        ///< Only drawing it tells which parts are clear, and where it is.
    bool moved = false;            ///< The same, because a program moves it; no part is clear.
    bool makesTriangles = false;   ///< The same, because a program makes triangles of points and lines, too.
    bool byPixel = false;          ///< The picture's pixels or projection tell that, which no light has: all casts.
    float opaqueFrom = 0.0f;       ///< The alpha from which on it casts where it is drawn without a test. 0: all does.
    std::optional<AlphaTest> test; ///< Which parts are clear. nullopt: none, or selfDrawn.
    std::vector<NumberedPlane> clips; ///< Planes that cut it, root frame.
    std::optional<unsigned> restart;  ///< Index that ends a primitive; ~0u: the largest of the list's type.
    bool offsetsTerminator =
        false; ///< What is smooth casts from farther on at its terminator: see terminatorOffsets().

    /// True if it casts by all its triangles, though some may be clear in part.
    bool isWhole() const { return casts && !test && clips.empty(); }
    /// True if more than vertices decides what is left.
    bool looksAtAll() const { return selfDrawn || test; }
    /// Mixes in everything that decides what is left of a drawable.
    void mix(const osg::Drawable& drawable, Fingerprint& into) const;
    /// Adds the objects that mix() identifies by address.
    void hold(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) const;
};

/// Finds the casting of drawables during one visit of a graph, in which no state changes.
class CastingJudge {
public:
    /// Without a rule, all cast whole, from where they are: what is wanted is what there is.
    void setRule(const std::optional<CastingRule>& rule) { _rule = rule; }
    /// True if planes in the eye's frame cut.
    bool cutsByViews() const { return _rule && _rule->clips == CastingRule::All; }
    /// True if a state set may keep part of what is below it from casting, or from being read as it is.
    bool mayMatter(const osg::StateSet& set);
    /// Of what no state matters to.
    Casting plain() const;
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
    const ProgramPlaces& placesIn(const osg::Program& program);

    std::optional<CastingRule> _rule;
    std::map<const osg::Program*, ProgramPlaces> _programs; ///< of those that discard.
    std::vector<const osg::StateSet*> _sets; ///< of _resolved: drawables of one state mostly follow each other.
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
