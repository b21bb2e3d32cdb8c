// SPDX-License-Identifier: MIT
#include <gnomon/compositor/ResolvedState.h>
#include <gnomon/group/LitCauses.h>
#include <gnomon/group/SlowCauses.h>

#include <algorithm>
#include <set>

namespace gnomon {
namespace {

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
    const std::string name = unshadowedSurface({casters, surfaces, entry.eyeFromGroup}, light, shadowed,
                                               notCastingBy(entry, shadowed, casters));
    if (name.empty()) return {};
    return "the casters' shadow can fall on '" + name +
           "', which this technique leaves lit. Use map, volume or traced, or add a technique that receives there.";
}

/// For techniques whose marks depend on depth.
std::vector<std::string> depthCauses(const TechniqueInStage& asked, const ShownByTechnique& shown) {
    const EnlistedTechnique& entry = asked.entry;
    const osg::Matrixd& lens = *entry.projection;
    const auto& [early, late] = shown.receiving;
    const DepthPixels pixels{viewOf(entry, *asked.stage.getViewport()).pixels, shown.depthSteps};
    const CastersInView seen{shown.casters, early, entry.eyeFromGroup};
    std::vector<std::string> causes;
    if (reachesCoarseDepth(seen, lens, pixels))
        if (const std::string name = coarselyPlaced(seen, lens, pixels); !name.empty())
            causes.push_back(
                "depths cannot tell where the shadow of '" + name +
                "' falls, because their steps are too long there. Move the near plane out, or let OpenSceneGraph "
                "compute it.");
    std::string off = drawnOffItsPlace(early, lens, pixels.size);
    if (off.empty()) off = drawnOffItsPlace(late, lens, pixels.size);
    if (!off.empty())
        causes.push_back("the vertices of '" + off +
                         "' lie so far from their origin that OpenGL draws them off their place, so shadows on it may "
                         "be lost or false. Put the offset into a transform, or use traced.");
    return causes;
}

} // namespace

std::vector<std::string> slowCauses(const TechniqueInStage& asked, const ShownByTechnique& shown) {
    const EnlistedTechnique& entry = asked.entry;
    std::vector<std::string> causes =
        enclosingCauses({shown.casters, shown.receiving.early, entry.eyeFromGroup}, shown.lights);
    if (!shown.marks) return causes;
    if (const osgUtil::RenderLeaf* cut = firstCut(asked.drawn.early, asked.stage))
        causes.push_back("'" + nameOf(*cut) +
                         "' blends by an alpha that differs from place to place, in a bin below 8, so what is seen "
                         "through it has its shadow. Set the rendering hint osg::StateSet::TRANSPARENT_BIN.");
    if (entry.technique->leavesSomeLit())
        for (const ShadowLight& light : shown.lights)
            if (const std::string cause = unshadowedCause(asked, light, shown.casters); !cause.empty())
                causes.push_back(cause);
    if (shown.depthSteps > 0.0)
        for (const std::string& cause : depthCauses(asked, shown)) causes.push_back(cause);
    return causes;
}

} // namespace gnomon
