// SPDX-License-Identifier: MIT
#include <support/Oracle.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace test {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

struct Ray {
    glm::dvec3 start, along;
};

/// Some triangles of a mesh, and a box about them: most rays pass most of them by.
struct Piece {
    /// True of a ray that passes the box, wherever it starts. A coordinate that is no number leaves all to the triangles.
    bool isPassedBy(const Ray& ray) const {
        double enter = -never, leave = never;
        for (int i = 0; i < 3; ++i) {
            if (ray.along[i] == 0.0 && (ray.start[i] < low[i] || ray.start[i] > high[i])) return true;
            const double one = (low[i] - ray.start[i]) / ray.along[i], other = (high[i] - ray.start[i]) / ray.along[i];
            if (!std::isfinite(one) || !std::isfinite(other)) continue;
            enter = std::max(enter, std::min(one, other));
            leave = std::min(leave, std::max(one, other));
        }
        return enter > leave;
    }

    const glm::dvec3 *first, *end;
    glm::dvec3 low{never}, high{-never};
};

std::vector<Piece> piecesOf(const std::vector<Mesh>& meshes) {
    constexpr std::size_t most = 3 * 128; // corners: less takes longer for the boxes
    std::vector<Piece> pieces;
    for (const Mesh& mesh : meshes)
        for (std::size_t i = 0; i + 2 < mesh.size(); i += most) {
            Piece piece{mesh.data() + i, mesh.data() + std::min(i + most, mesh.size() / 3 * 3)};
            for (const glm::dvec3* corner = piece.first; corner != piece.end; ++corner) {
                piece.low = glm::min(piece.low, *corner);
                piece.high = glm::max(piece.high, *corner);
            }
            const glm::dvec3 size = piece.high - piece.low, away = glm::max(glm::abs(piece.low), glm::abs(piece.high));
            piece.low -= 1e-3 * size + 1e-9 * away;
            piece.high += 1e-3 * size + 1e-9 * away;
            pieces.push_back(piece);
        }
    return pieces;
}

/// Smallest t > after at which the ray meets a triangle of the piece (Möller and Trumbore 1997).
double meets(const Ray& ray, const Piece& piece, double after) {
    double nearest = never;
    if (piece.isPassedBy(ray)) return nearest;
    for (const glm::dvec3* corner = piece.first; corner != piece.end; corner += 3) {
        const glm::dvec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
        const glm::dvec3 p = glm::cross(ray.along, e2);
        const double determinant = glm::dot(e1, p);
        if (determinant == 0.0) continue;
        const glm::dvec3 s = ray.start - corner[0];
        const double u = glm::dot(s, p) / determinant;
        const glm::dvec3 q = glm::cross(s, e1);
        const double v = glm::dot(ray.along, q) / determinant;
        if (u < 0.0 || v < 0.0 || u + v > 1.0) continue;
        const double t = glm::dot(e2, q) / determinant;
        if (t > after) nearest = std::min(nearest, t);
    }
    return nearest;
}

glm::dvec3 unproject(const osg::Matrixd& worldFromClip, double x, double y, double z) {
    const osg::Vec3d point = osg::Vec3d(x, y, z) * worldFromClip;
    return {point.x(), point.y(), point.z()};
}

bool shadowed(const glm::dvec3& point, const std::vector<Piece>& casters, const osg::Vec4d& light) {
    const glm::dvec3 given(light.x(), light.y(), light.z());
    const bool sun = light.w() == 0.0;
    const Ray ray{point, sun ? glm::normalize(given) : given / light.w() - point};
    for (const Piece& piece : casters)
        if (meets(ray, piece, 1e-9) < (sun ? never : 1.0)) return true;
    return false;
}

Seen see(const Ray& ray, const std::vector<Piece>& receiver, const std::vector<Piece>& casters,
         const std::vector<Piece>& clear, const osg::Vec4d& light) {
    double ground = never, caster = never;
    for (const Piece& piece : receiver) ground = std::min(ground, meets(ray, piece, 0.0));
    for (const Piece& piece : casters) caster = std::min(caster, meets(ray, piece, 0.0));
    if (std::min(ground, caster) == never) return Seen::Nothing;
    if (caster <= ground) return Seen::Caster;
    const glm::dvec3 point = ray.start + ground * ray.along;
    return shadowed(point, casters, light) || shadowed(point, clear, light) ? Seen::ShadowedReceiver
                                                                            : Seen::LitReceiver;
}

} // namespace

int Mask::count(Seen what) const { return static_cast<int>(std::count(pixels.begin(), pixels.end(), what)); }

bool Mask::atEdge(int x, int y, int reach) const {
    for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach); ++u)
            if (at(u, v) != at(x, y)) return true;
    return false;
}

Mask castRays(const Mesh& receiver, const std::vector<Mesh>& casters, const osg::Vec4d& light, const View& view,
              const std::vector<Mesh>& clear) {
    const osg::Matrixd worldFromClip = osg::Matrixd::inverse(view.view * view.projection);
    const std::vector<Mesh> receivers{receiver}; // pieces point into it
    const std::vector<Piece> ground = piecesOf(receivers), solid = piecesOf(casters), seenThrough = piecesOf(clear);
    Mask mask;
    mask.width = view.width;
    mask.height = view.height;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double u = (x + 0.5) / view.width * 2.0 - 1.0, v = (y + 0.5) / view.height * 2.0 - 1.0;
            const glm::dvec3 start = unproject(worldFromClip, u, v, -1.0), end = unproject(worldFromClip, u, v, 1.0);
            mask.pixels.push_back(see({start, end - start}, ground, solid, seenThrough, light));
        }
    return mask;
}

Comparison compare(const Picture& actual, const Picture& lit, const Picture& dark, const Mask& mask, int reach) {
    Comparison result;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x) {
            const bool inShadow = mask.at(x, y) == Seen::ShadowedReceiver;
            const bool right = actual.at(x, y) == (inShadow ? dark : lit).at(x, y);
            const bool possible = actual.at(x, y) == lit.at(x, y) || actual.at(x, y) == dark.at(x, y);
            const bool edge = mask.atEdge(x, y, reach);
            result.edges += edge;
            result.wrongInside += !right && !edge;
            result.wrongAtEdge += !possible && edge;
            result.flipped += !right && edge;
        }
    return result;
}

double coverage(const glm::dvec3& across, double middle) {
    constexpr int samples = 64; // each way
    int beyond = 0;
    for (int i = 0; i < samples * samples; ++i) {
        const glm::dvec3 off((i % samples + 0.5) / samples - 0.5, (i / samples + 0.5) / samples - 0.5, 0.0);
        beyond += middle + glm::dot(off, across) > 0.0;
    }
    return double(beyond) / (samples * samples);
}

} // namespace test
