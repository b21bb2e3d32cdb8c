// SPDX-License-Identifier: MIT
#pragma once
#include <gtest/gtest.h>
#include <support/Oracle.h>
#include <support/Scene.h>

#include <functional>
#include <vector>

namespace test {

/// The techniques that trials are run with: the same pictures are expected of all.
enum class By { Planar, Hull, Traced, Map, Volume, SmoothPlanar, SmoothTraced, SmoothVolume };
std::ostream& operator<<(std::ostream& out, By technique);

/// Cases of this fixture are run with each technique. All but planar, which has its plane, are told that the ground
/// receives.
class ByTechnique : public ::testing::TestWithParam<By> {
protected:
    ByTechnique();
    ~ByTechnique() override;
};
#define GNOMON_BY(suite, ...)                                                                                          \
    class suite : public ByTechnique {};                                                                               \
    INSTANTIATE_TEST_SUITE_P(Shadows, suite, testing::Values(__VA_ARGS__), testing::PrintToStringParamName())
#define GNOMON_BY_TECHNIQUE(suite) GNOMON_BY(suite, By::Planar, By::Hull, By::Traced, By::Map, By::Volume)
/// With smooth edges, too, where no picture is held against rays.
#define GNOMON_BY_SMOOTH_TECHNIQUE(suite)                                                                              \
    GNOMON_BY(suite, By::Planar, By::Hull, By::Traced, By::Map, By::Volume, By::SmoothPlanar, By::SmoothTraced,        \
              By::SmoothVolume)

/// For z = 0: the technique of the case that is run, else planar.
osg::ref_ptr<gnomon::ShadowTechnique> castingTechnique(osg::Node* receiver = nullptr);

/// A ground at z = 0, casters over it and one light, seen by one view.
struct Trial {
    std::vector<Mesh> casters;
    osg::Vec4d light{1.0, 0.0, 1.0, 0.0};
    View view = fromAbove(4.0, 128);
    double half = 8.0; ///< of the ground's side.
    int mapEdge = 2;   ///< pixels from an edge to where Map must be right, see shows().

    Scene build() const { return groundScene(casters, half, light); }
    /// The same with shadows on z = 0.
    Scene buildWithShadow() const;
};

/// What a trial ought to show: two pictures drawn without Gnomon, and rays that choose between them.
struct Truth {
    Picture lit, dark;
    Mask mask;
    int mapEdge = 2; ///< see Trial.

    int shadowPixels() const { return mask.count(Seen::ShadowedReceiver); }
};
Truth truthOf(const Trial& trial);
/// The same with something done to the scene that changes no shadow's place.
using Change = std::function<void(Scene& scene)>;
Truth truthOf(const Trial& trial, const Change& change);
/// The same, its shadow cast by another light than the one that shines: for lamps too far for a ray's parameter.
Truth truthOf(const Trial& trial, const osg::Vec4d& lightOfRays);

Picture black(const Picture& sizeOf);

/// The picture has the dark one's colours where the rays meet a caster, the lit one's elsewhere, bit for bit; at edges
/// either, since a rasteriser may decide about a pixel's centre on an edge otherwise than a ray in double. Of a map, edges
/// are two pixels wide on either side: its 1024 texels on a side lie over what is seen of some 100 to 400 pixels, a half
/// more for what it keeps in reserve and for corners that are cut off, so that a texel is less than a pixel.
::testing::AssertionResult shows(const Picture& actual, const Truth& truth);
/// The same where BLEND makes shadows black: seen also where the light's own share is nothing.
::testing::AssertionResult showsInBlack(const Picture& actual, const Truth& truth);
::testing::AssertionResult same(const Picture& actual, const Picture& expected);

/// Frames 1 to 3 (relit without and with what is known of solids, then blended to black) are what the rays say.
::testing::AssertionResult isRight(Scene& scene, const View& view, const Truth& truth);
::testing::AssertionResult isRight(const Trial& trial);
::testing::AssertionResult isRight(const Trial& trial, const Change& change);
/// Where the light stands. What faces away from it traced and map take to be in its own shadow: relit that shows nothing.
enum class Ground { ToTheLight, Away };
/// Neither relit nor, but for what those do to a ground that faces away, blended to black does the picture differ from
/// `lit`, by any bit.
::testing::AssertionResult isUnshadowed(Scene& scene, const View& view, const Picture& lit,
                                        Ground turned = Ground::ToTheLight);
::testing::AssertionResult isUnshadowed(const Trial& trial);

} // namespace test
