// SPDX-License-Identifier: MIT
#include <gnomon/casters/DrawableTriangles.h>

#include <osg/DispatchCompute>
#include <osg/DrawPixels>
#include <osg/PrimitiveSetIndirect>
#include <osg/Vec4>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

std::atomic<bool> quadsFromFirst{false};

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

using Set = osg::PrimitiveSet;

/// What a command that OpenGL reads from a buffer draws, as OpenSceneGraph has it in memory.
struct Command {
    unsigned count, first, base, instances;
};

/// Their first and number, as OpenSceneGraph hands them to OpenGL: 0 stands for all.
template <class Multi>
std::pair<unsigned, unsigned> givenOf(const Set& set) {
    const auto& multi = static_cast<const Multi&>(set);
    return {0, multi.getNumCommandsToDraw()};
}

std::pair<unsigned, unsigned> givenOf(const Set& set) {
    switch (set.getType()) {
    case Set::MultiDrawElementsUByteIndirectPrimitiveType:
        return {0, 0};
    case Set::MultiDrawElementsUShortIndirectPrimitiveType:
        return givenOf<osg::MultiDrawElementsIndirectUShort>(set);
    case Set::MultiDrawElementsUIntIndirectPrimitiveType:
        return givenOf<osg::MultiDrawElementsIndirectUInt>(set);
    case Set::MultiDrawArraysIndirectPrimitiveType: {
        const auto& multi = static_cast<const osg::MultiDrawArraysIndirect&>(set);
        return {multi.getFirstCommandToDraw(), multi.getNumCommandsToDraw()};
    }
    case Set::DrawArraysIndirectPrimitiveType:
        return {static_cast<const osg::DrawArraysIndirect&>(set).getFirstCommandToDraw(), 1};
    default:
        return {static_cast<const osg::DrawElementsIndirect&>(set).getFirstCommandToDraw(), 1};
    }
}

/// @param read  of one of the array, which has no const access.
template <class Array, class Read>
std::vector<Command> commandsIn(const Array* array, const Set& set, Read read) {
    std::vector<Command> result;
    const auto [first, number] = givenOf(set);
    const unsigned there = array ? array->getNumElements() : 0;
    for (unsigned i = first; i < there && (number == 0 || i - first < number); ++i)
        result.push_back(read(const_cast<Array&>(*array), i));
    return result;
}

std::vector<Command> commandsOf(const Set& set) {
    if (const auto* elements = dynamic_cast<const osg::DrawElementsIndirect*>(&set))
        return commandsIn(elements->getIndirectCommandArray(), set,
                          [](osg::IndirectCommandDrawElements& all, unsigned i) {
                              return Command{all.count(i), all.firstIndex(i), all.baseVertex(i), all.instanceCount(i)};
                          });
    return commandsIn(static_cast<const osg::DrawArraysIndirect&>(set).getIndirectCommandArray(), set,
                      [](osg::IndirectCommandDrawArrays& all, unsigned i) {
                          return Command{all.count(i), all.first(i), 0, all.instanceCount(i)};
                      });
}

/// The commands may be a program's, which writes them where they are read.
bool isDrawnUnseen(const Set& set) {
    if (!indirectCommands(set)) return false;
    const std::vector<Command> commands = commandsOf(set);
    return std::none_of(commands.begin(), commands.end(),
                        [](const Command& command) { return command.count > 0 && command.instances > 0; });
}

void readIndirect(const Set& set, TriangleDecoder& into) {
    const auto* elements = dynamic_cast<const osg::DrawElements*>(&set);
    const unsigned there = elements ? set.getNumIndices() : 0;
    for (const Command& command : commandsOf(set)) {
        if (command.instances == 0) continue;
        if (!elements) {
            into.drawArrays(set.getMode(), static_cast<GLint>(command.first), static_cast<GLsizei>(command.count));
            continue;
        }
        const unsigned first = std::min(command.first, there), count = std::min(command.count, there - first);
        const GLenum type = const_cast<osg::DrawElements*>(elements)->getDataType(); // which only reads
        into.drawIndexed(
            set.getMode(), count, [&](unsigned i) { return set.index(first + i); },
            type == GL_UNSIGNED_BYTE    ? 0xffu
            : type == GL_UNSIGNED_SHORT ? 0xffffu
                                        : ~0u,
            command.base);
    }
}

bool isAnyIndirect(const osg::Geometry& geometry) {
    const auto& all = geometry.getPrimitiveSetList();
    return std::any_of(all.begin(), all.end(), [](const auto& set) { return indirectCommands(*set) != nullptr; });
}

