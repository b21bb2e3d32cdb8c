// SPDX-License-Identifier: MIT
#include <gnomon/base/Fingerprint.h>
#include <gnomon/base/PixelRect.h>
#include <gnomon/base/ProgramText.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/group/StageLeaves.h>

#include <algorithm>
#include <limits>

namespace gnomon {
namespace {

/// The leaf that casts and comes first; null if none does.
const osgUtil::RenderLeaf* firstCaster(const ShadowCasterGroup& group, const std::vector<DrawnLeaf>& leaves,
                                       const osg::Matrixd& eyeFromWorld) {
    Selection all;
    all.node = const_cast<ShadowCasterGroup*>(&group);
    const auto below = receiversAmong(leaves, all, eyeFromWorld, group);
    const auto casting = receiversAmong(leaves, group.getCasters(), eyeFromWorld, group);
    const auto casts = [&](const DrawnLeaf& entry) { return below.count(entry.leaf) && casting.count(entry.leaf); };
    const auto found = std::find_if(leaves.begin(), leaves.end(), casts);
    return found == leaves.end() ? nullptr : found->leaf;
}

} // namespace

ViewFrame viewOf(const EnlistedTechnique& entry, const osg::Viewport& viewport) {
    const PixelRect all = pixelsOf(viewport);
    ViewFrame view;
    view.pixels = {double(all.width), double(all.height)};
    view.eyeFromGroup = entry.eyeFromGroup;
    view.groupFromTechnique = entry.groupFromTechnique;
    view.projection = *entry.projection;
    view.group = entry.group.get();
    view.options = entry.group->getCompositorOptions();
    view.frameNumber = entry.frameNumber;
    view.frameTime = entry.frameTime;
    return view;
}

ViewPrograms::ViewPrograms(osgUtil::RenderStage& stage)
    : _eyeFromWorld(*stage.getInitialViewMatrix()), _all(leavesBelow(stage, std::numeric_limits<int>::max())) {
    const osgUtil::StateGraph* graph = nullptr; // leaves of one state mostly follow each other
    ProgramPlaces places;
    for (const DrawnLeaf& entry : _all) {
        if (entry.leaf->_parent != graph) places = placesIn(graph = entry.leaf->_parent);
        if (places.unseen) {
            _unseen.push_back(entry);
            continue;
        }
        if (places.movesVertices && !drawsItself(*entry.leaf->_drawable)) _moving.push_back(entry);
        if (places.setsDepth) _setDepths.insert(entry.leaf);
    }
    if (_moving.empty() && _unseen.empty()) return;
    auto moved = std::make_shared<LeafSet>();
    for (const std::vector<DrawnLeaf>* leaves : {&_moving, &_unseen})
        for (const DrawnLeaf& entry : *leaves) moved->insert(entry.leaf);
    _moved = moved;
}

namespace {

bool areAsArraysStand(const osgUtil::StateGraph* graph) {
    const ProgramPlaces places = placesIn(graph);
    return !places.movesVertices && !places.setsDepth && !places.discards;
}

} // namespace

/// Leaves of one state, of one lens and of one matrix mostly follow each other.
std::uint64_t ViewPrograms::standingValue() const {
    if (_standingValue) return *_standingValue;
    Fingerprint value;
    const osgUtil::StateGraph* graph = nullptr;
    const osg::RefMatrix *lens = nullptr, *place = nullptr;
    for (const DrawnLeaf& entry : _all) {
        const osgUtil::RenderLeaf& leaf = *entry.leaf;
        value.mix(static_cast<const void*>(leaf._drawable.get()));
        value.mix(static_cast<const void*>(leaf._drawable->getDrawCallback()));
        if (leaf._parent != graph) value.mix(std::uint64_t{areAsArraysStand(graph = leaf._parent)});
        if (!place || leaf._modelview != place) value.mix(modelviewOf(leaf));
        if (!lens || leaf._projection != lens) value.mix(projectionOf(leaf));
        place = leaf._modelview.get();
        lens = leaf._projection.get();
    }
    return *(_standingValue = value.value());
}

void ViewPrograms::findStanding(const osg::Matrixd& projection) const {
    _standing.emplace();
    _lens = projection;
    const osgUtil::StateGraph* graph = nullptr; // leaves of one state mostly follow each other
    const osg::RefMatrix* lens = nullptr;       // and those of one lens
    bool stands = false, isOfView = false;
    for (const DrawnLeaf& entry : _all) {
        if (entry.leaf->_parent != graph) stands = areAsArraysStand(graph = entry.leaf->_parent);
        if (!lens || entry.leaf->_projection != lens) isOfView = isSameLens(projectionOf(*entry.leaf), projection);
        lens = entry.leaf->_projection.get();
        if (stands && isOfView && !entry.leaf->_drawable->getDrawCallback())
            _standing->add(*entry.leaf->_drawable, modelviewOf(*entry.leaf));
    }
}

const DrawablePlaces& ViewPrograms::standing(const osg::Matrixd& projection) const {
    if (!_standing || !isSameLens(_lens, projection)) findStanding(projection);
    return *_standing;
}

void ViewPrograms::report(const EnlistedTechnique& entry, const Leaves& receiving, const Leaves& receivingLate) const {
    for (const Leaves* leaves : {&receiving, &receivingLate}) {
        if (_setDepths.empty()) break;
        const auto bends = [&](const auto* leaf) {
            return _setDepths.count(leaf) > 0 && placesIn(leaf->_parent, entry.group->getMatrixUniforms()).setsDepth;
        };
        const auto bent = std::find_if(leaves->begin(), leaves->end(), bends);
        if (bent == leaves->end()) continue;
        entry.report(
            "the program of '" + nameOf(**bent) +
            "' replaces OpenGL's depth, so its shadow is missing or wrong. Leave gl_Position.z and gl_FragDepth to "
            "the projection, or leave the node out of the receiver.");
        break;
    }
    if (!_moving.empty()) reportMoved(entry);
    if (const std::string name = firstUnseen(*entry.group, receiving, receivingLate); !name.empty())
        entry.report(
            "a state attribute of '" + name +
            "' may apply a program that cannot be read, as it is no osg::Program. Where that program moves vertices "
            "or sets a depth, shadows are missing or wrong. Set an osg::Program, or leave the node out of casters "
            "and receiver.");
}

/// Maps let programs draw, but for those that do not take the light's projection, or discard by the picture's pixels.
void ViewPrograms::reportMoved(const EnlistedTechnique& entry) const {
    const bool letsDraw = entry.technique->drawsCasters();
    const auto castsWhereItMoves = [&entry](const osgUtil::RenderLeaf& leaf) {
        return placesIn(leaf._parent, entry.group->getMatrixUniforms()).castsWhereItMoves();
    };
    std::vector<DrawnLeaf> left;
    for (const DrawnLeaf& each : _moving)
        if (!letsDraw || !castsWhereItMoves(*each.leaf)) left.push_back(each);
    const osgUtil::RenderLeaf* moved = firstCaster(*entry.group, left, _eyeFromWorld);
    if (!moved) return;
    if (castsWhereItMoves(*moved))
        entry.report(
            "the program of '" + nameOf(*moved) +
            "' moves its vertices, but it casts where its arrays stand. Use map, or take it out of the casters "
            "(setCasters(), --casters), and let a node that is never drawn cast in its place.");
    else
        entry.report(
            "the program of '" + nameOf(*moved) +
            "' moves its vertices by a projection or depth of its own, or discards by pixels, so it casts "
            "where its arrays stand. Under map, use gl_ProjectionMatrix or osg_ProjectionMatrix, or name its matrix "
            "by addMatrixUniform(). Or let a node that is never drawn cast in its place.");
}

std::string ViewPrograms::firstUnseen(const ShadowCasterGroup& group, const Leaves& receiving,
                                      const Leaves& receivingLate) const {
    if (_unseen.empty()) return {};
    for (const Leaves* leaves : {&receiving, &receivingLate})
        for (const osgUtil::RenderLeaf* leaf : *leaves)
            if (placesIn(leaf->_parent).unseen) return nameOf(*leaf);
    const osgUtil::RenderLeaf* caster = firstCaster(group, _unseen, _eyeFromWorld);
    return caster ? nameOf(*caster) : std::string();
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

} // namespace gnomon
