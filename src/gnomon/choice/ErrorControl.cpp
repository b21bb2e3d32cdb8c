// SPDX-License-Identifier: MIT
#include <gnomon/choice/ErrorControl.h>

#include <algorithm>

namespace gnomon {
namespace {

constexpr int late = 4;            // frames whose times may still be those of the error before
constexpr int enoughSlow = 4;      // frames in a row: a single one has another reason
constexpr int mostPatience = 4096; // frames
constexpr int soon = 64;           // frames: what is slow so soon was made so by the tighter error

} // namespace

ErrorControl::ErrorControl(double from, double finest)
    : _error(std::max(from, finest)), _finest(finest), _loosest(std::max(_error, loosest)) {}

void ErrorControl::set(double error) {
    _tightened = error < _error;
    _error = error;
    _frames = _slow = _quick = 0;
}

void ErrorControl::add(double taken, double wanted) {
    if (!(taken > 0.0) || ++_frames <= late) return;
    const bool slow = taken > wanted, quick = taken < wanted / 2.0;
    _slow = slow ? _slow + 1 : 0;
    _quick = quick ? _quick + 1 : 0;
    if (_slow >= enoughSlow) {
        if (_tightened && _frames <= soon) _patience = std::min(2 * _patience, mostPatience);
        _tooSlow = _error >= _loosest;
        if (!_tooSlow) set(std::min(2.0 * _error, _loosest));
    } else if (!slow) {
        _tooSlow = false;
        if (_quick >= _patience && _error > _finest) set(std::max(_error / 2.0, _finest));
    }
}

} // namespace gnomon
