// SPDX-License-Identifier: MIT
#include "SceneTriangles.h"

#include <osg/Camera>
#include <osg/Geometry>
#include <osg/Material>
#include <osg/PolygonMode>
#include <osg/Projection>
#include <osg/State>
#include <osg/Transform>
#include <osg/TriangleIndexFunctor>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace gnomon::examples {
namespace {

bool isOn(const osg::State::ModeMap& modes, GLenum mode) {
    const auto found = modes.find(mode);
    return found != modes.end() && !found->second.valueVec.empty() &&
           (found->second.valueVec.back() & osg::StateAttribute::ON);
}

const osg::StateAttribute* attribute(const osg::State::AttributeMap& attributes, osg::StateAttribute::Type type) {
    const auto found = attributes.find({type, 0});
    if (found == attributes.end() || found->second.attributeVec.empty()) return nullptr;
    return found->second.attributeVec.back().first;
}

const osg::AlphaFunc* alphaTest(const osg::State& state) {
    if (!isOn(state.getModeMap(), GL_ALPHA_TEST)) return nullptr;
    return dynamic_cast<const osg::AlphaFunc*>(attribute(state.getAttributeMap(), osg::StateAttribute::ALPHAFUNC));
}

/// One with an image.
const osg::Texture2D* texture(const osg::State& state) {
    const auto& modes = state.getTextureModeMapList();
    const auto& attributes = state.getTextureAttributeMapList();
    if (modes.empty() || attributes.empty() || !isOn(modes.front(), GL_TEXTURE_2D)) return nullptr;
    const auto* found =
        dynamic_cast<const osg::Texture2D*>(attribute(attributes.front(), osg::StateAttribute::TEXTURE));
    return found && found->getImage() && found->getImage()->data() ? found : nullptr;
}

/// Of the material or, where that takes colours as none does, of the colour; 1 where each vertex has its own.
double baseAlphaOf(const osg::State& state, const osg::Drawable& drawable) {
    const auto* material =
        dynamic_cast<const osg::Material*>(attribute(state.getAttributeMap(), osg::StateAttribute::MATERIAL));
    if (material && material->getColorMode() == osg::Material::OFF)
        return double(material->getDiffuse(osg::Material::FRONT).a());
    const osg::Geometry* geometry = drawable.asGeometry();
    const auto* colors = geometry ? dynamic_cast<const osg::Vec4Array*>(geometry->getColorArray()) : nullptr;
    if (!colors || colors->empty()) return material ? double(material->getDiffuse(osg::Material::FRONT).a()) : 1.0;
    return colors->getBinding() == osg::Array::BIND_OVERALL ? double(colors->front().a()) : 1.0;
}

/// OpenSceneGraph's own rules of inheritance; nothing is sent to OpenGL.
void push(osg::State& state, const osg::NodePath& path, const osg::Drawable& drawable) {
    for (const osg::Node* node : path)
        if (node != &drawable && node->getStateSet()) state.pushStateSet(node->getStateSet());
    if (drawable.getStateSet()) state.pushStateSet(drawable.getStateSet());
}

/// Each bit of OpenGL's number of a comparison is one way to pass it: 1 less, 2 equal, 4 greater.
bool passes(osg::AlphaFunc::ComparisonFunction how, double alpha, double reference) {
    const unsigned ways = unsigned(how) - GL_NEVER;
    return (ways & (alpha < reference ? 1u : alpha > reference ? 4u : 2u)) != 0;
}

int wrapped(int texel, int size, osg::Texture::WrapMode how) {
    const int turn = ((texel % size) + size) % size;
    if (how == osg::Texture::REPEAT) return turn;
    if (how == osg::Texture::MIRROR) return ((texel - turn) / size) % 2 ? size - 1 - turn : turn;
    return std::min(std::max(texel, 0), size - 1);
}

struct Collect {
    std::vector<unsigned>* into = nullptr;
    unsigned first = 0, count = 0;

