// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/geometry/ScreenBounds.h>

#include <osg/BoundingBox>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <osg/RenderInfo>
#include <osg/Vec4d>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace gnomon {

/// Half-spaces, in a drawable's own frame, of what projects into a part of the screen.
using ScreenSides = std::array<osg::Vec4d, 4>;
ScreenSides screenSides(const ScreenRect& bounds, const osg::Matrixd& clipFromLocal);
/// False if a box is beyond one of the sides: nothing of it can be seen in that part.
bool mayTouch(const osg::BoundingBox& box, const ScreenSides& sides);

/// A big geometry in runs of 16 triangles or fewer, in the order in which it draws them, each with its box: so that part
/// of it can be drawn again from the same arrays.
class TriangleClusters : public osg::Referenced {
public:
    /// Consecutive corners within one primitive set.
    struct Run {
        unsigned primitiveSet, first, count;
    };

    /// Those of a drawable as it is now; null where it must be drawn whole: it is small, no plain osg::Geometry, or has
    /// primitives other than triangles, quads and triangle strips, instances, a draw callback or a bounding box that is
    /// not its vertices'. Made once a revision of its arrays and kept about as long as the drawable lives. Any thread.
    /// Not for what a program, primitive restart or a vertex array object draws: that the caller asks of the state.
    static osg::ref_ptr<const TriangleClusters> of(const osg::Drawable& drawable);
    /// False where of() gives null because the geometry is small.
    static bool isBig(const osg::Geometry& geometry);

    /// Runs that can touch a part of the screen, neighbours joined.
    /// @param test  of boxes in the drawable's frame; false for one leaves it out. May be empty.
    std::vector<Run> touching(const ScreenRect& bounds, const osg::Matrixd& clipFromLocal,
                              const std::function<bool(const osg::BoundingBox&)>& test = {}) const;

    /// Draws runs of the geometry that these clusters are of, as it draws itself.
    static void draw(osg::RenderInfo& renderInfo, const osg::Geometry& geometry, const std::vector<Run>& runs);

protected:
    ~TriangleClusters() override = default;

private:
    explicit TriangleClusters(const osg::Geometry& geometry);

    struct Cluster {
        Run run;
        osg::BoundingBox box;
    };
    void cut(const osg::PrimitiveSet& primitives, unsigned index, const osg::Vec3Array& vertices);

    std::vector<Cluster> _clusters;
};

} // namespace gnomon
