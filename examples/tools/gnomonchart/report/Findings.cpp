// SPDX-License-Identifier: MIT
#include "Findings.h"

#include "GnuplotText.h"

#include <algorithm>

namespace gnomon::examples {
namespace {

std::string nameOf(const BestPoint& best) {
    std::string name = best.curve->ours() ? best.curve->technique : best.curve->kit + " " + best.curve->technique;
    if (best.curve->points.size() > 1) name += ", " + best.point->setting;
    return name;
}

std::string numbersOf(const CurvePoint& point) {
    return shortNumber(point.time.median) + " ms, " + shortNumber(point.error) + " px";
}

std::string described(const BestPoint& best) { return nameOf(best) + " (" + numbersOf(*best.point) + ")"; }

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : "; ") + name;
    return text;
}

/// The sound points of Gnomon, or those of its peers.
std::vector<BestPoint> soundOf(const std::vector<Curve>& curves, bool ours) {
    std::vector<BestPoint> sound = soundPoints(curves);
    const auto others = [ours](const BestPoint& point) { return point.curve->ours() != ours; };
    sound.erase(std::remove_if(sound.begin(), sound.end(), others), sound.end());
    return sound;
}

/// Whether it costs no more and errs no more.
bool matches(const CurvePoint& point, const CurvePoint& other) {
    return point.time.median <= other.time.median && point.error <= other.error;
}

/// The same but for what runs differ by.
bool nearlyMatches(const CurvePoint& point, const CurvePoint& other) {
    constexpr double ms = 1.0, share = 0.1;
    return point.time.median <= other.time.median + std::max(ms, share * other.time.median) &&
           point.error <= (1.0 + share) * other.error;
}

/// The most accurate of those that cost no more; null if all cost more.
const BestPoint* mostAccurateWithin(const std::vector<BestPoint>& points, double ms) {
    const BestPoint* best = nullptr;
    for (const BestPoint& each : points)
        if (each.point->time.median <= ms && (!best || each.point->error < best->point->error)) best = &each;
    return best;
}

/// Peers among the best that Gnomon has nothing against.
std::vector<BestPoint> victors(const std::vector<Curve>& curves, const std::vector<BestPoint>& ours) {
    std::vector<BestPoint> found;
    for (const BestPoint& best : staircase(curves)) {
        const auto holds = [&](const BestPoint& own) { return matches(*own.point, *best.point); };
        if (!best.curve->ours() && std::none_of(ours.begin(), ours.end(), holds)) found.push_back(best);
    }
    return found;
}

std::string beatenSentence(const std::string& peers, const BestPoint* nearest, bool anyOurs) {
    if (nearest)
        return "A peer beats every Gnomon technique: " + peers +
               ". At equal or lower cost, the most accurate of Gnomon's is " + described(*nearest) + ".";
    return std::string(anyOurs ? "A peer is cheaper than every Gnomon technique: "
                               : "No Gnomon technique gives a sound shadow here, but a peer does: ") +
           peers + ".";
}

/// A sentence for each point of Gnomon that is the most accurate for what some victors cost.
std::vector<std::string> beatenSentences(const std::vector<Curve>& curves) {
    const std::vector<BestPoint> ours = soundOf(curves, true), peers = victors(curves, ours);
    std::vector<std::string> sentences;
    for (std::size_t i = 0; i < peers.size();) {
        const BestPoint* nearest = mostAccurateWithin(ours, peers[i].point->time.median);
        std::vector<std::string> names;
        for (; i < peers.size() && mostAccurateWithin(ours, peers[i].point->time.median) == nearest; ++i)
            names.push_back(described(peers[i]));
        sentences.push_back(beatenSentence(listed(names), nearest, !ours.empty()));
    }
    return sentences;
}

/// Peers that none of Gnomon's comes near to.
std::vector<std::string> peersAhead(const std::vector<Curve>& curves) {
    const std::vector<BestPoint> ours = soundOf(curves, true);
    std::vector<std::string> names;
    for (const BestPoint& peer : soundOf(curves, false)) {
        const auto isNear = [&](const BestPoint& own) { return nearlyMatches(*own.point, *peer.point); };
        if (std::none_of(ours.begin(), ours.end(), isNear)) names.push_back(described(peer));
    }
    return names;
}

std::string marginSentence(const std::vector<std::string>& ahead) {
    if (ahead.empty())
        return "The lead is within the variation between runs: at most 1 ms or a tenth of the time, and a tenth of the "
               "error.";
    return "The lead exceeds 1 ms and a tenth of the time, or a tenth of the error: " + listed(ahead) + ".";
}

std::string bestSentence(const std::vector<Curve>& curves) {
    std::vector<std::string> names;
    for (const BestPoint& best : staircase(curves)) names.push_back(described(best));
    if (names.empty()) return "No technique gives a sound shadow here.";
    return "The best for their time, from the fastest to the most accurate: " + listed(names) + ".";
}

