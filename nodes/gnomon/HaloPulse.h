// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>

#include <osg/Callback>

namespace gnomon {

/// Update callback of a HaloNode: when started, the halo grows and shrinks once, scale = 1 + a · sin t, t += 0.1 a frame,
/// until it falls back to 1; then the scale is 1. Of PIXELS it changes nothing.
///
///     halo->setUpdateCallback(pulse);    pulse->start();
///
/// Threads of the update traversal, as start() must be.
/// Source: M. Kilgard, halomagic.c.
class GNOMON_EXPORT HaloPulse : public osg::Callback {
public:
    HaloPulse() = default;
    explicit HaloPulse(double amplitude) { setAmplitude(amplitude); }
    HaloPulse(const HaloPulse& other, const osg::CopyOp& copyOp = osg::CopyOp::SHALLOW_COPY)
        : osg::Object(other, copyOp), osg::Callback(other, copyOp), _amplitude(other._amplitude) {}
    META_Object(gnomon, HaloPulse)

    /// a: how much larger at most, 0 … 999; default 0.2. Clamped; NaN is refused with a warning.
    void setAmplitude(double amplitude);
    double getAmplitude() const { return _amplitude; }

    /// From the next frame on; from its beginning if it is under way.
    void start() { _time = 0.0, _running = true; }
    bool isRunning() const { return _running; }

    bool run(osg::Object* object, osg::Object* data) override;

protected:
    ~HaloPulse() override = default;

private:
    double _amplitude = 0.2;
    double _time = 0.0;
    bool _running = false;
};

} // namespace gnomon
