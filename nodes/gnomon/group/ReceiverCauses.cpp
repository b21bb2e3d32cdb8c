// SPDX-License-Identifier: MIT
#include <gnomon/base/Fingerprint.h>
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/compositor/ShadowJob.h>
#include <gnomon/group/LitCauses.h>
#include <gnomon/group/ReceiverCauses.h>

#include <osg/Program>
#include <osgUtil/StateGraph>

#include <algorithm>
#include <set>

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
    if (const std::string name = firstOf(drawn.late.torn); !name.empty())
        entry.report("'" + name +
                     "' blends by an alpha that is 1 in some parts only, in a bin above 8, so it "
                     "receives no shadow. Draw it in a bin below 8, or without GL_BLEND by an "
                     "osg::AlphaFunc.");
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

/// What decides on which surfaces a group's techniques shadow.
std::uint64_t settingsOf(const ShadowCasterGroup& group, const std::vector<EnlistedTechnique>& all) {
    Fingerprint settings;
    for (const EnlistedTechnique& entry : all) {
        if (entry.group.get() != &group) continue;
        settings.mix(entry.technique.get());
        settings.mix(entry.technique->surfacesKey());
        settings.mix(entry.groupFromTechnique);
        const Selection receiver = entry.technique->getReceiver();
        settings.mix(std::uint64_t{receiver.mask});
        for (const auto& root : receiver.roots()) settings.mix(root.get());
    }
    return settings.value();
}

/// Surfaces on which a shadow could be expected, to be looked through.
Leaves surfacesOf(const EnlistedTechnique& entry, const StageLeaves& drawn) {
    const auto canReceive = [&](const osgUtil::RenderLeaf& leaf) {
        const auto displaced = drawn.displaced.find(&leaf);
        const bool isSky =
            displaced != drawn.displaced.end() && displaced->second.nearest == displaced->second.farthest;
        return !isSky && isSameLens(projectionOf(leaf), *entry.projection) && isShaded(leaf._parent) &&
               writesDepth(leaf._parent) && !drawn.programs.moves(leaf);
    };
    Leaves surfaces;
    for (const auto* leaves : {&drawn.early, &drawn.late.leaves})
        for (const DrawnLeaf& drawnLeaf : *leaves)
            if (canReceive(*drawnLeaf.leaf)) surfaces.push_back(drawnLeaf.leaf);
    return surfaces;
}

/// Those of the surfaces that a technique shadows.
LeafSet shadowedBy(const EnlistedTechnique& entry, const StageLeaves& drawn, osgUtil::RenderStage& stage) {
    const ViewFrame view = viewOf(entry, *stage.getViewport());
    LeafSet shadowed;
    for (const auto* leaves : {&drawn.early, &drawn.late.leaves})
        for (const osgUtil::RenderLeaf* leaf : receivingOf(entry, *leaves, stage))
            if (entry.technique->shadowsSurface(view, *leaf)) shadowed.insert(leaf);
    return shadowed;
}

/// Drawables that cast nothing by a technique: what its shadow lies on.
std::set<const osg::Drawable*> notCastingBy(const EnlistedTechnique& entry, const LeafSet& shadowed,
                                            const Casters& casters) {
    std::set<const osg::Drawable*> result;
    for (const osgUtil::RenderLeaf* leaf : shadowed) result.insert(leaf->_drawable.get());
    if (!entry.technique->hasReceiver()) return result;
    std::vector<const osg::Drawable*> all;
    for (const auto& piece : casters.list) all.push_back(piece->drawable);
    const std::set<const osg::Drawable*> named = drawablesUnder(entry.technique->getReceiver(), all, *entry.group);
    result.insert(named.begin(), named.end());
    return result;
}

/// What is wrong with the shadow on some receiver.
std::string flawedCause(const TechniqueInStage& asked) {
    const auto& [entry, all, drawn, stage] = asked;
    const ViewFrame view = viewOf(entry, *stage.getViewport());
    const bool named = entry.technique->hasReceiver();
    for (const auto* leaves : {&drawn.early, &drawn.late.leaves})
        for (const osgUtil::RenderLeaf* leaf : receivingOf(entry, *leaves, stage)) {
            if (!named && !(isShaded(leaf->_parent) && writesDepth(leaf->_parent))) continue;
            if (const std::string flaw = entry.technique->flawOn(view, *leaf); !flaw.empty()) return flaw;
        }
    return {};
}

