// SPDX-License-Identifier: MIT
#include <gnomon/base/ProgramText.h>
#include <gnomon/casters/Casting.h>
#include <gnomon/casters/DrawnState.h>

#include <osg/AlphaFunc>
#include <osg/BlendColor>
#include <osg/BlendFunc>
#include <osg/ClipPlane>
#include <osg/ColorMask>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/FrontFace>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/Material>
#include <osg/PolygonMode>
#include <osg/PolygonStipple>
#include <osg/PrimitiveRestartIndex>
#include <osg/Scissor>
#include <osg/Stencil>
#include <osg/TexEnv>
#include <osg/TexMat>

#include <algorithm>
#include <bitset>
#include <cmath>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

constexpr GLenum fixedRestart = 0x8D69; // GL_PRIMITIVE_RESTART_FIXED_INDEX
constexpr unsigned clipPlanes = 8;
constexpr int transparentBin = 10;
constexpr int firstLate = 8;    // the ShadowBin's number
constexpr int leastShown = 512; // of 1024 bits of a stipple

bool isRestart(GLenum mode) { return mode == GL_PRIMITIVE_RESTART || mode == fixedRestart; }

bool removes(GLenum mode) {
    return mode == GL_ALPHA_TEST || mode == GL_BLEND || mode == GL_POLYGON_STIPPLE ||
           (mode >= GL_CLIP_PLANE0 && mode < GL_CLIP_PLANE0 + clipPlanes);
}

bool isEmpty(const osg::Scissor& box) { return box.width() <= 0 || box.height() <= 0; }

bool isAllMasked(const osg::ColorMask& mask) {
    return !(mask.getRedMask() || mask.getGreenMask() || mask.getBlueMask() || mask.getAlphaMask());
}

bool isFar(const osg::Depth& depth) { return depth.getZNear() >= 1.0 && depth.getZFar() >= 1.0; }

bool isFilled(const osg::PolygonMode* mode, osg::PolygonMode::Face face) {
    return !mode || mode->getMode(face) == osg::PolygonMode::FILL;
}

/// True if an attribute may take anything away. For programs see CastingJudge.
bool removes(const A& attribute) {
    switch (attribute.getType()) {
    case A::DEPTH: {
        const auto* depth = dynamic_cast<const osg::Depth*>(&attribute);
        return depth && (isFar(*depth) || depth->getFunction() == osg::Depth::NEVER);
    }
    case A::COLORMASK: {
        const auto* mask = dynamic_cast<const osg::ColorMask*>(&attribute);
        return mask && isAllMasked(*mask);
    }
    case A::CULLFACE: {
        const auto* cull = dynamic_cast<const osg::CullFace*>(&attribute);
        return cull && cull->getMode() == osg::CullFace::FRONT_AND_BACK;
    }
    case A::POLYGONMODE: {
        const auto* mode = dynamic_cast<const osg::PolygonMode*>(&attribute);
        return !isFilled(mode, osg::PolygonMode::FRONT) || !isFilled(mode, osg::PolygonMode::BACK);
    }
    case A::STENCIL: {
        const auto* stencil = dynamic_cast<const osg::Stencil*>(&attribute);
        return stencil && stencil->getFunction() == osg::Stencil::NEVER;
    }
    case A::SCISSOR: {
        const auto* box = dynamic_cast<const osg::Scissor*>(&attribute);
        return box && isEmpty(*box);
    }
    default:
        return mayApplyProgram(attribute);
    }
}

/// True if neither side of a triangle is drawn and filled.
bool isNoFaceFilled(const PathState& state) {
    const auto* cull = state.attribute<osg::CullFace>(A::CULLFACE);
    const auto culled = !state.isOn(GL_CULL_FACE) ? GLenum(0) : cull ? cull->getMode() : GLenum(GL_BACK);
    const auto* mode = state.attribute<osg::PolygonMode>(A::POLYGONMODE);
    const auto isShown = [&](GLenum side, osg::PolygonMode::Face face) {
        return culled != side && culled != GL_FRONT_AND_BACK && isFilled(mode, face);
    };
    return !isShown(GL_FRONT, osg::PolygonMode::FRONT) && !isShown(GL_BACK, osg::PolygonMode::BACK);
}

