// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/auto/CandidateList.h>
#include <gnomon/auto/FrameCosts.h>
#include <gnomon/auto/InnerTechniques.h>
#include <gnomon/base/RecentCache.h>
#include <gnomon/choice/CandidateChoice.h>

#include <OpenThreads/Mutex>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// What an AutoShadowTechnique remembers: the choice for each light in each view, and the techniques that draw.
///
/// Threads any number; one at a time decides.
class AutoChooser {
public:
    /// What draws one light's shadow in one view, in this frame.
    struct Drawn {
        /// A technique, and what it draws.
        struct Share {
            osg::ref_ptr<const ShadowTechnique> technique;
            FrameCasters casters;
        };
        std::vector<Share> shares;               ///< empty: no shadow is drawn.
        std::string cause;                       ///< for ShadowTechnique::report(): the budget cannot be kept.
        std::shared_ptr<const LeafSet> surfaces; ///< see MarkJob::surfaces.
        bool timed = false; ///< this frame is measured: prepared() wants to know how long its cull took.
    };
    Drawn choose(const AutoView& view, const Selection& receiver, const AutoShadowOptions& options);

    /// How long choose()'s technique took to prepare a light in a view. @param time  milliseconds.
    void prepared(const void* stage, int light, double time);
    /// What is to be learnt in the view's draw; null: nothing. @param alone  nothing else is drawn by the compositor there.
    osg::ref_ptr<DrawWatch> watch(const void* stage, bool alone);

    /// Of the view that asked last, for each light and kind of receivers.
    std::vector<ShadowDecision> lastDecision() const;
    /// See InnerTechniques::passes().
    unsigned passes() const;
    /// True if all that was chosen takes the casters drawable by drawable.
    bool takesDrawables() const;
    void forEach(const std::function<void(ShadowTechnique&)>& visit) const;

private:
    /// What a choice was made for.
    struct Seen {
        osg::Matrixd eyeFromGroup, projection;
        osg::Vec2d pixels;
        ShadowLight light;
        osg::ref_ptr<const CasterDrawables> casters;
        std::uint64_t leaves = 0;
        ShadowCasterGroup::Composite composite = ShadowCasterGroup::RELIGHT;
        unsigned reservedBits = 0;
        std::size_t lights = 1;
        float dark = 0.0f;
        bool faint = false;
        Selection receiver;
        double error = 0.0, time = 0.0;

        bool isSame(const Seen& other) const { return hasSameMotion(other) && hasSameView(other) && asks(other); }
        bool hasSameMotion(const Seen& other) const;
        bool hasSameView(const Seen& other) const;
        /// True if the same is wanted of the same things, wherever they are.
        bool asks(const Seen& other) const;
    };
    struct Choice {
        const void* stage;
        int light;
        const void* renderStage; ///< see ViewFrame.
        ReceiverKind kind;
        Seen decided, last;
        AutoCandidate candidate;
        ShadowDecision decision;
        unsigned lastRound = 0;
        unsigned frames = 0;   ///< since the candidates were compared.
        unsigned patience = 0; ///< frames that have to pass before they are compared again, if nothing forces it.
        unsigned seen = 0;     ///< frames that could be held against one before.
        unsigned since = 0;    ///< frames since things began to move after a rest.
        AutoMotion moving;     ///< of the recent frames.
        std::string cause;     ///< see Drawn.
        std::vector<AutoCandidate> rivals;      ///< to be drawn for some frames, so that their times are known.
        std::optional<AutoCandidate> incumbent; ///< while a rival is drawn, what was drawn before.
        std::array<unsigned, AutoCosts::kinds> trials{}; ///< how often each kind was drawn as a rival.
        AutoMotion movingThen;                           ///< when the candidates were compared.
        unsigned learnt = 0;                             ///< FrameCosts::generation() then.
        AutoMotion motion;                               ///< of this frame.
        bool alone = false;         ///< nothing else counts in a frame's time, so that it can be measured.
        double prepared = 0.0;      ///< milliseconds, of a frame that is measured.
        FlatLeaves flat;            ///< that relighting draws alone,
        std::optional<Seen> flatIn; ///< and what they were found for.
        std::shared_ptr<std::atomic<double>> taken = std::make_shared<std::atomic<double>>(0.0);
    };
    Choice& find(const AutoView& view);
    std::vector<Drawn::Share> sharesOf(const AutoCandidate& candidate, const AutoView& view, const Selection& receiver);
    std::shared_ptr<const LeafSet> surfacesOf(Choice& choice, const Seen& now, const AutoView& view);
    bool isMeasured(const Choice& choice) const;
    bool isDue(Choice& choice, const Seen& now, const AutoView& view, const Selection& receiver);
    void decide(Choice& choice, const Seen& now, const AutoView& view, const Selection& receiver,
                const AutoShadowOptions& options);
    void findRivals(Choice& choice, const std::vector<AutoCandidate>& all, const std::vector<ChoiceCandidate>& judged,
                    const ChoiceBudget& budget, std::size_t chosen) const;
    bool isTrialDue(const Choice& choice) const;
    bool tryRival(Choice& choice, const AutoView& view, const Selection& receiver);

    mutable OpenThreads::Mutex _mutex;
    InnerTechniques _inner;
    AutoKnowledge _known;
    const osg::ref_ptr<FrameCosts> _costs = new FrameCosts;
    osg::ref_ptr<const CasterDrawables> _casters; ///< that the knowledge is of.
    RecentCache<std::unique_ptr<Choice>> _choices;
    unsigned _round = 0, _frame = 0;
    const void* _lastRenderStage = nullptr;
};

} // namespace gnomon