    void operator()(unsigned a, unsigned b, unsigned c) const {
        if (a >= count || b >= count || c >= count) return;
        for (const unsigned corner : {a, b, c}) into->push_back(first + corner);
    }
};

/// @param place  of a vertex of this kind of array.
template <typename Array, typename Place>
bool append(const osg::Array& array, std::vector<osg::Vec3d>& into, const Place& place) {
    const auto* typed = dynamic_cast<const Array*>(&array);
    if (typed) std::transform(typed->begin(), typed->end(), std::back_inserter(into), place);
    return typed != nullptr;
}

std::vector<osg::Vec3d> positions(const osg::Array* array) {
    const auto flat = [](const auto& v) { return osg::Vec3d(v.x(), v.y(), 0.0); };
    const auto solid = [](const auto& v) { return osg::Vec3d(v.x(), v.y(), v.z()); };
    const auto divided = [](const auto& v) { return osg::Vec3d(v.x(), v.y(), v.z()) / double(v.w()); };
    std::vector<osg::Vec3d> result;
    if (array)
        (void)(append<osg::Vec3Array>(*array, result, solid) || append<osg::Vec3dArray>(*array, result, solid) ||
               append<osg::Vec4Array>(*array, result, divided) || append<osg::Vec4dArray>(*array, result, divided) ||
               append<osg::Vec2Array>(*array, result, flat) || append<osg::Vec2dArray>(*array, result, flat));
    return result;
}

class Collector : public osg::NodeVisitor {
public:
    Collector(SceneTriangles& into, Clear clear)
        : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), _into(into), _clear(clear) {}

    void apply(osg::Camera&) override {}
    void apply(osg::Projection&) override {}
    void apply(osg::Geometry& geometry) override {
        const std::vector<osg::Vec3d> local = positions(geometry.getVertexArray());
        if (local.empty() || Cutout::isUnfilled(getNodePath(), geometry)) return;
        const osg::Matrixd world = osg::computeLocalToWorld(getNodePath());
        _into.objects.push_back({Cutout::of(getNodePath(), geometry), getNodePath()});
        if (_clear == Clear::PASSES && !_into.objects.back().cutout)
            _into.objects.back().cutout = Cutout::blended(getNodePath(), geometry);
        addTriangles(geometry, local.size());
        for (const osg::Vec3d& v : local) _into.vertices.push_back(v * world);
        addTexcoords(dynamic_cast<const osg::Vec2Array*>(geometry.getTexCoordArray(0)));
    }

private:
    void addTriangles(const osg::Geometry& geometry, std::size_t vertices) {
        osg::TriangleIndexFunctor<Collect> collect;
        collect.into = &_into.indices;
        collect.first = static_cast<unsigned>(_into.vertices.size());
        collect.count = static_cast<unsigned>(vertices);
        geometry.accept(collect);
        _into.object.resize(_into.indices.size() / 3, static_cast<unsigned>(_into.objects.size() - 1));
    }

    void addTexcoords(const osg::Vec2Array* texcoords) {
        if (texcoords)
            for (const osg::Vec2& t : *texcoords) _into.texcoords.emplace_back(t.x(), t.y());
        _into.texcoords.resize(_into.vertices.size());
    }

    SceneTriangles& _into;
    const Clear _clear;
};

} // namespace

std::optional<Cutout> Cutout::of(const osg::NodePath& path, const osg::Drawable& drawable) {
    const osg::ref_ptr<osg::State> state = new osg::State;
    push(*state, path, drawable);
    const osg::AlphaFunc* test = alphaTest(*state);
    const osg::Texture2D* image = texture(*state);
    if (!test || test->getFunction() == osg::AlphaFunc::ALWAYS || !image) return std::nullopt;
    return Cutout(*test, image);
}

std::optional<Cutout> Cutout::blended(const osg::NodePath& path, const osg::Drawable& drawable) {
    const osg::ref_ptr<osg::State> state = new osg::State;
    push(*state, path, drawable);
    if (!isOn(state->getModeMap(), GL_BLEND)) return std::nullopt;
    const osg::AlphaFunc* test = alphaTest(*state);
    if (test && test->getFunction() != osg::AlphaFunc::ALWAYS) return std::nullopt;
    static const osg::ref_ptr<osg::AlphaFunc> half = new osg::AlphaFunc(osg::AlphaFunc::GEQUAL, 0.5f),
                                              whole = new osg::AlphaFunc(osg::AlphaFunc::GEQUAL, 1.0f);
    const Cutout cut(*half, texture(*state), baseAlphaOf(*state, drawable));
    return cut.isEven() ? Cutout(*whole, cut._texture, cut._alpha) : cut;
}