template <class Array>
bool giveVertices(const osg::Array& array, TriangleDecoder& into) {
    const auto* vertices = dynamic_cast<const Array*>(&array);
    if (vertices)
        into.setVertexArray(static_cast<unsigned>(vertices->size()), vertices->empty() ? nullptr : &vertices->front());
    return vertices;
}

} // namespace

bool cutsQuadsFromFirst() { return quadsFromFirst; }

void learnQuadCut() {
    const GLubyte* vendor = glGetString(GL_VENDOR);
    if (vendor) quadsFromFirst = std::strncmp(reinterpret_cast<const char*>(vendor), "NVIDIA", 6) == 0;
}

void readTriangles(const osg::Drawable& drawable, TriangleDecoder& into) {
    const osg::Geometry* geometry = drawable.asGeometry();
    const osg::Array* array = geometry ? verticesOf(*geometry) : nullptr;
    const std::vector<osg::Vec4> integers = array ? integersOf(*array) : std::vector<osg::Vec4>();
    if (integers.empty() && !(array && isAnyIndirect(*geometry))) return drawable.accept(into);
    if (!integers.empty())
        into.setVertexArray(static_cast<unsigned>(integers.size()), integers.data());
    else if (!giveVertices<osg::Vec3Array>(*array, into) && !giveVertices<osg::Vec2Array>(*array, into) &&
             !giveVertices<osg::Vec4Array>(*array, into) && !giveVertices<osg::Vec3dArray>(*array, into) &&
             !giveVertices<osg::Vec2dArray>(*array, into) && !giveVertices<osg::Vec4dArray>(*array, into))
        return;
    for (const auto& primitives : geometry->getPrimitiveSetList())
        if (indirectCommands(*primitives))
            readIndirect(*primitives, into);
        else
            primitives->accept(into);
}

const osg::BufferData* indirectCommands(const osg::PrimitiveSet& set) {
    if (set.getType() < Set::DrawArraysIndirectPrimitiveType) return nullptr; // a look at each costs more
    if (const auto* elements = dynamic_cast<const osg::DrawElementsIndirect*>(&set))
        return elements->getIndirectCommandArray();
    const auto* arrays = dynamic_cast<const osg::DrawArraysIndirect*>(&set);
    return arrays ? arrays->getIndirectCommandArray() : nullptr;
}

const osg::Array* verticesOf(const osg::Geometry& geometry) {
    if (geometry.getVertexArray()) return geometry.getVertexArray();
    return geometry.getNumVertexAttribArrays() > 0 ? geometry.getVertexAttribArray(0) : nullptr;
}

const osg::Array* normalArrayOf(const osg::Geometry& geometry) {
    const osg::Array* array = geometry.getNormalArray();
    return array && array->getBinding() == osg::Array::BIND_PER_VERTEX ? array : nullptr;
}

std::vector<osg::Vec4> normalsOf(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    const osg::Array* array = geometry ? normalArrayOf(*geometry) : nullptr;
    if (!array || array->getDataSize() < 3) return {};
    if (array->getDataType() == GL_FLOAT) return floatsOf<float>(*array);
    return array->getDataType() == GL_DOUBLE ? floatsOf<double>(*array) : integersOf(*array);
}

bool hasTriangles(const osg::Drawable& drawable) {
    static const NoTriangles any;
    return drawable.asGeometry() || drawable.supports(any);
}

bool drawsTriangles(const osg::Geometry& geometry) {
    const osg::Geometry::PrimitiveSetList& all = geometry.getPrimitiveSetList();
    return std::any_of(all.begin(), all.end(), [](const auto& set) {
        return (set->getMode() >= Set::TRIANGLES && set->getMode() <= Set::POLYGON) ||
               set->getMode() == Set::TRIANGLES_ADJACENCY || set->getMode() == Set::TRIANGLE_STRIP_ADJACENCY;
    });
}

bool drawsItself(const osg::Drawable& drawable) {
    if (const osg::Geometry* geometry = drawable.asGeometry()) {
        const osg::Geometry::PrimitiveSetList& all = geometry->getPrimitiveSetList();
        return std::any_of(all.begin(), all.end(),
                           [](const auto& set) { return set->getMode() == Set::PATCHES || isDrawnUnseen(*set); });
    }
    if (hasTriangles(drawable)) return false;
    for (const char* library : {"osgText", "osgParticle"}) // which the kit does not link
        if (std::strcmp(drawable.libraryName(), library) == 0) return false;
    return !dynamic_cast<const osg::DrawPixels*>(&drawable) && !dynamic_cast<const osg::DispatchCompute*>(&drawable);
}

} // namespace gnomon
