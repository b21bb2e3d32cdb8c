// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/Ground.h>
#include <gnomon/geometry/ConvexParts.h>
#include <gnomon/ground/BoxMethod.h>
#include <gnomon/ground/HeightPyramid.h>
#include <gnomon/ground/HullSolids.h>

#include <glm/vec2.hpp>

#include <functional>
#include <iosfwd>
#include <string>

namespace test {

constexpr double degree = 3.14159265358979323846 / 180.0;

/// The way towards the sun, of length 1. @param azimuth  degrees, clockwise from north (+y). @param elevation  degrees.
glm::dvec3 sunAt(double azimuth, double elevation);

/// Height of hills with slopes of 8.5 degrees, root mean square, as the Appalachians have them; metres.
double hills(double x, double y);

/// Ground over a square of posts × posts, `pitch` apart, by its height at places from the corner on.
gnomon::HeightPyramid groundOf(const std::function<double(double, double)>& height, int posts, double base = 0.0,
                               const glm::dvec2& corner = glm::dvec2(0.0));
constexpr double pitch = 10.0;

/// Two numbers of a distribution, y drawn first: the order in which a call's arguments are evaluated is each compiler's own.
template <class Distribution, class Engine>
glm::dvec2 drawn(Distribution& distribution, Engine& engine) {
    const double y = distribution(engine);
    return {distribution(engine), y};
}

/// Triangles over a place in plan, those whose edge it lies on too.
int over(const gnomon::BoxTriangles& triangles, const glm::dvec2& place);

/// An upright caster with a flat roof.
struct Prism {
    std::string kind;
    std::vector<glm::dvec2> outline; ///< counter-clockwise from above.
    double base = 0.0, roof = 0.0;

    /// Whether a point's way to the light is blocked, by the plan alone: what the way passes of the outline between base
    /// and roof. Shares nothing with Gnomon. @param light  homogeneous, above the point.
    bool blocks(const glm::dvec3& point, const glm::dvec4& light) const;
    bool isUnder(const glm::dvec2& place) const; ///< the outline.
    glm::dvec2 middle() const;
    std::vector<glm::dvec3> corners() const;
    /// Of its triangles, in the frame of `outline`.
    std::vector<gnomon::ConvexPart> parts() const;
};

Prism boxAt(const glm::dvec2& middle, const glm::dvec2& half, double turn, double base, double roof);

/// Boxes, L-shapes and 20-sided tanks of 8 to 24 across, turned at random, 5 to 30 above the ground at their middle, and
/// well into it. @param low,high  in plan, where their middles may be. The same for the same seed.
std::vector<Prism> prismsOn(const gnomon::Ground& ground, const glm::dvec2& low, const glm::dvec2& high, int count,
                            unsigned seed);

/// What a method under trial finds of one caster.
struct Found {
    std::function<bool(const glm::dvec3& place)> covers; ///< of a place on the ground.
    std::size_t triangles;
};
/// @param light  homogeneous.
using Method = std::function<Found(const gnomon::Ground&, const Prism&, const glm::dvec4& light)>;
Method boxMethod();  ///< the published one.
Method hullMethod(); ///< hullSolids().

struct Contestant {
    std::string name;
    Method method;
};

/// One caster's shadow against rays, in plan, without the ground under the caster.
struct Share {
    int both = 0, either = 0;
    int rays = 0;
    std::size_t triangles = 0;
    double overlap() const { return either > 0 ? double(both) / either : 1.0; }
};

/// Which places are judged.
enum class Places {
    all,
    sunlit ///< not those that the ground itself keeps the light from, behind crests: a caster's shadow is not seen there.
};

/// Of each contestant, at the same points. @param points  about how many, evenly over where the shadow may be.
std::vector<Share> judge(const gnomon::Ground& ground, const Prism& prism, const glm::dvec4& light,
                         const std::vector<Contestant>& contestants, int points, Places places = Places::all);

/// Many casters' shadows: intersection over union of all, and in the worst twentieth of the casters.
struct Figures {
    double pooled = 1.0, fifth = 1.0, least = 1.0;
    double triangles = 0.0; ///< mean of a caster.
    int rays = 0;
};

Figures tally(const std::vector<Share>& shares);

/// Each caster in the sun at `elevation` degrees, azimuths all round; of each contestant.
std::vector<Figures> figures(const gnomon::Ground& ground, const std::vector<Prism>& prisms, double elevation,
                             const std::vector<Contestant>& contestants, int points, Places places = Places::all);

/// | sun | method | IoU pooled | 5th percentile | triangles |
void printHead(std::ostream& out);
void printRow(std::ostream& out, double elevation, const std::string& method, const Figures& figures);

} // namespace test
