// SPDX-License-Identifier: MIT
#include <gnomon/auto/AutoChooser.h>

#include <OpenThreads/ScopedLock>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <sstream>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned keptRounds = 60;    // choices of views that are gone are let go
constexpr double memory = 0.9;         // of motion, from a frame to the next
constexpr double atRest = 0.01;        // share of frames: 44 without motion after one with it
constexpr unsigned firstLook = 2;      // frames after the first: what moves from the start is known by then
constexpr unsigned settling = 8;       // frames of motion after a rest: a single one should change nothing
constexpr unsigned leastPatience = 16; // frames between two decisions that nothing forces
constexpr double mostPatience = 64.0;  // the same; the first decision takes long, for it knows nothing
constexpr double decisionTime = 0.05;  // ms a frame that decisions may take on average
/// Share of the frames in which things move at least, in the long run: of maps that take the same where all stands still, the
/// small one is taken.
constexpr double rarely = 0.02;
constexpr double doubt = 3.0;       // predicted times may be off by this factor, see VolumeForecast
constexpr unsigned trialFrames = 7; // until a candidate's time is known: see isMeasured(); draw may be a frame behind
constexpr unsigned mostTrials = 3;  // of a kind in a view: what breaks trials off again and again does so for good
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string rounded(double number) {
    std::ostringstream text;
    text.precision(2);
    text << number;
    return text.str();
}

ChoiceBudget budgetOf(const AutoShadowOptions& options) {
    const double error = options.error > 0.0 ? options.error : options.time > 0.0 ? 0.0 : AutoShadowOptions::usualError;
    return {error, options.time > 0.0 ? options.time : infinity};
}

std::string reasonFor(ChoiceReason reason, const ChoiceBudget& budget) {
    const std::string error = rounded(budget.error) + " px", time = rounded(budget.time) + " ms";
    switch (reason) {
    case ChoiceReason::Cheapest:
        return "the cheapest that keeps " + error;
    case ChoiceReason::Kept:
        return "chosen before, and keeps " + error + "; another would save less than a fifth";
    case ChoiceReason::MostAccurate:
        return "the most accurate within " + time;
    case ChoiceReason::ErrorTooSmall:
        return "the most accurate, for none keeps " + error;
    default:
        return "the cheapest, for none keeps " + time;
    }
}

std::string causeOf(ChoiceReason reason, const ChoiceBudget& budget, const ShadowCandidate& chosen) {
    if (reason == ChoiceReason::ErrorTooSmall)
        return "no technique keeps an error of " + rounded(budget.error) + " pixels here; " + chosen.spec +
               " is the most accurate, with " + rounded(chosen.error) + ". Allow a larger error.";
    if (reason == ChoiceReason::TimeTooShort)
        return "no technique keeps a time of " + rounded(budget.time) + " ms here; " + chosen.spec +
               " is the cheapest, with " + rounded(chosen.time) + ". Allow more time.";
    return {};
}

std::vector<ShadowCandidate> judgedOf(const std::vector<AutoCandidate>& all, const AutoCosts& costs,
                                      const AutoMotion& motion) {
    std::vector<ShadowCandidate> result;
    for (const AutoCandidate& candidate : all) result.push_back(candidate.judged(costs, motion));
    std::stable_sort(result.begin(), result.end(), [](const ShadowCandidate& a, const ShadowCandidate& b) {
        return std::make_pair(!a.obstacle.empty(), a.time) < std::make_pair(!b.obstacle.empty(), b.time);
    });
    return result;
}

/// A share of the recent frames, one frame later. All of the first frames count alike.
double followed(double share, double now, unsigned frames) {
    const double weight = std::max(1.0 - memory, 1.0 / frames), next = (1.0 - weight) * share + weight * now;
    return next < atRest ? 0.0 : next;
}

std::string describe(ReceiverKind kind) {
    if (kind == ReceiverKind::Usual) return {};
    return kind == ReceiverKind::Late ? "drawn late" : "with a depth range or polygon offset";
}

bool isMoving(const AutoMotion& motion) { return motion.scene > 0.0 || motion.view > 0.0; }

} // namespace

bool AutoChooser::Seen::hasSameMotion(const Seen& other) const {
    return light == other.light && casters == other.casters;
}

bool AutoChooser::Seen::hasSameView(const Seen& other) const {
    return eyeFromGroup == other.eyeFromGroup && projection == other.projection && leaves == other.leaves;
}