bool isMostlyStippled(const PathState& state) {
    const auto* stipple = state.attribute<osg::PolygonStipple>(A::POLYGONSTIPPLE);
    if (!stipple || !state.isOn(GL_POLYGON_STIPPLE)) return false;
    std::size_t shown = 0;
    for (int i = 0; i < 128; ++i) shown += std::bitset<8>(stipple->getMask()[i]).count();
    return shown < leastShown;
}

bool isMaskedAway(const PathState& state) {
    const auto* colors = state.attribute<osg::ColorMask>(A::COLORMASK);
    const auto* depth = state.attribute<osg::Depth>(A::DEPTH);
    return colors && isAllMasked(*colors) && ((depth && !depth->getWriteMask()) || !state.isOn(GL_DEPTH_TEST, true));
}

bool isNothingDrawn(const PathState& state) {
    const auto* depth = state.attribute<osg::Depth>(A::DEPTH);
    const auto* scissor = state.attribute<osg::Scissor>(A::SCISSOR);
    const auto* stencil = state.attribute<osg::Stencil>(A::STENCIL);
    return (depth && isFar(*depth)) ||
           (depth && depth->getFunction() == osg::Depth::NEVER && state.isOn(GL_DEPTH_TEST, true)) ||
           (scissor && isEmpty(*scissor) && state.isOn(GL_SCISSOR_TEST)) ||
           (stencil && stencil->getFunction() == osg::Stencil::NEVER && state.isOn(GL_STENCIL_TEST)) ||
           isNoFaceFilled(state) || isMostlyStippled(state) || isMaskedAway(state);
}

/// False of textures whose alpha is 1, whatever their image.
bool hasAlpha(const osg::Texture& texture) {
    constexpr GLenum without[] = {GL_LUMINANCE, GL_RED, GL_RG, GL_RGB8, GL_LUMINANCE8};
    const osg::Image* image = texture.getImage(0);
    const auto format = image ? image->getPixelFormat() : GLenum(texture.getInternalFormat());
    if (format == 0) return true; // nobody knows yet
    return osg::Image::computeNumComponents(format) != 3 &&
           std::find(std::begin(without), std::end(without), format) == std::end(without);
}

/// How a texture unit changes alpha.
enum class Effect { None, Multiplies, Replaces, Unknown };

Effect effectOf(const PathState& state, unsigned unit) {
    constexpr GLenum kinds[] = {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_3D, GL_TEXTURE_RECTANGLE, GL_TEXTURE_2D, GL_TEXTURE_1D};
    const auto kind =
        std::find_if(std::begin(kinds), std::end(kinds), [&](GLenum each) { return state.isTextureOn(unit, each); });
    const auto* texture = dynamic_cast<const osg::Texture*>(state.textureAttribute(A::TEXTURE, unit));
    if (kind == std::end(kinds) || !texture || holdsNothing(*texture) || !hasAlpha(*texture)) return Effect::None;
    const osg::StateAttribute* attribute = state.textureAttribute(A::TEXENV, unit);
    const auto* environment = dynamic_cast<const osg::TexEnv*>(attribute);
    if (environment && environment->getMode() == osg::TexEnv::DECAL) return Effect::None;
    const bool generated = state.isTextureOn(unit, GL_TEXTURE_GEN_S) || state.isTextureOn(unit, GL_TEXTURE_GEN_T);
    if (unit > 0 || *kind != GL_TEXTURE_2D || generated || (attribute && !environment)) return Effect::Unknown;
    return environment && environment->getMode() == osg::TexEnv::REPLACE ? Effect::Replaces : Effect::Multiplies;
}

bool takesVertexColor(const osg::Material& material) {
    return material.getColorMode() == osg::Material::DIFFUSE ||
           material.getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE;
}

} // namespace

