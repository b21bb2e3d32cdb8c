// SPDX-License-Identifier: MIT
#pragma once
#include "../StabilityScene.h"
#include "Mesh.h"
#include "SceneLights.h"

#include <functional>
#include <optional>
#include <utility>

namespace gnomon::examples {

/// What a stability scene is put together from. Lengths are metres, z is up.
struct SceneParts {
    osg::ref_ptr<osg::Group> content =
        new osg::Group;                    ///< receivers first; a flat one is "ground", a hilly one "terrain".
    osg::Vec4d light = sunAt(120.0, 45.0); ///< homogeneous, world.
    osg::Vec3d eye{-8.0, -14.0, 10.0}, center{0.0, 0.0, 1.0};
    double fovy = 40.0;                 ///< degrees.
    std::optional<double> orthographic; ///< instead: half of what the picture's height shows.
    std::optional<double> near, far;    ///< both or none; none: close about the content.
    double radius = 3.0;                ///< of what matters, for contact and the peers' lengths.
    osg::ref_ptr<osg::Group> truth;     ///< see StabilityCase.
    std::string round;                  ///< see ChartScene.

    void add(const Mesh& mesh, const std::string& name = "");
    void add(osg::Node* node) { content->addChild(node); }
    /// Puts all content below a transform. Light and camera stay.
    void enclose(const osg::Matrixd& matrix);
};

StabilityCase stabilityCase(const SceneParts& parts, int width, int height);

/// A StabilityScene::make of what makes the parts.
std::function<StabilityCase(double, int, int)> madeOf(std::function<SceneParts(double value)> parts);

/// A section of the stability table.
class Section {
public:
    explicit Section(const char* name) : _name(name) {}
    /// See StabilityScene.
    void add(const char* id, const char* title, const char* about, const char* parameter, const char* unit,
             std::vector<double> values, std::function<SceneParts(double value)> parts) {
        _scenes.push_back({{id, _name, title, about, parameter, unit, std::move(values)}, madeOf(std::move(parts))});
    }
    std::vector<StabilityScene> scenes() const { return _scenes; }

private:
    const char* _name;
    std::vector<StabilityScene> _scenes;
};

std::vector<StabilityScene> lightScenes();
std::vector<StabilityScene> receiverScenes();
std::vector<StabilityScene> numberScenes();
std::vector<StabilityScene> mapScenes();
std::vector<StabilityScene> blendingScenes();
std::vector<StabilityScene> meshScenes();

/// A square named "ground", of which the middle is the origin.
SceneParts onGround(double half = 12.0);

/// A height field of `cells` × `cells` about the origin, counter-clockwise from above.
Mesh landscape(const std::function<double(double x, double y)>& height, double half, int cells);

/// A plane through the origin, tilted about the y axis: its +x side is lower. Half of its side is `half`.
Mesh tilted(double half, double degrees);

/// A box of this size whose lower side's middle is `foot`.
Mesh boxAt(const glm::dvec3& foot, const glm::dvec3& size);

} // namespace gnomon::examples
