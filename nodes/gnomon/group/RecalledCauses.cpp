// SPDX-License-Identifier: MIT
#include <gnomon/group/RecalledCauses.h>

#include <algorithm>

namespace gnomon {
namespace {

constexpr unsigned patience = 60;     // frames in which something changes, until all is looked at again
constexpr std::size_t mostKnown = 512; // of askers and lights in a stage: what is forgotten is looked for in each frame

} // namespace

RecalledCauses::Known& RecalledCauses::knownOf(Kind kind, const void* who, int number) {
    const auto found = std::find_if(_known.begin(), _known.end(), [&](const Known& known) {
        return known.kind == kind && known.who == who && known.number == number;
    });
    if (found != _known.end()) return *found;
    if (_known.size() >= mostKnown) _known.erase(_known.begin());
    _known.push_back({kind, who, number});
    _known.back().frames = patience;
    return _known.back();
}

std::string RecalledCauses::causeOf(Kind kind, const void* who, const LitView& view, const State& state,
                                    const std::function<std::string()>& find) {
    Known& known = knownOf(kind, who, view.light.number);
    ++known.frames;
    const bool same = known.casters == view.casters.fingerprint && known.light == view.light.inGroup &&
                      known.state.seen == state.seen;
    const bool waits = known.frames < patience && known.pieces == view.casters.list.size();
    if ((same || waits) && known.state.settings == state.settings) return known.cause;
    known.casters = view.casters.fingerprint;
    known.pieces = view.casters.list.size();
    known.state = state;
    known.light = view.light.inGroup;
    known.frames = 0;
    known.cause = find();
    return known.cause;
}

} // namespace gnomon
