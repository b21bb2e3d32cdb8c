// SPDX-License-Identifier: MIT
#include <gnomon/compositor/MaterialHistory.h>
#include <gnomon/compositor/ResolvedState.h>

#include <osg/ContextData>
#include <osg/FrameStamp>
#include <osg/Geometry>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

const osg::Material* materialOf(const osgUtil::StateGraph* graph) {
    return resolved<osg::Material>(graph, A::MATERIAL);
}

/// True if the current colour is its ambient.
bool tracksAmbient(const osg::Material& material) {
    return material.getColorMode() == osg::Material::AMBIENT ||
           material.getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE;
}

osg::Vec4 trackedColor(const osg::Material& material) {
    return material.getColorMode() == osg::Material::AMBIENT ? material.getAmbient(osg::Material::FRONT)
                                                             : material.getDiffuse(osg::Material::FRONT);
}

osg::Vec4 colorNow() {
    osg::Vec4 color;
    glGetFloatv(GL_CURRENT_COLOR, color.ptr());
    return color;
}

/// OpenGL's current colour after a drawable with this material, which has just been drawn; nullopt if nobody knows.
std::optional<osg::Vec4> colorAfter(const osg::Drawable& drawable, const osg::Material& material) {
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry) return colorNow();
    const osg::Array* colors = geometry->getColorArray();
    if (!colors) return trackedColor(material);
    const auto* overall = dynamic_cast<const osg::Vec4Array*>(colors);
    if (!overall || overall->empty() || overall->getBinding() != osg::Array::BIND_OVERALL) return std::nullopt;
    return overall->front();
}

osg::Vec4 ambientNow() {
    osg::Vec4 ambient;
    glGetMaterialfv(GL_FRONT, GL_AMBIENT, ambient.ptr());
    return ambient;
}

/// That which osg::State applies where there is none.
const osg::Material& defaultOf(osg::State& state) {
    if (!state.getGlobalDefaultAttribute(A::MATERIAL)) state.setGlobalDefaultAttribute(new osg::Material);
    return static_cast<const osg::Material&>(*state.getGlobalDefaultAttribute(A::MATERIAL));
}

/// A context's first frame with shadows: nothing has been set by then.
class FirstFrame : public osg::Referenced {
public:
    explicit FirstFrame(unsigned) {}
    bool is(const osg::State& state) {
        const osg::FrameStamp* stamp = state.getFrameStamp();
        const unsigned frame = stamp ? stamp->getFrameNumber() : 0;
        if (!_number) _number = frame;
        return _number == frame;
    }

protected:
    ~FirstFrame() override = default;

private:
    std::optional<unsigned> _number;
};

/// True if the leaf drawn last shows it, but for a context's first frame. Where it cannot show it, Mesa mostly keeps nothing.
bool isKept(const osg::State& state, const osgUtil::RenderLeaf* last) {
    if (osg::get<FirstFrame>(state.getContextID())->is(state)) return false;
    const osg::Material* material = last ? materialOf(last->_parent) : nullptr;
    if (!material || !tracksAmbient(*material)) return false;
    const std::optional<osg::Vec4> color = colorAfter(*last->_drawable, *material);
    return color && ambientNow() != *color;
}

/// As Mesa does whenever it draws: what is set beside is taken over, and forgotten.
void takeOver() {
    glBegin(GL_POINTS);
    glEnd();
    glPushAttrib(GL_POINT_BIT);
    glPopAttrib();
}

} // namespace

MaterialHistory::MaterialHistory(osg::State& state, const std::vector<DrawnLeaf>& leaves,
                                 const osgUtil::RenderLeaf* last)
    : _state(state), _last(last ? last->_parent : nullptr) {
    if (isKept(state, last)) find(leaves);
}

/// Leaves of one graph mostly follow each other.
void MaterialHistory::find(const std::vector<DrawnLeaf>& leaves) {
    const osgUtil::StateGraph* graph = nullptr;
    const osg::Material* first = nullptr;
    bool isFirst = true;
    for (const DrawnLeaf& entry : leaves) {
        if (entry.leaf->_parent == graph) continue;
        const osg::Material* material = materialOf(entry.leaf->_parent);
        if (!graph) first = material;
        graph = entry.leaf->_parent;
        isFirst = isFirst && material == first;
        if (material && tracksAmbient(*material)) _tracking.insert({graph, isFirst});
    }
}

void MaterialHistory::leadTo(const osgUtil::StateGraph& graph) {
    const auto found = _tracking.find(&graph);
    if (found == _tracking.end()) return;
    if (_lead != found->second || _state.getLastAppliedAttribute(A::MATERIAL) != materialOf(&graph))
        lead(found->second);
}

void MaterialHistory::lead(bool byDefault) {
    takeOver();
    if (byDefault)
        defaultOf(_state).apply(_state);
    else
        glDisable(GL_COLOR_MATERIAL);
    _state.haveAppliedAttribute(A::MATERIAL); // or it would not apply the graph's own
    _lead = byDefault;
}

/// After its last leaf osgUtil::RenderStage applies the state above that one's.
void MaterialHistory::restore() {
    const osg::Material* material = _last ? materialOf(_last) : nullptr;
    if (!material) return;
    const auto found = _tracking.find(_last);
    if (found != _tracking.end()) lead(found->second);
    apply(*material);
    const osg::Material* above = materialOf(_last->_parent);
    if (!above || above == material) return;
    takeOver(); // as if the leaf had been drawn
    apply(*above);
}

void MaterialHistory::apply(const osg::Material& material) {
    material.apply(_state);
    _state.haveAppliedAttribute(&material);
}

void MaterialHistory::restoreDefault(osg::State& state) {
    takeOver();
    defaultOf(state).apply(state);
    state.haveAppliedAttribute(&defaultOf(state));
}

} // namespace gnomon
