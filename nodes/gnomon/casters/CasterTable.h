// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/base/RecentCache.h>
#include <gnomon/casters/Casters.h>
#include <gnomon/casters/KnownCasters.h>

#include <OpenThreads/Mutex>

#include <atomic>
#include <cstdint>

namespace gnomon {

/// The casters of a group, for each choice of levels of detail that a view made lately.
///
/// A scene without levels has one choice. Whatever has changed takes the place of what was there before.
///
/// Threads
/// - Any number.
class CasterTable : public osg::Referenced {
public:
    /// The casters below a node. Reads the graph as a cull traversal does.
    /// @param view  whose levels are taken; null: the finest.
    osg::ref_ptr<const Casters> casters(osg::Node& root, const Selection& casters, const CasterView* view);
    /// Makes the layers of casters that have none, from those that the view had last, or any that are known. Reads the graph as a
    /// cull traversal does.
    void makeLayers(const Casters& casters);
    /// What of the drawables casts. Default: all that is drawn, transparent or not.
    void setRule(const CastingRule& rule);
    /// How often there was something that was not known.
    unsigned count() const;
    /// Forgets all: others cast.
    void clear();
    /// A cull has passed the group. Forgets all if nobody has asked for the casters in so many: no technique is left, or on.
    /// @return true if it does: who keeps something of these casters may let it go.
    bool passCull() {
        if (++_culls != keptCalls) return false;
        clear();
        return true;
    }

protected:
    ~CasterTable() override = default;

private:
    static constexpr unsigned keptCalls = 240; ///< choices that nobody asked for since are let go.
    /// What casts with one choice of levels.
    struct Choice {
        std::uint64_t choice;
        const void* view = nullptr; ///< that had it last.
        unsigned lastCall = 0;
        CurrentCasters casters{};
        osg::ref_ptr<const Casters> former{}; ///< retired ones, whose layers the next are made from.
        unsigned formerSince = 0;             ///< call.
    };
    Choice& take(const Casters& now, const CasterView* view);
    void make(const Casters& casters);
    osg::ref_ptr<const Casters> knownTo(const CasterView* view) const;
    osg::ref_ptr<const Casters> layersKnownTo(const void* view) const;

    mutable OpenThreads::Mutex _mutex;
    RecentCache<Choice> _choices;
    KnownCasters _known;
    unsigned _calls = 0, _count = 0;
    std::atomic<unsigned> _culls{0}; ///< since the casters were asked for.
    CastingRule _rule;
};

} // namespace gnomon
