// SPDX-License-Identifier: MIT
#include "ImageFile.h"
#include "InputFile.h"

#include <metrics/ShadowMetrics.h>
#include <osg/UserDataContainer>
#include <osg/ValueObject>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <type_traits>
#include <vector>

namespace gnomon::examples {
namespace {

/// What readColours() understands.
bool isUnderstood(const osg::Image& image) {
    const auto isOneOf = [](GLenum value, std::initializer_list<GLenum> allowed) {
        return std::find(allowed.begin(), allowed.end(), value) != allowed.end();
    };
    return image.r() == 1 && isOneOf(image.getDataType(), {GL_UNSIGNED_BYTE, GL_UNSIGNED_SHORT, GL_FLOAT}) &&
           isOneOf(image.getPixelFormat(), {GL_LUMINANCE, GL_LUMINANCE_ALPHA, GL_RGB, GL_RGBA, GL_BGR, GL_BGRA});
}

using Colour = glm::dvec3;

const Colour missedShadow(0.9, 0.1, 0.1), falseShadow(0.1, 0.2, 1.0), noNumber(1.0, 0.0, 1.0), turnedAway(0.1);

Colour colourAt(const metrics::Picture& visibility, const metrics::TruthMaps& truth, const metrics::PixelSets& sets,
                std::size_t i) {
    const double v = visibility.cells[i];
    if (!std::isfinite(v)) {
        if (truth.receiver.cells[i] == 0) return Colour(0.0);
        return truth.facing.cells[i] > 0.05 ? noNumber : turnedAway; // no renderer shows light there
    }
    const Colour grey(0.15 + 0.7 * std::clamp(v, 0.0, 1.0));
    if (sets.agreeing.cells[i] && metrics::isTooth(visibility, truth, i)) return falseShadow;
    if (!sets.facing.cells[i]) return 0.4 * grey;
    const bool lit = truth.litCentre.cells[i];
    if (metrics::isShadowed(v) != lit) return grey;
    const Colour wrong = lit ? falseShadow : missedShadow;
    return sets.certain.cells[i] ? wrong : 0.5 * (wrong + grey);
}

} // namespace

metrics::Picture readGrey(const std::string& file, const std::string& program) {
    const osg::ref_ptr<osg::Image> image = readImage(file, program);
    if (!isUnderstood(*image))
        throw std::runtime_error(
            quoted(file) +
            " has a pixel format that cannot be compared. Give grey or colour in bytes, shorts or floats.");
    if (image->getOrigin() == osg::Image::TOP_LEFT) image->flipVertical();
    return greysOf(*image);
}

metrics::Picture greysOf(const osg::Image& image) {
    metrics::Picture greys(image.s(), image.t());
    auto grey = greys.cells.begin();
    readColours(image, [&](float r, float g, float b) { *grey++ = (double(r) + double(g) + double(b)) / 3.0; });
    return greys;
}

osg::ref_ptr<osg::Image> errorOverlay(const metrics::Picture& visibility, const metrics::TruthMaps& truth) {
    const metrics::PixelSets sets = metrics::pixelSets(truth, visibility);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(visibility.width, visibility.height, 1, GL_RGB, GL_UNSIGNED_BYTE);
    for (std::size_t i = 0; i < visibility.cells.size(); ++i) {
        const Colour colour = colourAt(visibility, truth, sets, i);
        const int width = visibility.width, at = static_cast<int>(i);
        unsigned char* pixel = image->data(static_cast<unsigned>(at % width), static_cast<unsigned>(at / width));
        for (int c = 0; c < 3; ++c) pixel[c] = static_cast<unsigned char>(std::lround(255.0 * colour[c]));
    }
    return image;
}

namespace {

using metrics::Grid;
using metrics::TruthMaps;

/// Calls visit(name, grid, needed) for each map but the positions.
template <class Maps, class Visit>
void eachMap(Maps& truth, const Visit& visit) {
    visit("lit", truth.lit, true);
    visit("litCentre", truth.litCentre, true);
    visit("blockerDistance", truth.blockerDistance, true);
    visit("receiver", truth.receiver, true);
    visit("facing", truth.facing, true);
    visit("drawn", truth.drawn, false);
    visit("litByDisc", truth.litByDisc, false);
    visit("blocker", truth.blocker, false);
    visit("edgeLength", truth.edgeLength, false);
}

constexpr const char* axes[] = {"x", "y", "z"};

Grid<double> along(int axis, const Grid<glm::dvec3>& position) {
    Grid<double> one(position.width, position.height);
    for (std::size_t i = 0; i < one.cells.size(); ++i) one.cells[i] = position.cells[i][axis];
    return one;
}

osg::Vec3d toOsg(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

/// Takes layers out of an image.
class Reader {
public:
    Reader(const osg::Image& image, const std::string& file) : _image(image), _file(file) {
        const bool kind = image.getPixelFormat() == GL_LUMINANCE && image.getDataType() == GL_FLOAT;
        if (image.getUserDataContainer()) _names = image.getUserDataContainer()->getDescriptions();
        if (!kind || _names.size() != static_cast<std::size_t>(image.r()))
            refuse("it is not an image of floats with one named layer for each map");
    }

    [[noreturn]] void refuse(const std::string& why) const {
        throw std::runtime_error("\"" + _file + "\" is not a truth file: " + why + ".");
    }

    template <typename T>
    void take(const std::string& name, Grid<T>& grid, bool needed) const {
        const auto found = std::find(_names.begin(), _names.end(), name);
        if (found == _names.end() && needed) refuse("it has no layer \"" + name + "\"");
        if (found == _names.end()) return;
        grid = Grid<T>(_image.s(), _image.t());
        const auto layer = static_cast<unsigned>(found - _names.begin());
        for (int y = 0; y < grid.height; ++y)
            for (int x = 0; x < grid.width; ++x) {
                const float number = *reinterpret_cast<const float*>(
                    _image.data(static_cast<unsigned>(x), static_cast<unsigned>(y), layer));
                if (std::is_integral_v<T> && !(number >= 0.0f && number <= 16777216.0f)) // must not be converted
                    refuse("its layer \"" + name + "\" holds a value that is not an id");
                grid.at(x, y) = std::is_same_v<T, unsigned char> ? T(number != 0.0f) : static_cast<T>(number);
            }
    }

    void takePositions(Grid<glm::dvec3>& position) const {
        Grid<double> one[3];
        for (int axis = 0; axis < 3; ++axis) take(axes[axis], one[axis], false);
        if (one[0].empty() || one[1].empty() || one[2].empty()) return;
        position = Grid<glm::dvec3>(_image.s(), _image.t());
        for (std::size_t i = 0; i < position.cells.size(); ++i)
            position.cells[i] = {one[0].cells[i], one[1].cells[i], one[2].cells[i]};
    }

    void takeVector(const char* name, glm::dvec3& vector) const {
        osg::Vec3d value;
        if (_image.getUserValue(name, value)) vector = {value.x(), value.y(), value.z()};
    }

private:
    const osg::Image& _image;
    std::string _file;
    osg::UserDataContainer::DescriptionList _names;
};

bool isShare(double value) { return value >= 0.0 && value <= 1.0; }

/// Whatever is measured against must be a number.
void requireNumbers(const Reader& reader, const TruthMaps& truth) {
    for (std::size_t i = 0; i < truth.receiver.cells.size(); ++i) {
        if (truth.receiver.cells[i] == 0) continue;
        const bool shares =
            isShare(truth.lit.cells[i]) && (truth.litByDisc.empty() || isShare(truth.litByDisc.cells[i]));
        if (!shares || std::isnan(truth.facing.cells[i]) || std::isnan(truth.blockerDistance.cells[i]))
            reader.refuse("a pixel of its surface holds NaN, or a share outside 0 to 1");
    }
}

} // namespace

osg::ref_ptr<osg::Image> truthImage(const TruthMaps& truth) {
    osg::ref_ptr<osg::Image> image = new osg::Image;
    std::vector<float> values;
    const auto add = [&](const char* name, const auto& grid, bool) {
        if (grid.empty()) return;
        image->getOrCreateUserDataContainer()->addDescription(name);
        for (const auto& value : grid.cells) values.push_back(static_cast<float>(value));
    };
    eachMap(truth, add);
    for (int axis = 0; axis < 3; ++axis) add(axes[axis], along(axis, truth.position), false);
    const int layers = static_cast<int>(values.size() / truth.lit.cells.size());
    image->allocateImage(truth.lit.width, truth.lit.height, layers, GL_LUMINANCE, GL_FLOAT);
    std::copy(values.begin(), values.end(), reinterpret_cast<float*>(image->data()));
    image->setUserValue("towardsLight", toOsg(truth.towardsLight));
    image->setUserValue("up", toOsg(truth.up));
    return image;
}

TruthMaps truthOf(const osg::Image& image, const std::string& file) {
    const Reader reader(image, file);
    TruthMaps truth;
    eachMap(truth, [&](const char* name, auto& grid, bool needed) { reader.take(name, grid, needed); });
    reader.takePositions(truth.position);
    reader.takeVector("towardsLight", truth.towardsLight);
    reader.takeVector("up", truth.up);
    requireNumbers(reader, truth);
    return truth;
}

TruthMaps readTruth(const std::string& file, const std::string& program) {
    return truthOf(*readImage(file, program), file);
}

} // namespace gnomon::examples
