// SPDX-License-Identifier: MIT
#include <gnomon/ShadowBin.h>
#include <gnomon/StageDraw.h>

#include <algorithm>

namespace gnomon {

StageDraw::StageDraw(osg::RenderInfo& info, osgUtil::RenderStage& drawn, std::vector<StageLeaf> before, bool isClean)
    : renderInfo(info), state(*info.getState()), stage(drawn), leaves(std::move(before)), clean(isClean) {
    GLint stencil = 0, alpha = 0;
    glGetIntegerv(GL_STENCIL_BITS, &stencil);
    glGetIntegerv(GL_ALPHA_BITS, &alpha);
    hasStencil = stencil > 0;
    hasAlpha = alpha > 0;
    for (int i = std::min(stencil, 8); i-- > 0;)
        if (!(ShadowBin::reserved() & (1u << i))) bits.push_back(1u << i);
}

void StageDraw::clear(unsigned stencil, const ScreenRect& bounds) const {
    pass(bounds, [stencil](ScreenPass& screen) { screen.clearStencil(stencil); });
}

void StageDraw::clearLeftovers(unsigned stencil) const {
    if (!clean) clear(stencil, {{-1.0, -1.0}, {1.0, 1.0}});
}

} // namespace gnomon