struct CastingJudge::Resolved {
    bool nothing = false;        ///< is drawn, or hides anything.
    bool discards = false;       ///< a program.
    bool byPixel = false;        ///< the same, by gl_FragCoord, or under a projection of its own.
    bool moves = false;          ///< a program, which maps let draw what it moves.
    bool makesTriangles = false; ///< such a program, of points, too.
    bool blends = false;         ///< by alpha.
    bool programmed = false;     ///< alpha comes from a program.
    bool late = false;           ///< drawn with what is transparent.
    bool unknown = false;        ///< alpha is nothing that could be read.
    bool replaces = false;       ///< the texture's alpha is that of all.
    unsigned clipModes = 0;      ///< a bit each.
    std::optional<unsigned> restart;
    std::optional<std::pair<int, float>> test; ///< which alphas pass, and the reference.
    std::optional<float> material;             ///< alpha, if it is not that of colours.
    osg::ref_ptr<osg::Texture2D> texture;      ///< whose alpha counts.
    osg::Matrixd textureMatrix;
    std::vector<osg::ref_ptr<const osg::ClipPlane>> planes; ///< of state sets.

    Resolved(const PathState& state, const CastingRule& rule);

private:
    void findBlend(const PathState& state, const CastingRule& rule);
    void findAlpha(const PathState& state);
    void findClips(const PathState& state, const CastingRule& rule);
};

CastingJudge::Resolved::Resolved(const PathState& state, const CastingRule& rule) {
    nothing = isNothingDrawn(state);
    if (rule.opaqueFrom > 0.0f && state.isOn(GL_BLEND)) findBlend(state, rule);
    const auto* function = state.attribute<osg::AlphaFunc>(A::ALPHAFUNC);
    if (function && state.isOn(GL_ALPHA_TEST) && function->getFunction() != osg::AlphaFunc::ALWAYS)
        test = {function->getFunction() - osg::AlphaFunc::NEVER, // whose order this is
                std::clamp(function->getReferenceValue(), 0.0f, 1.0f)};
    if (blends || test) findAlpha(state);
    findClips(state, rule);
    late = state.bin() >= transparentBin;
}

/// What share of the colours behind it is hidden.
void CastingJudge::Resolved::findBlend(const PathState& state, const CastingRule& rule) {
    const auto* function = state.attribute<osg::BlendFunc>(A::BLENDFUNC);
    switch (function ? function->getDestination() : GLenum(osg::BlendFunc::ONE_MINUS_SRC_ALPHA)) {
    case osg::BlendFunc::ONE:
        nothing = true;
        break;
    case osg::BlendFunc::ONE_MINUS_SRC_ALPHA:
        blends = true;
        break;
    case osg::BlendFunc::ONE_MINUS_CONSTANT_ALPHA: {
        const auto* color = state.attribute<osg::BlendColor>(A::BLENDCOLOR);
        nothing = nothing || !color || color->getConstantColor().a() < rule.evenFrom;
        break;
    }
    default:
        break;
    }
}

void CastingJudge::Resolved::findAlpha(const PathState& state) {
    programmed = state.isProgrammed();
    if (programmed) return;
    const auto* lit = state.isOn(GL_LIGHTING, true) ? state.attribute<osg::Material>(A::MATERIAL) : nullptr;
    if (lit && !takesVertexColor(*lit)) material = lit->getDiffuse(osg::Material::FRONT).a();
    for (unsigned unit = 0; unit < state.units(); ++unit) {
        const Effect effect = effectOf(state, unit);
        unknown = unknown || effect == Effect::Unknown;
        if (effect != Effect::Multiplies && effect != Effect::Replaces) continue;
        replaces = effect == Effect::Replaces;
        texture = dynamic_cast<osg::Texture2D*>(state.textureAttribute(A::TEXTURE));
        unknown = unknown || !texture || changesUnseen(*texture);
        const auto* matrix = dynamic_cast<const osg::TexMat*>(state.textureAttribute(A::TEXMAT));
        if (matrix) textureMatrix = matrix->getMatrix();
    }
}

