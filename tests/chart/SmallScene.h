// SPDX-License-Identifier: MIT
#pragma once
#include "Yardstick.h"

#include <string>

namespace test {

/// A house and a sphere above a ground named "ground", under a sun; 320 × 240 pixels.
gnomon::examples::ChartScene smallScene();
/// What is true of it, without the sun's disc.
const gnomon::examples::Yardstick& smallYardstick();

const gnomon::examples::Peer& peerNamed(const std::string& name);
/// A contender's errors in a scene, which another may be the truth of.
gnomon::metrics::ShadowMetrics errorsOf(const gnomon::examples::Contender& contender,
                                        const gnomon::examples::ChartScene& drawn,
                                        const gnomon::examples::Yardstick& yardstick);

} // namespace test
