// SPDX-License-Identifier: MIT
#include "Hills.h"

#include <osg/Math>

#include <cmath>

namespace test {

osg::ref_ptr<osg::Geode> hillTile(int column, int row, int cells) {
    const auto at = [&](int i, int k) {
        const double x = 100.0 * (column - 4) + 100.0 * i / cells, y = 100.0 * (row - 4) + 100.0 * k / cells;
        return glm::dvec3(x, y, 25.0 * std::sin(x / 37.0) * std::cos(y / 29.0));
    };
    Mesh mesh;
    for (int i = 0; i < cells; ++i)
        for (int k = 0; k < cells; ++k)
            for (const glm::dvec3& corner :
                 {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)})
                mesh.push_back(corner);
    return node(mesh);
}

osg::Vec3 centreOfTile(int column, int row) {
    return {100.0f * static_cast<float>(column) - 350.0f, 100.0f * static_cast<float>(row) - 350.0f, 0.0f};
}

osg::Vec4d sunOverHills() {
    const double elevation = osg::DegreesToRadians(35.0);
    return {std::cos(elevation), 0.3 * std::cos(elevation), std::sin(elevation), 0.0};
}

} // namespace test
