// SPDX-License-Identifier: MIT
#include <support/Truth.h>

#include <gnomon/Convert.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <list>
#include <ostream>

namespace test {
namespace {

bool onSamePlane(const gnomon::TruthPixel& a, const gnomon::TruthPixel& b) {
    return b.seen() && glm::dot(a.normal, b.normal) > 1.0 - 1e-9 &&
           std::abs(glm::dot(a.normal, b.position - a.position)) < 1e-4;
}

bool counts(const gnomon::TruthImage& truth, int x, int y) {
    if (x < 1 || y < 1 || x + 1 >= truth.width || y + 1 >= truth.height) return false;
    const gnomon::TruthPixel& pixel = truth.at(x, y);
    if (!pixel.seen() || !(pixel.facing > 0.05)) return false;
    for (int v = y - 1; v <= y + 1; ++v)
        for (int u = x - 1; u <= x + 1; ++u)
            if (!onSamePlane(pixel, truth.at(u, v))) return false;
    return true;
}

double red(std::uint32_t color) { return color & 0xffu; }

/// All that a truth image depends on.
struct Asked {
    Mesh mesh;
    osg::Vec4d light;
    osg::Matrixd clip;
    int width, height;
    double sunAngle;

    bool operator==(const Asked& other) const {
        return mesh == other.mesh && light == other.light && clip == other.clip && width == other.width &&
               height == other.height && sunAngle == other.sunAngle;
    }
};

/// Rays take seconds, and cases of one program often ask for the same.
struct Traced {
    Asked asked;
    gnomon::TruthImage truth;
};

gnomon::TruthImage trace(const Asked& asked) {
    const std::vector<glm::vec3> vertices(asked.mesh.begin(), asked.mesh.end());
    std::vector<unsigned> indices;
    for (unsigned i = 0; i < vertices.size(); ++i) indices.push_back(i);
    const gnomon::RayScene scene({vertices.data(), vertices.size(), indices.data(), indices.size(), glm::dvec3(0.0)});
    const gnomon::TruthView seen{gnomon::toGlm(asked.clip), asked.width, asked.height, gnomon::toGlm(asked.light)};
    constexpr int strata = 4;
    return asked.sunAngle > 0.0 ? gnomon::softShadowTruth(scene, scene, seen, asked.sunAngle, strata)
                                : gnomon::shadowTruth(scene, scene, seen);
}

} // namespace

gnomon::TruthImage truthOf(const std::vector<Mesh>& meshes, const osg::Vec4d& light, const View& view,
                           double sunAngle) {
    constexpr std::size_t most = 4; // of some 20 MB
    static std::list<Traced> known; // the last asked for is the first
    const Asked asked{joined(meshes), light, view.view * view.projection, view.width, view.height, sunAngle};
    const auto found = std::find_if(known.begin(), known.end(), [&](const Traced& one) { return one.asked == asked; });
    if (found != known.end())
        known.splice(known.begin(), known, found);
    else
        known.push_front({asked, trace(asked)});
    if (known.size() > most) known.pop_back();
    return known.front().truth;
}

std::ostream& operator<<(std::ostream& out, const TruthComparison& r) {
    return out << r.pixels << " pixels, " << r.shadowed << " shadowed, " << r.edges << " edges; wrong " << r.wrong
               << ", floor " << r.floor << ", certain " << r.certain << ", neither " << r.neither;
}

TruthComparison compare(const Picture& actual, const Picture& lit, const Picture& dark,
                        const gnomon::TruthImage& truth) {
    TruthComparison result;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            result.neither += actual.at(x, y) != lit.at(x, y) && actual.at(x, y) != dark.at(x, y);
            if (!counts(truth, x, y) || lit.at(x, y) == dark.at(x, y)) continue;
            const gnomon::TruthPixel& pixel = truth.at(x, y);
            const bool shadow = pixel.lit < 0.5f, wrong = (actual.at(x, y) == dark.at(x, y)) != shadow;
            ++result.pixels;
            result.shadowed += shadow;
            result.edges += pixel.isEdge();
            result.wrong += wrong;
            result.certain += wrong && !pixel.isEdge();
            result.floor += pixel.litCentre == shadow;
        }
    return result;
}

gnomon::metrics::BoundaryDistance edgesOff(const Picture& actual, const Picture& lit, const Picture& dark,
                                           const gnomon::TruthImage& truth) {
    gnomon::metrics::Picture drawn(truth.width, truth.height), arrives = drawn;
    gnomon::metrics::Mask within(truth.width, truth.height);
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            const double most = red(lit.at(x, y)), least = red(dark.at(x, y));
            within.at(x, y) = counts(truth, x, y) && most > least;
            drawn.at(x, y) = most > least ? (red(actual.at(x, y)) - least) / (most - least) : 1.0;
            arrives.at(x, y) = truth.at(x, y).lit;
        }
    return gnomon::metrics::boundaryDistance(drawn, arrives, within).value();
}

double shareOff(const Picture& actual, const Picture& lit, const Picture& dark, const gnomon::TruthImage& truth) {
    double sum = 0.0;
    int pixels = 0;
    for (int y = 0; y < truth.height; ++y)
        for (int x = 0; x < truth.width; ++x) {
            const double most = red(lit.at(x, y)), least = red(dark.at(x, y));
            if (!counts(truth, x, y) || !(most - least > 50.0)) continue; // of less, a step of colour is too much
            const double off = (red(actual.at(x, y)) - least) / (most - least) - truth.at(x, y).lit;
            sum += off * off;
            ++pixels;
        }
    return std::sqrt(sum / pixels);
}

} // namespace test