/// Gnomon's techniques of which every sound point is matched by some peer's.
std::string outdoneSentence(const std::vector<Curve>& curves) {
    const std::vector<BestPoint> theirs = soundOf(curves, false), ours = soundOf(curves, true);
    std::vector<std::string> names;
    for (const Curve& curve : curves) {
        bool any = false, all = true;
        for (const BestPoint& own : ours) {
            if (own.curve != &curve) continue;
            any = true;
            all = all && std::any_of(theirs.begin(), theirs.end(),
                                     [&](const BestPoint& peer) { return matches(*peer.point, *own.point); });
        }
        if (any && all) names.push_back(curve.technique);
    }
    if (names.empty()) return "";
    return "Never worth it here, because at each setting a peer costs no more and errs no more: " + listed(names) + ".";
}

std::string catastropheSentence(const std::vector<Curve>& curves) {
    std::vector<std::string> names;
    for (const Curve& curve : curves) {
        const auto bad = std::count_if(curve.points.begin(), curve.points.end(),
                                       [](const CurvePoint& point) { return point.catastrophic; });
        const auto all = curve.points.size();
        const std::string share =
            all == 1 ? "" : " (" + std::to_string(bad) + " of " + std::to_string(all) + " settings)";
        if (bad > 0) names.push_back((curve.ours() ? "" : curve.kit + " ") + curve.technique + share);
    }
    return names.empty() ? "" : "Failed or catastrophic: " + listed(names) + ".";
}

/// Whether a kit's techniques were timed in a scene, or could not be; not in a run that ended before.
bool tried(const ChartResults& results, const std::string& scene, bool ours) {
    return std::any_of(results.points.begin(), results.points.end(), [&](const ChartPoint& point) {
        return point.scene == scene && point.ours() == ours && (point.cost || !point.failure.empty());
    });
}

std::string notJudgedSentence(bool ours, bool peers) {
    if (!ours && !peers) return "Nothing was timed here.";
    return std::string("Only ") + (ours ? "Gnomon's techniques" : "peers") +
           " were timed here, so there is no comparison.";
}

SceneFinding findingOf(const ChartResults& results, const ChartSceneResult& scene, LightMotion light) {
    const std::vector<Curve> curves = sceneCurves(results, scene.name, light);
    const bool ours = tried(results, scene.name, true), peers = tried(results, scene.name, false);
    SceneFinding finding{scene.name, scene.title, light, ours && peers, false, false, {}};
    if (!finding.judged) {
        finding.sentences = {notJudgedSentence(ours, peers)};
        if (ours || peers) finding.sentences.push_back(bestSentence(curves));
        return finding;
    }
    const std::vector<std::string> beaten = beatenSentences(curves);
    const std::vector<std::string> ahead = peersAhead(curves);
    finding.peerBeatsUs = !beaten.empty();
    finding.peerIsAhead = !ahead.empty();
    finding.sentences = {bestSentence(curves)};
    finding.sentences.insert(finding.sentences.end(), beaten.begin(), beaten.end());
    if (finding.peerBeatsUs) finding.sentences.push_back(marginSentence(ahead));
    for (const std::string& sentence : {outdoneSentence(curves), catastropheSentence(curves)})
        if (!sentence.empty()) finding.sentences.push_back(sentence);
    return finding;
}

/// Those of which that holds.
std::vector<std::string> casesWith(const std::vector<SceneFinding>& findings, bool SceneFinding::*that) {
    std::vector<std::string> names;
    for (const SceneFinding& finding : findings)
        if (finding.*that)
            names.push_back(finding.scene + (finding.light == LightMotion::Still ? ", still light" : ", moving light"));
    return names;
}

} // namespace

std::vector<SceneFinding> findings(const ChartResults& results) {
    std::vector<SceneFinding> all;
    for (const ChartSceneResult& scene : results.scenes) {
        const auto here = [&](const ChartPoint& point) { return point.scene == scene.name; };
        if (std::none_of(results.points.begin(), results.points.end(), here)) continue;
        for (const LightMotion light : {LightMotion::Still, LightMotion::Moving})
            all.push_back(findingOf(results, scene, light));
    }
    return all;
}

std::string findingsSummary(const std::vector<SceneFinding>& findings) {
    const std::vector<std::string> beaten = casesWith(findings, &SceneFinding::peerBeatsUs),
                                   ahead = casesWith(findings, &SceneFinding::peerIsAhead);
    const auto judged = casesWith(findings, &SceneFinding::judged).size();
    if (judged == 0) return "No scene is compared, because that needs timings of a Gnomon technique and of a peer.";
    const std::string cases = std::to_string(judged) + " cases (each scene with a still and with a moving light)";
    if (beaten.empty())
        return "In none of " + cases +
               " does a peer beat Gnomon. For every peer, some Gnomon technique costs no more and errs no more.";
    return "In " + std::to_string(beaten.size()) + " of " + cases +
           " a peer beats every Gnomon technique at some cost: " + listed(beaten) +
           ". The lead exceeds 1 ms and a tenth of the time, or a tenth of the error, " +
           (ahead.empty() ? "in none" : "in " + std::to_string(ahead.size()) + ": " + listed(ahead)) + ".";
}

} // namespace gnomon::examples
