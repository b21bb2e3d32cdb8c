// SPDX-License-Identifier: MIT
#pragma once
#include <Mesh.h>

namespace test {

using gnomon::examples::Mesh;

using gnomon::examples::box;
using gnomon::examples::house;
using gnomon::examples::insideOut;
using gnomon::examples::joined;
using gnomon::examples::moved;
using gnomon::examples::node;
using gnomon::examples::quad;
using gnomon::examples::sphere;
using gnomon::examples::square;
using gnomon::examples::town;

} // namespace test
