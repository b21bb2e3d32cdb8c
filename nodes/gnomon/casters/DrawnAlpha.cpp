// SPDX-License-Identifier: MIT
#include <gnomon/casters/DrawnAlpha.h>
#include <gnomon/casters/DrawnState.h>

#include <osg/Geometry>
#include <osg/Image>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace gnomon {
namespace {

constexpr int mostCells = 256; // along a side
constexpr double exact = 1e-3; // texels: coordinates on the border between two texels mean one of them

/// How a texel's bytes hold its alpha; a step of 0 if they do otherwise.
struct AlphaBytes {
    explicit AlphaBytes(const osg::Image& image) {
        if (image.getDataType() != GL_UNSIGNED_BYTE) return;
        switch (image.getPixelFormat()) {
        case GL_RGBA:
        case GL_BGRA:
            step = 4, at = 3;
            break;
        case GL_LUMINANCE_ALPHA:
            step = 2, at = 1;
            break;
        case GL_ALPHA:
            step = 1;
            break;
        default:
            break;
        }
    }
    int step = 0, at = 0;
};

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

const osg::Array* colorArray(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    return geometry ? geometry->getColorArray() : nullptr;
}

bool isAVertex(const osg::Array& array, const osg::Array* vertices) {
    return vertices && array.getNumElements() >= vertices->getNumElements() &&
           (array.getDataType() == GL_FLOAT || array.getDataType() == GL_DOUBLE) && array.getDataSize() <= 4;
}

template <class Number>
std::vector<float> fourths(const osg::Array& colors, double one) {
    const auto* numbers = static_cast<const Number*>(colors.getDataPointer());
    std::vector<float> result(colors.getNumElements());
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = std::clamp(static_cast<float>(static_cast<double>(numbers[4 * i + 3]) / one), 0.0f, 1.0f);
    return result;
}

AlphaRange rangeOf(const std::vector<float>& alphas) {
    const auto [least, most] = std::minmax_element(alphas.begin(), alphas.end());
    return alphas.empty() ? AlphaRange() : AlphaRange{*least, *most};
}

void mixArray(const osg::Array* array, Fingerprint& into) {
    into.mix(static_cast<const void*>(array));
    if (array) into.mix(std::uint64_t{array->getModifiedCount()} << 32 | array->getNumElements());
}

std::uint64_t samplingOf(const osg::Texture2D& texture) {
    Fingerprint found;
    mixTexture(texture, found);
    return found.value();
}

} // namespace

void TextureAlpha::Cell::add(const Cell& other) {
    least = std::min(least, other.least);
    most = std::max(most, other.most);
}

osg::ref_ptr<const TextureAlpha> TextureAlpha::of(const osg::Texture2D& texture) {
    const osg::Image* image = texture.getImage();
    const osg::ref_ptr<TextureAlpha> result = new TextureAlpha(texture);
    if (!image || !image->data() || image->s() < 1 || image->t() < 1) return result;
    if (image->isCompressed() && image->isImageTranslucent()) return result;
    const auto isNearest = [&](osg::Texture::FilterParameter which) {
        return texture.getFilter(which) == osg::Texture::NEAREST;
    };
    if (isNearest(osg::Texture::MIN_FILTER) && isNearest(osg::Texture::MAG_FILTER)) result->_reach = 0.0;
    result->_mixes = !isNearest(osg::Texture::MAG_FILTER);
    result->_wrap[0] = texture.getWrap(osg::Texture::WRAP_S);
    result->_wrap[1] = texture.getWrap(osg::Texture::WRAP_T);
    const auto border =
        static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(texture.getBorderColor().a(), 0.0, 1.0)));
    result->_border = {border, border};
    if (image->isCompressed())
        result->_all = {255, 255};
    else
        result->read(*image);
    return result;
}

TextureAlpha::TextureAlpha(const osg::Texture2D& of)
    : _texture(&of),
      _image(of.getImage()),
      _count(of.getImage() ? of.getImage()->getModifiedCount() : 0),
      _sampling(samplingOf(of)) {}

