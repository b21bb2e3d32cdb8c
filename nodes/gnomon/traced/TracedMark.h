// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/RayScene.h>
#include <gnomon/base/RecentCache.h>
#include <gnomon/casters/CasterDrawables.h>
#include <gnomon/compositor/MarkJob.h>
#include <gnomon/gl/FrameCopies.h>
#include <gnomon/rays/DepthBufferShadow.h>

#include <OpenThreads/Mutex>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon {

/// What rays are cast for in one view and of one light.
struct TracedFrame {
    const void* stage = nullptr; ///< tells views apart.
    int light = 0;               ///< number.
    std::shared_ptr<const RayScene> scene;
    osg::ref_ptr<const CasterDrawables> pieces; ///< of the scene; null if they are not known.
    osg::Vec3d origin;                          ///< of the scene, group frame.
    glm::dmat4 clipFromScene{1.0};
    glm::dvec4 lightInScene{0.0};
    DepthPicture picture; ///< the depths of it.
};

/// The answers of a technique's last frames, so that rays are cast only where depth, light or casters have changed.
///
/// Cost
/// - Four bytes a pixel, of each light in each of the last eight views.
/// Threads
/// - Any number.
class TracedFrames {
public:
    /// Bits of a frame, as depthBufferShadow() has them. Casts rays only where they may differ from the last ones of the same
    /// view and light.
    std::vector<std::uint8_t> bitsOf(TracedFrame frame);
    /// How many pixels rays were cast for so far.
    std::size_t traced() const { return _traced; }

private:
    /// A caster, for comparisons.
    struct Piece {
        std::uint64_t fingerprint;
        osg::BoundingBoxd bounds; ///< group frame.
    };
    using Pieces = std::vector<Piece>;
    struct Known {
        TracedFrame frame;                    ///< without scene and pieces, which may be large.
        std::weak_ptr<const RayScene> scene;  ///< of it.
        std::shared_ptr<const Pieces> pieces; ///< of it; null if they are not known.
        std::vector<std::uint8_t> bits;
    };
    static constexpr std::size_t most = 8;

    static std::shared_ptr<const Pieces> piecesOf(const CasterDrawables* casters);
    static bool addMissing(const Pieces& pieces, const Pieces& others, const osg::Vec3d& origin,
                           std::vector<RayBox>& boxes);
    static std::optional<std::vector<RayBox>> changesBetween(const Known& before, const Pieces* now,
                                                             const osg::Vec3d& origin);
    std::shared_ptr<const Known> find(const TracedFrame& frame);
    void keep(std::shared_ptr<const Known> known);

    OpenThreads::Mutex _mutex;
    RecentCache<std::shared_ptr<const Known>> _known;
    std::atomic<std::size_t> _traced{0};
};

/// Marks of one light in one view: a ray to the light from where the depth buffer says a surface is.
class TracedMark : public MarkJob {
public:
    TracedFrame frame;                       ///< without the picture.
    std::shared_ptr<TracedFrames> frames;    ///< the technique's.
    std::shared_ptr<ResolvedDepth> resolved; ///< the technique's, for framebuffers with several samples.
    double rounding = 0.0;                   ///< of the casters' vertices.
    glm::dvec2 pushedBack{0.0};              ///< see ViewFrame.

    /// Rays find the surface within what a depth may mean.
    double depthSteps() const override { return 0.0; }
    std::string mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const override;

protected:
    ~TracedMark() override = default;
};

} // namespace gnomon
