// SPDX-License-Identifier: MIT
#include <gnomon/casters/DrawnState.h>

#include <osg/AlphaFunc>
#include <osg/GraphicsContext>
#include <osg/Material>
#include <osg/Program>
#include <osg/TexEnv>
#include <osg/TexEnvCombine>
#include <osg/TexGen>
#include <osg/TexMat>
#include <osg/Texture2D>

#include <algorithm>
#include <cstring>
#include <set>
#include <string>
#include <tuple>
#include <typeinfo>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

void mixValue(const osg::Vec4& value, Fingerprint& into) { into.mixBytes(value.ptr(), sizeof value); }
void mixValue(double value, Fingerprint& into) { into.mix(value); }
void mixValue(unsigned value, Fingerprint& into) { into.mix(std::uint64_t{value}); }
void mixValue(const std::string& text, Fingerprint& into) {
    into.mix(std::uint64_t{text.size()});
    into.mixBytes(text.data(), text.size());
}

template <class... Value>
void mixValues(Fingerprint& into, const Value&... value) {
    (mixValue(value, into), ...);
}

/// By value, for many applications set the same in each frame.
void mixUniform(const osg::Uniform& uniform, Fingerprint& into) {
    const osg::Array* arrays[] = {uniform.getFloatArray(), uniform.getDoubleArray(), uniform.getIntArray(),
                                  uniform.getUIntArray(),  uniform.getInt64Array(),  uniform.getUInt64Array()};
    for (const osg::Array* array : arrays)
        if (array) into.mixBytes(array->getDataPointer(), array->getTotalDataSize());
}

void mixMaterial(const osg::Material& material, Fingerprint& into) {
    mixValues(into, unsigned(material.getColorMode()));
    for (const auto face : {osg::Material::FRONT, osg::Material::BACK})
        mixValues(into, material.getAmbient(face), material.getDiffuse(face), material.getSpecular(face),
                  material.getEmission(face), material.getShininess(face));
}

void mixProgram(const osg::Program& program, Fingerprint& into) {
    for (unsigned i = 0; i < program.getNumShaders(); ++i) {
        into.mix(static_cast<const void*>(program.getShader(i)));
        mixValue(program.getShader(i)->getShaderSource(), into);
    }
}

void mixGenerator(const osg::TexGen& generator, Fingerprint& into) {
    mixValues(into, unsigned(generator.getMode()));
    for (const auto axis : {osg::TexGen::S, osg::TexGen::T, osg::TexGen::R, osg::TexGen::Q})
        mixValue(osg::Vec4(generator.getPlane(axis).asVec4()), into);
}

void mixAttribute(const A& attribute, Fingerprint& into) {
    into.mix(static_cast<const void*>(&attribute));
    if (const osg::Texture* texture = attribute.asTexture()) return mixTexture(*texture, into);
    if (const auto* program = dynamic_cast<const osg::Program*>(&attribute)) return mixProgram(*program, into);
    if (const auto* material = dynamic_cast<const osg::Material*>(&attribute)) return mixMaterial(*material, into);
    if (const auto* matrix = dynamic_cast<const osg::TexMat*>(&attribute)) return into.mix(matrix->getMatrix());
    if (const auto* generator = dynamic_cast<const osg::TexGen*>(&attribute)) return mixGenerator(*generator, into);
    if (const auto* test = dynamic_cast<const osg::AlphaFunc*>(&attribute))
        return mixValues(into, unsigned(test->getFunction()), test->getReferenceValue());
    if (const auto* unit = dynamic_cast<const osg::TexEnv*>(&attribute))
        return mixValues(into, unsigned(unit->getMode()), unit->getColor());
    if (const auto* unit = dynamic_cast<const osg::TexEnvCombine*>(&attribute))
        mixValues(into, unit->getConstantColor(), unit->getScale_Alpha(), unsigned(unit->getCombine_Alpha()));
}

/// Calls act(attribute) for each.
template <class Act>
void forAttributes(const DrawnStates& states, const Act& act) {
    for (const auto& set : states) {
        for (const auto& [type, attribute] : set->getAttributeList()) act(*attribute.first);
        for (const auto& unit : set->getTextureAttributeList())
            for (const auto& [type, attribute] : unit) act(*attribute.first);
    }
}

/// Times of the frame, which each view's own set gives.
bool readsClock(const osg::Program& program) {
    for (unsigned i = 0; i < program.getNumShaders(); ++i)
        for (const char* clock : {"osg_FrameNumber", "osg_FrameTime", "osg_SimulationTime", "osg_Delta"})
            if (program.getShader(i)->getShaderSource().find(clock) != std::string::npos) return true;
    return false;
}

/// OpenGL itself writes to buffers and images that are bound by number.
bool isUntold(const A& attribute) {
    if (std::strcmp(attribute.libraryName(), "osg") != 0 || attribute.getShaderComponent()) return true;
    if (const osg::Texture* texture = attribute.asTexture()) return changesUnseen(*texture);
    const auto* program = dynamic_cast<const osg::Program*>(&attribute);
    const A::Type type = attribute.getType();
    return (program && readsClock(*program)) || type == A::BINDIMAGETEXTURE || type == A::UNIFORMBUFFERBINDING ||
           type == A::ATOMICCOUNTERBUFFERBINDING || type == A::SHADERSTORAGEBUFFERBINDING;
}

} // namespace