bool Cutout::isEven() const {
    for (int row = 0; _image && row < _image->t(); ++row)
        for (int column = 0; column < _image->s(); ++column)
            if (alphaOf(column, row) != alphaOf(0, 0)) return false;
    return true;
}

bool Cutout::isUnfilled(const osg::NodePath& path, const osg::Drawable& drawable) {
    const osg::ref_ptr<osg::State> state = new osg::State;
    push(*state, path, drawable);
    using Mode = osg::PolygonMode;
    const auto* mode = dynamic_cast<const Mode*>(attribute(state->getAttributeMap(), osg::StateAttribute::POLYGONMODE));
    return mode && mode->getMode(Mode::FRONT) != Mode::FILL && mode->getMode(Mode::BACK) != Mode::FILL;
}

Cutout::Cutout(const osg::AlphaFunc& test, const osg::Texture2D* texture, double alpha)
    : _test(&test), _texture(texture), _image(texture ? texture->getImage() : nullptr), _alpha(alpha) {}

double Cutout::alphaOf(int column, int row) const {
    const auto s = static_cast<unsigned>(wrapped(column, _image->s(), _texture->getWrap(osg::Texture::WRAP_S)));
    const auto t = static_cast<unsigned>(wrapped(row, _image->t(), _texture->getWrap(osg::Texture::WRAP_T)));
    return double(_image->getColor(s, t).a());
}

/// As the texture's own filter for magnification mixes texels.
double Cutout::alphaAt(const osg::Vec2d& texcoord) const {
    if (!_image) return 1.0;
    if (!(std::abs(texcoord.x()) < 1e6 && std::abs(texcoord.y()) < 1e6)) return 1.0; // no place in an image: solid
    const double s = texcoord.x() * _image->s(), t = texcoord.y() * _image->t();
    if (_texture->getFilter(osg::Texture::MAG_FILTER) == osg::Texture::NEAREST)
        return alphaOf(static_cast<int>(std::floor(s)), static_cast<int>(std::floor(t)));
    const double left = std::floor(s - 0.5), low = std::floor(t - 0.5), x = s - 0.5 - left, y = t - 0.5 - low;
    const int column = static_cast<int>(left), row = static_cast<int>(low);
    return (1.0 - y) * ((1.0 - x) * alphaOf(column, row) + x * alphaOf(column + 1, row)) +
           y * ((1.0 - x) * alphaOf(column, row + 1) + x * alphaOf(column + 1, row + 1));
}

bool Cutout::keeps(const osg::Vec2d& texcoord) const {
    return passes(_test->getFunction(), _alpha * alphaAt(texcoord), double(_test->getReferenceValue()));
}

bool SceneTriangles::solidAt(unsigned triangle, double u, double v) const {
    const std::optional<Cutout>& cutout = objects[object[triangle]].cutout;
    if (!cutout) return true;
    const unsigned* corner = &indices[3 * std::size_t{triangle}];
    return cutout->keeps(texcoords[corner[0]] * (1.0 - u - v) + texcoords[corner[1]] * u + texcoords[corner[2]] * v);
}

bool SceneTriangles::hasCutouts() const {
    return std::any_of(objects.begin(), objects.end(), [](const Object& each) { return each.cutout.has_value(); });
}

double SceneTriangles::longestEdge(unsigned triangle) const {
    const unsigned* corner = &indices[3 * std::size_t{triangle}];
    const osg::Vec3d &a = vertices[corner[0]], &b = vertices[corner[1]], &c = vertices[corner[2]];
    return std::max({(b - a).length(), (c - b).length(), (a - c).length()});
}

SceneTriangles sceneTriangles(osg::Node& scene, Clear clear) {
    SceneTriangles result;
    Collector collector(result, clear);
    scene.accept(collector);
    return result;
}

} // namespace gnomon::examples
