// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>

#include <osg/Matrixd>
#include <osg/Vec3d>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::testing {

/// A place that looks at the origin, y up. Degrees; at azimuth 0 on the z axis.
osg::Vec3d onOrbit(double elevation, double azimuth, double distance);

/// A spotlight on the origin, 40 degrees wide, with a map of 508 × 508 texels.
struct TracedLamp {
    osg::Vec3d place, color; ///< color: 0 … 1, diffuse and specular.
    double ambient = 0.0;
    double turned = 0.0; ///< about its own upright, degrees, to its right.
};

/// How lights add up to a pixel: a pass each, of its whole light inside its square beam; or together, where shadows take
/// all but the ambient light away.
enum class Sum { Passes, Compositor };

/// Objects as OpenGL lights them, at their vertices, without Gnomon's or OpenGL's code, and shadows by rays.
///
/// Limits  triangles of osg::Geometry with a material each, without textures or transforms.
class TracedScene {
public:
    struct Size {
        int width, height;
    };
    /// @param radius  that the corners of the box about all are scaled to.
    /// @param eye  looks at the origin, 40 degrees wide.
    TracedScene(const std::string& file, double radius, const osg::Vec3d& eye, const Size& size);

    struct Pixel {
        osg::Vec3d color; ///< 0 … 255.
        int shadows = 0;  ///< lights that do not reach it.
    };
    /// From the lower left. @return nullopt where nothing is seen, or what is seen changes within a fiftieth of a pixel, or
    /// a light's shadow or beam has an edge 2 texels away or less; of the compositor's where a surface ends a pixel away.
    std::optional<Pixel> color(int x, int y, const std::vector<TracedLamp>& lamps, Sum sum) const;

private:
    struct Material {
        osg::Vec3d diffuse, specular;
        double shininess = 0.0;
    };
    struct Corner {
        osg::Vec3d place, normal;
        std::size_t material = 0;
    };
    struct Seen {
        osg::Vec3d place, normal; ///< of the triangle, towards the eye.
        std::array<const Corner*, 3> corners;
        osg::Vec3d weights;
    };
    /// Which part of a lamp's light there is at a point and all about it; nullopt where that changes.
    struct Arrival {
        bool reaches, inBeam;
    };

    void read(const std::string& file, double radius);
    std::optional<Seen> see(double x, double y) const;
    osg::Vec3d lit(const Corner& corner, const TracedLamp& lamp, bool ambientOnly) const;
    osg::Vec3d lit(const Seen& seen, const std::vector<TracedLamp>& lamps, const std::vector<bool>& ambientOnly) const;
    bool standsAlone(double x, double y, const Seen& seen, const TracedLamp& lamp) const;
    /// Whether the pixels beside it see the same surface: ShadowMapTechnique takes its slope from them.
    bool goesOn(double x, double y, const Seen& seen) const;
    std::optional<Arrival> arrival(const Seen& seen, const TracedLamp& lamp) const;

    osg::Vec3d _eye;
    Size _size;
    osg::Matrixd _worldFromClip;
    std::vector<Corner> _corners; ///< three a triangle.
    std::vector<Material> _materials;
    std::unique_ptr<RayScene> _rays;
};

} // namespace gnomon::testing