bool TextureAlpha::isOf(const osg::Texture2D& texture) const {
    const osg::Image* image = texture.getImage();
    return _texture == &texture && _sampling == samplingOf(texture) &&
           (!image || (image == _image.get() && image->getModifiedCount() == _count));
}

void TextureAlpha::read(const osg::Image& image) {
    _size[0] = image.s();
    _size[1] = image.t();
    _step = (std::max(_size[0], _size[1]) + mostCells - 1) / mostCells;
    for (int axis = 0; axis < 2; ++axis) _cells[axis] = (_size[axis] + _step - 1) / _step;
    _grid.resize(std::size_t(_cells[0]) * std::size_t(_cells[1]));
    _texels.reserve(std::size_t(_size[0]) * std::size_t(_size[1]));
    const AlphaBytes bytes(image);
    for (int row = 0; row < _size[1]; ++row) {
        const unsigned char* texel = image.data(0, unsigned(row)) + bytes.at;
        Cell* cells = &_grid[std::size_t(row / _step) * std::size_t(_cells[0])];
        for (int column = 0; column < _size[0]; ++column, texel += bytes.step) {
            Cell here{*texel, *texel};
            if (bytes.step == 0) {
                const double alpha = 255.0 * double{image.getColor(unsigned(column), unsigned(row)).a()};
                here.least = static_cast<std::uint8_t>(std::clamp(std::floor(alpha), 0.0, 255.0));
                here.most = static_cast<std::uint8_t>(std::clamp(std::ceil(alpha), 0.0, 255.0));
            }
            _texels.push_back(static_cast<std::uint8_t>((here.least + here.most) / 2));
            cells[column / _step].add(here);
        }
    }
    _all = {};
    for (const Cell& cell : _grid) _all.add(cell);
    const auto isToBorder = [](osg::Texture::WrapMode wrap) { return wrap == osg::Texture::CLAMP_TO_BORDER; };
    if (_all.least == _all.most && std::none_of(std::begin(_wrap), std::end(_wrap), isToBorder)) _texels = {};
}

TextureAlpha::Covered TextureAlpha::coveredAlong(unsigned axis, double low, double high) const {
    const int size = _size[axis];
    Covered all{{0, 0}, {_cells[axis], 0}};
    const osg::Texture::WrapMode wrap = _wrap[axis];
    all.border = wrap == osg::Texture::CLAMP_TO_BORDER;
    if (!(std::abs(low) < 1e6 && std::abs(high) < 1e6)) return all; // NaN, too
    const double begin = std::floor(low * size - _reach + exact),
                 end = std::max(std::ceil(high * size + _reach - exact), begin + 1.0);
    const auto span = [&](double from, double to) {
        const int first = std::clamp(int(from), 0, size - 1), last = std::clamp(int(to) - 1, 0, size - 1);
        return Covered{{first / _step, 0}, {last / _step + 1, 0}};
    };
    if (wrap == osg::Texture::REPEAT || wrap == osg::Texture::MIRROR) {
        const double turn = std::floor(begin / size), from = begin - turn * size, to = end - turn * size;
        const bool crosses = to > size;
        if (end - begin >= size || (crosses && wrap == osg::Texture::MIRROR)) return all;
        if (wrap == osg::Texture::MIRROR && std::fmod(turn, 2.0) != 0.0) return span(size - to, size - from);
        Covered result = span(from, std::min<double>(to, size));
        if (!crosses) return result;
        result.spans = 2;
        result.first[1] = 0;
        result.end[1] = span(0.0, to - size).end[0];
        return result;
    }
    Covered result = span(begin, end);
    result.border = all.border && (begin < 0.0 || end > size);
    return result;
}

