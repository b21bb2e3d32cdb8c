// SPDX-License-Identifier: MIT
#include <gnomon/compositor/DrawnLeaves.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/group/ViewLights.h>

#include <osg/ClipPlane>
#include <osg/Light>
#include <osg/Program>
#include <osgUtil/PositionalStateContainer>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

namespace gnomon {
namespace {

/// The way by the eye is never quite the same: a light at rest should stay where it is while the camera moves. To so many binary
/// places the floats of an osg::Light are whole, unless one is far smaller than another.
/// @param eye  what adds to the rounding: the eye's distance.
osg::Vec3d rounded(const osg::Vec3d& vector, double eye) {
    constexpr int places = 40;
    const double size = vector.length() + eye;
    if (!(size > 0.0) || !std::isfinite(size)) return vector;
    const double step = std::exp2(std::ilogb(size) - places);
    if (step == 0.0) return vector;
    const auto nearest = [step](double value) { return std::round(value / step) * step + 0.0; }; // no -0
    return {nearest(vector.x()), nearest(vector.y()), nearest(vector.z())};
}

/// A light as the stage will apply it.
struct StageLight {
    const osg::Light* light = nullptr;
    osg::Vec4d inEye;
    osg::Vec3d direction; ///< of a spot, in eye space.

    ShadowLight in(const osg::Matrixd& groupFromEye) const {
        const osg::Vec4d position = inEye * groupFromEye;
        const osg::Vec3d place(position.x(), position.y(), position.z());
        const osg::Vec3d still = rounded(place, position.w() == 0.0 ? 0.0 : groupFromEye.getTrans().length());
        return {light->getLightNum(), osg::Vec4d(still, position.w()),
                rounded(osg::Matrixd::transform3x3(direction, groupFromEye), 0.0), double{light->getSpotCutoff()}};
    }
};

void collect(osgUtil::PositionalStateContainer* container, const osg::Matrixd& eyeFromContainer,
             std::map<int, StageLight>& lights) {
    if (!container) return;
    for (const auto& [attribute, containerFromLight] : container->getAttrMatrixList()) {
        const auto* light = dynamic_cast<const osg::Light*>(attribute.get());
        if (!light) continue;
        const osg::Vec4d given(light->getPosition());
        const osg::Vec4d position = containerFromLight ? given * *containerFromLight : given;
        const osg::Vec3d way(light->getDirection());
        const osg::Vec3d direction = containerFromLight ? osg::Matrixd::transform3x3(way, *containerFromLight) : way;
        lights[light->getLightNum()] = {light, position * eyeFromContainer, // as in GL, the last one holds
                                        osg::Matrixd::transform3x3(direction, eyeFromContainer)};
    }
}

std::map<int, StageLight> lightsIn(osgUtil::RenderStage& stage) {
    std::map<int, StageLight> lights;
    collect(stage.getInheritedPositionalStateContainer(), stage.getInheritedPositionalStateContainerMatrix(), lights);
    collect(stage.getPositionalStateContainer(), osg::Matrixd(), lights);
    return lights;
}

std::string notOpenGL(int number) {
    return "light " + std::to_string(number) +
           " is left out, because OpenGL's lights are 0 to 7. Give it another number.";
}

void addSetLights(const ShadowCasterGroup& group, const std::map<int, StageLight>& inStage,
                  const osg::Matrixd& groupFromEye, GroupLights& result) {
    const auto sources = group.getLightSources();
    result.lights = group.getLights();
    if (sources.size() < group.getNumLightSources())
        result.causes.push_back("a LightSource given to ShadowCasterGroup::addLight() is gone, because nothing else "
                                "kept it. Add it to the scene, and give it to the group anew.");
    for (const auto& source : sources) {
        const osg::Light* light = source->getLight();
        if (light && (light->getLightNum() < 0 || light->getLightNum() > 7)) {
            result.causes.push_back(notOpenGL(light->getLightNum()));
            continue;
        }
        const auto found = light ? inStage.find(light->getLightNum()) : inStage.end();
        if (found != inStage.end() && found->second.light == light)
            result.lights.push_back(found->second.in(groupFromEye));
        else
            result.causes.push_back("the LightSource '" + source->getName() +
                                    "' is not in this view's scene graph, or another light has its number. Add it to "
                                    "the scene, or give it another number.");
    }
}

/// True if programs take the light from a uniform.
bool hasUniform(const ShadowCasterGroup& group, int number) {
    const auto& uniforms = group.getLightUniforms();
    return std::any_of(uniforms.begin(), uniforms.end(),
                       [number](const LightUniform& uniform) { return uniform.number == number; });
}

/// By OpenGL's own shading; programs may make more of a light. nullopt if it may grow near a lamp.
std::optional<double> strengthOf(const osg::Light& light) {
    if (light.getPosition().w() != 0.0f && light.getConstantAttenuation() < 1.0f) return std::nullopt;
    double most = 0.0;
    for (int channel = 0; channel < 3; ++channel)
        most =
            std::max(most, std::abs(double{light.getDiffuse()[channel]}) +
                               std::abs(double{light.getSpecular()[channel]})); // a light below zero takes light away
    return most;
}

void addStrengths(const ShadowCasterGroup& group, const std::map<int, StageLight>& inStage, GroupLights& result) {
    for (const ShadowLight& light : result.lights) {
        const auto found = inStage.find(light.number);
        if (found == inStage.end() || hasUniform(group, light.number)) continue;
        if (const auto strength = strengthOf(*found->second.light)) result.strengths[light.number] = *strength;
    }
}

bool isBlack(const osg::Vec4& color) { return color.r() == 0.0f && color.g() == 0.0f && color.b() == 0.0f; }

/// RELIGHT takes away what a light gives. @return why nobody sees that; empty if somebody may.
std::string whyAllIsDark(const ShadowCasterGroup& group, const std::map<int, StageLight>& inStage,
                         const std::vector<ShadowLight>& lights) {
    if (group.getComposite() != ShadowCasterGroup::RELIGHT || lights.empty()) return "";
    const auto mayShine = [&](const ShadowLight& light) {
        const auto found = inStage.find(light.number);
        return hasUniform(group, light.number) || found == inStage.end() ||
               !isBlack(found->second.light->getDiffuse()) || !isBlack(found->second.light->getSpecular());
    };
    if (std::any_of(lights.begin(), lights.end(), mayShine)) return "";
    return "each light in this view is black, so there is no shadow to be seen. Give it a diffuse or specular colour.";
}

/// RELIGHT takes nothing away where a named light is off, and its shadow is none. Programs may light without OpenGL's switch.
void findSwitchedOff(const ShadowCasterGroup& group, osgUtil::RenderStage& stage, GroupLights& result) {
    if (group.getComposite() != ShadowCasterGroup::RELIGHT) return;
    const std::vector<DrawnLeaf> leaves = leavesBelow(stage, std::numeric_limits<int>::max());
    const auto hasProgram = [](const DrawnLeaf& entry) {
        return resolved<osg::Program>(entry.leaf->_parent, osg::StateAttribute::PROGRAM) != nullptr;
    };
    std::vector<int> off; // mostly none, which the first leaf tells
    for (const ShadowLight& light : result.lights)
        if (light.number >= 0 && light.number <= 7 && !hasUniform(group, light.number) &&
            !isModeOn(leaves, GL_LIGHT0 + static_cast<unsigned>(light.number)))
            off.push_back(light.number);
    if (off.empty() || !isModeOn(leaves, GL_LIGHTING) || std::any_of(leaves.begin(), leaves.end(), hasProgram)) return;
    for (const int number : off) {
        const std::string name = std::to_string(number);
        result.causes.push_back("light " + name + " was named by addLight(), but GL_LIGHT" + name +
                                " is off in this view, so it has no shadow. Switch that mode on above the scene.");
    }
}

} // namespace

std::vector<NumberedPlane> clipPlanesOf(osgUtil::RenderStage& stage, const osg::Matrixd& eyeFromGroup, bool all) {
    std::vector<NumberedPlane> planes;
    const double eye = osg::Matrixd::inverse(eyeFromGroup).getTrans().length();
    const auto collect = [&](osgUtil::PositionalStateContainer* container, const osg::Matrixd& eyeFromContainer) {
        if (!container) return;
        for (const auto& [attribute, containerFromPlane] : container->getAttrMatrixList()) {
            const auto* clip = dynamic_cast<const osg::ClipPlane*>(attribute.get());
            if (!clip || !(containerFromPlane || all)) continue;
            const osg::Matrixd eyeFromPlane =
                containerFromPlane ? *containerFromPlane * eyeFromContainer : eyeFromContainer;
            const osg::Vec4d plane = eyeFromGroup * (osg::Matrixd::inverse(eyeFromPlane) * clip->getClipPlane());
            const osg::Vec3d normal(plane.x(), plane.y(), plane.z());
            const osg::Vec3d still = rounded(normal, 0.0), far = rounded({plane.w(), 0.0, 0.0}, normal.length() * eye);
            planes.emplace_back(clip->getClipPlaneNum(), osg::Vec4d(still, far.x()));
        }
    };
    collect(stage.getInheritedPositionalStateContainer(), stage.getInheritedPositionalStateContainerMatrix());
    const bool isNested = stage.getCamera() && stage.getCamera()->getNumParents() > 0;
    if (all || !isNested) collect(stage.getPositionalStateContainer(), osg::Matrixd());
    return planes;
}

GroupLights lightsOf(const ShadowCasterGroup& group, const osg::Matrixd& eyeFromGroup, osgUtil::RenderStage& stage) {
    const std::map<int, StageLight> inStage = lightsIn(stage);
    const osg::Matrixd groupFromEye = osg::Matrixd::inverse(eyeFromGroup);
    GroupLights result;
    const auto addCause = [&](const std::string& cause) {
        if (!cause.empty()) result.causes.push_back(cause);
    };
    if (!group.getLights().empty() || group.getNumLightSources() > 0) {
        addSetLights(group, inStage, groupFromEye, result);
        addStrengths(group, inStage, result);
        addCause(whyAllIsDark(group, inStage, result.lights));
        findSwitchedOff(group, stage, result);
        return result;
    }
    const std::vector<DrawnLeaf> leaves = leavesBelow(stage, std::numeric_limits<int>::max());
    for (const auto& [number, light] : inStage)
        if (number < 0 || number > 7)
            result.causes.push_back(notOpenGL(number));
        else if (isModeOn(leaves, GL_LIGHT0 + static_cast<unsigned>(number)))
            result.lights.push_back(light.in(groupFromEye));
    addStrengths(group, inStage, result);
    if (result.lights.empty() && (inStage.empty() || !leaves.empty())) // with nothing in sight, nobody can tell
        result.causes.push_back("no light is on in this view. Add an osg::LightSource and switch its mode on, or set a "
                                "light with ShadowCasterGroup::addLight() (--light).");
    addCause(whyAllIsDark(group, inStage, result.lights));
    return result;
}

} // namespace gnomon
