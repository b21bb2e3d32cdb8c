// SPDX-License-Identifier: MIT
#pragma once
#include "../../examples/tools/gnomonchart/scenes/ChartScene.h"

namespace test {

/// A house and a sphere above a ground named "ground", under a sun; 320 × 240 pixels.
gnomon::examples::ChartScene smallScene();

} // namespace test
