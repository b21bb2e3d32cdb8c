// SPDX-License-Identifier: MIT
#include <gnomon/CasterMarkers.h>
#include <gnomon/casters/CasterVisitor.h>
#include <gnomon/casters/DrawableContents.h>
#include <gnomon/casters/DrawableTriangles.h>

#include <osg/AutoTransform>
#include <osg/Billboard>
#include <osg/Camera>
#include <osg/ClipNode>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/MatrixTransform>
#include <osg/PositionAttitudeTransform>
#include <osg/PrimitiveSet>
#include <osg/Projection>
#include <osg/Sequence>

#include <algorithm>
#include <cstring>
#include <limits>
#include <typeinfo>

namespace gnomon {
namespace {

/// By name: the kit does not link osgText for this.
bool isText(const osg::Drawable& drawable) {
    return !drawable.asGeometry() && std::strcmp(drawable.libraryName(), "osgText") == 0;
}

/// Nearly every Geode is a plain one: the cast is for the others.
bool neverCasts(const osg::Geode& geode) {
    return typeid(geode) != typeid(osg::Geode) && dynamic_cast<const NeverCasts*>(&geode);
}

/// A group that shows all its children, and does nothing else with them.
bool showsAll(const osg::Node& node) {
    const std::type_info& type = typeid(node);
    if (type == typeid(osg::Group) || type == typeid(osg::MatrixTransform) ||
        type == typeid(osg::PositionAttitudeTransform))
        return true;
    const auto* group = dynamic_cast<const ShowsChildren*>(&node);
    return group && group->showsAllChildren();
}

unsigned usableChildren(const osg::LOD& lod) { return std::min(lod.getNumChildren(), lod.getNumRanges()); }

bool isShownAt(const osg::LOD& lod, unsigned child, float range) {
    return lod.getMinRange(child) <= range && range < lod.getMaxRange(child);
}

/// The range, a distance or a size in pixels, that the most detailed child begins at.
float finestRange(const osg::LOD& lod) {
    const bool byDistance = lod.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT;
    float finest = byDistance ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
    for (unsigned i = 0; i < usableChildren(lod); ++i) {
        const float start = lod.getMinRange(i);
        if (!(start < lod.getMaxRange(i))) continue;
        finest = byDistance ? std::min(finest, start) : std::max(finest, start);
    }
    return finest;
}

osg::Vec3d row(const osg::Matrixd& matrix, int i) { return {matrix(i, 0), matrix(i, 1), matrix(i, 2)}; }

/// Two counts of 32 bits as one word.
std::uint64_t word(unsigned high, unsigned low) { return std::uint64_t{high} << 32 | low; }

void mixGeometry(const osg::Geometry& geometry, Fingerprint& into) {
    for (const osg::Array* array : {verticesOf(geometry), normalArrayOf(geometry)}) {
        into.mix(static_cast<const void*>(array));
        if (!array) continue;
        into.mix(word(array->getModifiedCount(), array->getNumElements()));
        into.mix(std::uint64_t{array->getNormalize()});
    }
    into.mix(std::uint64_t{geometry.getNumPrimitiveSets()});
    for (const auto& primitives : geometry.getPrimitiveSetList()) {
        if (const osg::BufferData* commands = indirectCommands(*primitives)) {
            into.mix(static_cast<const void*>(commands));
            into.mix(word(commands->getModifiedCount(), commands->getTotalDataSize()));
            into.mix(static_cast<const void*>(primitives.get()));
            into.mix(word(primitives->getModifiedCount(), primitives->getMode()));
            continue;
        }
        const bool listed = primitives->getDrawElements() != nullptr; // then a look at the first would touch the list
        const unsigned indices = primitives->getNumIndices();
        into.mix(static_cast<const void*>(primitives.get()));
        into.mix(word(primitives->getModifiedCount(), indices));
        into.mix(word(primitives->getMode(), listed || indices == 0 ? 0 : primitives->index(0)));
    }
}

std::uint64_t valueOf(const osg::Matrixd& matrix) {
    Fingerprint result;
    result.mix(matrix);
    return result.value();
}

} // namespace

/// While a node is on the way down.
class CasterVisitor::OnTheWay {
public:
    OnTheWay(CasterVisitor& visitor, const osg::Node& node)
        : _visitor(visitor),
          _entered(visitor.isRoot(node) ? 1 : 0),
          _exceptions(node.getStateSet() && visitor._judge.mayMatter(*node.getStateSet()) ? 1 : 0),
          _hidden(visitor._view && !(visitor._view->mask & node.getNodeMask()) ? 1 : 0),
          _states(visitor._states.size()) {
        _visitor._inside += _entered;
        _visitor._exceptions += _exceptions;
        _visitor._hidden += _hidden;
        _visitor.enterState(node);
    }
    ~OnTheWay() {
        _visitor._inside -= _entered;
        _visitor._exceptions -= _exceptions;
        _visitor._hidden -= _hidden;
        if (_visitor._states.size() == _states) return;
        _visitor._states.resize(_states);
        _visitor._hiding.reset();
    }
    OnTheWay(const OnTheWay&) = delete;
    OnTheWay& operator=(const OnTheWay&) = delete;

private:
    CasterVisitor& _visitor;
    const int _entered, _exceptions, _hidden;
    const std::size_t _states;
};

/// What is above the first node counts by first parents.
void CasterVisitor::enterState(const osg::Node& node) {
    if (_states.empty()) {
        osg::NodePath above(getNodePath().begin(), getNodePath().end() - 1);
        for (osg::Node* first = getNodePath().front(); first->getNumParents() > 0;)
            above.insert(above.begin(), first = first->getParent(0));
        _states.emplace_back();
        for (const osg::Node* each : above)
            if (each->getStateSet()) _states.back().apply(*each->getStateSet());
    }
    if (!node.getStateSet()) return;
    _states.push_back(_states.back());
    _states.back().apply(*node.getStateSet());
    _hiding.reset();
}

void CasterVisitor::enterPlace(const osg::Matrixd& matrix) {
    _placements.push_back({matrix});
    _hiding.reset();
}

void CasterVisitor::leavePlace() {
    _placements.pop_back();
    _hiding.reset();
}

CasterVisitor::CasterVisitor(const Selection& selection)
    : osg::NodeVisitor(NODE_VISITOR, TRAVERSE_ACTIVE_CHILDREN),
      _selected(selection.roots()),
      _roots(_selected.begin(), _selected.end()) {
    setTraversalMask(selection.mask);
    CasterVisitor::reset();
}

void CasterVisitor::reset() {
    setRootFromVisited(osg::Matrixd::identity());
    _inside = _selected.empty() ? 1 : 0;
    _choice = Fingerprint();
    _judge.reset();
    _front = nullptr;
    _leftOut.clear();
    findWays();
}

std::uint64_t CasterVisitor::placeValue() const {
    const Placement& place = _placements.back();
    if (place.value == 0) place.value = valueOf(place.rootFromLocal);
    return place.value;
}

void CasterVisitor::findWays() {
    if (_selected.empty()) return;
    _ways.clear();
    std::vector<osg::Node*> reached;
    std::set<const osg::Node*> met;
    for (const auto& root : _selected)
        if (met.insert(root.get()).second) reached.push_back(root.get());
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (osg::Group* parent : reached[i]->getParents()) {
            const auto [way, isNew] = _ways.try_emplace(parent);
            way->second.push_back(reached[i]);
            if (isNew && !isRoot(*parent)) reached.push_back(parent);
        }
}

bool CasterVisitor::isOnTheWay(const osg::Node& node) const {
    return _inside > 0 || isRoot(node) || _ways.count(&node) > 0;
}

/// Of a town beside the terrain nothing need be visited to find the terrain.
bool CasterVisitor::goesTheOnlyWays(osg::Node& node) {
    if (_inside > 0 || !showsAll(node)) return false;
    for (osg::Node* child : _ways[&node]) child->accept(*this);
    return true;
}

void CasterVisitor::apply(osg::Node& node) {
    if (!isOnTheWay(node)) return;
    const OnTheWay here(*this, node);
    if (!goesTheOnlyWays(node)) traverse(node);
}

void CasterVisitor::apply(osg::Drawable& drawable) {
    const OnTheWay here(*this, drawable);
    if (_inside == 0 || isText(drawable)) return;
    const bool triangles = hasTriangles(drawable), selfDrawn = drawsItself(drawable);
    if (!triangles && !selfDrawn) return;
    const Casting casting = castingOf(drawable);
    if (!casting.casts) {
        if (_leftOut.empty()) _leftOut = nameAlong(getNodePath());
        return;
    }
    if (_atLevels > 0 || _hidden > 0) _choice.mix(static_cast<const void*>(&drawable));
    if (triangles) applyCaster(drawable, casting);
    if (selfDrawn) applySelfDrawing(drawable, casting);
}

/// Found once for all below one root.
bool CasterVisitor::mayMatterAbove() {
    const osg::Node* front = getNodePath().front();
    if (front == _front) return _exceptionAbove;
    _front = front;
    _exceptionAbove = false;
    for (const osg::Node* above = front; above->getNumParents() > 0 && !_exceptionAbove;) {
        above = above->getParent(0);
        _exceptionAbove = above->getStateSet() && _judge.mayMatter(*above->getStateSet());
    }
    return _exceptionAbove;
}

Casting CasterVisitor::castingOf(const osg::Drawable& drawable) {
    if (_exceptions == 0 && !mayMatterAbove()) return _judge.plain();
    return _judge.of(getNodePath(), drawable, rootFromLocal(), _planes);
}

/// Planes that are given in the eye's frame are the view's: none in their place cuts nothing.
void CasterVisitor::apply(osg::ClipNode& node) {
    const std::size_t before = _planes.size();
    const bool ofEye = node.getReferenceFrame() != osg::ClipNode::RELATIVE_RF;
    if (!ofEye || !_judge.cutsByViews())
        for (const auto& plane : node.getClipPlaneList())
            _planes.emplace_back(plane->getClipPlaneNum(),
                                 ofEye ? osg::Vec4d() : osg::Matrixd::inverse(rootFromLocal()) * plane->getClipPlane());
    apply(static_cast<osg::Node&>(node));
    _planes.resize(before);
}

void CasterVisitor::apply(osg::Geode& geode) {
    if (!neverCasts(geode)) apply(static_cast<osg::Node&>(geode));
}

void CasterVisitor::apply(osg::LOD& lod) {
    if (!isOnTheWay(lod)) return;
    const OnTheWay here(*this, lod);
    ++_atLevels;
    visitLevels(lod);
    --_atLevels;
}

void CasterVisitor::apply(osg::Sequence& sequence) {
    ++_atLevels;
    apply(static_cast<osg::Node&>(sequence));
    --_atLevels;
}

void CasterVisitor::visitLevels(osg::LOD& lod) {
    if (_levels == Levels::All) {
        for (unsigned i = 0; i < lod.getNumChildren(); ++i) lod.getChild(i)->accept(*this);
    } else if (!_view) {
        const float finest = finestRange(lod);
        for (unsigned i = 0; i < usableChildren(lod); ++i)
            if (isShownAt(lod, i, finest)) lod.getChild(i)->accept(*this);
    } else if (lod.getRangeMode() == osg::LOD::PIXEL_SIZE_ON_SCREEN && _view->viewport) {
        enterCullStack(eyeFromHere());
        traverse(lod);
        leaveCullStack();
    } else {
        traverse(lod);
    }
}

void CasterVisitor::enterCullStack(const osg::Matrixd& eyeFromLocal) {
    if (!_cullStack) {
        _cullStack = std::make_unique<osg::CullStack>();
        _cullStack->setLODScale(_view->lodScale);
        _cullStack->pushViewport(_view->viewport);
        _cullStack->pushProjectionMatrix(new osg::RefMatrix(_view->projection));
    }
    _cullStack->pushModelViewMatrix(new osg::RefMatrix(eyeFromLocal), osg::Transform::RELATIVE_RF);
    ++_atPixelLevels;
}

void CasterVisitor::leaveCullStack() {
    --_atPixelLevels;
    _cullStack->popModelViewMatrix();
}

void CasterVisitor::setView(const CasterView& view) {
    _view = view;
    _planes = view.planes;
    _cullStack = nullptr;
}

/// Multiplied in the cull's order, for a view may stand where a level begins.
osg::Matrixd CasterVisitor::eyeFrom(std::size_t end) const {
    osg::Matrixd matrix = _turned.empty() ? _view->eyeFromGroup : _turned.back().second;
    for (std::size_t at = _turned.empty() ? 0 : _turned.back().first; at < end; ++at)
        if (const osg::Transform* transform = getNodePath()[at]->asTransform())
            transform->computeLocalToWorldMatrix(matrix, const_cast<CasterVisitor*>(this)); // which changes nothing
    return matrix;
}

osg::Vec3 CasterVisitor::getEyePoint() const {
    return _view ? osg::Vec3(osg::Matrixd::inverse(eyeFromHere()).getTrans()) : osg::NodeVisitor::getEyePoint();
}

osg::Vec3 CasterVisitor::getViewPoint() const {
    return _view ? _view->viewPoint * osg::Matrixd::inverse(eyeFromHere()) : osg::NodeVisitor::getViewPoint();
}

float CasterVisitor::getDistanceToEyePoint(const osg::Vec3& place, bool useLODScale) const {
    return _view ? (place - getEyePoint()).length() * (useLODScale ? _view->lodScale : 1.0f) : 0.0f;
}

float CasterVisitor::getDistanceToViewPoint(const osg::Vec3& place, bool useLODScale) const {
    return _view ? (place - getViewPoint()).length() * (useLODScale ? _view->lodScale : 1.0f) : 0.0f;
}

float CasterVisitor::getDistanceFromEyePoint(const osg::Vec3& place, bool useLODScale) const {
    if (!_view) return 0.0f;
    const auto depth = static_cast<float>(-(osg::Vec3d(place) * eyeFromHere()).z());
    return useLODScale ? depth * _view->lodScale : depth;
}

void CasterVisitor::apply(osg::Transform& transform) {
    if (transform.getReferenceFrame() != osg::Transform::RELATIVE_RF) return;
    if (osg::AutoTransform* automatic = transform.asAutoTransform()) {
        if (automatic->getAutoScaleToScreen()) return; // a label
        if (automatic->getAutoRotateMode() != osg::AutoTransform::NO_ROTATION) return visitTurning(*automatic);
    }
    osg::Matrixd matrix = rootFromLocal();
    transform.computeLocalToWorldMatrix(matrix, this);
    enterPlace(matrix);
    apply(static_cast<osg::Node&>(transform));
    leavePlace();
}

/// It asks for the view's CullStack, as in the cull.
void CasterVisitor::visitTurning(osg::AutoTransform& transform) {
    if (!_view || !_view->viewport || !isOnTheWay(transform)) return;
    osg::Matrixd eye = eyeFrom(getNodePath().size() - 1), matrix = rootFromLocal();
    enterCullStack(eye);
    transform.computeLocalToWorldMatrix(matrix, this);
    transform.computeLocalToWorldMatrix(eye, this);
    leaveCullStack();
    _choice.mix(_view->key); // another view turns it otherwise
    enterPlace(matrix);
    _turned.emplace_back(getNodePath().size(), eye);
    apply(static_cast<osg::Node&>(transform));
    _turned.pop_back();
    leavePlace();
}

/// Each of its drawables turns by itself.
void CasterVisitor::apply(osg::Billboard& billboard) {
    if (!_view || !isOnTheWay(billboard)) return;
    const OnTheWay here(*this, billboard);
    const osg::Matrixd eye = eyeFromHere(), localFromEye = osg::Matrixd::inverse(eye);
    _choice.mix(_view->key);
    for (unsigned i = 0; i < std::min<std::size_t>(billboard.getNumDrawables(), billboard.getPositionList().size());
         ++i) {
        osg::Matrixd turned = eye;
        billboard.computeMatrix(turned, localFromEye.getTrans(), billboard.getPosition(i));
        enterPlace(turned * localFromEye * rootFromLocal());
        billboard.getDrawable(i)->accept(*this);
        leavePlace();
    }
}

Hiding CasterVisitor::hiding() const {
    if (_hidden > 0) return Hiding::Neither;
    if (!_hiding) _hiding = _states.back().hiding(mirrors(rootFromLocal()));
    return *_hiding;
}

void CasterVisitor::holdSources(const osg::Drawable& drawable,
                                std::vector<osg::ref_ptr<const osg::Referenced>>& sources) {
    if (const osg::Geometry* geometry = drawable.asGeometry()) {
        sources.emplace_back(verticesOf(*geometry));
        if (const osg::Array* normals = normalArrayOf(*geometry)) sources.emplace_back(normals);
        for (const auto& primitives : geometry->getPrimitiveSetList()) {
            sources.emplace_back(primitives);
            if (const osg::BufferData* commands = indirectCommands(*primitives)) sources.emplace_back(commands);
        }
    } else {
        sources.emplace_back(&drawable);
    }
}

bool mirrors(const osg::Matrixd& matrix) { return (row(matrix, 0) ^ row(matrix, 1)) * row(matrix, 2) < 0.0; }

std::string nameAlong(const osg::NodePath& path) {
    const auto named =
        std::find_if(path.rbegin(), path.rend(), [](const osg::Node* node) { return !node->getName().empty(); });
    return named != path.rend() ? (*named)->getName() : path.back()->className();
}

CasterFingerprint::CasterFingerprint(const Selection& selection) : CasterVisitor(selection) {}

void CasterFingerprint::reset() {
    CasterVisitor::reset();
    _fingerprint = Fingerprint();
}

std::uint64_t CasterFingerprint::of(const osg::Drawable& drawable, const osg::Matrixd& rootFromLocal,
                                    const Casting& casting) {
    const bool isRead = followsOf(drawable) == Follows::Each;
    return placed(ofGeometry(drawable, casting, isRead ? contentsOf(drawable, casting.looksAtAll()) : 0),
                  valueOf(rootFromLocal));
}

std::uint64_t CasterFingerprint::ofGeometry(const osg::Drawable& drawable, const Casting& casting,
                                            std::uint64_t contents) {
    Fingerprint result;
    result.mix(std::uint64_t{cutsQuadsFromFirst()});
    result.mix(contents);
    result.mix(drawable.getBoundingBox());
    if (const osg::Geometry* geometry = drawable.asGeometry())
        mixGeometry(*geometry, result);
    else
        result.mix(static_cast<const void*>(&drawable));
    casting.mix(drawable, result);
    return result.value();
}

std::uint64_t CasterFingerprint::placed(std::uint64_t geometry, std::uint64_t place) {
    Fingerprint result;
    result.mix(place);
    result.mix(geometry);
    return result.value();
}

} // namespace gnomon
