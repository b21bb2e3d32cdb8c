// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <support/Panels.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <osg/CullFace>
#include <osg/Geode>
#include <osg/Geometry>

#include <algorithm>
#include <cmath>

namespace test {
namespace {

osg::Vec3 toOsg(const glm::dvec3& v) { return osg::Vec3(osg::Vec3d(v.x, v.y, v.z)); }

/// How far along the sight the panel is met; nullopt if not.
std::optional<double> meet(const Sight& sight, const Panel& panel) {
    const glm::dmat3 system(panel.side, panel.up, -sight.way);
    if (glm::determinant(system) == 0.0) return std::nullopt;
    const glm::dvec3 at = glm::inverse(system) * (sight.from - panel.corner);
    const bool inside = at.x >= 0.0 && at.x <= 1.0 && at.y >= 0.0 && at.y <= 1.0 && at.z > 1e-9;
    const bool back = glm::dot(glm::cross(panel.side, panel.up), sight.way) > 0.0;
    if (!inside || (panel.oneSided && back)) return std::nullopt;
    return at.z;
}

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

} // namespace

osg::ref_ptr<osg::Node> node(const Panel& panel) {
    osg::ref_ptr<osg::Geometry> geometry =
        osg::createTexturedQuadGeometry(toOsg(panel.corner), toOsg(panel.side), toOsg(panel.up));
    osg::ref_ptr<osg::Vec4Array> color = new osg::Vec4Array(osg::Array::BIND_OVERALL);
    color->push_back(osg::Vec4(toOsg(glm::dvec3(panel.color) / 255.0), 1.0f));
    geometry->setColorArray(color);
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->setName(panel.name);
    geode->addDrawable(geometry);
    geode->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
    if (panel.oneSided) geode->getStateSet()->setAttributeAndModes(new osg::CullFace);
    return geode;
}

osg::ref_ptr<osg::Group> group(const std::vector<Panel>& panels) {
    osg::ref_ptr<osg::Group> all = new osg::Group;
    for (const Panel& panel : panels) all->addChild(node(panel));
    return all;
}

Sights::Sights(const View& view)
    : _worldFromWindow(glm::inverse(gnomon::toGlm(view.view * view.projection)) *
                       glm::translate(glm::dmat4(1.0), glm::dvec3(-1.0, -1.0, 0.0)) *
                       glm::scale(glm::dmat4(1.0), glm::dvec3(2.0 / view.width, 2.0 / view.height, 1.0))) {}

Sight Sights::at(double x, double y) const {
    const auto atDepth = [&](double depth) {
        const glm::dvec4 point = _worldFromWindow * glm::dvec4(x, y, depth, 1.0);
        return glm::dvec3(point) / point.w;
    };
    return {atDepth(-1.0), glm::normalize(atDepth(1.0) - atDepth(-1.0))};
}

Sight sight(const View& view, double x, double y) { return Sights(view).at(x, y); }

std::optional<Met> meet(const Sight& sight, const std::vector<Panel>& panels,
                        const std::function<bool(const Panel&)>& counts) {
    std::optional<Met> nearest;
    double best = INFINITY;
    for (const Panel& panel : panels) {
        const auto distance = counts(panel) ? meet(sight, panel) : std::nullopt;
        if (!distance || *distance >= best) continue;
        best = *distance;
        nearest = Met{&panel, sight.from + best * sight.way};
    }
    return nearest;
}

Judgement judge(const Picture& picture, const View& view, const Shown& seen, double tolerance) {
    Judgement result;
    const Sights sights(view);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const auto at = [&](double dx, double dy) { return seen(sights.at(x + 0.5 + dx, y + 0.5 + dy)); };
            const glm::dvec3 expected = at(0.0, 0.0);
            const auto same = [&](double dx, double dy) { return at(dx, dy) == expected; };
            if (!(same(0.02, 0.02) && same(-0.02, 0.02) && same(0.02, -0.02) && same(-0.02, -0.02))) {
                ++result.edges;
                continue;
            }
            const double error = largest(colorAt(picture, x, y) - expected);
            result.worst = std::max(result.worst, error);
            result.wrong += error > tolerance;
        }
    return result;
}

glm::dvec3 colorAt(const Picture& picture, int x, int y) {
    const std::uint32_t pixel = picture.at(x, y);
    return {double(pixel & 0xffu), double((pixel >> 8) & 0xffu), double((pixel >> 16) & 0xffu)};
}

} // namespace test
