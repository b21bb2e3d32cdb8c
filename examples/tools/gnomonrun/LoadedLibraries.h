// SPDX-License-Identifier: MIT
#pragma once

namespace gnomon::examples {

/// True if the program, or a library that it has loaded, needs a library of OpenSceneGraph. This library and those of
/// OpenSceneGraph itself do not count.
bool programNeedsOsg();

} // namespace gnomon::examples