bool AutoChooser::Seen::asks(const Seen& other) const {
    return pixels == other.pixels && composite == other.composite && reservedBits == other.reservedBits &&
           lights == other.lights && dark == other.dark && faint == other.faint && receiver == other.receiver &&
           error == other.error && time == other.time && light.inGroup.w() == other.light.inGroup.w() &&
           casters->list.size() == other.casters->list.size();
}

AutoChooser::Choice& AutoChooser::find(const AutoView& view) {
    auto* known = _choices.find(
        [&](const auto& choice) { return choice->stage == view.frame.stage && choice->light == view.light.number; });
    Choice& choice = known ? **known : *_choices.add(std::make_unique<Choice>());
    if (!known) choice.stage = view.frame.stage, choice.light = view.light.number;
    if (view.frame.frameNumber != _frame || (known && choice.lastRound == _round)) {
        _frame = view.frame.frameNumber;
        ++_round;
    }
    choice.lastRound = _round;
    choice.renderStage = view.frame.renderStage;
    choice.kind = view.frame.kind;
    _choices.dropWhile([this](const auto& old) { return _round - old->lastRound > keptRounds; });
    return choice;
}

/// Whether the candidates are to be compared. A choice that is right only as long as things lie as they lie is looked at
/// whenever they do not.
bool AutoChooser::isDue(Choice& choice, const Seen& now, const AutoView& view, const Selection& receiver) {
    ++choice.frames;
    if (choice.decision.decisions == 0) return true;
    const bool same = now.isSame(choice.last);
    const bool moves = !now.hasSameMotion(choice.last), flies = !moves && !now.hasSameView(choice.last);
    choice.motion = {moves ? 1.0 : 0.0, flies ? 1.0 : 0.0};
    const bool rested = !isMoving(choice.moving);
    ++choice.seen;
    choice.moving = {followed(choice.moving.scene, choice.motion.scene, choice.seen),
                     followed(choice.moving.view, choice.motion.view, choice.seen)};
    choice.since = rested ? 0 : choice.since + (moves || flies);
    choice.last = now;
    if (!now.asks(choice.decided) || (!choice.incumbent && choice.learnt != _costs->generation())) return true;
    if (!same && !whyWrong(choice.candidate, view, receiver, _known).empty()) return true;
    if (choice.seen == firstLook && isMoving(choice.moving)) return true; // the first decision took all to stand still
    if (choice.incumbent) return false;                                   // the end of a trial compares them
    const bool began = choice.since >= settling && isMoving(choice.motion) && !isMoving(choice.movingThen);
    if (began) return true; // the last decision took all to stand still, too
    const bool cameToRest = !isMoving(choice.moving) && isMoving(choice.movingThen);
    const bool isSettled = !isMoving(choice.moving) || choice.since >= settling;
    return choice.frames >= choice.patience && isSettled && (cameToRest || !now.isSame(choice.decided));
}

void AutoChooser::decide(Choice& choice, const Seen& now, const AutoView& view, const Selection& receiver,
                         const AutoShadowOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const ChoiceBudget budget = budgetOf(options);
    const bool tried = choice.incumbent.has_value();
    if (tried) choice.candidate = *choice.incumbent;
    choice.incumbent.reset();
    choice.learnt = _costs->generation();
    const AutoCosts costs = _costs->now();
    const CandidateList list = listCandidates(view, receiver, budget.error, _known);
    const AutoMotion expected{std::max(choice.moving.scene, rarely), choice.moving.view};
    std::vector<ChoiceCandidate> judged;
    std::optional<std::size_t> before;
    for (const AutoCandidate& candidate : list.all) {
        if (choice.decision.decisions > 0 && candidate.isSame(choice.candidate)) before = judged.size();
        judged.push_back({candidate.obstacle.empty(), candidate.error, candidate.time(costs, expected)});
    }
    const auto chosen = chooseCandidate(judged, budget, before);
    const std::size_t index = chosen ? chosen->index : 0;
    const ChoiceReason reason = chosen ? chosen->reason : ChoiceReason::Cheapest;
    ShadowDecision& decision = choice.decision;
    const bool changes = decision.decisions > 0 && !list.all[index].isSame(choice.candidate);
    choice.candidate = list.all[index];
    decision.light = view.light.number;
    decision.chosen = choice.candidate.judged(costs, expected);
    decision.reason = list.nothing.empty() ? reasonFor(reason, budget) : "none is needed: " + list.nothing;
    decision.keepsBudget = reason != ChoiceReason::ErrorTooSmall && reason != ChoiceReason::TimeTooShort;
    decision.candidates = judgedOf(list.all, costs, expected);
    decision.changes += changes ? 1 : 0;
    if (changes || tried) choice.taken = std::make_shared<std::atomic<double>>(0.0);
    ++decision.decisions;
    choice.cause = list.nothing.empty() ? causeOf(reason, budget, decision.chosen) : "";
    choice.decided = choice.last = now;
    choice.movingThen = choice.moving;
    choice.frames = 0;
    findRivals(choice, list.all, judged, budget, index);
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    choice.patience = std::max(leastPatience, unsigned(std::min(took.count() / decisionTime, mostPatience)));
}

