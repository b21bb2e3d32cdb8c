// SPDX-License-Identifier: MIT
#include "WindowPicture.h"

namespace gnomon::examples {

WindowPicture::WindowPicture(osg::GraphicsContext& window) : _own(window.getSwapCallback()) {}

void WindowPicture::swapBuffersImplementation(osg::GraphicsContext* window) {
    const osg::GraphicsContext::Traits& traits = *window->getTraits();
    _picture = new osg::
        Image; // from what is bound: toolkits give their windows framebuffers that OpenSceneGraph does not know
    glPushClientAttrib(GL_CLIENT_PIXEL_STORE_BIT);
    _picture->readPixels(0, 0, traits.width, traits.height, GL_RGBA, GL_UNSIGNED_BYTE);
    glPopClientAttrib();
    if (_own)
        _own->swapBuffersImplementation(window);
    else
        window->swapBuffersImplementation();
}

} // namespace gnomon::examples
