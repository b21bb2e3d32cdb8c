// SPDX-License-Identifier: MIT
#include <gnomon/ShadowCasterGroup.h>
#include <gnomon/auto/AutoChooser.h>
#include <gnomon/base/Fingerprint.h>
#include <gnomon/base/NumberText.h>

#include <OpenThreads/ScopedLock>

#include <algorithm>
#include <utility>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

constexpr unsigned keptRounds = 60; // culls without a caster: then all that is kept of casters is let go
constexpr double memory = 0.9;      // of motion, from a frame to the next
constexpr double atRest = 0.01;     // share of frames: 44 without motion after one with it
constexpr unsigned firstLook = 2;   // frames after the first: what moves from the start is known by then
constexpr unsigned settling = 8;    // frames of motion after a rest: a single one should change nothing
// Frames between two decisions that nothing forces: the more triangles are looked at, the more.
constexpr double leastPatience = 16.0, mostPatience = 64.0, trianglesAFrame = 4096.0;
constexpr double another = 0.125; // change of the situation that asks for a decision; see Situation::changeTo()
constexpr double longest = 8.0;   // times as long, and what changes less asks, too: a body that moves among others does
constexpr double muchMore = 1.5;  // times as many triangles are another scene
/// Share of the frames in which things move at least, in the long run: of maps that take the same where all stands still, the
/// small one is taken.
constexpr double rarely = 0.02;

double triangles(const Casters& casters) {
    double sum = 0.0;
    for (const auto& piece : casters.list) sum += double(piece->triangles);
    return sum;
}

std::string reasonFor(ChoiceReason reason, double error) {
    const std::string budget = textOf(error) + " px";
    if (reason == ChoiceReason::Cheapest) return "the cheapest that keeps " + budget;
    if (reason == ChoiceReason::MoreAccurate)
        return "the most accurate of those that keep " + budget + " and take hardly more than the cheapest";
    if (reason == ChoiceReason::Kept) return "chosen before, and keeps " + budget + "; no other is better by a tenth";
    return "the most accurate, for none keeps " + budget;
}

std::string causeOf(double error, const ShadowCandidate& chosen) {
    return "no technique keeps an error of " + textOf(error) + " pixels here; " + chosen.spec +
           " is the most accurate, with " + roundedText(chosen.error) + ". Allow a larger error.";
}

/// The usable ones first, by their times.
std::vector<ShadowCandidate> judgedOf(const std::vector<AutoCandidate>& all, const RendererRates& rates,
                                      const AutoMotion& motion) {
    std::vector<ShadowCandidate> result;
    for (const AutoCandidate& candidate : all) result.push_back(candidate.judged(rates, motion));
    std::stable_sort(result.begin(), result.end(), [](const ShadowCandidate& a, const ShadowCandidate& b) {
        return std::make_pair(!a.obstacle.empty(), a.time) < std::make_pair(!b.obstacle.empty(), b.time);
    });
    return result;
}

/// A share of the recent frames, one frame later. All of the first frames count alike.
double followed(double share, bool now, unsigned frames) {
    const double weight = std::max(1.0 - memory, 1.0 / frames), next = (1.0 - weight) * share + (now ? weight : 0.0);
    return next < atRest ? 0.0 : next;
}

std::string describe(ReceiverKind kind) {
    if (kind == ReceiverKind::Usual) return {};
    return kind == ReceiverKind::Late ? "drawn late" : "with a depth range or polygon offset";
}

} // namespace

/// Keeps no caster alive.
AutoChooser::Seen AutoChooser::seenIn(const ShadowInView& shadow, const Selection& receiver, double error) const {
    const ViewFrame& frame = shadow.view;
    Fingerprint light, sight, asked;
    for (int i = 0; i < 4; ++i) light.mix(shadow.light.inGroup[i]);
    for (int i = 0; i < 3; ++i) light.mix(shadow.light.direction[i]);
    light.mix(shadow.light.cutoff);
    sight.mix(frame.eyeFromGroup);
    sight.mix(frame.projection);
    sight.mix(frame.seenValue);
    for (const double number :
         {frame.pixels.x(), frame.pixels.y(), double(frame.group->getComposite()),
          double(frame.options.reservedStencilBits), double(frame.lights), double(frame.group->getDark()),
          double(isFaint(shadow)), shadow.light.inGroup.w(), double(receiver.mask), double(_renderer->value.load())})
        asked.mix(number);
    for (const osg::ref_ptr<osg::Node>& root : receiver.roots()) asked.mix(static_cast<const void*>(root.get()));
    return {light.value(), shadow.casters.fingerprint, sight.value(), asked.value(), error};
}

/// Whether the candidates are to be compared. A choice that is right only as long as things lie as they lie is looked at
/// whenever they do not.
bool AutoChooser::isDue(Choice& choice, const Seen& now, const ShadowInView& shadow, const Selection& receiver) {
    ++choice.frames;
    if (choice.decision.decisions == 0) return true;
    const Seen before = std::exchange(choice.last, now);
    const bool turns = now.light != before.light, moves = !turns && now.casters != before.casters,
               flies = !turns && !moves && now.view != before.view;
    const bool rested = !choice.moving.isAny();
    ++choice.seen;
    choice.moving = {followed(choice.moving.light, turns, choice.seen),
                     followed(choice.moving.casters, moves, choice.seen),
                     followed(choice.moving.view, flies, choice.seen)};
    choice.since = rested ? 0 : choice.since + (turns || moves || flies);
    if (now.asked != choice.decided.asked || now.error != choice.decided.error) return true;
    if (choice.seen == firstLook && choice.moving.isAny()) return true; // the first decision took all to stand still
    if (now == before) return false;
    if (!whyWrong(choice.candidate, shadow, receiver, _known).empty()) return true;
    if (now.casters != before.casters && std::max(triangles(shadow.casters), 1.0) > muchMore * choice.triangles)
        return true;
    return choice.since >= settling && !choice.movingThen.isAny(); // so did the last one
}

