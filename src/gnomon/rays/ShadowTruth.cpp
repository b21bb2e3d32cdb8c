// SPDX-License-Identifier: MIT
#include <gnomon/ShadowTruth.h>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace gnomon {
namespace {

constexpr int grid = 4; // rays a pixel and side
constexpr double aboutCentre =
    1.0 / 16.0; // pixels: rasterisers snap to 1/256, but 24 bits of depth move places by more

constexpr double sameNormal = 1e-9; // of a cosine: rounding between the triangles of one plane

/// A place that a line of sight met.
struct Place {
    unsigned triangle = RayHit::none;
    glm::dvec3 position{0.0};
    glm::dvec3 normal{0.0}; ///< towards the eye.
};

/// The sun's disc, seen from anywhere.
struct Disc {
    double radius = 0.0; ///< tangent of half its diameter; 0 for a point.
    int strata = 1;
};

class Tracer {
public:
    Tracer(const RayScene& seen, const RayScene& casters, const TruthView& view, const Disc& disc)
        : _seen(seen), _casters(casters), _view(view), _worldFromClip(glm::inverse(view.clipFromWorld)), _disc(disc) {}

    TruthPixel pixel(int x, int y) const;

private:
    Place look(const glm::dvec2& at) const;
    glm::dvec3 unproject(double x, double y, double depth) const;
    glm::dvec3 towardsLight(const glm::dvec3& from) const;
    Ray rayToLight(const Place& place, const glm::dvec3& towards) const;
    template <class Lit>
    TruthPixel pixel(int x, int y, bool& bends, const Lit& lit) const;
    double litByPoint(const Place& place) const;
    double litByDisc(const Place& place, std::mt19937& random) const;
    void lookBeside(double x, double y, TruthPixel& pixel) const;
    bool isUndecidedInPlane(double x, double y, const TruthPixel& pixel) const;
    void fillCentre(TruthPixel& pixel, const Place& place) const;