AlphaRange TextureAlpha::over(const osg::Vec2d& low, const osg::Vec2d& high) const {
    const auto rangeOf = [](const Cell& cell) {
        return AlphaRange{float(cell.least) / 255.0f, float(cell.most) / 255.0f};
    };
    if (_grid.empty() || (_all.least == _all.most && _border.least == _all.least)) return rangeOf(_all);
    const Covered columns = coveredAlong(0, low.x(), high.x()), rows = coveredAlong(1, low.y(), high.y());
    Cell found;
    if (columns.border || rows.border) found.add(_border);
    for (int down = 0; down < rows.spans; ++down)
        for (int row = rows.first[down]; row < rows.end[down]; ++row)
            for (int across = 0; across < columns.spans; ++across)
                for (int column = columns.first[across]; column < columns.end[across]; ++column) {
                    found.add(_grid[std::size_t(row) * std::size_t(_cells[0]) + std::size_t(column)]);
                    if (found.least <= _all.least && found.most >= _all.most) return rangeOf(found);
                }
    return rangeOf(found);
}

/// Of a place in texels, as the wrap mode has it; -1: the border.
int TextureAlpha::texelAlong(unsigned axis, double at) const {
    const int size = _size[axis], texel = static_cast<int>(std::floor(at));
    if (texel >= 0 && texel < size) return texel;
    const auto turned = [texel](int by) { return (texel % by + by) % by; };
    switch (_wrap[axis]) {
    case osg::Texture::REPEAT:
        return turned(size);
    case osg::Texture::MIRROR:
        return std::min(turned(2 * size), 2 * size - 1 - turned(2 * size));
    case osg::Texture::CLAMP_TO_BORDER:
        return -1;
    case osg::Texture::CLAMP: // mixes with the border, but reaches no farther
        return _mixes ? -1 : std::clamp(texel, 0, size - 1);
    default:
        return std::clamp(texel, 0, size - 1);
    }
}

int TextureAlpha::texel(int column, int row) const {
    if (column < 0 || row < 0) return _border.least;
    return _texels[std::size_t(row) * std::size_t(_size[0]) + std::size_t(column)];
}

float TextureAlpha::at(const osg::Vec2d& place) const {
    if (_texels.empty()) return float(_all.least) / 255.0f;
    if (!(std::abs(place.x()) < 1e5 && std::abs(place.y()) < 1e5)) return 1.0f; // NaN, too: a place in no image
    double texels[2];
    for (unsigned axis = 0; axis < 2; ++axis) {
        const bool clamps = _wrap[axis] == osg::Texture::CLAMP;
        texels[axis] = (clamps ? std::clamp(place[axis], 0.0, 1.0) : place[axis]) * _size[axis];
    }
    if (!_mixes) return static_cast<float>(texel(texelAlong(0, texels[0]), texelAlong(1, texels[1]))) / 255.0f;
    const double left = texels[0] - 0.5, low = texels[1] - 0.5, x = left - std::floor(left), y = low - std::floor(low);
    const int columns[] = {texelAlong(0, left), texelAlong(0, left + 1.0)};
    const int rows[] = {texelAlong(1, low), texelAlong(1, low + 1.0)};
    const auto along = [&](int row) { return (1.0 - x) * texel(columns[0], row) + x * texel(columns[1], row); };
    return static_cast<float>(((1.0 - y) * along(rows[0]) + y * along(rows[1])) / 255.0);
}

bool AlphaTest::sampled(const osg::Vec3d& coordinate) const {
    const float alpha = alphas->at({coordinate.x() / coordinate.z(), coordinate.y() / coordinate.z()}),
                least = sampledReference();
    return passing & (alpha < least ? 1 : alpha > least ? 4 : 2);
}

bool AlphaTest::hasCoordinates(const osg::Drawable& drawable) {
    const osg::Array* array = coordinateArray(drawable);
    return array && array->getNumElements() > 0 && isAVertex(*array, drawable.asGeometry()->getVertexArray());
}

std::vector<osg::Vec3> AlphaTest::coordinatesOf(const osg::Drawable& drawable, const osg::Matrixd& matrix) {
    std::vector<osg::Vec3> result;
    if (!hasCoordinates(drawable)) return result;
    const osg::Array& array = *coordinateArray(drawable);
    const auto read = array.getDataType() == GL_FLOAT ? coordinate<float> : coordinate<double>;
    result.reserve(array.getNumElements());
    for (std::size_t i = 0; i < array.getNumElements(); ++i) {
        const osg::Vec4d moved = read(array, i) * matrix;
        result.emplace_back(osg::Vec3d(moved.x(), moved.y(), moved.w()));
    }
    return result;
}

