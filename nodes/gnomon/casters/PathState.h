// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Node>
#include <osg/Program>
#include <osg/StateAttribute>
#include <osg/StateSet>

#include <algorithm>
#include <vector>

namespace gnomon {

/// OpenGL's state as the sets along a path leave it, by OpenSceneGraph's rules of inheritance.
class PathState {
public:
    explicit PathState(const osg::NodePath& path) {
        for (const osg::Node* node : path) add(*node);
        if (path.empty()) return;
        for (const osg::Node* node = path.front(); node->getNumParents() > 0;) add(*(node = node->getParent(0)), true);
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
    bool _late = false; ///< drawn in bin 8 or later.
    bool _discards = false;
    const Attribute *_face = nullptr, *_front = nullptr, *_polygons = nullptr, *_depth = nullptr, *_program = nullptr;
};

} // namespace gnomon