    const RayScene& _seen;
    const RayScene& _casters;
    const TruthView& _view;
    const glm::dmat4 _worldFromClip;
    const Disc _disc;
};

glm::dvec3 Tracer::unproject(double x, double y, double depth) const {
    const glm::dvec4 point =
        _worldFromClip * glm::dvec4(2.0 * x / _view.width - 1.0, 2.0 * y / _view.height - 1.0, depth, 1.0);
    return glm::dvec3(point) / point.w;
}

/// What is seen at a place of the picture, in pixels from its lower left corner.
Place Tracer::look(const glm::dvec2& at) const {
    const glm::dvec3 near = unproject(at.x, at.y, -1.0), far = unproject(at.x, at.y, 1.0);
    const Ray ray{near, far - near, 1.0};
    const RayHit hit = _seen.closest(ray);
    if (!hit) return {};
    const bool front = glm::dot(hit.normal, ray.along) < 0.0;
    return {hit.triangle, near + hit.distance * ray.along, front ? hit.normal : -hit.normal};
}

/// The way to the light; of a lamp the whole way, so that a ray of reach 1 ends there.
glm::dvec3 Tracer::towardsLight(const glm::dvec3& from) const {
    const glm::dvec3 light(_view.light);
    return _view.light.w == 0.0 ? glm::normalize(light) : light / _view.light.w - from;
}

Ray Tracer::rayToLight(const Place& place, const glm::dvec3& towards) const {
    const glm::dvec3 start = _casters.lifted(place.position, place.normal);
    if (_view.light.w == 0.0) return {start, towards};
    return {start, towardsLight(start), 1.0};
}

/// Share of the light that arrives.
double Tracer::litByPoint(const Place& place) const {
    const glm::dvec3 towards = towardsLight(place.position);
    return glm::dot(place.normal, towards) > 0.0 && !_casters.blocked(rayToLight(place, towards)) ? 1.0 : 0.0;
}

double Tracer::litByDisc(const Place& place, std::mt19937& random) const {
    const glm::dvec3 middle = towardsLight(place.position);
    const glm::dvec3 side = std::abs(middle.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
    const glm::dvec3 u = glm::normalize(glm::cross(side, middle)), v = glm::cross(middle, u);
    std::uniform_real_distribution<double> within;
    int arrive = 0;
    for (int i = 0; i < _disc.strata * _disc.strata; ++i) {
        const double radius = _disc.radius * std::sqrt((i / _disc.strata + within(random)) / _disc.strata);
        const double around = glm::two_pi<double>() * (i % _disc.strata + within(random)) / _disc.strata;
        const glm::dvec3 towards = middle + radius * (std::cos(around) * u + std::sin(around) * v);
        arrive += glm::dot(place.normal, towards) > 0.0 && !_casters.blocked(rayToLight(place, towards));
    }
    return arrive / double(_disc.strata * _disc.strata);
}

/// Not only whether, but what blocks: hence the closest hit. What faces away is asked from its far side: its own triangle is no
/// blocker.
void Tracer::fillCentre(TruthPixel& pixel, const Place& place) const {
    const glm::dvec3 towards = towardsLight(place.position);
    pixel.receiver = place.triangle;
    pixel.position = place.position;
    pixel.normal = place.normal;
    pixel.facing = glm::dot(place.normal, glm::normalize(towards));
    const glm::dvec3 litSide = pixel.facing > 0.0 ? place.normal : -place.normal;
    const Ray ray = rayToLight({place.triangle, place.position, litSide}, towards);
    const RayHit hit = _casters.blocked(ray) ? _casters.closest(ray) : RayHit(); // a lamp may lie on a surface
    pixel.litCentre = pixel.facing > 0.0 && !hit;
    if (!hit) return;
    pixel.blocker = hit.triangle;
    pixel.blockerDistance = hit.distance * glm::length(ray.along);
}

glm::dvec2 beside(double x, double y, int i) {
    return {x + (i % 2 ? aboutCentre : -aboutCentre), y + (i / 2 ? aboutCentre : -aboutCentre)};
}

void Tracer::lookBeside(double x, double y, TruthPixel& pixel) const {
    for (int i = 0; i < 4; ++i) {
        const Place place = look(beside(x, y, i));
        if (place.triangle != RayHit::none) pixel.litBeside[std::size_t(i)] = litByPoint(place) > 0.0;
    }
}

/// Whether the light is otherwise where the lines of sight close by meet the plane of the surface. An edge of the shadow that
/// lies along an edge of the surface shows there alone.
bool Tracer::isUndecidedInPlane(double x, double y, const TruthPixel& pixel) const {
    for (int i = 0; i < 4; ++i) {
        const glm::dvec2 at = beside(x, y, i);
        const glm::dvec3 near = unproject(at.x, at.y, -1.0), along = unproject(at.x, at.y, 1.0) - near;
        const double towards = glm::dot(pixel.normal, along);
        if (!(towards < 0.0)) continue;
        const double distance = glm::dot(pixel.normal, pixel.position - near) / towards;
        if ((litByPoint({pixel.receiver, near + distance * along, pixel.normal}) > 0.0) != pixel.litCentre) return true;
    }
    return false;
}

/// Dice are made for a disc alone: they cost as much as a third of a point light's rays.
TruthPixel Tracer::pixel(int x, int y) const {
    if (_disc.radius == 0.0) {
        bool bends = false;
        TruthPixel result = pixel(x, y, bends, [this](const Place& place) { return litByPoint(place); });
        result.litBeside.fill(result.litCentre);
        if (!result.seen()) return result;
        if (result.isEdge()) lookBeside(x + 0.5, y + 0.5, result);
        const auto isOtherwise = [&](bool lit) { return lit != result.litCentre; };
        result.undecided = std::any_of(result.litBeside.begin(), result.litBeside.end(), isOtherwise) ||
                           (bends && isUndecidedInPlane(x + 0.5, y + 0.5, result));
        return result;
    }
    std::mt19937 random(static_cast<unsigned>(y * _view.width + x)); // the same picture every time
    bool bends = false;
    return pixel(x, y, bends, [&](const Place& place) { return litByDisc(place, random); });
}

template <class Lit>
TruthPixel Tracer::pixel(int x, int y, bool& bends, const Lit& litAt) const {
    const Place centre = look({x + 0.5, y + 0.5});
    TruthPixel result;
    double lit = 0.0;
    int seen = 0;
    for (int i = 0; i < grid * grid; ++i) {
        const Place place = look({x + (i % grid + 0.5) / grid, y + (i / grid + 0.5) / grid});
        if (place.triangle == RayHit::none) continue;
        lit += litAt(place);
        ++seen;
        bends = bends || glm::dot(place.normal, centre.normal) < 1.0 - sameNormal;
    }
    if (seen > 0) result.lit = static_cast<float>(lit / seen);
    if (centre.triangle != RayHit::none) fillCentre(result, centre);
    return result;
}

TruthImage trace(const RayScene& seen, const RayScene& casters, const TruthView& view, const Disc& disc) {
    TruthImage image;
    image.width = view.width;
    image.height = view.height;
    image.pixels.resize(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
    const Tracer tracer(seen, casters, view, disc);
    tbb::parallel_for(0, view.height, [&](int y) {
        const auto row = image.pixels.begin() + std::ptrdiff_t{y} * view.width;
        for (int x = 0; x < view.width; ++x) row[x] = tracer.pixel(x, y);
    });
    return image;
}

} // namespace

double TruthImage::floor() const {
    std::size_t counted = 0, wrong = 0;
    for (const TruthPixel& pixel : pixels) {
        if (!pixel.seen() || !(pixel.facing > 0.0)) continue;
        ++counted;
        wrong += pixel.litCentre != (pixel.lit >= 0.5f);
    }
    return counted ? double(wrong) / double(counted) : 0.0;
}

TruthImage shadowTruth(const RayScene& seen, const RayScene& casters, const TruthView& view) {
    return trace(seen, casters, view, {});
}

TruthImage softShadowTruth(const RayScene& seen, const RayScene& casters, const TruthView& view, double degrees,
                           int strata) {
    return trace(seen, casters, view, {std::tan(glm::radians(degrees) / 2.0), std::max(strata, 1)});
}

} // namespace gnomon
