// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>

namespace gnomon::examples {

/// Calls that draw, handed to OpenGL by this process since it began: vertices, elements and display lists, each part of a
/// multi-draw as one. A program that links this stands between every library and OpenGL, so that whoever draws is counted
/// alike. What is compiled into a display list counts when the list is called, as one.
std::size_t drawCalls();

} // namespace gnomon::examples
