// SPDX-License-Identifier: MIT
#include <gnomon/base/ProgramText.h>
#include <gnomon/casters/PathState.h>

#include <osg/CullFace>
#include <osg/Depth>
#include <osg/FrontFace>
#include <osg/PolygonMode>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

constexpr int firstLate = 8; // the ShadowBin's number

template <class Class>
const Class* as(const osg::StateSet::RefAttributePair* pair) {
    return pair ? static_cast<const Class*>(pair->first.get()) : nullptr;
}

bool isPlain(const osg::Depth& depth) {
    return depth.getWriteMask() &&
           (depth.getFunction() == osg::Depth::LESS || depth.getFunction() == osg::Depth::LEQUAL);
}

bool isFilled(const osg::PolygonMode& mode) {
    return mode.getMode(osg::PolygonMode::FRONT) == osg::PolygonMode::FILL &&
           mode.getMode(osg::PolygonMode::BACK) == osg::PolygonMode::FILL;
}

} // namespace

void HidingState::apply(const osg::StateSet& set) {
    for (const auto& [mode, given] : set.getModeList()) {
        Value* now = mode == GL_BLEND                                   ? &_blend
                     : mode == GL_ALPHA_TEST                            ? &_alphaTest
                     : mode == GL_CULL_FACE                             ? &_cull
                     : mode == GL_POLYGON_STIPPLE                       ? &_stipple
                     : mode == GL_DEPTH_TEST                            ? &_depthTest
                     : mode >= GL_CLIP_PLANE0 && mode <= GL_CLIP_PLANE5 ? &_clip[mode - GL_CLIP_PLANE0]
                                                                        : nullptr;
        if (now && !(given & A::INHERIT) && (!(*now & A::OVERRIDE) || (given & A::PROTECTED))) *now = given;
    }
    for (const auto& [type, given] : set.getAttributeList()) {
        const Attribute** now = type.first == A::CULLFACE      ? &_face
                                : type.first == A::FRONTFACE   ? &_front
                                : type.first == A::POLYGONMODE ? &_polygons
                                : type.first == A::DEPTH       ? &_depth
                                : type.first == A::PROGRAM     ? &_program
                                                               : nullptr;
        if (!now || (*now && ((*now)->second & A::OVERRIDE) && !(given.second & A::PROTECTED))) continue;
        *now = &given;
        if (now == &_program) _discards = mayDiscard(*as<osg::Program>(_program));
    }
    if (set.useRenderBinDetails()) _late = set.getBinNumber() >= firstLate;
}

Hiding HidingState::hiding(bool mirrored) const {
    const auto* depth = as<osg::Depth>(_depth);
    const auto* polygons = as<osg::PolygonMode>(_polygons);
    const auto isOn = [](Value value) { return (value & A::ON) != 0; };
    const bool solid = !(_late && isOn(_blend)) && !isOn(_alphaTest) && !isOn(_stipple) && isOn(_depthTest) &&
                       std::none_of(std::begin(_clip), std::end(_clip), isOn) && (!depth || isPlain(*depth)) &&
                       (!polygons || isFilled(*polygons)) && !_discards;
    if (!solid) return Hiding::Neither;
    if (!isOn(_cull)) return Hiding::Both;
    const auto* face = as<osg::CullFace>(_face);
    const auto* front = as<osg::FrontFace>(_front);
    const bool backs = !face || face->getMode() == osg::CullFace::BACK;
    const bool counterclockwise = !front || front->getMode() == osg::FrontFace::COUNTER_CLOCKWISE;
    return backs && counterclockwise && !mirrored ? Hiding::Fronts : Hiding::Neither;
}

} // namespace gnomon
