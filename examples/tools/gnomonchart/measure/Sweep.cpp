// SPDX-License-Identifier: MIT
#include "Sweep.h"
#include "Contender.h"
#include "Yardstick.h"

#include <algorithm>
#include <exception>
#include <limits>
#include <map>

namespace gnomon::examples {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t narrowKnobs = 2, narrowValues = 3;

class Sweep {
public:
    Sweep(const Peer& peer, const Yardstick& yardstick, const std::function<bool()>& goesOn)
        : _peer(peer), _yardstick(yardstick), _goesOn(goesOn) {
        for (const Knob& knob : peer.knobs)
            if (!knob.values.empty()) _best[knob.name] = knob.fallback;
        _bestScore = scoreOf(_best);
    }

    /// The knob to its best value, the others as they are.
    void turn(const Knob& knob, std::size_t values) {
        for (std::size_t i = 0; i < knob.values.size() && i < values && _goesOn(); ++i) {
            Places tried = _best;
            tried[knob.name] = knob.values[i];
            const double got = scoreOf(tried);
            if (!(got < _bestScore)) continue;
            _bestScore = got;
            _best = tried;
        }
    }

    Settings best() const { return settingsOf(_best); }

private:
    using Places = std::map<std::string, std::string>;

    /// Without what stands at its default.
    Settings settingsOf(const Places& places) const {
        Settings settings;
        for (const Knob& knob : _peer.knobs) {
            const auto place = places.find(knob.name);
            if (place != places.end() && place->second != knob.fallback) settings.push_back(*place);
        }
        return settings;
    }

    double scoreOf(const Places& places) {
        const auto known = _scores.find(places);
        if (known != _scores.end()) return known->second;
        double result = infinite;
        try {
            Sight sight(peerContender(_peer, "", settingsOf(places)), _yardstick.scene());
            result = score(metrics::shadowMetrics(sight.visibility(), _yardstick.maps(), _yardstick.limits()));
        } catch (const std::exception&) {
            // these settings do not work here
        }
        return _scores[places] = result;
    }

    const Peer& _peer;
    const Yardstick& _yardstick;
    const std::function<bool()>& _goesOn;
    Places _best;
    double _bestScore = infinite;
    std::map<Places, double> _scores;
};

} // namespace

double score(const metrics::ShadowMetrics& metrics) {
    if (metrics.catastrophes.any()) return infinite;
    const double wrong = 100.0 * metrics.headline.misclassified().value_or(0.0),
                 teeth = metrics.agreeing ? 100.0 * double(metrics.teeth.value_or(0)) / double(metrics.agreeing) : 0.0;
    return (metrics.boundary ? metrics.boundary->p95 : 0.0) + wrong + teeth;
}

Settings bestSettings(const Peer& peer, const Yardstick& yardstick, SweepWidth width,
                      const std::function<bool()>& goesOn) {
    const bool wide = width == SweepWidth::WIDE;
    Sweep sweep(peer, yardstick, goesOn);
    const std::size_t knobs = wide ? peer.knobs.size() : std::min(peer.knobs.size(), narrowKnobs);
    for (std::size_t i = 0; i < knobs; ++i)
        sweep.turn(peer.knobs[i], wide ? peer.knobs[i].values.size() : narrowValues);
    if (!peer.knobs.empty()) sweep.turn(peer.knobs.front(), wide ? peer.knobs.front().values.size() : narrowValues);
    Settings best = sweep.best();
    if (!peer.scenesLight.empty()) best.emplace_back("ambientBias", peer.scenesLight);
    return best;
}

} // namespace gnomon::examples
