// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon {

/// The error that keeps a time: loosened twofold where shadows take longer, and tightened where they take less than half.
///
/// A tighter error that turned out too dear is tried again after twice as many frames as the time before.
class ErrorControl {
public:
    static constexpr double tightest = 0.125, loosest = 8.0; ///< pixels.

    /// @param from    pixels, the first error. It may be looser than `loosest`.
    /// @param finest  pixels: no tighter error is wanted.
    ErrorControl(double from, double finest);

    /// Pixels.
    double error() const { return _error; }
    /// True if even the loosest error takes longer.
    bool isTooSlow() const { return _tooSlow; }
    /// Takes what the shadows of a frame took.
    /// @param wanted  at most. Both in one unit. A number that is not above 0 counts for nothing.
    void add(double taken, double wanted);

private:
    void set(double error);

    double _error, _finest, _loosest;
    int _frames = 0;           ///< since the error changed; the first of them do not count.
    int _slow = 0, _quick = 0; ///< of the counted frames since the last ones of the other kind.
    int _patience = 32;        ///< quick frames before the error is tightened.
    bool _tightened = false;   ///< by the last change.
    bool _tooSlow = false;
};

} // namespace gnomon
