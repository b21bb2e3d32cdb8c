// SPDX-License-Identifier: MIT
#include <gnomon/casters/CastingRule.h>
#include <gnomon/casters/PathState.h>

#include <osg/Array>
#include <osg/BlendColor>
#include <osg/BlendFunc>
#include <osg/Depth>
#include <osg/Geometry>
#include <osg/Material>

#include <optional>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

template <class Attribute>
const Attribute* attributeOf(const PathState& state, A::Type type) {
    return dynamic_cast<const Attribute*>(state.attribute(type));
}

bool isAtFarPlane(const PathState& state) {
    const auto* depth = attributeOf<osg::Depth>(state, A::DEPTH);
    return depth && depth->getZNear() >= 1.0 && depth->getZFar() >= 1.0;
}

/// Of one colour for all of a drawable; OpenGL's own where it has none.
std::optional<float> colorAlpha(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    const osg::Array* colors = geometry ? geometry->getColorArray() : nullptr;
    if (!colors || colors->getNumElements() == 0) return geometry ? std::optional<float>(1.0f) : std::nullopt;
    if (colors->getBinding() != osg::Array::BIND_OVERALL && colors->getNumElements() > 1) return std::nullopt;
    if (const auto* floats = dynamic_cast<const osg::Vec4Array*>(colors)) return floats->front().a();
    if (const auto* bytes = dynamic_cast<const osg::Vec4ubArray*>(colors)) return bytes->front().a() / 255.0f;
    return colors->getDataSize() == 3 ? std::optional<float>(1.0f) : std::nullopt;
}

bool takesVertexColor(const osg::Material& material) {
    return material.getColorMode() == osg::Material::DIFFUSE ||
           material.getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE;
}

/// Before textures, which make it no more.
std::optional<float> surfaceAlpha(const PathState& state, const osg::Drawable& drawable) {
    if (state.hasProgram()) return std::nullopt;
    const auto* material = attributeOf<osg::Material>(state, A::MATERIAL);
    if (!state.isOn(GL_LIGHTING, true) || !material || takesVertexColor(*material)) return colorAlpha(drawable);
    return material->getDiffuse(osg::Material::FRONT).a();
}

/// What share of the colours behind it a blending drawable hides, if that is known.
std::optional<float> hiddenShare(const PathState& state, const osg::Drawable& drawable) {
    const auto* blend = attributeOf<osg::BlendFunc>(state, A::BLENDFUNC);
    switch (blend ? blend->getDestination() : GLenum(osg::BlendFunc::ONE_MINUS_SRC_ALPHA)) {
    case osg::BlendFunc::ONE:
        return 0.0f;
    case osg::BlendFunc::ONE_MINUS_SRC_ALPHA:
        return surfaceAlpha(state, drawable);
    case osg::BlendFunc::ONE_MINUS_CONSTANT_ALPHA: {
        const auto* color = attributeOf<osg::BlendColor>(state, A::BLENDCOLOR);
        return color ? color->getConstantColor().a() : 0.0f;
    }
    default:
        return std::nullopt;
    }
}

} // namespace

bool CastingRule::mayMatter(const osg::Node& node) {
    const osg::StateSet* set = node.getStateSet();
    return set && ((set->getMode(GL_BLEND) & A::ON) || set->getAttribute(A::DEPTH));
}

bool CastingRule::lets(const osg::NodePath& path, const osg::Drawable& drawable) const {
    const PathState state(path);
    if (isAtFarPlane(state)) return false;
    if (!(opaqueFrom > 0.0f) || !state.isOn(GL_BLEND)) return true;
    const std::optional<float> hidden = hiddenShare(state, drawable);
    return !hidden || *hidden >= opaqueFrom;
}

} // namespace gnomon
