// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>

#include <optional>
#include <random>
#include <vector>

namespace test {

/// Triangles of a test's scene, corners not shared; each shape counter-clockwise from outside.
struct Soup {
    std::vector<glm::vec3> vertices;
    std::vector<unsigned> indices;
    glm::dvec3 origin{0.0};

    void triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);
    void quad(const glm::dvec3& corner, const glm::dvec3& side, const glm::dvec3& up);
    void ground(double half, double height = 0.0);
    void box(const glm::dvec3& low, const glm::dvec3& high);
    void sphere(const glm::dvec3& centre, double radius, int slices);
    /// `side` × `side` boxes of various sizes on z = 0, pitch 5, about the origin.
    void town(int side);
    void add(const Soup& other);

    Soup moved(const glm::dvec3& by) const;
    Soup turned() const; ///< every triangle looks the other way.
    Soup without(std::size_t firstTriangle, std::size_t count = 1) const;

    std::size_t size() const { return indices.size() / 3; }
    glm::dvec3 corner(std::size_t triangle, int i) const { return glm::dvec3(vertices[indices[3 * triangle + i]]); }
    gnomon::TriangleSoup view() const {
        return {vertices.data(), vertices.size(), indices.data(), indices.size(), origin};
    }
};

/// How far along a way from a place a triangle is met, in double and without any of Gnomon's code (Möller and Trumbore 1997);
/// nullopt if it is not. @param start  about the soup's origin.
std::optional<double> met(const Soup& soup, std::size_t triangle, const glm::dvec3& start, const glm::dvec3& along);

/// The nearest hit by testing every triangle.
gnomon::RayHit bruteForce(const Soup& soup, const gnomon::Ray& ray);

/// Evenly spread over the sphere of directions.
glm::dvec3 randomDirection(std::mt19937& random);

} // namespace test