void mixTexture(const osg::Texture& texture, Fingerprint& into) {
    for (const auto which : {osg::Texture::MIN_FILTER, osg::Texture::MAG_FILTER})
        into.mix(std::uint64_t{unsigned(texture.getFilter(which))});
    for (const auto axis : {osg::Texture::WRAP_S, osg::Texture::WRAP_T, osg::Texture::WRAP_R})
        into.mix(std::uint64_t{unsigned(texture.getWrap(axis))});
    into.mix(texture.getBorderColor().a());
    into.mix(std::uint64_t{holdsNothing(texture)});
    for (unsigned face = 0; face < texture.getNumImages() && !texture.getUnRefImageDataAfterApply(); ++face) {
        const osg::Image* image = texture.getImage(face);
        into.mix(static_cast<const void*>(image));
        if (image) into.mix(std::uint64_t{image->getModifiedCount()});
    }
}

/// By the rules of osg::Texture2D::apply(). Of other classes that is not known.
bool holdsNothing(const osg::Texture& texture) {
    if (typeid(texture) != typeid(osg::Texture2D)) return false;
    const auto& plain = static_cast<const osg::Texture2D&>(texture);
    if (plain.getSubloadCallback() || (plain.getImage() && plain.getImage()->data())) return false;
    if (plain.getTextureWidth() != 0 && plain.getTextureHeight() != 0) return false;
    for (unsigned context = 0; context <= osg::GraphicsContext::getMaxContextID(); ++context)
        if (plain.getTextureObject(context)) return false; // somebody's own
    return true;
}

bool changesUnseen(const osg::Texture& texture) {
    const auto* plain = dynamic_cast<const osg::Texture2D*>(&texture);
    if (plain && plain->getSubloadCallback()) return true;
    return !holdsNothing(texture) && !texture.getUnRefImageDataAfterApply() &&
           (texture.getNumImages() == 0 || !texture.getImage(0));
}

ReleasedImages::ReleasedImages(const DrawnStates& states) {
    forAttributes(states, [this](const A& attribute) {
        const osg::Texture* texture = attribute.asTexture();
        if (!texture || !texture->getUnRefImageDataAfterApply()) return;
        const osg::Image* image = texture->getImage(0);
        _all.push_back({texture, image, image ? image->getModifiedCount() : 0});
    });
}

bool ReleasedImages::haveOther() const {
    return std::any_of(_all.begin(), _all.end(), [](const Released& known) {
        const osg::Image* image = known.texture->getImage(0);
        return image && !(image == known.image.get() && image->getModifiedCount() == known.count);
    });
}

/// What is given again below has no effect, unless it overrides.
bool changesUnseen(const DrawnStates& states) {
    std::set<std::tuple<std::size_t, A::Type, unsigned>> given; // units and types; 0 is no unit's
    for (auto set = states.rbegin(); set != states.rend(); ++set) {
        const auto changes = [&given](std::size_t unit, const osg::StateSet::AttributeList& list) {
            return std::any_of(list.begin(), list.end(), [&](const auto& entry) {
                const bool isInnermost = given.insert({unit, entry.first.first, entry.first.second}).second;
                return (isInnermost || (entry.second.second & A::OVERRIDE)) && isUntold(*entry.second.first);
            });
        };
        const auto& units = (*set)->getTextureAttributeList();
        if (changes(0, (*set)->getAttributeList())) return true;
        for (std::size_t unit = 0; unit < units.size(); ++unit)
            if (changes(unit + 1, units[unit])) return true;
    }
    return false;
}

void mixStates(const DrawnStates& states, Fingerprint& into) {
    for (const auto& set : states) {
        into.mix(static_cast<const void*>(set.get()));
        for (const auto& [mode, value] : set->getModeList()) into.mix(std::uint64_t{mode} << 32 | value);
        for (const auto& unit : set->getTextureModeList())
            for (const auto& [mode, value] : unit) into.mix(std::uint64_t{mode} << 32 | value);
        for (const auto& [name, uniform] : set->getUniformList()) {
            into.mix(static_cast<const void*>(uniform.first.get()));
            mixUniform(*uniform.first, into);
        }
        for (const auto& [name, define] : set->getDefineList()) mixValues(into, name, define.first);
    }
    forAttributes(states, [&into](const A& attribute) { mixAttribute(attribute, into); });
}

void holdStates(const DrawnStates& states, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) {
    for (const auto& set : states)
        for (const auto& [name, uniform] : set->getUniformList()) sources.emplace_back(uniform.first);
    forAttributes(states, [&sources](const A& attribute) {
        sources.emplace_back(&attribute);
        const osg::Texture* texture = attribute.asTexture();
        for (unsigned face = 0; texture && face < texture->getNumImages(); ++face)
            if (!texture->getUnRefImageDataAfterApply()) sources.emplace_back(texture->getImage(face));
    });
}

} // namespace gnomon
