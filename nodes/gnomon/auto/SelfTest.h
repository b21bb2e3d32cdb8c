// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/choice/CostRatios.h>

#include <osg/RenderInfo>

#include <optional>

namespace gnomon {

/// Times small pieces of each kind of work in the context that is current, in a framebuffer of its own.
///
/// Cost   some 100 ms.
/// Needs  framebuffer objects, and state sets off the stack. OpenGL's state is as it was afterwards.
/// @return nullopt if OpenGL makes no such framebuffer.
std::optional<CostRatios> measureCosts(osg::RenderInfo& renderInfo);

} // namespace gnomon
