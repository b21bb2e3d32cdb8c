// SPDX-License-Identifier: MIT
#pragma once
#include <osg/GLExtensions>
#include <osg/State>

namespace gnomon {

/// While it lives, pixels go to and come from memory as they are, without gaps.
class PlainPixels {
public:
    explicit PlainPixels(const osg::State& state) : _extensions(*state.get<osg::GLExtensions>()) {
        glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
        glPushAttrib(GL_CURRENT_BIT | GL_PIXEL_MODE_BIT);
        for (GLenum size : {GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS, GL_PACK_SKIP_ROWS, GL_PACK_SWAP_BYTES,
                            GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_PIXELS, GL_UNPACK_SKIP_ROWS, GL_UNPACK_LSB_FIRST})
            glPixelStorei(size, 0);
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
        glPixelTransferf(GL_DEPTH_SCALE, 1.0f);
        glPixelTransferf(GL_DEPTH_BIAS, 0.0f);
        if (!_extensions.isPBOSupported) return;
        for (GLenum buffer : {GL_PIXEL_PACK_BUFFER_ARB, GL_PIXEL_UNPACK_BUFFER_ARB})
            _extensions.glBindBuffer(buffer, 0);
    }
    ~PlainPixels() {
        glPopAttrib();
        glPopClientAttrib();
    }
    PlainPixels(const PlainPixels&) = delete;
    PlainPixels& operator=(const PlainPixels&) = delete;

private:
    const osg::GLExtensions& _extensions;
};

} // namespace gnomon
