// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/RecentCache.h>
#include <gnomon/casters/CasterBodies.h>
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/casters/CasterLayers.h>
#include <gnomon/casters/Casting.h>

#include <OpenThreads/Mutex>

#include <cstdint>
#include <utility>

namespace gnomon {

/// Casters that views may ask for. Once these are let go, or replaced, they are retired: caches may let them go, too.
template <class Casters>
class CurrentCasters {
public:
    CurrentCasters() = default;
    CurrentCasters(CurrentCasters&& other) noexcept { std::swap(_casters, other._casters); }
    CurrentCasters& operator=(CurrentCasters&& other) noexcept {
        std::swap(_casters, other._casters);
        return *this;
    }
    ~CurrentCasters() { set(nullptr); }

    void set(const osg::ref_ptr<const Casters>& casters) {
        if (_casters && _casters != casters) _casters->retire();
        _casters = casters;
    }
    const osg::ref_ptr<const Casters>& get() const { return _casters; }

private:
    osg::ref_ptr<const Casters> _casters;
};

/// The casters of a group, in each form and for each choice of levels of detail that a view made lately.
///
/// A scene without levels has one choice. Whatever has changed takes the place of what was there before.
///
/// Threads
/// - Any number.
class CasterRevisions {
public:
    /// The casters below a node as meshes. Reads the graph as a cull traversal does.
    /// @param view  whose levels are taken; null: the finest.
    osg::ref_ptr<const CasterLayers> layers(osg::Node& root, const Selection& casters, const CasterView* view);
    /// The same, drawable by drawable.
    osg::ref_ptr<const CasterDrawables> drawables(osg::Node& root, const Selection& casters, const CasterView* view);
    /// Some of the drawables as meshes, made from earlier ones.
    osg::ref_ptr<const CasterLayers> layersOf(const CasterDrawables& some, const CasterLayers& before);
    /// What of the drawables casts. Default: all that is drawn, transparent or not.
    void setRule(const CastingRule& rule);
    /// How often there was something that was not known.
    unsigned count() const;
    /// Forgets all: others cast.
    void clear();

private:
    /// What casts with one choice of levels.
    struct Choice {
        std::uint64_t choice, fingerprint;
        const void* view; ///< that had it last.
        unsigned lastCall;
        CurrentCasters<CasterLayers> layers;
        CurrentCasters<CasterDrawables> pieces;
        osg::ref_ptr<const CasterLayers> former; ///< retired ones, which the next are made from.
        unsigned lastLayersCall = 0;
    };
    Choice& take(std::uint64_t choice, std::uint64_t fingerprint, const CasterView* view);
    Choice& findDrawables(osg::Node& root, const Selection& casters, const CasterView* view);
    osg::ref_ptr<const CasterDrawables> knownTo(const CasterView* view) const;
    osg::ref_ptr<const CasterLayers> layersKnownTo(const CasterView* view) const;

    mutable OpenThreads::Mutex _mutex;
    RecentCache<Choice> _choices;
    LevelPieces _levels;
    CasterBodies _bodies;
    unsigned _calls = 0, _count = 0;
    CastingRule _rule;
};

} // namespace gnomon
