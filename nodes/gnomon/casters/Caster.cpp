// SPDX-License-Identifier: MIT
#include <gnomon/Convert.h>
#include <gnomon/base/BoxAbout.h>
#include <gnomon/casters/Caster.h>
#include <gnomon/casters/CasterVisitor.h>
#include <gnomon/casters/DrawableTriangles.h>
#include <gnomon/rays/Placement.h>

#include <osg/Geometry>

#include <algorithm>

namespace gnomon {
namespace {

void mixArrays(const osg::Geometry& geometry, Fingerprint& into) {
    osg::Geometry::ArrayList arrays;
    geometry.getArrayList(arrays);
    for (const auto& array : arrays) {
        into.mix(static_cast<const void*>(array.get()));
        into.mix(std::uint64_t{array->getModifiedCount()});
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

DrawnStates SelfDrawing::statesAlong(const osg::NodePath& path) {
    DrawnStates states;
    const auto add = [&states](const osg::Node& node) {
        if (node.getStateSet()) states.emplace_back(const_cast<osg::StateSet*>(node.getStateSet()));
    };
    for (auto node = path.rbegin(); node != path.rend(); ++node) add(**node);
    for (const osg::Node* node = path.front(); node->getNumParents() > 0;) add(*(node = node->getParent(0)));
    std::reverse(states.begin(), states.end());
    return states;
}

SelfDrawing::SelfDrawing(const osg::NodePath& path, const osg::Drawable& given, const osg::Matrixd& matrix,
                         const Casting& what)
    : drawable(&given),
      groupFromLocal(matrix),
      states(statesAlong(path)),
      images(states),
      name(nameAlong(path)),
      bounds(boxAbout(given.getBoundingBox(), matrix)),
      casting(what),
      hasPiece(hasTriangles(given) && !drawsItself(given)),
      byProgram(PathState(path).isProgrammed()),
      mayChange(changesUnseen(given) || changesUnseen(states)) {
    CasterVisitor::holdSources(given, sources);
    osg::Geometry::ArrayList arrays;
    if (const osg::Geometry* geometry = given.asGeometry()) geometry->getArrayList(arrays);
    sources.insert(sources.end(), arrays.begin(), arrays.end());
    holdStates(states, sources);
}

std::uint64_t SelfDrawing::fingerprintOf(const osg::Drawable& drawable, std::uint64_t placed, std::uint64_t states) {
    Fingerprint result;
    result.mix(placed);
    result.mix(static_cast<const void*>(&drawable));
    result.mix(std::uint64_t{changesUnseen(drawable)});
    if (const osg::Geometry* geometry = drawable.asGeometry()) mixArrays(*geometry, result);
    result.mix(states);
    return result.value();
}

} // namespace gnomon
