// SPDX-License-Identifier: MIT
#pragma once
#include <support/Picture.h>

#include <glm/vec3.hpp>
#include <osg/Group>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace test {

/// A parallelogram of one colour, unlit: what a scene is made of whose pixels can be worked out.
struct Panel {
    glm::dvec3 corner, side, up;
    glm::ivec3 color; ///< 0 … 255.
    std::string name;
    bool oneSided = false; ///< seen only from where side × up points to.
};

/// Its node, named as it is; one-sided by face culling.
osg::ref_ptr<osg::Node> node(const Panel& panel);
osg::ref_ptr<osg::Group> group(const std::vector<Panel>& panels);

/// A line of sight, from the near plane on.
struct Sight {
    glm::dvec3 from, way;
};
/// @param x,y  pixels from the lower left corner; pixel centres lie at halves.
Sight sight(const View& view, double x, double y);

/// Those of one view, for many: its matrix is inverted once.
class Sights {
public:
    explicit Sights(const View& view);
    Sight at(double x, double y) const;

private:
    const glm::dmat4 _worldFromWindow;
};

struct Met {
    const Panel* panel;
    glm::dvec3 where;
};
/// The nearest panel for which `counts` holds.
std::optional<Met> meet(const Sight& sight, const std::vector<Panel>& panels,
                        const std::function<bool(const Panel&)>& counts);

/// What a line of sight ought to show.
using Shown = std::function<glm::dvec3(const Sight&)>;

/// How a picture differs from what lines of sight through its pixels' centres show. Pixels where sights 0.02 pixels
/// beside the centre show something else are edges, where a rasteriser may decide either way, and do not count.
struct Judgement {
    int wrong = 0;      ///< pixels more than `tolerance` off in any channel.
    double worst = 0.0; ///< the largest difference.
    int edges = 0;      ///< pixels that do not count.
};
Judgement judge(const Picture& picture, const View& view, const Shown& seen, double tolerance);

/// Camera's background.
constexpr glm::dvec3 background{0.0, 0.0, 64.0};

glm::dvec3 colorAt(const Picture& picture, int x, int y);

} // namespace test
