// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>

#include <string>
#include <vector>

namespace test {

/// What a technique says, but for surfaces that it leaves lit: where casters stand in each other's shadow and that is not
/// what a test is about.
std::vector<std::string> causesButLitSurfaces(const gnomon::ShadowTechnique& technique);

} // namespace test
