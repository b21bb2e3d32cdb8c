// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/auto/AutoCandidate.h>
#include <gnomon/auto/RendererCosts.h>
#include <gnomon/choice/CostCorrection.h>
#include <gnomon/compositor/DrawWatch.h>

#include <OpenThreads/Mutex>
#include <osg/Referenced>

#include <array>
#include <atomic>
#include <memory>
#include <optional>

namespace gnomon {

/// What an AutoShadowTechnique has learnt of what work takes: from its renderer, and from frames.
///
/// Threads
/// - Any number. Cull asks, draw tells.
class FrameCosts : public osg::Referenced {
public:
    FrameCosts() = default;

    /// False if costs are fixed, see RendererCosts::areMeasured().
    bool areMeasured() const { return _measured; }
    /// The first call may read the user's cache: in the first frame's cull, no renderer can be asked.
    AutoCosts now();
    /// Rises whenever now() changes.
    unsigned generation() const { return _generation; }
    /// True if enough frames of a kind were measured to tell what it takes.
    bool isKnown(AutoCandidate::Kind kind);
    /// False before the renderer's costs are known.
    bool knowRenderer() const { return _knowRenderer; }

    /// In draw: takes the renderer's costs.
    void learn(osg::RenderInfo& renderInfo);

    /// A frame that is measured.
    struct Frame {
        AutoCandidate::Kind kind;
        ShadowWork work;                            ///< counted before.
        double prepared = 0.0;                      ///< milliseconds in cull.
        std::shared_ptr<std::atomic<double>> taken; ///< gets the milliseconds that it took.
        bool moving = false;                        ///< a light or a caster has moved.
    };
    void add(const Frame& frame, double drawn);

protected:
    ~FrameCosts() override = default;

private:
    double predicted(const Frame& frame) const;

    const bool _measured = RendererCosts::areMeasured();
    OpenThreads::Mutex _mutex;
    std::optional<CostRates> _rates; ///< nullopt before the first call of now() or learn().
    std::array<CostCorrection, AutoCosts::kinds> _still, _moving;
    std::atomic<unsigned> _generation{0};
    std::atomic<bool> _knowRenderer{false};
};

/// Learns from one frame of one view, in draw.
class CostWatch : public DrawWatch {
public:
    /// @param frame  nullopt: only the renderer's costs are asked for.
    CostWatch(FrameCosts& costs, std::optional<FrameCosts::Frame> frame);
    void begin(osg::RenderInfo& renderInfo) override;
    void end(osg::RenderInfo& renderInfo) override;

protected:
    ~CostWatch() override;

private:
    const osg::ref_ptr<FrameCosts> _costs;
    const std::optional<FrameCosts::Frame> _frame;
    std::unique_ptr<class DrawClock> _clock;
};

} // namespace gnomon
