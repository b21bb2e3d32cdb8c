// SPDX-License-Identifier: MIT
#include <gnomon/casters/DrawableTriangles.h>

#include <osg/DispatchCompute>
#include <osg/DrawPixels>
#include <osg/Vec4>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace gnomon {
namespace {

/// As OpenGL 4.2 and later take it: the smallest signed number is -1, as its neighbour.
template <class Number>
float normalised(Number value) {
    return std::max(static_cast<float>(value) / static_cast<float>(std::numeric_limits<Number>::max()), -1.0f);
}

template <class Number>
std::vector<osg::Vec4> floatsOf(const osg::Array& array) {
    const unsigned size = array.getDataSize();
    const bool scaled = array.getNormalize() && !array.getPreserveDataType();
    const auto* numbers = static_cast<const Number*>(array.getDataPointer());
    std::vector<osg::Vec4> result(array.getNumElements(), osg::Vec4(0.0f, 0.0f, 0.0f, 1.0f));
    for (std::size_t i = 0; i < result.size(); ++i)
        for (unsigned axis = 0; axis < size; ++axis) {
            const Number value = numbers[i * size + axis];
            result[i][axis] = scaled ? normalised(value) : static_cast<float>(value);
        }
    return result;
}

/// Empty if the vertices are not integers.
std::vector<osg::Vec4> integersOf(const osg::Array& array) {
    if (array.getDataSize() < 2 || array.getDataSize() > 4) return {};
    switch (array.getDataType()) {
    case GL_BYTE:
        return floatsOf<std::int8_t>(array);
    case GL_UNSIGNED_BYTE:
        return floatsOf<std::uint8_t>(array);
    case GL_SHORT:
        return floatsOf<std::int16_t>(array);
    case GL_UNSIGNED_SHORT:
        return floatsOf<std::uint16_t>(array);
    case GL_INT:
        return floatsOf<std::int32_t>(array);
    case GL_UNSIGNED_INT:
        return floatsOf<std::uint32_t>(array);
    default:
        return {};
    }
}

/// Asked of drawables of other kinds alone, by type: the functor reads nothing.
class NoTriangles : public TriangleDecoder {
public:
    NoTriangles() : TriangleDecoder(osg::Matrixd()) {}
    ~NoTriangles() override = default;

protected:
    void start(unsigned) override {}
    void point(unsigned) override {}
    void triangle(unsigned, unsigned, unsigned) override {}
};

} // namespace

void readTriangles(const osg::Drawable& drawable, TriangleDecoder& into) {
    into.setFromList(isFromList(drawable, into.quads()));
    const osg::Geometry* geometry = drawable.asGeometry();
    const osg::Array* array = geometry ? verticesOf(*geometry) : nullptr;
    const std::vector<osg::Vec4> integers = array ? integersOf(*array) : std::vector<osg::Vec4>();
    if (integers.empty()) return drawable.accept(into);
    into.setVertexArray(static_cast<unsigned>(integers.size()), integers.data());
    for (const auto& primitives : geometry->getPrimitiveSetList()) primitives->accept(into);
}

/// As osg::Drawable::draw() decides.
bool isFromList(const osg::Drawable& drawable, const QuadSplit& quads) {
    return quads.lists && drawable.getUseDisplayList() && drawable.getSupportsDisplayList() &&
           !drawable.getUseVertexArrayObject() && !drawable.getUseVertexBufferObjects();
}

const osg::Array* verticesOf(const osg::Geometry& geometry) {
    if (geometry.getVertexArray()) return geometry.getVertexArray();
    return geometry.getNumVertexAttribArrays() > 0 ? geometry.getVertexAttribArray(0) : nullptr;
}

bool hasTriangles(const osg::Drawable& drawable) {
    static const NoTriangles any;
    return drawable.asGeometry() || drawable.supports(any);
}

bool drawsItself(const osg::Drawable& drawable) {
    if (const osg::Geometry* geometry = drawable.asGeometry()) {
        const osg::Geometry::PrimitiveSetList& all = geometry->getPrimitiveSetList();
        return std::any_of(all.begin(), all.end(),
                           [](const auto& set) { return set->getMode() == osg::PrimitiveSet::PATCHES; });
    }
    if (hasTriangles(drawable)) return false;
    for (const char* library : {"osgText", "osgParticle"}) // which the kit does not link
        if (std::strcmp(drawable.libraryName(), library) == 0) return false;
    return !dynamic_cast<const osg::DrawPixels*>(&drawable) && !dynamic_cast<const osg::DispatchCompute*>(&drawable);
}

} // namespace gnomon
