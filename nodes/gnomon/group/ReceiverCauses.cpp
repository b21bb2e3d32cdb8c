// SPDX-License-Identifier: MIT
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/group/ReceiverCauses.h>

#include <osg/Program>
#include <osgUtil/StateGraph>

#include <algorithm>

namespace gnomon {
namespace {

/// Shadows are found by the depths that stand.
void reportNoDepth(const EnlistedTechnique& entry, const std::vector<const osgUtil::RenderLeaf*>& receiving) {
    const auto hasDepth = [](const auto* leaf) { return writesDepth(leaf->_parent); };
    const auto shaded =
        std::find_if(receiving.begin(), receiving.end(), [](auto* leaf) { return isShaded(leaf->_parent); });
    if (shaded == receiving.end() || std::any_of(receiving.begin(), receiving.end(), hasDepth)) return;
    entry.report("no receiver in this view writes depth, so there is no shadow; the first is '" + nameOf(**shaded) +
                 "'. Switch GL_DEPTH_TEST and the mask of osg::Depth on.");
}

/// What stands behind would need its own shadow and that of what is combined with it.
void reportSeenThrough(const TechniqueInStage& asked) {
    const auto& [entry, others, drawn, stage] = asked;
    const auto firstOf = [&](const std::vector<DrawnLeaf>& leaves) {
        const Leaves all = receivingOf(asked.entry, leaves, asked.stage);
        const auto first = std::find_if(all.begin(), all.end(), [](auto* leaf) { return isShaded(leaf->_parent); });
        return first == all.end() ? std::string() : nameOf(**first);
    };
    if (const std::string name = firstOf(drawn.late.combined); !name.empty())
        entry.report("a logic operation combines '" + name +
                     "' with what stands behind it, in a bin above 8, so it receives no shadow. Draw it "
                     "in a bin below 8, or switch GL_COLOR_LOGIC_OP off.");
    if (const std::string name = firstOf(drawn.late.clear); !name.empty())
        entry.report("'" + name +
                     "' blends with what stands behind it, so it is as bright as without shadows; what "
                     "is seen through it has its shadow. Switch GL_BLEND off if it is opaque.");
}

/// A factor is for what is seen, fog and all.
void reportFog(const EnlistedTechnique& entry, const StageLeaves& drawn) {
    if (entry.group->getComposite() == ShadowCasterGroup::BLEND &&
        (isModeOn(drawn.early, GL_FOG) || isModeOn(drawn.late.leaves, GL_FOG)))
        entry.report("fog is on, and BLEND darkens it with the surface behind it. Set "
                     "RELIGHT (composite=relight), or switch GL_FOG off.");
}

} // namespace

std::string whyNoPicture(const EnlistedTechnique& entry) {
    bool overrides = false;
    const auto* program =
        dynamic_cast<const osg::Program*>(resolvedAttribute(entry.state, osg::StateAttribute::PROGRAM, &overrides));
    if (!program || !overrides || program->getNumShaders() == 0) return {};
    for (unsigned i = 0; i < program->getNumShaders(); ++i) {
        const std::string& text = program->getShader(i)->getShaderSource();
        const auto has = [&text](const std::string& word) { return text.find(word) != std::string::npos; };
        const auto& uniforms = entry.group->getLightUniforms();
        const auto named = [&has](const LightUniform& uniform) { return has(uniform.name); };
        if (text.empty() || has("gl_LightSource") || has("LightProduct") || has("ormal") || has("texture") ||
            has("sampler") || std::any_of(uniforms.begin(), uniforms.end(), named))
            return {};
    }
    return "a program with OVERRIDE draws this whole view, '" + program->getName() +
           "', and takes neither light nor textures, as programs do that draw identifiers. So no shadow falls here. "
           "Set "
           "it without osg::StateAttribute::OVERRIDE if it draws a picture.";
}

bool reportOtherLens(const TechniqueInStage& asked) {
    const EnlistedTechnique& entry = asked.entry;
    const auto isServed = [&](const osgUtil::RenderLeaf& leaf) {
        return std::any_of(asked.all.begin(), asked.all.end(), [&](const EnlistedTechnique& other) {
            return other.technique == entry.technique && isSameLens(projectionOf(leaf), *other.projection);
        });
    };
    std::vector<DrawnLeaf> others;
    for (const auto* leaves : {&asked.drawn.early, &asked.drawn.late.leaves})
        for (const DrawnLeaf& each : *leaves)
            if (!isServed(*each.leaf) && isShaded(each.leaf->_parent) && writesDepth(each.leaf->_parent))
                others.push_back(each);
    if (others.empty()) return false;
    Selection receiver = entry.technique->getReceiver();
    if (!entry.technique->hasReceiver()) receiver.node = const_cast<ShadowCasterGroup*>(entry.group.get());
    const LeafSet meant = receiversAmong(others, receiver, *asked.stage.getInitialViewMatrix(), *entry.group);
    const auto first =
        std::find_if(others.begin(), others.end(), [&](auto& each) { return meant.count(each.leaf) > 0; });
    if (first == others.end()) return false;
    entry.report("'" + nameOf(*first->leaf) +
                 "' is drawn through a projection of its own, so it receives no shadow. Draw it through "
                 "the camera's, or put it under a ShadowCasterGroup of its own.");
    return true;
}

void reportNoReceiver(const EnlistedTechnique& entry, osgUtil::RenderStage& stage) {
    if (entry.technique->isReceiverGone())
        return entry.report("the node given to setReceiver() is gone, because nothing "
                            "else kept it. Add the receiver to the scene, and name it "
                            "anew.");
    const std::string cause = whyMissing(entry.technique->getReceiver(), "receiver", *entry.group, stage);
    if (!cause.empty()) entry.report(cause);
}

void reportReceiverStates(const TechniqueInStage& asked, const Receiving& receiving) {
    const EnlistedTechnique& entry = asked.entry;
    const auto& [early, late] = receiving;
    asked.drawn.programs.report(entry, early, late);
    reportSeenThrough(asked);
    if (late.empty()) reportNoDepth(entry, early);
    if (!early.empty() || !late.empty()) reportFog(entry, asked.drawn);
}

} // namespace gnomon