void CastingJudge::Resolved::findClips(const PathState& all, const CastingRule& rule) {
    if (rule.clips == CastingRule::None) return;
    const PathState state = rule.clips == CastingRule::All ? all : all.ofMainGraph();
    for (unsigned number = 0; number < clipPlanes; ++number) {
        if (!state.isOn(GL_CLIP_PLANE0 + number)) continue;
        clipModes |= 1u << number;
        if (const auto* plane = state.attribute<osg::ClipPlane>(A::CLIPPLANE, number)) planes.emplace_back(plane);
    }
}

void CastingJudge::reset() {
    _programs.clear();
    _resolved = nullptr;
}

const ProgramPlaces& CastingJudge::placesIn(const osg::Program& program) {
    const auto [known, isNew] = _programs.try_emplace(&program);
    if (isNew) known->second = placesOf(program, _rule ? _rule->matrices : std::vector<MatrixUniform>());
    return known->second;
}

bool CastingJudge::mayMatter(const osg::StateSet& set) {
    for (const auto& [mode, value] : set.getModeList())
        if ((value & A::ON) && (isRestart(mode) || (_rule && removes(mode)))) return true;
    if (!_rule) return false;
    for (const auto& [type, attribute] : set.getAttributeList()) {
        const auto* program =
            type.first == A::PROGRAM ? dynamic_cast<const osg::Program*>(attribute.first.get()) : nullptr;
        if (!program && removes(*attribute.first)) return true;
        if (program && (placesIn(*program).discards || placesIn(*program).castsWhereItMoves())) return true;
    }
    return false;
}

const CastingJudge::Resolved& CastingJudge::resolved(const PathState& state) {
    if (_resolved && _sets == state.sets()) return *_resolved;
    _sets = state.sets();
    const auto now = std::make_shared<Resolved>(state, _rule.value_or(CastingRule()));
    const osg::Program* program = state.program();
    const ProgramPlaces places = program ? placesIn(*program) : ProgramPlaces();
    now->discards = places.discards || state.hasUnseenProgram();
    now->byPixel = places.discardsByPixel || (places.discards && !places.takesProjection);
    now->moves = places.castsWhereItMoves();
    now->makesTriangles = now->moves && places.makesTriangles;
    if (state.isOn(fixedRestart))
        now->restart = ~0u;
    else if (state.isOn(GL_PRIMITIVE_RESTART)) {
        const auto* index = state.attribute<osg::PrimitiveRestartIndex>(A::PRIMITIVERESTARTINDEX);
        now->restart = index ? index->getRestartIndex() : 0u;
    }
    _resolved = now;
    return *now;
}

namespace {

/// The alpha that a drawable's colours give: of all of it, or a vertex each.
struct ColorAlpha {
    float all = 1.0f;
    bool byVertex = false, unknown = false;
};

ColorAlpha colorAlpha(const osg::Drawable& drawable) {
    const osg::Geometry* geometry = drawable.asGeometry();
    const osg::Array* colors = geometry ? geometry->getColorArray() : nullptr;
    ColorAlpha result;
    if (!colors || colors->getNumElements() == 0 || colors->getDataSize() == 3 ||
        colors->getBinding() == osg::Array::BIND_OFF || colors->getBinding() == osg::Array::BIND_UNDEFINED)
        return result;
    if (colors->getBinding() == osg::Array::BIND_OVERALL || colors->getNumElements() == 1) {
        const std::vector<float> alphas = vertexAlphas(drawable);
        result.unknown = alphas.empty();
        if (!result.unknown) result.all = alphas.front();
        return result;
    }
    result.byVertex = colors->getBinding() == osg::Array::BIND_PER_VERTEX;
    result.unknown = !result.byVertex;
    return result;
}

/// Where a plane leaves a drawable.
enum class Side { Kept, Cut, Gone };

Side sideOf(const osg::Drawable& drawable, const osg::Vec4d& plane) {
    const osg::BoundingBox& box = drawable.getBoundingBox();
    if (!box.valid()) return Side::Cut;
    double middle = plane.w(), reach = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        middle += plane[axis] * 0.5 * (double{box._min[axis]} + double{box._max[axis]});
        reach += std::abs(plane[axis]) * 0.5 * (double{box._max[axis]} - double{box._min[axis]});
    }
    return middle + reach < 0.0 ? Side::Gone : middle - reach < 0.0 ? Side::Cut : Side::Kept;
}

