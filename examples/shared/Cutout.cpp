// SPDX-License-Identifier: MIT
#include "Cutout.h"

#include <osg/Geometry>
#include <osg/Material>
#include <osg/Node>
#include <osg/PolygonMode>
#include <osg/State>

#include <algorithm>
#include <cmath>

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

bool passes(osg::AlphaFunc::ComparisonFunction how, double alpha, double reference) {
    switch (how) {
    case osg::AlphaFunc::NEVER:
        return false;
    case osg::AlphaFunc::LESS:
        return alpha < reference;
    case osg::AlphaFunc::EQUAL:
        return alpha == reference;
    case osg::AlphaFunc::LEQUAL:
        return alpha <= reference;
    case osg::AlphaFunc::GREATER:
        return alpha > reference;
    case osg::AlphaFunc::NOTEQUAL:
        return alpha != reference;
    case osg::AlphaFunc::GEQUAL:
        return alpha >= reference;
    default:
        return true;
    }
}

int wrapped(int texel, int size, osg::Texture::WrapMode how) {
    const int turn = ((texel % size) + size) % size;
    if (how == osg::Texture::REPEAT) return turn;
    if (how == osg::Texture::MIRROR) return ((texel - turn) / size) % 2 ? size - 1 - turn : turn;
    return std::min(std::max(texel, 0), size - 1);
}

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
    static const osg::ref_ptr<osg::AlphaFunc> half = new osg::AlphaFunc(osg::AlphaFunc::GEQUAL, 0.5f);
    return Cutout(*half, texture(*state), baseAlphaOf(*state, drawable));
}

bool Cutout::isUnfilled(const osg::NodePath& path, const osg::Drawable& drawable) {
    const osg::ref_ptr<osg::State> state = new osg::State;
    push(*state, path, drawable);
    using Mode = osg::PolygonMode;
    const auto* mode =
        dynamic_cast<const Mode*>(attribute(state->getAttributeMap(), osg::StateAttribute::POLYGONMODE));
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

} // namespace gnomon::examples
