// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Export.h>
#include <gnomon/ScreenPass.h>

#include <osg/Matrixd>
#include <osg/State>
#include <osg/StateSet>

#include <memory>
#include <string>

namespace gnomon {

/// Draws a Mark by a program that says for each pixel what share of the light arrives.
///
/// The program is GLSL 1.30: uniforms of its own, and a function of the place that is seen in the pixel.
///
///     float arrivesAt(vec3 place) { return distance(place.xy, middle) < radius ? 0.0 : 1.0; }
///
/// Cost
/// - A copy of the depths within the pass, and a fragment for each of its pixels.
/// Needs
/// - A depth buffer.
/// Limits
/// - A place is as fine as the depth buffer and floats are: take a frame about an origin near the casters.
/// Threads
/// - Any number of draw threads.
class GNOMON_EXPORT MarkProgram : public osg::Referenced {
public:
    /// @param arrives  GLSL that defines `float arrivesAt(vec3 place)`, 0 … 1.
    explicit MarkProgram(const std::string& arrives);

    /// Draws what the pass wants. Where nothing stands in the depth buffer, all of the light arrives.
    /// @param clipFromFrame  takes the frame in which places are to be given to clip space, as it is drawn.
    /// @param uniforms       the program's own.
    /// @return a cause, as Mark::draw().
    std::string draw(ScreenPass& pass, const osg::Matrixd& clipFromFrame, const osg::StateSet& uniforms) const;

    /// As of osg::Node. The technique that owns the program calls it.
    void resizeGLObjectBuffers(unsigned maxSize);
    /// As of osg::Node. The technique that owns the program calls it.
    void releaseGLObjects(osg::State* state = nullptr) const;

protected:
    ~MarkProgram() override;

private:
    struct Parts;
    const std::unique_ptr<Parts> _parts;
};

} // namespace gnomon
