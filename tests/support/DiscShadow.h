// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/ShadowTechnique.h>

#include <atomic>
#include <memory>
#include <set>

namespace test {

/// A "technique" whose shadow is a disc on the screen, whatever casts: tells the compositor apart from how marks are found.
/// Radii in pixels. Between `inner` and `outer` the light fades in linearly.
class DiscShadow : public gnomon::ShadowTechnique {
public:
    DiscShadow(const osg::Vec2d& at, double fullTo, double noneFrom) : centre(at), inner(fullTo), outer(noneFrom) {}
    DiscShadow(const osg::Vec2d& at, double radius) : DiscShadow(at, radius, radius) {}
    DiscShadow(const DiscShadow&, const osg::CopyOp&) = delete;

    std::vector<osg::ref_ptr<gnomon::Mark>> prepare(const gnomon::ViewFrame& view, const gnomon::ShadowLight& light,
                                                    const gnomon::Casters& casters) const override;

    /// Share of the light that reaches a pixel's centre.
    double arriving(int x, int y) const;

    osg::Vec2d centre;
    double inner, outer;
    std::set<int> lights; ///< those it blocks; empty: all.
    osg::Vec2d size;      ///< of the viewport, in pixels.
    const std::shared_ptr<std::atomic<int>> draws = std::make_shared<std::atomic<int>>(0); ///< of its marks, so far.

protected:
    ~DiscShadow() override = default;
};

} // namespace test
