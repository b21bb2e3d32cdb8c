// SPDX-License-Identifier: MIT
#include "BoxOnGround.h"

#include <cmath>
#include <limits>

namespace gnomon::test {
namespace {

using metrics::TruthMaps;

constexpr double left = 20.0, right = 40.0, below = 32.0, above = 64.0, shadowEnd = 70.2; // px

bool onRoof(double x, double y) { return x >= left && x < right && y >= below && y < above; }

/// Whether a ray from (x, y), in px, reaches the sun.
bool isLit(double x, double y, double lowering) {
    return onRoof(x, y) || !(x >= right && x < shadowEnd + lowering && y >= below && y < above);
}

double shareOfRays(double x, double y, double lowering) {
    int lit = 0;
    for (int i = 0; i < 16; ++i) lit += isLit(x + (i % 4 + 0.5) / 4, y + (i / 4 + 0.5) / 4, lowering);
    return lit / 16.0;
}

TruthMaps blank() {
    TruthMaps truth;
    truth.lit = metrics::Picture(BoxOnGround::width, BoxOnGround::height);
    truth.blockerDistance = truth.lit;
    truth.facing = metrics::Picture(BoxOnGround::width, BoxOnGround::height, std::sqrt(0.5));
    truth.litCentre = metrics::Mask(BoxOnGround::width, BoxOnGround::height);
    truth.receiver = metrics::Grid<int>(BoxOnGround::width, BoxOnGround::height);
    truth.position = metrics::Grid<glm::dvec3>(BoxOnGround::width, BoxOnGround::height);
    truth.towardsLight = {-1, 0, 1};
    return truth;
}

} // namespace

TruthMaps BoxOnGround::truth() const {
    TruthMaps truth = blank();
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const double x = column + camera.x, y = row + camera.y, cx = x + 0.5, cy = y + 0.5;
            const bool lit = isLit(cx, cy, lowering);
            truth.lit.at(column, row) = shareOfRays(x, y, lowering);
            truth.litCentre.at(column, row) = lit;
            truth.blockerDistance.at(column, row) =
                lit ? std::numeric_limits<double>::infinity() : (cx - right) * pixel * std::sqrt(2.0);
            truth.receiver.at(column, row) = onRoof(cx, cy) ? roof : ground;
            truth.position.at(column, row) = {cx * pixel, cy * pixel, onRoof(cx, cy) ? 1.51 : 0.0};
        }
    return truth;
}

glm::dmat4 BoxOnGround::clipFromPosition() const {
    glm::dmat4 clip(1.0);
    clip[0][0] = 2.0 / (pixel * width);
    clip[1][1] = 2.0 / (pixel * height);
    clip[2][2] = -0.1;
    clip[3][0] = -1.0 - 2.0 * camera.x / width;
    clip[3][1] = -1.0 - 2.0 * camera.y / height;
    return clip;
}

metrics::Picture picture(int width, int height, const std::function<double(int x, int y)>& value) {
    metrics::Picture result(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) result.at(x, y) = value(x, y);
    return result;
}

metrics::Picture filled(metrics::Picture picture, int x, int y, int w, int h, double value) {
    for (int row = y; row < y + h; ++row)
        for (int column = x; column < x + w; ++column) picture.at(column, row) = value;
    return picture;
}

metrics::ShadowMetrics measured(const metrics::Picture& visibility, const TruthMaps& truth) {
    const metrics::Picture one(visibility.width, visibility.height, 1.0), zero(visibility.width, visibility.height);
    return metrics::shadowMetrics(metrics::visibility(visibility, one, zero), truth);
}

metrics::ShadowMetrics measured(const metrics::Picture& visibility) {
    return measured(visibility, BoxOnGround().truth());
}

} // namespace gnomon::test
