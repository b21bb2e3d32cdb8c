// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <osg/Callback>

namespace gnomon {

/// Update callback that makes a HaloNode pulse: after start(), the halo grows and shrinks once.
///
/// Use it to point out a picked object.
///
///     osg::ref_ptr<gnomon::HaloPulse> pulse = new gnomon::HaloPulse;
///     halo->setUpdateCallback(pulse);
///     pulse->start();
///
/// Each frame sets the halo's scale to 1 + a · sin t and adds 0.1 to t, until the scale is back at 1.
///
/// Cost
/// - One setScale() a frame while it runs.
/// Limits
/// - A halo of the shape PIXELS does not change.
/// Threads
/// - The update traversal's. Call start() there or between frames.
/// Source
/// - M. Kilgard, halomagic.c.
class GNOMON_EXPORT HaloPulse : public osg::Callback {
public:
    /// A pulse of amplitude 0.2.
    HaloPulse() = default;
    /// A pulse of the given amplitude.
    explicit HaloPulse(double amplitude) { setAmplitude(amplitude); }
    /// Copies the amplitude. The copy does not run.
    HaloPulse(const HaloPulse& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : osg::Object(other, copyOp), osg::Callback(other, copyOp), _amplitude(other._amplitude) {}
    META_Object(gnomon, HaloPulse)

    /// Largest growth a of the scale, 0 … 999. Default 0.2. Clamped. NaN is refused with a warning.
    void setAmplitude(double amplitude);
    /// See setAmplitude().
    double getAmplitude() const { return _amplitude; }

    /// Starts the pulse at the next frame. Restarts a running pulse.
    void start() { _time = 0.0, _running = true; }
    /// True from start() until the scale is back at 1.
    bool isRunning() const { return _running; }

    /// Sets the scale for one frame. The update traversal calls it.
    bool run(osg::Object* object, osg::Object* data) override;

protected:
    ~HaloPulse() override = default;

private:
    double _amplitude = 0.2;
    double _time = 0.0;
    bool _running = false;
};

} // namespace gnomon