/// True once the candidates have not been compared for some frames, and things are not as they were then. While they move on, a small
/// change asks for nothing.
bool AutoChooser::isOld(const Choice& choice, const Seen& now, const ShadowInView& shadow) const {
    const double patience = std::clamp(choice.triangles / trianglesAFrame, leastPatience, mostPatience);
    const bool isMoving = choice.moving.isAny(), cameToRest = !isMoving && choice.movingThen.isAny();
    if (choice.frames < patience || (isMoving && choice.since < settling)) return false;
    if (!isMoving) return cameToRest || !(now == choice.decided);
    return choice.frames >= longest * patience || choice.situation.changeTo(Situation(shadow)) >= another;
}

void AutoChooser::decide(Choice& choice, const Seen& now, const ShadowInView& shadow, const CandidateList& list) {
    const RendererRates& rates = ratesOf(_renderer->value);
    const AutoMotion expected{std::max(choice.moving.light, rarely), choice.moving.casters, choice.moving.view};
    ShadowDecision& decision = choice.decision;
    std::vector<ChoiceCandidate> judged;
    std::optional<std::size_t> before;
    for (const AutoCandidate& candidate : list.all) {
        if (decision.decisions > 0 && candidate.isSame(choice.candidate)) before = judged.size();
        judged.push_back(
            {candidate.obstacle.empty(), candidate.error, candidate.time(rates, expected), candidate.flawed});
    }
    const CandidateChoice chosen =
        chooseCandidate(judged, now.error, before, rates.little).value_or(CandidateChoice{0, ChoiceReason::Cheapest});
    const AutoCandidate& candidate = list.all[chosen.index];
    if (decision.decisions > 0 && !candidate.isSame(choice.candidate)) ++decision.changes;
    ++decision.decisions;
    choice.candidate = candidate;
    decision.light = shadow.light.number;
    decision.chosen = candidate.judged(rates, expected);
    decision.reason = list.nothing.empty() ? reasonFor(chosen.reason, now.error) + ": " + candidate.why
                                           : "none is needed: " + list.nothing;
    decision.keepsBudget = chosen.reason != ChoiceReason::ErrorTooSmall;
    decision.candidates = judgedOf(list.all, rates, expected);
    choice.cause = decision.keepsBudget ? "" : causeOf(now.error, decision.chosen);
    choice.decided = choice.last = now;
    choice.movingThen = choice.moving;
    choice.situation = Situation(shadow);
    choice.triangles = triangles(shadow.casters);
    choice.frames = 0;
}

AutoChooser::Drawn AutoChooser::choose(const ShadowInView& shadow, const Selection& receiver,
                                       const AutoShadowOptions& options) {
    Lock lock(_mutex);
    Choice& choice = _choices.of(shadow.view.key, shadow.light.number, shadow.view.frameNumber);
    choice.kind = shadow.view.kind;
    _lastStage = shadow.view.key.stage;
    _idleCulls = 0;
    const Seen now = seenIn(shadow, receiver, options.error > 0.0 ? options.error : AutoShadowOptions::usualError);
    const bool isNeeded = isDue(choice, now, shadow, receiver);
    if (isNeeded || (!choice.search && isOld(choice, now, shadow))) choice.search.emplace();
    while (choice.search) {
        const std::optional<CandidateList> list = choice.search->look(shadow, receiver, _known);
        if (list) decide(choice, now, shadow, *list);
        if (list) choice.search.reset();
        if (!isNeeded) break; // a part a frame
    }
    return {_inner.of(choice.candidate, receiver, _choices.round()), choice.cause};
}

void AutoChooser::beginCull(bool isCurrent) {
    if (isCurrent) _renderer->value = currentRenderer();
    Lock lock(_mutex);
    if (_idleCulls++ != keptRounds) return;
    _inner.clear();
    _choices.dropIf([](const Choice&) { return true; });
    _known = {};
}

void AutoChooser::forgetFacts() {
    Lock lock(_mutex);
    for (const auto& entry : _choices) entry->value.search.reset();
    _known = {};
}

osg::ref_ptr<DrawWatch> AutoChooser::watch() const {
    return _renderer->value == Renderer::Unknown ? _renderer : nullptr;
}

std::vector<ShadowDecision> AutoChooser::lastDecision() const {
    Lock lock(_mutex);
    std::vector<const PerView<Choice>::Entry*> last; // in the order in which they were asked for
    for (const auto& entry : _choices)
        if (entry->view.stage == _lastStage && entry->lastRound == _choices.round()) last.push_back(entry.get());
    std::stable_sort(last.begin(), last.end(), [](const auto* a, const auto* b) {
        return std::make_pair(a->light, a->value.kind) < std::make_pair(b->light, b->value.kind);
    });
    std::vector<ShadowDecision> result;
    for (const auto* entry : last) {
        result.push_back(entry->value.decision);
        result.back().receivers = describe(entry->value.kind);
    }
    return result;
}

unsigned AutoChooser::passes() const {
    Lock lock(_mutex);
    return _inner.passes();
}

void AutoChooser::forEach(const std::function<void(ShadowTechnique&)>& visit) const {
    Lock lock(_mutex);
    _inner.forEach(visit);
}

} // namespace gnomon
