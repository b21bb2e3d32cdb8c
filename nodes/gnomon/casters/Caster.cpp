// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/base/PlacedBox.h>
#include <gnomon/casters/Caster.h>
#include <gnomon/casters/CasterVisitor.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/rays/Placement.h>

#include <algorithm>

namespace gnomon {
namespace {

using States = std::vector<osg::ref_ptr<osg::StateSet>>;

/// By first parents above the path.
States statesAlong(const osg::NodePath& path) {
    States states;
    const auto add = [&states](const osg::Node& node) {
        if (node.getStateSet()) states.emplace_back(const_cast<osg::StateSet*>(node.getStateSet()));
    };
    for (auto node = path.rbegin(); node != path.rend(); ++node) add(**node);
    for (const osg::Node* node = path.front(); node->getNumParents() > 0;) add(*(node = node->getParent(0)));
    std::reverse(states.begin(), states.end());
    return states;
}

void mixState(const osg::StateSet& set, Fingerprint& into) {
    into.mix(static_cast<const void*>(&set));
    for (const auto& [type, attribute] : set.getAttributeList())
        into.mix(static_cast<const void*>(attribute.first.get()));
    for (const auto& [name, uniform] : set.getUniformList()) {
        into.mix(static_cast<const void*>(uniform.first.get()));
        into.mix(std::uint64_t{uniform.first->getModifiedCount()});
    }
}

/// A display list, and arrays that count their changes, show the same again.
bool changesUnseen(const osg::Drawable& drawable) {
    if (drawable.getDataVariance() != osg::Object::UNSPECIFIED)
        return drawable.getDataVariance() == osg::Object::DYNAMIC;
    return !drawable.asGeometry() && !(drawable.getSupportsDisplayList() && drawable.getUseDisplayList());
}

} // namespace

bool isBody(const Caster& piece) {
    return piece.triangles >= fewestOfABody && piece.casting.isWhole() && piece.invalidTriangles == 0 &&
           isPlacement(toGlm(piece.groupFromLocal));
}

SelfDrawing::SelfDrawing(const osg::NodePath& path, const osg::Drawable& given, const osg::Matrixd& matrix,
                         const Casting& what)
    : drawable(&given),
      groupFromLocal(matrix),
      states(statesAlong(path)),
      name(nameAlong(path)),
      bounds(placedBox(given.getBoundingBox(), matrix)),
      casting(what),
      hasPiece(hasTriangles(given) && !drawsItself(given)),
      byProgram(PathState(path).isProgrammed()),
      mayChange(changesUnseen(given)) {
    CasterVisitor::holdSources(given, sources);
    for (const auto& set : states) {
        for (const auto& [type, attribute] : set->getAttributeList()) sources.emplace_back(attribute.first);
        for (const auto& [uniformName, uniform] : set->getUniformList()) sources.emplace_back(uniform.first);
    }
}

std::uint64_t SelfDrawing::fingerprintOf(const osg::NodePath& path, const osg::Drawable& drawable,
                                         std::uint64_t placed) {
    Fingerprint result;
    result.mix(placed);
    result.mix(static_cast<const void*>(&drawable));
    result.mix(std::uint64_t{changesUnseen(drawable)});
    for (const auto& set : statesAlong(path)) mixState(*set, result);
    return result.value();
}

} // namespace gnomon
