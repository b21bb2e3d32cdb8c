// SPDX-License-Identifier: MIT
#include <gnomon/compositor/LateReceivers.h>
#include <gnomon/compositor/ResolvedState.h>

#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/Geometry>
#include <osg/LogicOp>
#include <osg/Material>

#include <algorithm>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

/// An alpha of this or more is drawn as 1 by a framebuffer of eight bits.
constexpr float opaqueAlpha = 1.0f - 0.5f / 255.0f;

/// True if an alpha of 1 hides what is behind.
bool alphaHides(const osgUtil::StateGraph* graph) {
    const auto* equation = resolved<osg::BlendEquation>(graph, A::BLENDEQUATION);
    if (equation && equation->getEquationRGB() != osg::BlendEquation::FUNC_ADD) return false;
    const auto* function = resolved<osg::BlendFunc>(graph, A::BLENDFUNC);
    if (!function) return true; // OSG's default
    const GLenum source = function->getSource(), destination = function->getDestination();
    return (source == GL_SRC_ALPHA || source == GL_ONE) &&
           (destination == GL_ONE_MINUS_SRC_ALPHA || destination == GL_ZERO);
}

/// True if a logic operation, which takes the place of blending, hides what is behind.
bool operationHides(const osgUtil::StateGraph* graph) {
    const auto* operation = resolved<osg::LogicOp>(graph, A::LOGICOP);
    if (!operation) return true; // OSG's default, COPY
    const osg::LogicOp::Opcode code = operation->getOpcode();
    return code == osg::LogicOp::COPY || code == osg::LogicOp::COPY_INVERTED || code == osg::LogicOp::CLEAR ||
           code == osg::LogicOp::SET;
}

bool hasTexture(const osgUtil::StateGraph* graph) {
    for (; graph; graph = graph->_parent)
        if (graph->getStateSet() && !graph->getStateSet()->getTextureAttributeList().empty()) return true;
    return false;
}

/// The alpha of the one colour that a geometry has; 1 where it has several, or none.
float alphaOf(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    const auto* colors = geometry ? dynamic_cast<const osg::Vec4Array*>(geometry->getColorArray()) : nullptr;
    return colors && colors->size() == 1 ? colors->front().a() : 1.0f;
}

/// What is known of the alpha without textures and programs: it is this at most.
float mostAlpha(const osgUtil::RenderLeaf& leaf) {
    const osgUtil::StateGraph* graph = leaf._parent;
    if (hasTexture(graph) || resolvedAttribute(graph, A::PROGRAM)) return 1.0f;
    const auto* material = resolved<osg::Material>(graph, A::MATERIAL);
    if (!isOn(graph, GL_LIGHTING)) return alphaOf(*leaf._drawable);
    if (!material) return 1.0f;
    const bool tracks = material->getColorMode() == osg::Material::DIFFUSE ||
                        material->getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE;
    if (tracks && leaf._drawable->asGeometry() && leaf._drawable->asGeometry()->getColorArray())
        return alphaOf(*leaf._drawable);
    return std::max(material->getDiffuse(osg::Material::FRONT).a(), material->getDiffuse(osg::Material::BACK).a());
}

/// What has no bounds draws something else than surfaces: a user interface, for one, which must not be drawn twice.
bool isSurface(const osgUtil::RenderLeaf& leaf) {
    return leaf._drawable->getBoundingBox().valid() && writesDepth(leaf._parent);
}

bool blendHides(const osgUtil::RenderLeaf& leaf) {
    return !isOn(leaf._parent, GL_BLEND) || (alphaHides(leaf._parent) && mostAlpha(leaf) >= opaqueAlpha);
}

} // namespace

LateReceivers lateReceivers(osgUtil::RenderStage& stage, int number) {
    LateReceivers late;
    const auto& bins = stage.getRenderBinList();
    for (auto bin = bins.lower_bound(number); bin != bins.end(); ++bin)
        for (const DrawnLeaf& entry : leavesIn(*bin->second)) {
            if (!isSurface(*entry.leaf)) continue;
            const bool combines = isOn(entry.leaf->_parent, GL_COLOR_LOGIC_OP);
            if (combines && !operationHides(entry.leaf->_parent)) {
                late.combined.push_back(entry);
            } else if (combines || blendHides(*entry.leaf)) {
                late.leaves.push_back(entry);
                late.last = bin->second.get();
            }
        }
    return late;
}

} // namespace gnomon
