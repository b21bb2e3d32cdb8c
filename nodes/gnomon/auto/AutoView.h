// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowLight.h>
#include <gnomon/group/FrameCasters.h>
#include <gnomon/group/ViewFrame.h>

#include <glm/vec4.hpp>

#include <cstdint>
#include <string>

namespace gnomon {

/// What a decision is about: one light in one view, and the casters.
struct AutoView {
    const ViewFrame& frame;
    const ShadowLight& light;
    const FrameCasters& meshes;     ///< of the casters; a decision alone asks for them.
    const CasterDrawables& casters; ///< the same, drawable by drawable.
    glm::dvec4 towards;             ///< the light, group frame: w = 0 and length 1, or w = 1.
};

/// The least change of a channel that can be seen.
constexpr double leastContrast = 2.0 / 255.0;

/// Stands for the drawables that can receive, and where they are in the view.
std::uint64_t fingerprintOf(const std::vector<const osgUtil::RenderLeaf*>& leaves);

/// True if nobody could see that the receivers lose a light: with all that are fainter it gives them less than two of 255
/// steps of any channel.
bool isFaint(const AutoView& view);

/// True if what is drawn so shows no more of a light than the light gives: by OpenGL's own lighting.
bool isShadedByOpenGl(const osgUtil::StateGraph* graph);

/// Why casters need a technique that knows their textures; empty if they do not.
std::string whyCutOut(const CasterDrawables& casters);

/// Triangles of a drawable, by its primitives; an estimate where it is no geometry.
double trianglesOf(const osg::Drawable& drawable);

/// Triangles of these leaves that are drawn again where marks are within these bounds.
double trianglesWithin(const std::vector<const osgUtil::RenderLeaf*>& leaves, const ScreenRect& bounds);

/// Pixels within these bounds.
double pixelsOf(const ViewFrame& frame, const ScreenRect& bounds);

} // namespace gnomon
