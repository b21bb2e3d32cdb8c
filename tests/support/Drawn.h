// SPDX-License-Identifier: MIT
#pragma once
#include <glm/vec2.hpp>

namespace test {

/// Two numbers of a distribution, y drawn first: the order in which a call's arguments are evaluated is each compiler's own.
template <class Distribution, class Engine>
glm::dvec2 drawn(Distribution& distribution, Engine& engine) {
    const double y = distribution(engine);
    return {distribution(engine), y};
}

} // namespace test