std::string unshadowedCause(const TechniqueInStage& asked, const ShadowLight& light, const Casters& casters) {
    const auto& [entry, all, drawn, stage] = asked;
    if (const std::string flaw = flawedCause(asked); !flaw.empty()) return flaw;
    Leaves surfaces = surfacesOf(entry, drawn);
    for (const EnlistedTechnique& other : all) {
        if (other.group != entry.group || surfaces.empty()) continue;
        const LeafSet shadowed = shadowedBy(other, drawn, stage);
        const auto isShadowed = [&](const osgUtil::RenderLeaf* leaf) { return shadowed.count(leaf) > 0; };
        surfaces.erase(std::remove_if(surfaces.begin(), surfaces.end(), isShadowed), surfaces.end());
    }
    if (surfaces.empty()) return {};
    const LeafSet shadowed = shadowedBy(entry, drawn, stage);
    const std::string name = unshadowedSurface({*entry.group, light, casters, surfaces, entry.eyeFromGroup}, shadowed,
                                               notCastingBy(entry, shadowed, casters));
    if (name.empty()) return {};
    return "the casters' shadow can fall on '" + name +
           "', which this technique leaves lit. Use map, volume or traced, or add a technique that receives there.";
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

Leaves receivingOf(const EnlistedTechnique& entry, const std::vector<DrawnLeaf>& leaves, osgUtil::RenderStage& stage) {
    const bool named = entry.technique->hasReceiver();
    LeafSet receivers;
    if (named)
        receivers = receiversAmong(leaves, entry.technique->getReceiver(), *stage.getInitialViewMatrix(), *entry.group);
    Leaves receiving;
    for (const DrawnLeaf& leaf : leaves)
        if (isSameLens(projectionOf(*leaf.leaf), *entry.projection) && (!named || receivers.count(leaf.leaf) > 0))
            receiving.push_back(leaf.leaf);
    return receiving;
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
    asked.drawn.programs.report(entry.technique->reportIn(entry.frameNumber), *entry.group, early, late);
    reportSeenThrough(asked);
    if (late.empty()) reportNoDepth(entry, early);
    if (!early.empty() || !late.empty()) reportFog(entry, asked.drawn);
}

void reportEnclosers(const TechniqueInStage& asked, const std::vector<ShadowLight>& lights, const Casters& casters,
                     const Leaves& receiving) {
    const EnlistedTechnique& entry = asked.entry;
    for (const ShadowLight& light : lights) {
        const LightInView lit{*entry.group, light, casters, receiving, entry.eyeFromGroup};
        const std::string cause = keptBy<RecalledCauses>(asked.stage)
                                      .causeOf(RecalledCauses::Kind::EnclosingNode, entry.group.get(), lit,
                                               {receiving.size(), 0}, [&] { return enclosingCause(lit); });
        if (!cause.empty()) entry.report(cause);
    }
}

void reportUnshadowed(const TechniqueInStage& asked, const std::vector<ShadowLight>& lights, const Casters& casters) {
    const EnlistedTechnique& entry = asked.entry;
    if (entry.technique->surfacesKey() == 0) return;
    const std::optional<std::uint64_t> seen = asked.drawn.shadedFingerprint();
    if (!seen) return;
    const RecalledCauses::State state{*seen, settingsOf(*entry.group, asked.all)};
    const Leaves none;
    for (const ShadowLight& light : lights) {
        const LightInView lit{*entry.group, light, casters, none, entry.eyeFromGroup};
        const std::string cause = keptBy<RecalledCauses>(asked.stage)
                                      .causeOf(RecalledCauses::Kind::UnshadowedSurface, entry.technique.get(), lit,
                                               state, [&] { return unshadowedCause(asked, light, casters); });
        if (!cause.empty()) entry.report(cause);
    }
}

void reportUnsureDepths(const TechniqueInStage& asked, const ShadowLight& light, const Casters& casters, double steps,
                        const Receiving& receiving) {
    const EnlistedTechnique& entry = asked.entry;
    const osg::Matrixd& lens = *entry.projection;
    const DepthPixels pixels{viewOf(entry, *asked.stage.getViewport()).pixels, steps};
    const LightInView lit{*entry.group, light, casters, receiving.early, entry.eyeFromGroup};
    Fingerprint seen;
    seen.mix(entry.eyeFromGroup);
    seen.mix(lens);
    seen.mix(std::uint64_t{receiving.early.size() + receiving.late.size()});
    const auto report = [&](RecalledCauses::Kind kind, const char* before, const char* after, const auto& find) {
        const auto found = [&] {
            const std::string name = find();
            return name.empty() ? name : before + name + after;
        };
        const std::string cause =
            keptBy<RecalledCauses>(asked.stage).causeOf(kind, entry.technique.get(), lit, {seen.value(), 0}, found);
        if (!cause.empty()) entry.report(cause);
    };
    if (reachesCoarseDepth(lit, lens, pixels))
        report(RecalledCauses::Kind::CoarseDepth, "depths cannot tell where the shadow of '",
               "' falls, because their steps are too long there. Move the near plane out, or let OpenSceneGraph "
               "compute it.",
               [&] { return coarselyPlaced(lit, lens, pixels); });
    report(
        RecalledCauses::Kind::LargeCoordinates, "the vertices of '",
        "' lie so far from their origin that OpenGL draws them off their place, so shadows on it may be lost or false. "
        "Put the offset into a transform, or use traced.",
        [&] {
            const std::string name = drawnOffItsPlace(receiving.early, lens, pixels.size);
            return name.empty() ? drawnOffItsPlace(receiving.late, lens, pixels.size) : name;
        });
}

} // namespace gnomon
