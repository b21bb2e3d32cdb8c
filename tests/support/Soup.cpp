// SPDX-License-Identifier: MIT
#include "Soup.h"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include <cmath>
#include <utility>

namespace test {

void Soup::triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    for (const glm::dvec3& v : {a, b, c}) {
        indices.push_back(static_cast<unsigned>(vertices.size()));
        vertices.emplace_back(v);
    }
}

void Soup::quad(const glm::dvec3& corner, const glm::dvec3& side, const glm::dvec3& up) {
    triangle(corner, corner + side, corner + side + up);
    triangle(corner, corner + side + up, corner + up);
}

void Soup::ground(double half, double height) {
    quad({-half, -half, height}, {2.0 * half, 0.0, 0.0}, {0.0, 2.0 * half, 0.0});
}

void Soup::box(const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 x(high.x - low.x, 0.0, 0.0), y(0.0, high.y - low.y, 0.0), z(0.0, 0.0, high.z - low.z);
    quad(low, y, x);
    quad(low + z, x, y);
    quad(low, x, z);
    quad(low + y, z, x);
    quad(low, z, y);
    quad(low + x, y, z);
}

void Soup::sphere(const glm::dvec3& centre, double radius, int slices) {
    const auto at = [&](int slice, int stack) {
        const double around = glm::two_pi<double>() * slice / slices, down = glm::two_pi<double>() * stack / slices;
        return centre + radius * glm::dvec3(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                                            std::cos(down));
    };
    for (int stack = 0; stack < slices / 2; ++stack)
        for (int slice = 0; slice < slices; ++slice) {
            const int next = (slice + 1) % slices;
            if (stack > 0) triangle(at(slice, stack), at(slice, stack + 1), at(next, stack));
            if (stack + 1 < slices / 2) triangle(at(next, stack), at(slice, stack + 1), at(next, stack + 1));
        }
}

void Soup::town(int side) {
    for (int i = 0; i < side * side; ++i) {
        const glm::dvec3 low(5.0 * (i % side) - 2.5 * side + 1.0, 5.0 * (i / side) - 2.5 * side + 1.0, 0.0);
        const int variety = (i * 7919) % 97; // sizes that do not repeat along rows
        box(low, low + glm::dvec3(1.5 + variety % 5 * 0.3, 1.5 + variety % 7 * 0.2, 1.0 + variety % 11 * 0.3));
    }
}

void Soup::add(const Soup& other) {
    for (std::size_t i = 0; i < other.size(); ++i) triangle(other.corner(i, 0), other.corner(i, 1), other.corner(i, 2));
}

Soup Soup::moved(const glm::dvec3& by) const {
    Soup result = *this;
    for (glm::vec3& vertex : result.vertices) vertex += glm::vec3(by);
    return result;
}

Soup Soup::turned() const {
    Soup result = *this;
    for (std::size_t i = 0; i < indices.size(); i += 3) std::swap(result.indices[i + 1], result.indices[i + 2]);
    return result;
}

Soup Soup::without(std::size_t firstTriangle, std::size_t count) const {
    Soup result = *this;
    const auto at = result.indices.begin() + static_cast<std::ptrdiff_t>(3 * firstTriangle);
    result.indices.erase(at, at + static_cast<std::ptrdiff_t>(3 * count));
    return result;
}

std::optional<double> met(const Soup& soup, std::size_t triangle, const glm::dvec3& start, const glm::dvec3& along) {
    const glm::dvec3 a = soup.corner(triangle, 0), e1 = soup.corner(triangle, 1) - a, e2 = soup.corner(triangle, 2) - a;
    const glm::dvec3 p = glm::cross(along, e2), s = start - a, q = glm::cross(s, e1);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0.0) return std::nullopt;
    const double u = glm::dot(s, p) / determinant, v = glm::dot(along, q) / determinant;
    if (u < 0.0 || v < 0.0 || u + v > 1.0) return std::nullopt;
    return glm::dot(e2, q) / determinant;
}

gnomon::RayHit bruteForce(const Soup& soup, const gnomon::Ray& ray) {
    gnomon::RayHit nearest;
    for (std::size_t i = 0; i < soup.size(); ++i) {
        const auto t = met(soup, i, ray.start - soup.origin, ray.along);
        if (!t || *t < 0.0 || *t > ray.reach || *t >= nearest.distance) continue;
        const glm::dvec3 a = soup.corner(i, 0);
        nearest.triangle = static_cast<unsigned>(i);
        nearest.distance = *t;
        nearest.normal = glm::normalize(glm::cross(soup.corner(i, 1) - a, soup.corner(i, 2) - a));
    }
    return nearest;
}

glm::dvec3 randomDirection(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

} // namespace test
