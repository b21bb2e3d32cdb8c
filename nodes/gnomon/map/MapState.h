// SPDX-License-Identifier: MIT
#pragma once
#include <gnomon/gl/ScreenPass.h>

#include <osg/GL>

namespace gnomon {

/// OpenGL as a map is drawn under; put back at its end.
class MapState {
public:
    explicit MapState(double slopeOffset) {
        glPushAttrib(GL_ENABLE_BIT | GL_VIEWPORT_BIT | GL_DEPTH_BUFFER_BIT | GL_POLYGON_BIT | GL_SCISSOR_BIT |
                     GL_STENCIL_BUFFER_BIT);
        for (const GLenum mode : {GL_STENCIL_TEST, GL_CULL_FACE}) glDisable(mode);
        for (GLenum plane = GL_CLIP_PLANE0; plane <= GL_CLIP_PLANE5; ++plane) glDisable(plane);
        for (const GLenum mode :
             {GLenum(GL_SCISSOR_TEST), GLenum(GL_DEPTH_TEST), depthClamp, GLenum(GL_POLYGON_OFFSET_FILL)})
            glEnable(mode);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glDepthRange(0.0, 1.0);
        glClearDepth(1.0);
        glPolygonOffset(static_cast<GLfloat>(slopeOffset), 0.0f);
    }
    ~MapState() { glPopAttrib(); }
    MapState(const MapState&) = delete;
    MapState& operator=(const MapState&) = delete;
};

} // namespace gnomon