/// As a transform's inverse takes places, so it takes planes.
osg::Vec4d placedPlane(const osg::Matrixd& inverse, const osg::Vec4d& plane) { return inverse * plane; }

} // namespace

Casting CastingJudge::plain() const {
    Casting result;
    result.offsetsTerminator = _rule && _rule->offsetsTerminator;
    return result;
}

Casting CastingJudge::of(const osg::NodePath& path, const osg::Drawable& drawable, const osg::Matrixd& rootFromLocal,
                         const std::vector<NumberedPlane>& planes) {
    const PathState state(path);
    const Resolved& found = resolved(state);
    Casting result = plain();
    result.restart = found.restart;
    if (!_rule) return result;
    result.casts = !found.nothing;
    for (unsigned number = 0; number < clipPlanes && result.casts; ++number) {
        if (!(found.clipModes & 1u << number)) continue;
        osg::Vec4d inRoot;
        const auto isIt = [number](const auto& plane) { return plane.first == number; };
        const auto own = std::find_if(found.planes.begin(), found.planes.end(),
                                      [number](const auto& plane) { return plane->getClipPlaneNum() == number; });
        const auto placed = std::find_if(planes.rbegin(), planes.rend(), isIt);
        if (own != found.planes.end())
            inRoot = placedPlane(osg::Matrixd::inverse(rootFromLocal), (*own)->getClipPlane());
        else if (placed != planes.rend())
            inRoot = placed->second;
        const Side side = sideOf(drawable, placedPlane(rootFromLocal, inRoot));
        if (side == Side::Cut) result.clips.emplace_back(number, inRoot);
        if (side == Side::Gone) result.casts = false;
    }
    if (!result.casts) return result;
    result.byPixel = found.byPixel;
    if (result.byPixel) return result;
    result.selfDrawn = found.discards || found.moves;
    result.moved = found.moves && !found.discards;
    result.makesTriangles = found.makesTriangles;
    const bool counts =
        found.test || (found.blends && (!found.programmed || found.late)); // a program's alpha may be any
    if (!counts) return result;
    if (!found.test) result.opaqueFrom = _rule->opaqueFrom;
    const ColorAlpha colors =
        found.material ? ColorAlpha{std::clamp(*found.material, 0.0f, 1.0f)} : colorAlpha(drawable);
    if (found.programmed || found.unknown || found.discards || colors.unknown ||
        (found.texture && !AlphaTest::hasCoordinates(drawable))) {
        result.selfDrawn = true;
        result.moved = false;
        return result;
    }
    AlphaTest test;
    test.passing = found.test ? found.test->first : 6;
    test.reference = found.test ? found.test->second : _rule->opaqueFrom;
    test.evenFrom = found.blends ? _rule->evenFrom : 0.0f;
    if (!found.replaces) {
        test.surfaceFrom = found.blends ? _rule->opaqueFrom : 0.0f;
        test.surface = colors.all;
        test.byVertex = colors.byVertex;
    }
    if (test.byVertex || test.surface > 0.0f) test.texture = found.texture;
    if (test.texture) test.matrix = found.textureMatrix;
    if (test.texture || test.byVertex)
        result.test = test;
    else
        result.casts = ClearParts(test, drawable).of(0, 0, 0) != ClearParts::Clear;
    return result;
}

