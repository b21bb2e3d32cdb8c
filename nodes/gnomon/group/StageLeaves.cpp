// SPDX-License-Identifier: MIT
#include <gnomon/base/PixelRect.h>
#include <gnomon/base/ProgramText.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/group/StageLeaves.h>

#include <algorithm>
#include <cmath>
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

ProgramCauses::ProgramCauses(osgUtil::RenderStage& stage)
    : _eyeFromWorld(*stage.getInitialViewMatrix()), _all(leavesBelow(stage, std::numeric_limits<int>::max())) {
    for (const DrawnLeaf& entry : _all) {
        const auto [places, isNew] = _places.try_emplace(entry.leaf->_parent);
        if (isNew) places->second = placesIn(entry.leaf->_parent);
        if (places->second.unseen) {
            _unseen.push_back(entry);
            continue;
        }
        if (places->second.movesVertices && !drawsItself(*entry.leaf->_drawable)) _moving.push_back(entry);
        if (places->second.setsDepth) _setDepths.insert(entry.leaf);
    }
    if (_moving.empty() && _unseen.empty()) return;
    auto moved = std::make_shared<LeafSet>();
    for (const std::vector<DrawnLeaf>* leaves : {&_moving, &_unseen})
        for (const DrawnLeaf& entry : *leaves) moved->insert(entry.leaf);
    _moved = moved;
}

void ProgramCauses::findStanding(const osg::Matrixd& projection) const {
    const osgUtil::StateGraph* graph = nullptr; // leaves of one state mostly follow each other
    const osg::RefMatrix* lens = nullptr;       // and those of one lens
    bool stands = false, isOfView = false;
    for (const DrawnLeaf& entry : _all) {
        if (entry.leaf->_parent != graph) {
            const ProgramPlaces& places = _places.at(graph = entry.leaf->_parent);
            stands = !places.movesVertices && !places.setsDepth && !places.discards;
        }
        if (!lens || entry.leaf->_projection != lens) isOfView = isSameLens(projectionOf(*entry.leaf), projection);
        lens = entry.leaf->_projection.get();
        if (stands && isOfView && !entry.leaf->_drawable->getDrawCallback()) _standing.push_back(entry.leaf);
    }
}

bool ProgramCauses::draws(const Caster& caster, const ViewFrame& view) const {
    if (_standing.empty() && _next == 0) findStanding(view.projection);
    if (_standing.empty()) {
        _next = 1; // they need not be looked for again
        return false;
    }
    // Where the origin goes, and a direction: two places of one drawable differ by these.
    const auto turned = [](const osg::Matrixd& m) {
        return osg::Vec3d(m(0, 0) + 2.0 * m(1, 0) + 3.0 * m(2, 0), m(0, 1) + 2.0 * m(1, 1) + 3.0 * m(2, 1),
                          m(0, 2) + 2.0 * m(1, 2) + 3.0 * m(2, 2));
    };
    const auto size = [](const osg::Vec3d& v) { return std::abs(v.x()) + std::abs(v.y()) + std::abs(v.z()); };
    const osg::Vec3d inGroup = caster.groupFromLocal.getTrans(), place = inGroup * view.eyeFromGroup,
                     way = osg::Matrixd::transform3x3(turned(caster.groupFromLocal), view.eyeFromGroup);
    const double margin = 1e-9 * (size(place) + size(way)) + 1e-14 * size(inGroup); // the same product in another order
    const auto isAt = [&](const osgUtil::RenderLeaf& leaf) {
        const osg::Matrixd& here = modelviewOf(leaf);
        return size(here.getTrans() - place) <= margin && size(turned(here) - way) <= margin;
    };
    if (_next < _standing.size() && _standing[_next]->_drawable == caster.drawable && isAt(*_standing[_next])) {
        ++_next;
        return true;
    }
    if (_sorted.empty()) {
        for (std::size_t i = 0; i < _standing.size(); ++i)
            _sorted.emplace_back(_standing[i]->_drawable.get(), modelviewOf(*_standing[i])(3, 0), i);
        std::sort(_sorted.begin(), _sorted.end());
    }
    auto found = std::lower_bound(_sorted.begin(), _sorted.end(), Standing{caster.drawable, place.x() - margin, 0});
    for (; found != _sorted.end(); ++found) {
        const auto& [drawable, x, index] = *found;
        if (drawable != caster.drawable || x > place.x() + margin) return false;
        if (!isAt(*_standing[index])) continue;
        _next = index + 1;
        return true;
    }
    return false;
}

void ProgramCauses::report(const FrameReport& report, const ShadowCasterGroup& group, const Leaves& receiving,
                           const Leaves& receivingLate) const {
    for (const Leaves* leaves : {&receiving, &receivingLate}) {
        if (_setDepths.empty()) break;
        const auto bends = [this](const auto* leaf) { return _setDepths.count(leaf) > 0; };
        const auto bent = std::find_if(leaves->begin(), leaves->end(), bends);
        if (bent == leaves->end()) continue;
        report("the program of '" + nameOf(**bent) +
               "' replaces OpenGL's depth, so its shadow is missing or wrong. Leave gl_Position.z and gl_FragDepth to "
               "the projection, or leave the node out of the receiver.");
        break;
    }
    const osgUtil::RenderLeaf* moved = _moving.empty() ? nullptr : firstCaster(group, _moving, _eyeFromWorld);
    if (moved)
        report("the program of '" + nameOf(*moved) +
               "' moves its vertices, but it casts where its arrays stand. Take it out of the casters (setCasters(), "
               "--casters), and let a node that is never drawn cast in its place.");
    if (const std::string name = firstUnseen(group, receiving, receivingLate); !name.empty())
        report("a state attribute of '" + name +
               "' may apply a program that cannot be read, as it is no osg::Program. Where that program moves vertices "
               "or sets a depth, shadows are missing or wrong. Set an osg::Program, or leave the node out of casters "
               "and receiver.");
}

std::string ProgramCauses::firstUnseen(const ShadowCasterGroup& group, const Leaves& receiving,
                                       const Leaves& receivingLate) const {
    if (_unseen.empty()) return {};
    for (const Leaves* leaves : {&receiving, &receivingLate})
        for (const osgUtil::RenderLeaf* leaf : *leaves)
            if (const auto places = _places.find(leaf->_parent); places != _places.end() && places->second.unseen)
                return nameOf(*leaf);
    const osgUtil::RenderLeaf* caster = firstCaster(group, _unseen, _eyeFromWorld);
    return caster ? nameOf(*caster) : std::string();
}

} // namespace gnomon
