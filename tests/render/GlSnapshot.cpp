// SPDX-License-Identifier: MIT
#include "GlSnapshot.h"

#include <osg/GLExtensions>
#include <osg/Texture>

#include <sstream>

namespace test {
namespace {

struct Name {
    const char* text;
    GLenum value;
    int count;
};
#define NAME(name, count)                                                                                              \
    { #name, name, count }

// Not in OSG's headers of 3.6.
constexpr GLenum vertexArrayBinding = 0x85B5, currentProgram = 0x8B8D, elementArrayBufferBinding = 0x8895,
                 depthClamp = 0x864F;

const Name values[] = {{"program", currentProgram, 1},
                       {"vertex array", vertexArrayBinding, 1},
                       {"array buffer", 0x8894, 1},
                       {"element array buffer", elementArrayBufferBinding, 1},
                       {"pixel pack buffer", 0x88ED, 1},
                       {"pixel unpack buffer", 0x88EF, 1},
                       {"draw framebuffer", 0x8CA6, 1},
                       {"read framebuffer", 0x8CAA, 1},
                       {"renderbuffer", 0x8CA7, 1},
                       {"active texture", 0x84E0, 1},
                       {"client active texture", 0x84E1, 1},
                       {"blend source", 0x80C9, 1},
                       {"blend destination", 0x80C8, 1},
                       {"blend source alpha", 0x80CB, 1},
                       {"blend destination alpha", 0x80CA, 1},
                       {"blend equation", 0x8009, 1},
                       {"blend colour", 0x8005, 4},
                       {"back stencil function", 0x8800, 1},
                       {"back stencil fail", 0x8801, 1},
                       {"back stencil z fail", 0x8802, 1},
                       {"back stencil z pass", 0x8803, 1},
                       {"back stencil reference", 0x8CA3, 1},
                       NAME(GL_COLOR_WRITEMASK, 4),
                       NAME(GL_DEPTH_WRITEMASK, 1),
                       NAME(GL_STENCIL_FUNC, 1),
                       NAME(GL_STENCIL_REF, 1),
                       NAME(GL_STENCIL_FAIL, 1),
                       NAME(GL_STENCIL_PASS_DEPTH_FAIL, 1),
                       NAME(GL_STENCIL_PASS_DEPTH_PASS, 1),
                       NAME(GL_STENCIL_CLEAR_VALUE, 1),
                       NAME(GL_COLOR_CLEAR_VALUE, 4),
                       NAME(GL_DEPTH_CLEAR_VALUE, 1),
                       NAME(GL_DEPTH_FUNC, 1),
                       NAME(GL_DEPTH_RANGE, 2),
                       NAME(GL_SCISSOR_BOX, 4),
                       NAME(GL_VIEWPORT, 4),
                       NAME(GL_CULL_FACE_MODE, 1),
                       NAME(GL_FRONT_FACE, 1),
                       NAME(GL_POLYGON_MODE, 2),
                       NAME(GL_POLYGON_OFFSET_FACTOR, 1),
                       NAME(GL_POLYGON_OFFSET_UNITS, 1),
                       NAME(GL_SHADE_MODEL, 1),
                       NAME(GL_LINE_WIDTH, 1),
                       NAME(GL_POINT_SIZE, 1),
                       NAME(GL_ALPHA_TEST_FUNC, 1),
                       NAME(GL_ALPHA_TEST_REF, 1),
                       NAME(GL_LOGIC_OP_MODE, 1),
                       NAME(GL_MATRIX_MODE, 1),
                       NAME(GL_MODELVIEW_MATRIX, 16),
                       NAME(GL_PROJECTION_MATRIX, 16),
                       NAME(GL_TEXTURE_MATRIX, 16),
                       NAME(GL_MODELVIEW_STACK_DEPTH, 1),
                       NAME(GL_PROJECTION_STACK_DEPTH, 1),
                       NAME(GL_ATTRIB_STACK_DEPTH, 1),
                       NAME(GL_CLIENT_ATTRIB_STACK_DEPTH, 1),
                       NAME(GL_DRAW_BUFFER, 1),
                       NAME(GL_READ_BUFFER, 1),
                       NAME(GL_LIGHT_MODEL_AMBIENT, 4),
                       NAME(GL_LIGHT_MODEL_TWO_SIDE, 1),
                       NAME(GL_FOG_COLOR, 4),
                       NAME(GL_PACK_ALIGNMENT, 1),
                       NAME(GL_UNPACK_ALIGNMENT, 1)};

/// Of eight bits, whatever stands above them.
const Name stencilMasks[] = {NAME(GL_STENCIL_WRITEMASK, 1),
                             NAME(GL_STENCIL_VALUE_MASK, 1),
                             {"back stencil value mask", 0x8CA4, 1},
                             {"back stencil write mask", 0x8CA5, 1}};

const Name capabilities[] = {NAME(GL_LIGHTING, 1),
                             NAME(GL_BLEND, 1),
                             NAME(GL_ALPHA_TEST, 1),
                             NAME(GL_DEPTH_TEST, 1),
                             NAME(GL_STENCIL_TEST, 1),
                             {"two-sided stencil test", 0x8910, 1},
                             NAME(GL_SCISSOR_TEST, 1),
                             NAME(GL_CULL_FACE, 1),
                             NAME(GL_POLYGON_OFFSET_FILL, 1),
                             NAME(GL_POLYGON_OFFSET_LINE, 1),
                             NAME(GL_FOG, 1),
                             NAME(GL_NORMALIZE, 1),
                             NAME(GL_COLOR_MATERIAL, 1),
                             NAME(GL_COLOR_LOGIC_OP, 1),
                             NAME(GL_LINE_SMOOTH, 1),
                             {"depth clamp", depthClamp, 1},
                             {"multisample", 0x809D, 1},
                             {"alpha to coverage", 0x809E, 1},
                             {"secondary colour", 0x8458, 1}};
#undef NAME

template <class Get>
std::vector<float> asked(int count, Get get) {
    std::vector<float> result(16, 0.0f);
    get(result.data());
    result.resize(static_cast<std::size_t>(count));
    return result;
}

void addNumbered(GlSnapshot& snapshot) {
    for (unsigned i = 0; i < 8; ++i) {
        const std::string number = " " + std::to_string(i);
        snapshot["light" + number] = {static_cast<float>(glIsEnabled(GL_LIGHT0 + i))};
        snapshot["clip plane" + number] = {static_cast<float>(glIsEnabled(GL_CLIP_PLANE0 + i))};
        for (const GLenum what : {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_POSITION})
            snapshot["light" + number + " parameter " + std::to_string(what)] =
                asked(4, [&](float* to) { glGetLightfv(GL_LIGHT0 + i, what, to); });
    }
    for (const GLenum what : {GL_AMBIENT, GL_DIFFUSE, GL_SPECULAR, GL_EMISSION})
        snapshot["material parameter " + std::to_string(what)] =
            asked(4, [&](float* to) { glGetMaterialfv(GL_FRONT, what, to); });
}

void addTextures(GlSnapshot& snapshot) {
    using ActiveTexture = void (*)(GLenum);
    ActiveTexture activeTexture = nullptr;
    osg::setGLExtensionFuncPtr(activeTexture, "glActiveTexture");
    GLint active = 0;
    glGetIntegerv(0x84E0, &active);
    for (GLenum unit = 0; unit < 8; ++unit) {
        activeTexture(GL_TEXTURE0 + unit);
        const std::string number = " " + std::to_string(unit);
        snapshot["texture of unit" + number] = asked(1, [](float* to) { glGetFloatv(GL_TEXTURE_BINDING_2D, to); });
        snapshot["texturing of unit" + number] = {static_cast<float>(glIsEnabled(GL_TEXTURE_2D))};
        snapshot["environment of unit" + number] =
            asked(1, [](float* to) { glGetTexEnvfv(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, to); });
    }
    activeTexture(static_cast<GLenum>(active));
}

} // namespace

GlSnapshot glSnapshot() {
    GlSnapshot snapshot;
    for (const Name& name : values)
        snapshot[name.text] = asked(name.count, [&](float* to) { glGetFloatv(name.value, to); });
    for (const Name& name : capabilities) snapshot[name.text] = {static_cast<float>(glIsEnabled(name.value))};
    for (const Name& name : stencilMasks) {
        GLint mask = 0;
        glGetIntegerv(name.value, &mask);
        snapshot[name.text] = {static_cast<float>(mask & 0xff)};
    }
    addNumbered(snapshot);
    addTextures(snapshot);
    while (glGetError()) {
    } // of a name that this context does not know
    return snapshot;
}

std::string difference(const GlSnapshot& expected, const GlSnapshot& actual) {
    std::ostringstream text;
    if (expected.empty() || expected.size() != actual.size()) text << "the state was not asked for\n";
    for (const auto& [name, value] : expected) {
        const auto found = actual.find(name);
        if (found == actual.end() || found->second == value) continue;
        text << name << ": ";
        for (const float number : found->second) text << number << ' ';
        text << "instead of ";
        for (const float number : value) text << number << ' ';
        text << '\n';
    }
    return text.str();
}

GlProbe::GlProbe() {
    setSupportsDisplayList(false);
    setCullingActive(false);
}

} // namespace test