/// Candidates that would be drawn if they took less than is thought. A kind is tried until its time is known. What made the
/// prediction too high for the one that is drawn may be a part that all share.
void AutoChooser::findRivals(Choice& choice, const std::vector<AutoCandidate>& all,
                             const std::vector<ChoiceCandidate>& judged, const ChoiceBudget& budget,
                             std::size_t chosen) const {
    choice.rivals.clear();
    if (!_costs->areMeasured()) return;
    const double shared = std::min(1.0, _costs->now().factors[std::size_t(all[chosen].kind)].still);
    const bool flies = choice.moving.view > 0.0; // then maps cannot be measured
    for (std::size_t kind = 0; kind < AutoCosts::kinds; ++kind) {
        const bool isDrawn = kind == std::size_t(all[chosen].kind); // and measured as long as it is
        if (isDrawn || choice.trials[kind] >= mostTrials || _costs->isKnown(AutoCandidate::Kind(kind))) continue;
        std::vector<ChoiceCandidate> hopeful = judged;
        for (std::size_t i = 0; i < all.size(); ++i)
            if (std::size_t(all[i].kind) == kind) hopeful[i].time *= shared / doubt;
        const auto best = chooseCandidate(hopeful, budget, chosen);
        if (!best || std::size_t(all[best->index].kind) != kind) continue;
        const AutoCandidate& rival = all[best->index];
        if (!flies || !rival.hasMap()) choice.rivals.push_back(rival);
    }
}

bool AutoChooser::isTrialDue(const Choice& choice) const {
    return choice.frames >= trialFrames && (choice.incumbent || (choice.alone && !choice.rivals.empty()));
}

/// What was right when the candidates were compared may be wrong by now.
/// @return false if no rival is left that can be measured now.
bool AutoChooser::tryRival(Choice& choice, const AutoView& view, const Selection& receiver) {
    std::vector<AutoCandidate>& rivals = choice.rivals;
    while (!rivals.empty() && !whyWrong(rivals.back(), view, receiver, _known).empty()) rivals.pop_back();
    if (rivals.empty() || (rivals.back().hasMap() && choice.motion.view > 0.0)) return false; // see isMeasured()
    if (!choice.incumbent) choice.incumbent = choice.candidate;
    choice.candidate = rivals.back();
    rivals.pop_back();
    ++choice.trials[std::size_t(choice.candidate.kind)];
    choice.taken = std::make_shared<std::atomic<double>>(0.0);
    choice.frames = 0;
    return true;
}

AutoChooser::Drawn AutoChooser::choose(const AutoView& view, const Selection& receiver,
                                       const AutoShadowOptions& options) {
    Lock lock(_mutex);
    Choice& choice = find(view);
    _lastRenderStage = view.frame.renderStage;
    if (_casters != &view.casters) {
        _casters = &view.casters;
        _known.bodies.keepMostly(view.casters);
    }
    _known.flat.reset();
    const Seen now{view.frame.eyeFromGroup,
                   view.frame.projection,
                   view.frame.pixels,
                   view.light,
                   &view.casters,
                   fingerprintOf(view.frame.seen),
                   view.frame.group->getComposite(),
                   view.frame.options.reservedStencilBits,
                   view.frame.lights,
                   view.frame.dark,
                   isFaint(view),
                   receiver,
                   options.error,
                   options.time};
    if (isDue(choice, now, view, receiver) ||
        (isTrialDue(choice) && !tryRival(choice, view, receiver) && choice.incumbent))
        decide(choice, now, view, receiver, options);
    return {sharesOf(choice.candidate, view, receiver), choice.cause, surfacesOf(choice, now, view),
            isMeasured(choice)};
}

