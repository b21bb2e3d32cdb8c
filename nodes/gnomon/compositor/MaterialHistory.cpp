// SPDX-License-Identifier: MIT
#include <gnomon/compositor/MaterialHistory.h>
#include <gnomon/compositor/ResolvedState.h>

#include <osg/Geometry>
#include <osg/Program>

#include <limits>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

constexpr int last = std::numeric_limits<int>::max(); ///< below it are all bins.

const osg::Material* appliedTo(const osg::State& state) {
    return static_cast<const osg::Material*>(state.getLastAppliedAttribute(A::MATERIAL));
}

const osg::Material* materialOf(const osgUtil::StateGraph* graph) {
    return resolved<osg::Material>(graph, A::MATERIAL);
}

/// True if the current colour is its ambient.
bool tracksAmbient(const osg::Material& material) {
    return material.getColorMode() == osg::Material::AMBIENT ||
           material.getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE;
}

/// The current colour that it sets, as osg::Material::apply() has it.
osg::Vec4 colorBy(const osg::Material& material) {
    switch (material.getColorMode()) {
    case osg::Material::AMBIENT:
        return material.getAmbient(osg::Material::FRONT);
    case osg::Material::SPECULAR:
        return material.getSpecular(osg::Material::FRONT);
    case osg::Material::EMISSION:
        return material.getEmission(osg::Material::FRONT);
    default:
        return material.getDiffuse(osg::Material::FRONT);
    }
}

/// What a drawable does to the current colour.
struct ColorUse {
    bool reads = false;            ///< it may be drawn in the colour that stands.
    bool isKnown = true;           ///< `sets` is all that it does.
    std::optional<osg::Vec4> sets; ///< the colour that it leaves.
};

ColorUse colorUseOf(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    if (!geometry) return {true, false, {}};
    const osg::Array* colors = geometry->getColorArray();
    if (!colors || colors->getNumElements() == 0) return {true, true, {}};
    if (colors->getBinding() == osg::Array::BIND_PER_VERTEX) return {false, true, {}};
    if (colors->getBinding() != osg::Array::BIND_OVERALL) return {false, false, {}};
    if (const auto* four = dynamic_cast<const osg::Vec4Array*>(colors)) return {false, true, four->front()};
    if (const auto* three = dynamic_cast<const osg::Vec3Array*>(colors))
        return {false, true, osg::Vec4(three->front(), 1.0f)};
    const auto* bytes = dynamic_cast<const osg::Vec4ubArray*>(colors);
    if (!bytes) return {false, false, {}};
    const osg::Vec4ub& byte = bytes->front();
    return {false, true, osg::Vec4(byte.r(), byte.g(), byte.b(), byte.a()) / 255.0f};
}

/// True if what osg::State's default material sets beside stands until the next frame: not if RenderStage has applied a
/// material that tracks the colour after the last leaf, with nothing drawn by it.
bool standsAfter(const std::vector<DrawnLeaf>& leaves) {
    if (leaves.empty()) return true;
    const osgUtil::StateGraph* graph = leaves.back().leaf->_parent;
    const osg::Material* above = materialOf(graph->_parent);
    return !above || above == materialOf(graph) || above->getColorMode() == osg::Material::OFF;
}

/// As Mesa does whenever it draws: what is set beside is taken over, and forgotten. A program of tessellation draws no
/// points, so none is bound meanwhile.
void takeOver(const osg::State& state) {
    const osg::Program::PerContextProgram* program = state.getLastAppliedProgramObject();
    const osg::GLExtensions* gl = state.get<osg::GLExtensions>();
    if (program) gl->glUseProgram(0);
    glBegin(GL_POINTS);
    glEnd();
    if (program) gl->glUseProgram(program->getHandle());
    glPushAttrib(GL_POINT_BIT);
    glPopAttrib();
}

} // namespace

MaterialHistory::MaterialHistory(osg::State& state, osgUtil::RenderStage& stage, bool followsDefault)
    : _state(state), _stage(stage), _followsDefault(followsDefault), _material(appliedTo(state)) {
    glGetFloatv(GL_CURRENT_COLOR, _now.color.ptr());
    if (!_material || !tracksAmbient(*_material)) return;
    osg::Vec4 ambient;
    glGetMaterialfv(GL_FRONT, GL_AMBIENT, ambient.ptr());
    _now.byDefault = ambient != _now.color;
}

bool MaterialHistory::isDefault(osg::State& state) {
    const osg::Material* applied = appliedTo(state);
    return applied && applied == state.getGlobalDefaultAttribute(A::MATERIAL);
}

/// Goes through all leaves, as they are drawn.
void MaterialHistory::find() {
    _found.emplace();
    const std::vector<DrawnLeaf> leaves = leavesBelow(_stage, last);
    const bool byDefault = _followsDefault && standsAfter(leaves);
    const osgUtil::StateGraph* graph = nullptr;
    const osg::Material* material = nullptr;
    std::optional<Found> now;
    for (const DrawnLeaf& entry : leaves) {
        const osg::Material* before = material;
        if (entry.leaf->_parent != graph) material = materialOf(entry.leaf->_parent);
        if (material && (material != before || !graph)) now = Found{!graph && byDefault, colorBy(*material)};
        graph = entry.leaf->_parent;
        const ColorUse use = colorUseOf(*entry.leaf->_drawable);
        if (use.sets && (!now || *use.sets != now->color)) now = Found{false, *use.sets};
        if (now) _found->insert({entry.leaf, *now});
        if (!use.isKnown) now.reset();
    }
}

void MaterialHistory::leadTo(const osgUtil::RenderLeaf& leaf) {
    const osg::Material* material = appliedTo(_state);
    if (!material || !tracksAmbient(*material)) return;
    const ColorUse use = colorUseOf(*leaf._drawable);
    if (!use.reads && use.sets != colorBy(*material)) return;
    if (!_found) find();
    const auto found = _found->find(&leaf);
    if (found != _found->end()) lead(*material, found->second);
}

void MaterialHistory::lead(const osg::Material& material, const Found& found) {
    takeOver(_state);
    const osg::StateAttribute* byDefault = _state.getGlobalDefaultAttribute(A::MATERIAL);
    if (found.byDefault && byDefault)
        byDefault->apply(_state);
    else
        glDisable(GL_COLOR_MATERIAL);
    material.apply(_state);
    glColor4fv(found.color.ptr());
}

void MaterialHistory::restore() {
    if (!_material) {
        glColor4fv(_now.color.ptr());
        return _state.haveAppliedAttribute(A::MATERIAL);
    }
    lead(*_material, _now);
    _state.haveAppliedAttribute(_material);
    if (!isDefault(_state) || !standsAfter(leavesBelow(_stage, last))) takeOver(_state);
}

} // namespace gnomon
