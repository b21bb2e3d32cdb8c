// SPDX-License-Identifier: MIT
#pragma once
#include <support/Scene.h>
#include <support/Truth.h>

#include <string>
#include <vector>

namespace test {

/// Meshes that all cast and receive, under one light.
struct TracedCase {
    std::string name;
    std::vector<Mesh> meshes; ///< the first is named "ground".
    osg::Vec4d light;
    View view;

    Scene build() const;
    gnomon::TruthImage truth() const { return truthOf(meshes, light, view); }
};

/// A sphere and a house on a ground.
TracedCase labEight();
/// 400 houses.
TracedCase townOfHouses();
/// A lamp and three things in a closed room.
TracedCase room();
/// Four rows of houses along a street of 2 km, as one who stands in it sees it.
/// @param azimuth  of the sun, degrees from where one looks.
TracedCase longStreet(double azimuth, double elevation = 15.0);
/// A level square of `side` × `side` small ones under a sun of `elevation` degrees, seen from `height`.
TracedCase flatGround(double half, double height, double elevation, double near, double far, int side = 1);

} // namespace test
