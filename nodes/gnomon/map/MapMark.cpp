// SPDX-License-Identifier: MIT
#include <gnomon/map/MapMark.h>

namespace gnomon {

std::string SoftMapMark::markTouched(osg::RenderInfo& renderInfo, ScreenPass& pass, unsigned bit) const {
    return markBelow(allOfIt, renderInfo, pass, bit);
}

std::string SoftMapMark::drawShare(osg::RenderInfo& renderInfo, ScreenPass& pass, Share share) const {
    constexpr double any = 2.0;
    return quad.draw(renderInfo, pass, {any, share == Share::Blocked, 1.0});
}

} // namespace gnomon
