// SPDX-License-Identifier: MIT
#include <gnomon/MapMark.h>

namespace gnomon {

std::string SoftMapMark::markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    constexpr double whole = 511.0 / 512.0; // less than that is a step of eight bits of alpha
    return markBelow(whole, renderInfo, pass, bit);
}

std::string SoftMapMark::drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const {
    constexpr double any = 2.0;
    return quad.draw(renderInfo, pass, any, share == Share::Blocked);
}

} // namespace gnomon
