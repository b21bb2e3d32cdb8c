// SPDX-License-Identifier: MIT
#include "TruthFile.h"
#include "ImageFile.h"

#include <osg/UserDataContainer>
#include <osg/ValueObject>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gnomon::examples {
namespace {

using metrics::Grid;
using metrics::TruthMaps;

/// A truth's layers by name, all as floats.
struct Layer {
    std::string name;
    Grid<float> values;
};

template <typename T>
void addLayer(std::vector<Layer>& layers, const char* name, const Grid<T>& grid) {
    if (grid.empty()) return;
    Layer layer{name, Grid<float>(grid.width, grid.height)};
    std::transform(grid.cells.begin(), grid.cells.end(), layer.values.cells.begin(),
                   [](const T& value) { return static_cast<float>(value); });
    layers.push_back(layer);
}

constexpr const char* axes[] = {"x", "y", "z"};

void addPositions(std::vector<Layer>& layers, const Grid<glm::dvec3>& position) {
    for (int axis = 0; axis < 3; ++axis) {
        Grid<double> one(position.width, position.height);
        for (std::size_t i = 0; i < one.cells.size(); ++i) one.cells[i] = position.cells[i][axis];
        addLayer(layers, axes[axis], one);
    }
}

std::vector<Layer> layersOf(const TruthMaps& truth) {
    std::vector<Layer> layers;
    addLayer(layers, "lit", truth.lit);
    addLayer(layers, "litCentre", truth.litCentre);
    addLayer(layers, "blockerDistance", truth.blockerDistance);
    addLayer(layers, "receiver", truth.receiver);
    addLayer(layers, "facing", truth.facing);
    addLayer(layers, "drawn", truth.drawn);
    addLayer(layers, "litByDisc", truth.litByDisc);
    addLayer(layers, "blocker", truth.blocker);
    addLayer(layers, "edgeLength", truth.edgeLength);
    addPositions(layers, truth.position);
    return layers;
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

    bool has(const std::string& name) const { return std::find(_names.begin(), _names.end(), name) != _names.end(); }

    template <typename T>
    void take(const char* name, Grid<T>& grid) const {
        const auto found = std::find(_names.begin(), _names.end(), name);
        if (found == _names.end()) return;
        grid = Grid<T>(_image.s(), _image.t());
        const int layer = static_cast<int>(found - _names.begin());
        for (int y = 0; y < grid.height; ++y)
            for (int x = 0; x < grid.width; ++x)
                grid.at(x, y) = static_cast<T>(*reinterpret_cast<const float*>(
                    _image.data(static_cast<unsigned>(x), static_cast<unsigned>(y), static_cast<unsigned>(layer))));
    }

    template <typename T>
    void need(const char* name, Grid<T>& grid) const {
        if (!has(name)) refuse(std::string("it has no layer \"") + name + "\"");
        take(name, grid);
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

/// An id or a flag that is no number at all must not reach a conversion to int.
Grid<int> wholeNumbers(const Reader& reader, const char* name) {
    Grid<double> numbers;
    reader.take(name, numbers);
    Grid<int> whole(numbers.width, numbers.height);
    for (std::size_t i = 0; i < numbers.cells.size(); ++i) {
        const double number = numbers.cells[i];
        if (!(number >= 0.0 && number <= 16777216.0))
            reader.refuse(std::string("its layer \"") + name + "\" holds a value that is not an id");
        whole.cells[i] = static_cast<int>(number);
    }
    return whole;
}

void takePositions(const Reader& reader, Grid<glm::dvec3>& position) {
    if (!reader.has("x") || !reader.has("y") || !reader.has("z")) return;
    for (int axis = 0; axis < 3; ++axis) {
        Grid<double> one;
        reader.take(axes[axis], one);
        if (position.empty()) position = Grid<glm::dvec3>(one.width, one.height);
        for (std::size_t i = 0; i < one.cells.size(); ++i) position.cells[i][axis] = one.cells[i];
    }
}

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
    const std::vector<Layer> layers = layersOf(truth);
    osg::ref_ptr<osg::Image> image = new osg::Image;
    image->allocateImage(truth.lit.width, truth.lit.height, static_cast<int>(layers.size()), GL_LUMINANCE, GL_FLOAT);
    float* place = reinterpret_cast<float*>(image->data());
    for (const Layer& layer : layers) {
        place = std::copy(layer.values.cells.begin(), layer.values.cells.end(), place);
        image->getOrCreateUserDataContainer()->addDescription(layer.name);
    }
    image->setUserValue("towardsLight", toOsg(truth.towardsLight));
    image->setUserValue("up", toOsg(truth.up));
    return image;
}

TruthMaps truthOf(const osg::Image& image, const std::string& file) {
    const Reader reader(image, file);
    TruthMaps truth;
    reader.need("lit", truth.lit);
    reader.need("blockerDistance", truth.blockerDistance);
    reader.need("facing", truth.facing);
    metrics::Picture needed;
    reader.need("litCentre", needed);
    reader.need("receiver", needed);
    const Grid<int> litCentre = wholeNumbers(reader, "litCentre");
    truth.litCentre = metrics::Mask(image.s(), image.t());
    std::transform(litCentre.cells.begin(), litCentre.cells.end(), truth.litCentre.cells.begin(),
                   [](int lit) { return static_cast<unsigned char>(lit != 0); });
    truth.receiver = wholeNumbers(reader, "receiver");
    truth.drawn = wholeNumbers(reader, "drawn");
    truth.blocker = wholeNumbers(reader, "blocker");
    reader.take("litByDisc", truth.litByDisc);
    reader.take("edgeLength", truth.edgeLength);
    takePositions(reader, truth.position);
    reader.takeVector("towardsLight", truth.towardsLight);
    reader.takeVector("up", truth.up);
    requireNumbers(reader, truth);
    return truth;
}

TruthMaps readTruth(const std::string& file, const std::string& program) {
    return truthOf(*readImage(file, program), file);
}

} // namespace gnomon::examples
