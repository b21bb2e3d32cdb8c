// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoCandidate.h>
#include <gnomon/auto/CandidateList.h>
#include <gnomon/auto/Renderer.h>
#include <gnomon/auto/Situation.h>
#include <gnomon/group/PerView.h>

#include <OpenThreads/Mutex>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// What an AutoShadowTechnique remembers: the choice for each light in each view, and the techniques that draw.
///
/// A choice follows from facts of the scene, and stays until another candidate is better by a margin, or until it is wrong.
/// No clock and no measured frame has a part in it.
///
/// Threads any number; one at a time decides.
class AutoChooser {
public:
    /// What draws one light's shadow in one view, in this frame.
    struct Drawn {
        osg::ref_ptr<const ShadowTechnique> technique; ///< null: no shadow is drawn.
        std::string cause;                             ///< for ShadowTechnique::report(): the budget cannot be kept.
    };
    Drawn choose(const ShadowInView& shadow, const Selection& receiver, const AutoShadowOptions& options);

    /// A cull begins. Lets all go that is kept of casters if none of the last culls had any.
    /// @param isCurrent  the thread may ask OpenGL, and so learns who draws.
    void beginCull(bool isCurrent);
    /// Learns who draws, in the view's draw; null: that is known.
    osg::ref_ptr<DrawWatch> watch() const;

    /// Of the view that asked last, for each light and kind of receivers.
    std::vector<ShadowDecision> lastDecision() const;
    /// See InnerTechniques::passes().
    unsigned passes() const;
    /// Lets go what is known of casters.
    void forgetFacts();
    void forEach(const std::function<void(ShadowTechnique&)>& visit) const;

private:
    /// Stands for what a choice was made for.
    struct Seen {
        std::uint64_t light = 0;
        std::uint64_t casters = 0; ///< wherever they are.
        std::uint64_t view = 0;    ///< the view, and what is in sight.
        std::uint64_t asked = 0;   ///< what is wanted.
        double error = 0.0;        ///< pixels.

        bool operator==(const Seen& other) const {
            return light == other.light && casters == other.casters && view == other.view && asked == other.asked &&
                   error == other.error;
        }
    };
    struct Choice {
        ReceiverKind kind = ReceiverKind::Usual;
        Seen decided, last;
        AutoCandidate candidate;
        ShadowDecision decision;
        std::string cause;                     ///< see Drawn.
        Situation situation;                   ///< when the candidates were compared.
        std::optional<CandidateSearch> search; ///< that has begun.
        double triangles = 0.0;                ///< of the casters, then.
        unsigned frames = 0;                   ///< since the candidates were compared.
        unsigned seen = 0;                     ///< frames that could be held against one before.
        unsigned since = 0;                    ///< frames since things began to move after a rest.
        AutoMotion moving;                     ///< of the recent frames.
        AutoMotion movingThen;                 ///< when the candidates were compared.
    };
    Seen seenIn(const ShadowInView& shadow, const Selection& receiver, double error) const;
    bool isDue(Choice& choice, const Seen& now, const ShadowInView& shadow, const Selection& receiver);
    bool isOld(const Choice& choice, const Seen& now, const ShadowInView& shadow) const;
    void decide(Choice& choice, const Seen& now, const ShadowInView& shadow, const CandidateList& list);

    mutable OpenThreads::Mutex _mutex;
    InnerTechniques _inner;
    AutoKnowledge _known;
    PerView<Choice> _choices;
    const osg::ref_ptr<RendererFact> _renderer = new RendererFact;
    unsigned _idleCulls = 0; ///< since the last choice.
    const void* _lastStage = nullptr;
};

} // namespace gnomon
