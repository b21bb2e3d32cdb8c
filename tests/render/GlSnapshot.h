// SPDX-License-Identifier: MIT
#pragma once
#include <osg/Camera>
#include <osg/Drawable>

#include <map>
#include <string>
#include <vector>

namespace test {

/// OpenGL's state by name, but for what depends on the drawable drawn last: vertex arrays that are on, which osg::State
/// keeps account of, and the current colour, normal and texture coordinates, which nobody may count on.
using GlSnapshot = std::map<std::string, std::vector<float>>;
/// Of the context that is current.
GlSnapshot glSnapshot();
/// What differs, a line each; empty if nothing does.
std::string difference(const GlSnapshot& expected, const GlSnapshot& actual);

/// A drawable that draws nothing and remembers the state it was drawn in last.
class GlProbe : public osg::Drawable {
public:
    GlProbe();
    GlProbe(const GlProbe& other, const osg::CopyOp& copyOp) : osg::Drawable(other, copyOp) {}
    META_Node(test, GlProbe)
    void drawImplementation(osg::RenderInfo&) const override { _seen = glSnapshot(); }
    const GlSnapshot& seen() const { return _seen; }

private:
    mutable GlSnapshot _seen;
};

/// The same as a camera's draw callback.
class GlProbeCallback : public osg::Camera::DrawCallback {
public:
    void operator()(osg::RenderInfo&) const override { _seen = glSnapshot(); }
    const GlSnapshot& seen() const { return _seen; }

private:
    mutable GlSnapshot _seen;
};

} // namespace test
