// SPDX-License-Identifier: MIT
#include <gnomon/compositor/CompositorStage.h>
#include <gnomon/compositor/LeafReplay.h>
#include <gnomon/compositor/ReplaySelection.h>
#include <gnomon/effects/HaloEffect.h>

#include <algorithm>

namespace gnomon {
namespace {

constexpr unsigned mostCounted = 7;

/// All pixels of a disc.
std::vector<glm::ivec2> disc(int radius) {
    std::vector<glm::ivec2> pixels;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x)
            if (x * x + y * y <= radius * radius) pixels.push_back({x, y});
    return pixels;
}

/// Of the free bits those from bit 0 on, up to mostCounted: they count.
unsigned countingBits(const std::vector<unsigned>& free) {
    unsigned bits = 0;
    for (unsigned bit = 1; bit <= mostCounted && std::count(free.begin(), free.end(), bit); bit <<= 1) bits |= bit;
    return bits;
}

} // namespace

/// The leaves do not depend on what else the stage draws.
void HaloEffect::prepare(osgUtil::RenderStage&, const std::vector<DrawnLeaf>&) {
    const std::vector<DrawnLeaf> unsorted = children->leaves();
    for (std::size_t i = 0; i < larger.size(); ++i) {
        const osgUtil::RenderLeaf& leaf = *unsorted[i].leaf;
        osg::ref_ptr<osgUtil::RenderLeaf> own =
            new osgUtil::RenderLeaf(leaf._drawable, leaf._projection, new osg::RefMatrix(larger[i]), leaf._depth);
        own->_parent = leaf._parent;
        _own.push_back(own);
        _larger.push_back({own, unsorted[i].bin});
    }
    _leaves = children->sortedLeaves();
}

void HaloEffect::draw(const CompositorStage& draw) const {
    if (!stencilCure) return blendEachTriangle(draw);
    const unsigned bit = draw.bits.front();
    draw.clearLeftovers(bit);
    markRim(draw, bit);
    draw.pass(wholeScreen, [&](ScreenPass& screen) {
        screen.takeStencil(bit, bit);
        blend(screen);
    });
    draw.clear(bit, wholeScreen);
}

/// Where the larger children would be seen, but for what one sees of the children themselves.
void HaloEffect::markRim(const CompositorStage& draw, unsigned bit) const {
    LeafReplay::Overlay overlay;
    overlay.color = LeafReplay::Color::None;
    overlay.keepDepth = true;
    overlay.reference = overlay.write = bit;
    if (larger.empty()) overlay.shifts = disc(width);
    {
        LeafReplay replay(draw, overlay);
        for (const DrawnLeaf& entry : larger.empty() ? _leaves : _larger) replay.draw(entry);
    }
    overlay.shifts.clear();
    overlay.reference = 0;
    overlay.equalDepth = true;
    LeafReplay replay(draw, overlay);
    for (const DrawnLeaf& entry : _leaves) replay.draw(entry);
}

void HaloEffect::blend(ScreenPass& screen) const {
    screen.blendColor(osg::Vec3(color.x(), color.y(), color.z()), color.w());
}

/// Without the stencil cure: counts the triangles over each pixel, and blends as many times.
void HaloEffect::blendEachTriangle(const CompositorStage& draw) const {
    const unsigned bits = countingBits(draw.bits);
    if (bits == 0)
        return report("without the stencil cure the halo cannot count triangles, because stencil bit 0 is "
                      "reserved. Leave bit 0 out of CompositorOptions::reservedStencilBits, or switch the cure on.");
    draw.clearLeftovers(bits);
    LeafReplay::Overlay overlay;
    overlay.color = LeafReplay::Color::None;
    overlay.keepDepth = true;
    overlay.write = bits;
    overlay.stencilPass = GL_INCR;
    if (larger.empty()) overlay.shifts = disc(width);
    {
        LeafReplay replay(draw, overlay);
        for (const DrawnLeaf& entry : larger.empty() ? _leaves : _larger) replay.draw(entry);
    }
    for (unsigned times = 1; times <= bits; ++times)
        draw.pass(wholeScreen, [&](ScreenPass& screen) {
            screen.stencilAtLeast(times, bits);
            blend(screen);
        });
    draw.clear(bits, wholeScreen);
}

} // namespace gnomon
