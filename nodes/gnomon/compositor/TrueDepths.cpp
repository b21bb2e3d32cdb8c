// SPDX-License-Identifier: MIT
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/TrueDepths.h>

#include <vector>

namespace gnomon {

TrueDepths::TrueDepths(const CompositorStage& draw, const ScreenRect& bounds) : _draw(draw), _bounds(bounds) {
    if (_draw.vast.empty()) return;
    const unsigned bit = _draw.vastBit;
    if (!_draw.clean) _draw.clear(bit, _bounds);
    std::vector<ReplayedLeaf> leaves;
    for (const VastLeaf& leaf : _draw.vast) leaves.push_back({leaf.entry, 0});
    writeWhereSeen(_draw, leaves, bit, bit, _bounds);
    _draw.pass(_bounds, [&](ScreenPass& screen) {
        screen.stencilEqual(bit, bit, 0);
        screen.writeFarDepth();
        for (const VastLeaf& leaf : _draw.vast) {
            const DepthPlacement placement = depthPlacementOf(leaf.entry.leaf->_parent);
            const osg::Vec2d offset = polygonOffsetOf(leaf.entry.leaf->_parent);
            screen.writeDepths(leaf.corners, {placement.nearest, placement.farthest}, {offset.x(), offset.y()});
        }
    });
}

/// The leaf alone, as it was drawn: it was what one saw there.
TrueDepths::~TrueDepths() {
    if (_draw.vast.empty()) return;
    const unsigned bit = _draw.vastBit;
    _draw.pass(_bounds, [&](ScreenPass& screen) {
        screen.stencilEqual(bit, bit, 0);
        screen.writeFarDepth();
    });
    LeafReplay::Overlay overlay;
    overlay.stencilFunction = GL_EQUAL;
    overlay.reference = overlay.test = bit;
    overlay.color = LeafReplay::Color::None;
    overlay.bounds = _bounds;
    {
        LeafReplay replay(_draw, overlay);
        for (const VastLeaf& leaf : _draw.vast) replay.draw(leaf.entry);
    }
    _draw.clear(bit, _bounds);
}

} // namespace gnomon
