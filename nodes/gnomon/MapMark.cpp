// SPDX-License-Identifier: MIT
#include <gnomon/MapMark.h>
#include <gnomon/ScreenPass.h>

namespace gnomon {
namespace {

constexpr double half = 0.5;
constexpr double whole = 511.0 / 512.0; // less than that is a step of eight bits of alpha
constexpr double any = 2.0;

std::string markBelow(const MapQuad& quad, double share, osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) {
    pass.stencilEqual(bit, 0, bit);
    return quad.draw(renderInfo, pass, share);
}

} // namespace

std::string MapMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    return markBelow(quad, half, renderInfo, pass, bit);
}

std::string SoftMapMark::mark(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    return markBelow(quad, half, renderInfo, pass, bit);
}

std::string SoftMapMark::markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    return markBelow(quad, whole, renderInfo, pass, bit);
}

std::string SoftMapMark::drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const {
    return quad.draw(renderInfo, pass, any, share == Share::Blocked);
}

} // namespace gnomon
