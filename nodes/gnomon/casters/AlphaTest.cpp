// SPDX-License-Identifier: MIT
#include <gnomon/casters/AlphaTest.h>
#include <gnomon/casters/PathState.h>

#include <osg/AlphaFunc>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/TexEnv>
#include <osg/TexMat>

#include <algorithm>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

bool isTextured(const PathState& state) {
    constexpr GLenum kinds[] = {GL_TEXTURE_2D, GL_TEXTURE_1D, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_TEXTURE_RECTANGLE};
    for (unsigned unit = 0; unit < state.units(); ++unit)
        for (const GLenum kind : kinds)
            if (state.isTextureOn(unit, kind)) return true;
    return false;
}

/// Null if alpha is something else's.
osg::Texture2D* textureOf(const PathState& state) {
    const bool generated = state.isTextureOn(0, GL_TEXTURE_GEN_S) || state.isTextureOn(0, GL_TEXTURE_GEN_T);
    if (state.hasProgram() || generated || !state.isTextureOn(0, GL_TEXTURE_2D)) return nullptr;
    return dynamic_cast<osg::Texture2D*>(state.textureAttribute(A::TEXTURE));
}

bool hasAlpha(const osg::Image& image) {
    constexpr GLenum without[] = {GL_LUMINANCE, GL_RED, GL_RG};
    const GLenum format = image.getPixelFormat();
    return osg::Image::computeNumComponents(format) != 3 &&
           std::find(std::begin(without), std::end(without), format) == std::end(without);
}

/// True if the texture's alpha is 1 everywhere, or counts for nothing.
bool isSolid(const osg::Texture2D& texture, const PathState& state) {
    const auto* environment = dynamic_cast<const osg::TexEnv*>(state.textureAttribute(A::TEXENV));
    return (environment && environment->getMode() == osg::TexEnv::DECAL) ||
           (texture.getImage() && !hasAlpha(*texture.getImage()));
}

template <class Number>
osg::Vec4d coordinate(const osg::Array& array, std::size_t i) {
    const unsigned size = array.getDataSize();
    const Number* at = static_cast<const Number*>(array.getDataPointer()) + i * size;
    osg::Vec4d result(0.0, 0.0, 0.0, 1.0);
    for (unsigned axis = 0; axis < size; ++axis) result[axis] = double{at[axis]};
    return result;
}

const osg::Array* coordinateArray(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    return geometry ? geometry->getTexCoordArray(0) : nullptr;
}

bool isAVertex(const osg::Array& array, const osg::Array* vertices) {
    return vertices && array.getNumElements() >= vertices->getNumElements() &&
           (array.getDataType() == GL_FLOAT || array.getDataType() == GL_DOUBLE) && array.getDataSize() <= 4;
}

} // namespace

bool AlphaTest::isOn(const osg::Node& node) {
    return node.getStateSet() && (node.getStateSet()->getMode(GL_ALPHA_TEST) & A::ON);
}

std::optional<AlphaTest> AlphaTest::of(const osg::NodePath& path) {
    const PathState state(path);
    const auto* test = dynamic_cast<const osg::AlphaFunc*>(state.attribute(A::ALPHAFUNC));
    if (!test || !state.isOn(GL_ALPHA_TEST) || test->getFunction() == osg::AlphaFunc::ALWAYS) return std::nullopt;
    AlphaTest result;
    result.passing = test->getFunction() - osg::AlphaFunc::NEVER; // whose order this is
    result.reference = std::clamp(test->getReferenceValue(), 0.0f, 1.0f);
    result.texture = textureOf(state);
    if (result.texture ? isSolid(*result.texture, state) : !isTextured(state) && !state.hasProgram())
        return std::nullopt;
    const auto* matrix = dynamic_cast<const osg::TexMat*>(state.textureAttribute(A::TEXMAT));
    if (matrix) result.matrix = matrix->getMatrix();
    return result;
}

std::vector<osg::Vec3> AlphaTest::coordinatesOf(const osg::Drawable& drawable) const {
    const osg::Array* array = coordinateArray(drawable);
    std::vector<osg::Vec3> result;
    if (!array || !isAVertex(*array, drawable.asGeometry()->getVertexArray())) return result;
    const auto read = array->getDataType() == GL_FLOAT ? coordinate<float> : coordinate<double>;
    result.reserve(array->getNumElements());
    for (std::size_t i = 0; i < array->getNumElements(); ++i) {
        const osg::Vec4d moved = read(*array, i) * matrix;
        result.emplace_back(osg::Vec3d(moved.x(), moved.y(), moved.w()));
    }
    return result;
}

void AlphaTest::mix(const osg::Drawable& drawable, Fingerprint& into) const {
    into.mix(static_cast<std::uint64_t>(passing));
    into.mix(double{reference});
    into.mix(static_cast<const void*>(texture.get()));
    into.mix(matrix);
    const bool staysThere = texture && !texture->getUnRefImageDataAfterApply(); // else it is let go when it is drawn
    const osg::Image* image = staysThere ? texture->getImage() : nullptr;
    into.mix(static_cast<const void*>(image));
    if (image) into.mix(std::uint64_t{image->getModifiedCount()});
    const osg::Array* array = coordinateArray(drawable);
    into.mix(static_cast<const void*>(array));
    if (array) into.mix(std::uint64_t{array->getModifiedCount()} << 32 | array->getNumElements());
}

void AlphaTest::hold(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) const {
    sources.emplace_back(texture.get());
    if (texture) sources.emplace_back(texture->getImage());
    sources.emplace_back(coordinateArray(drawable));
}

} // namespace gnomon