void Casting::mix(const osg::Drawable& drawable, Fingerprint& into) const {
    if (restart) into.mix(std::uint64_t{*restart} << 1 | 1);
    if (byPixel) into.mix(double{-1.0});
    if (offsetsTerminator) into.mix(double{-2.0});
    if (selfDrawn) into.mix(double{1.0f + opaqueFrom});
    if (moved) into.mix(double{-3.0});
    for (const auto& [number, plane] : clips) {
        into.mix(std::uint64_t{number});
        for (int i = 0; i < 4; ++i) into.mix(plane[i]);
    }
    if (test) test->mix(drawable, into);
}

void Casting::hold(const osg::Drawable& drawable, std::vector<osg::ref_ptr<const osg::Referenced>>& sources) const {
    if (test) test->hold(drawable, sources);
}

namespace {

template <class Class>
const Class* as(const osg::StateSet::RefAttributePair* pair) {
    return pair ? static_cast<const Class*>(pair->first.get()) : nullptr;
}

bool isPlain(const osg::Depth& depth) {
    return depth.getWriteMask() &&
           (depth.getFunction() == osg::Depth::LESS || depth.getFunction() == osg::Depth::LEQUAL);
}

} // namespace

void HidingState::apply(const osg::StateSet& set) {
    for (const auto& [mode, given] : set.getModeList()) {
        Value* now = mode == GL_BLEND                                   ? &_blend
                     : mode == GL_ALPHA_TEST                            ? &_alphaTest
                     : mode == GL_CULL_FACE                             ? &_cull
                     : mode == GL_POLYGON_STIPPLE                       ? &_stipple
                     : mode == GL_DEPTH_TEST                            ? &_depthTest
                     : mode >= GL_CLIP_PLANE0 && mode <= GL_CLIP_PLANE5 ? &_clip[mode - GL_CLIP_PLANE0]
                                                                        : nullptr;
        if (now && !(given & A::INHERIT) && (!(*now & A::OVERRIDE) || (given & A::PROTECTED))) *now = given;
    }
    for (const auto& [type, given] : set.getAttributeList()) {
        const Attribute** now = type.first == A::CULLFACE      ? &_face
                                : type.first == A::FRONTFACE   ? &_front
                                : type.first == A::POLYGONMODE ? &_polygons
                                : type.first == A::DEPTH       ? &_depth
                                : type.first == A::PROGRAM     ? &_program
                                                               : nullptr;
        _unseen = _unseen || mayApplyProgram(*given.first);
        if (!now || (*now && ((*now)->second & A::OVERRIDE) && !(given.second & A::PROTECTED))) continue;
        *now = &given;
        if (now != &_program) continue;
        const auto* program = dynamic_cast<const osg::Program*>(given.first.get());
        _discards = program && mayDiscard(*program);
    }
    if (set.useRenderBinDetails()) _late = set.getBinNumber() >= firstLate;
}

Hiding HidingState::hiding(bool mirrored) const {
    const auto* depth = as<osg::Depth>(_depth);
    const auto* polygons = as<osg::PolygonMode>(_polygons);
    const auto isOn = [](Value value) { return (value & A::ON) != 0; };
    const bool solid = !(_late && isOn(_blend)) && !isOn(_alphaTest) && !isOn(_stipple) && isOn(_depthTest) &&
                       std::none_of(std::begin(_clip), std::end(_clip), isOn) && (!depth || isPlain(*depth)) &&
                       isFilled(polygons, osg::PolygonMode::FRONT) && isFilled(polygons, osg::PolygonMode::BACK) &&
                       !_discards && !_unseen;
    if (!solid) return Hiding::Neither;
    if (!isOn(_cull)) return Hiding::Both;
    const auto* face = as<osg::CullFace>(_face);
    const auto* front = as<osg::FrontFace>(_front);
    const bool backs = !face || face->getMode() == osg::CullFace::BACK;
    const bool counterclockwise = !front || front->getMode() == osg::FrontFace::COUNTER_CLOCKWISE;
    return backs && counterclockwise && !mirrored ? Hiding::Fronts : Hiding::Neither;
}

} // namespace gnomon