void AlphaTest::mix(const osg::Drawable& drawable, Fingerprint& into) const {
    into.mix(static_cast<std::uint64_t>(passing));
    for (const float alpha : {reference, surfaceFrom, evenFrom, surface}) into.mix(double{alpha});
    into.mix(static_cast<const void*>(texture.get()));
    if (byVertex) mixArray(colorArray(drawable), into);
    if (!texture) return;
    into.mix(matrix);
    mixTexture(*texture, into);
    mixArray(coordinateArray(drawable), into);
}

void AlphaTest::hold(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) const {
    if (byVertex) sources.emplace_back(colorArray(drawable));
    if (!texture) return;
    sources.emplace_back(texture.get());
    if (!texture->getUnRefImageDataAfterApply()) sources.emplace_back(texture->getImage());
    sources.emplace_back(coordinateArray(drawable));
}

std::vector<float> vertexAlphas(const osg::Drawable& drawable) {
    const osg::Array* colors = colorArray(drawable);
    if (!colors) return {};
    if (colors->getDataSize() == 3) return std::vector<float>(colors->getNumElements(), 1.0f);
    if (colors->getDataSize() != 4) return {};
    switch (colors->getDataType()) {
    case GL_FLOAT:
        return fourths<float>(*colors, 1.0);
    case GL_DOUBLE:
        return fourths<double>(*colors, 1.0);
    case GL_UNSIGNED_BYTE:
        return fourths<std::uint8_t>(*colors, 255.0);
    default:
        return {};
    }
}

ClearParts::ClearParts(const AlphaTest& test, const osg::Drawable& drawable) : _test(test) {
    if (test.texture) _coordinates = AlphaTest::coordinatesOf(drawable, test.matrix);
    if (test.byVertex) _vertices = vertexAlphas(drawable);
    AlphaRange all{test.surface, test.surface};
    if (test.byVertex) all = rangeOf(_vertices);
    if (test.texture) {
        const AlphaRange texture = test.alphas ? test.alphas->over({0.0, 0.0}, {1.0, 1.0}) : AlphaRange();
        all = {all.least * texture.least, all.most * texture.most};
    }
    _lightPasses = !(all.least < all.most) && all.most < test.evenFrom;
}

ClearParts::Part ClearParts::of(unsigned a, unsigned b, unsigned c) const {
    if (_lightPasses) return Clear;
    AlphaRange surface{_test.surface, _test.surface};
    if (_test.byVertex) {
        if (std::max({a, b, c}) >= _vertices.size()) return Mixed;
        surface = {std::min({_vertices[a], _vertices[b], _vertices[c]}),
                   std::max({_vertices[a], _vertices[b], _vertices[c]})};
    }
    if (surface.most < _test.surfaceFrom) return Clear;
    const AlphaRange texture = _test.texture ? textureOver(a, b, c) : AlphaRange{1.0f, 1.0f};
    const float least = surface.least * texture.least, most = surface.most * texture.most;
    const int possible = (least < _test.reference ? 1 : 0) |
                         (least <= _test.reference && most >= _test.reference ? 2 : 0) |
                         (most > _test.reference ? 4 : 0);
    if (!(possible & _test.passing)) return Clear;
    return (possible & ~_test.passing) || surface.least < _test.surfaceFrom ? Mixed : Solid;
}

AlphaRange ClearParts::textureOver(unsigned a, unsigned b, unsigned c) const {
    if (!_test.alphas || std::max({a, b, c}) >= _coordinates.size()) return {};
    constexpr double none = std::numeric_limits<double>::infinity();
    osg::Vec2d low(none, none), high(-none, -none);
    for (const unsigned corner : {a, b, c}) {
        const osg::Vec3d place(_coordinates[corner]);
        if (!(place.z() > 0.0)) return {};
        for (int axis = 0; axis < 2; ++axis) {
            low[axis] = std::min(low[axis], place[axis] / place.z());
            high[axis] = std::max(high[axis], place[axis] / place.z());
        }
    }
    return _test.alphas->over(low, high);
}

} // namespace gnomon
