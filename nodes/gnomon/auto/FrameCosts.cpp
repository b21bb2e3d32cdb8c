// SPDX-License-Identifier: MIT
#include <gnomon/auto/FrameCosts.h>
#include <gnomon/gl/DrawClock.h>

#include <OpenThreads/ScopedLock>

namespace gnomon {
namespace {

using Lock = OpenThreads::ScopedLock<OpenThreads::Mutex>;

} // namespace

AutoCosts FrameCosts::now() {
    Lock lock(_mutex);
    if (!_rates) _rates = (_measured ? RendererCosts::expected() : std::nullopt).value_or(CostRates());
    AutoCosts result{*_rates, {}};
    for (std::size_t i = 0; i < AutoCosts::kinds; ++i) {
        const double still = _still[i].factor();
        result.factors[i] = {still, _moving[i].isKnown() ? _moving[i].factor() : still};
    }
    return result;
}

bool FrameCosts::isKnown(AutoCandidate::Kind kind) {
    Lock lock(_mutex);
    return _still[std::size_t(kind)].isKnown() || _moving[std::size_t(kind)].isKnown();
}

void FrameCosts::learn(osg::RenderInfo& renderInfo) {
    if (_knowRenderer) return;
    const CostRates rates = RendererCosts::of(renderInfo);
    Lock lock(_mutex);
    if (!(_rates == rates)) ++_generation;
    _rates = rates;
    _knowRenderer = true;
}

double FrameCosts::predicted(const Frame& frame) const { return timeOf(frame.work, _rates.value_or(CostRates())); }

void FrameCosts::add(const Frame& frame, double drawn) {
    const double taken = frame.prepared + drawn;
    *frame.taken = taken;
    Lock lock(_mutex);
    CostCorrection& correction = (frame.moving ? _moving : _still)[std::size_t(frame.kind)];
    const bool wasKnown = correction.isKnown(), changed = correction.add(taken, predicted(frame));
    if (changed || (frame.moving && correction.isKnown() && !wasKnown)) ++_generation; // until then the still one's
}

CostWatch::CostWatch(FrameCosts& costs, std::optional<FrameCosts::Frame> frame)
    : _costs(&costs), _frame(std::move(frame)) {}

CostWatch::~CostWatch() = default;

void CostWatch::begin(osg::RenderInfo& renderInfo) {
    _costs->learn(renderInfo);
    if (!_frame) return;
    _clock = std::make_unique<DrawClock>(*renderInfo.getState());
    _clock->start();
}

void CostWatch::end(osg::RenderInfo&) {
    if (_clock) _costs->add(*_frame, _clock->stop());
    _clock.reset();
}

} // namespace gnomon