std::vector<AutoChooser::Drawn::Share> AutoChooser::sharesOf(const AutoCandidate& candidate, const AutoView& view,
                                                             const Selection& receiver) {
    if (candidate.kind == AutoCandidate::Kind::Nothing) return {};
    if (candidate.kind != AutoCandidate::Kind::Mixed) return {{_inner.of(candidate, receiver, _round), view.meshes}};
    const CasterSplit& split = _known.splits.of(view.casters);
    AutoCandidate volume, map = candidate;
    volume.kind = AutoCandidate::Kind::Volume;
    map.kind = AutoCandidate::Kind::Map;
    return {{_inner.of(volume, receiver, _round), split.simple(view.meshes)},
            {_inner.of(map, receiver, _round), split.dense(view.meshes)}};
}

std::shared_ptr<const LeafSet> AutoChooser::surfacesOf(Choice& choice, const Seen& now, const AutoView& view) {
    if (!relightsAlone(choice.candidate, view)) {
        choice.flatIn.reset();
        return nullptr;
    }
    if (!choice.flatIn || !now.isSame(*choice.flatIn)) {
        choice.flat = FlatLeaves(view.frame.seen, _known.flatIn(view).leaves);
        choice.flatIn = now;
    }
    return choice.flat.in(view.frame.seen);
}

/// A few frames after a decision, and one now and then while things move: measuring waits for OpenGL. A map that another
/// view may or may not have drawn again tells nothing.
bool AutoChooser::isMeasured(const Choice& choice) const {
    const unsigned since = choice.frames;
    const bool early = (since >= 3 && since <= 5) || (since <= 64 && since >= 8 && (since & (since - 1)) == 0);
    const bool known = !choice.candidate.hasMap() || choice.motion.view == 0.0;
    return _costs->areMeasured() && choice.candidate.kind != AutoCandidate::Kind::Nothing && known &&
           (early || (isMoving(choice.moving) && since % 64 == 0 && since > 0));
}

void AutoChooser::prepared(const void* stage, int light, double time) {
    Lock lock(_mutex);
    for (const auto& choice : _choices)
        if (choice->stage == stage && choice->light == light) choice->prepared = time;
}

osg::ref_ptr<DrawWatch> AutoChooser::watch(const void* stage, bool alone) {
    if (!_costs->areMeasured()) return nullptr;
    Lock lock(_mutex);
    std::optional<FrameCosts::Frame> frame;
    bool measured = true;
    const auto isOfView = [&](const auto& choice) { return choice->stage == stage && choice->lastRound == _round; };
    for (const auto& choice : _choices) {
        if (!isOfView(choice)) continue;
        measured = measured && isMeasured(*choice);
        if (!frame) frame = FrameCosts::Frame{choice->candidate.kind, {}, 0.0, choice->taken};
        alone = alone && frame->kind == choice->candidate.kind;
        frame->work += choice->candidate.still;
        if (choice->motion.scene > 0.0) frame->work += choice->candidate.change, frame->moving = true;
        frame->prepared += choice->prepared;
    }
    for (const auto& choice : _choices)
        if (isOfView(choice)) choice->alone = alone;
    if (!alone || !measured) frame.reset();
    return frame || !_costs->knowRenderer() ? new CostWatch(*_costs, frame) : nullptr;
}

std::vector<ShadowDecision> AutoChooser::lastDecision() const {
    Lock lock(_mutex);
    std::vector<const Choice*> last; // in the order in which they were asked for
    for (const auto& choice : _choices)
        if (choice->renderStage == _lastRenderStage && choice->lastRound == _round) last.push_back(choice.get());
    std::stable_sort(last.begin(), last.end(), [](const Choice* a, const Choice* b) {
        return std::make_pair(a->light, a->kind) < std::make_pair(b->light, b->kind);
    });
    std::vector<ShadowDecision> result;
    for (const Choice* choice : last) {
        result.push_back(choice->decision);
        result.back().receivers = describe(choice->kind);
        if (choice->incumbent) result.back().onTrial = choice->candidate.spec();
        result.back().measured = *choice->taken;
    }
    return result;
}

unsigned AutoChooser::passes() const {
    Lock lock(_mutex);
    return _inner.passes();
}

bool AutoChooser::takesDrawables() const {
    Lock lock(_mutex);
    const auto does = [](const auto& choice) { return choice->candidate.kind == AutoCandidate::Kind::Terrain; };
    return _choices.begin() != _choices.end() && std::all_of(_choices.begin(), _choices.end(), does);
}

void AutoChooser::forEach(const std::function<void(ShadowTechnique&)>& visit) const {
    Lock lock(_mutex);
    _inner.forEach(visit);
}

} // namespace gnomon
