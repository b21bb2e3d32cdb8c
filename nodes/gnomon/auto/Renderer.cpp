// SPDX-License-Identifier: MIT
#include <gnomon/auto/Renderer.h>

#include <osg/GL>

#include <algorithm>
#include <initializer_list>
#include <string>

namespace gnomon {

Renderer currentRenderer() {
    const GLubyte* text = glGetString(GL_RENDERER);
    if (!text) return Renderer::Unknown;
    const std::string renderer = reinterpret_cast<const char*>(text);
    const std::initializer_list<const char*> processors = {"llvmpipe", "softpipe", "SWR", "Software", "SwiftShader"};
    const bool processor = std::any_of(processors.begin(), processors.end(),
                                       [&](const char* name) { return renderer.find(name) != std::string::npos; });
    return processor ? Renderer::Processor : Renderer::Graphics;
}

void RendererFact::begin(osg::RenderInfo&) {
    if (value == Renderer::Unknown) value = currentRenderer();
}

} // namespace gnomon
