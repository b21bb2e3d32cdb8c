// SPDX-License-Identifier: MIT
#include <gnomon/compositor/KeptByStage.h>
#include <gnomon/compositor/LateReceivers.h>
#include <gnomon/compositor/ResolvedState.h>

#include <osg/BlendEquation>
#include <osg/BlendFunc>
#include <osg/Geometry>
#include <osg/Image>
#include <osg/LogicOp>
#include <osg/Material>
#include <osg/TexEnv>
#include <osg/Texture>
#include <osg/observer_ptr>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <unordered_map>

namespace gnomon {
namespace {

using A = osg::StateAttribute;

/// An alpha of this or more is drawn as 1 by a framebuffer of eight bits.
constexpr float opaqueAlpha = 1.0f - 0.5f / 255.0f;

/// True if an alpha of 1 hides what is behind.
bool alphaHides(const osgUtil::StateGraph* graph) {
    const auto* equation = resolved<osg::BlendEquation>(graph, A::BLENDEQUATION);
    if (equation && equation->getEquationRGB() != osg::BlendEquation::FUNC_ADD) return false;
    const auto* function = resolved<osg::BlendFunc>(graph, A::BLENDFUNC);
    if (!function) return true; // OSG's default
    const GLenum source = function->getSource(), destination = function->getDestination();
    return (source == GL_SRC_ALPHA || source == GL_ONE) &&
           (destination == GL_ONE_MINUS_SRC_ALPHA || destination == GL_ZERO);
}

/// True if a logic operation, which takes the place of blending, hides what is behind.
bool operationHides(const osgUtil::StateGraph* graph) {
    const auto* operation = resolved<osg::LogicOp>(graph, A::LOGICOP);
    if (!operation) return true; // OSG's default, COPY
    const osg::LogicOp::Opcode code = operation->getOpcode();
    return code == osg::LogicOp::COPY || code == osg::LogicOp::COPY_INVERTED || code == osg::LogicOp::CLEAR ||
           code == osg::LogicOp::SET;
}

/// Texture units that any state set speaks of.
unsigned textureUnits(const osgUtil::StateGraph* graph) {
    std::size_t units = 0;
    for (; graph; graph = graph->_parent)
        if (graph->getStateSet()) units = std::max(units, graph->getStateSet()->getTextureAttributeList().size());
    return static_cast<unsigned>(units);
}

/// The texture that fixed function reads in a unit; null: none.
const osg::Texture* textureIn(const osgUtil::StateGraph* graph, unsigned unit) {
    const auto* texture = dynamic_cast<const osg::Texture*>(resolvedTextureAttribute(graph, unit, A::TEXTURE));
    return texture && isTextureModeOn(graph, unit, texture->getTextureTarget()) ? texture : nullptr;
}

/// The least and the largest alpha of something.
struct Alphas {
    float least = 1.0f, most = 1.0f;

    void add(float alpha) {
        least = std::min(least, alpha);
        most = std::max(most, alpha);
    }
    Alphas operator*(const Alphas& other) const { return {least * other.least, most * other.most}; }
    bool areSolid() const { return least >= opaqueAlpha; }
    /// True if there is more than one, and one may hide what is behind.
    bool areCut() const { return !areSolid() && most > least && most >= hidingAlpha; }
};

constexpr Alphas none{1.0f, 0.0f};
constexpr Alphas any{0.0f, 1.0f};

Alphas alphasIn(const osg::Image& image) {
    if (!image.isImageTranslucent()) return {};
    Alphas result = none;
    for (int row = 0; row < image.t() && !(result.least <= 0.0f && result.most >= 1.0f); ++row)
        for (int column = 0; column < image.s(); ++column)
            result.add(image.getColor(unsigned(column), unsigned(row)).a());
    return result;
}

Alphas alphasIn(const osg::Array& array) {
    Alphas result = none;
    if (const auto* floats = dynamic_cast<const osg::Vec4Array*>(&array))
        for (const osg::Vec4& color : *floats) result.add(color.a());
    else if (const auto* bytes = dynamic_cast<const osg::Vec4ubArray*>(&array))
        for (const osg::Vec4ub& color : *bytes) result.add(float(color.a()) / 255.0f);
    return result.most < result.least ? Alphas() : result;
}

/// Alphas of images and arrays, looked through once, until these say that they have changed.
class KnownAlphas : public osg::Object {
public:
    KnownAlphas() = default;
    KnownAlphas(const KnownAlphas& other, const osg::CopyOp& copyOp) : osg::Object(other, copyOp) {}
    META_Object(gnomon, KnownAlphas)

    /// @param owner  of the data, which it may let go once it has been drawn. @param data  null: gone, or not there.
    template <class Data>
    Alphas of(const osg::Object& owner, const Data* data) {
        const auto known = _known.find(&owner);
        const bool valid = known != _known.end() && known->second.owner.valid();
        const bool isSame =
            valid && data && known->second.data.get() == data && known->second.modified == data->getModifiedCount();
        if (!data || isSame) return valid ? known->second.alphas : Alphas();
        if (_known.size() >= _mostWithGone) letGo();
        return (_known[&owner] = {&owner, data, data->getModifiedCount(), alphasIn(*data)}).alphas;
    }

protected:
    ~KnownAlphas() override = default;

private:
    /// Those whose owner is gone. Before each new one that would take as long as all of them squared.
    void letGo() {
        for (auto each = _known.begin(); each != _known.end();)
            each = each->second.owner.valid() ? std::next(each) : _known.erase(each);
        _mostWithGone = 2 * _known.size() + 1;
    }

    struct Entry {
        osg::observer_ptr<const osg::Object> owner, data;
        unsigned modified;
        Alphas alphas;
    };
    std::unordered_map<const osg::Object*, Entry> _known;
    std::size_t _mostWithGone = 1; ///< entries, some of whose owners may be gone.
};

/// Null if it has none, or is no geometry.
const osg::Array* colorsOf(const osg::Drawable& drawable) {
    return drawable.asGeometry() ? drawable.asGeometry()->getColorArray() : nullptr;
}

/// True if colours of vertices take the place of the diffuse one.
bool showsColors(const osgUtil::StateGraph* graph) {
    const auto* material = resolved<osg::Material>(graph, A::MATERIAL);
    return !isOn(graph, GL_LIGHTING) || (material && (material->getColorMode() == osg::Material::DIFFUSE ||
                                                      material->getColorMode() == osg::Material::AMBIENT_AND_DIFFUSE));
}

/// Of what textures leave. Programs may do anything, textures but multiply.
Alphas alphasOfTextures(const osgUtil::StateGraph* graph, KnownAlphas& known) {
    if (resolvedAttribute(graph, A::PROGRAM)) return any;
    Alphas result;
    for (unsigned unit = 0, end = textureUnits(graph); unit < end; ++unit) {
        const osg::Texture* texture = textureIn(graph, unit);
        const osg::StateAttribute* environment = resolvedTextureAttribute(graph, unit, A::TEXENV);
        const auto* plain = dynamic_cast<const osg::TexEnv*>(environment); // the other combines
        if (!texture || (plain && plain->getMode() == osg::TexEnv::DECAL)) continue;
        if (environment && !(plain && plain->getMode() == osg::TexEnv::MODULATE)) return any;
        result = result * known.of(*texture, texture->getImage(0));
    }
    return result;
}

/// Of the diffuse colour that vertices do not replace.
Alphas alphasOfMaterial(const osgUtil::StateGraph* graph) {
    const auto* material = isOn(graph, GL_LIGHTING) ? resolved<osg::Material>(graph, A::MATERIAL) : nullptr;
    if (!material) return {};
    const float alpha =
        std::max(material->getDiffuse(osg::Material::FRONT).a(), material->getDiffuse(osg::Material::BACK).a());
    return {alpha, alpha};
}

enum class Kind { None, Combined, Clear, Cut, Solid };

/// What leaves of one state are, as far as that tells.
class StateKind {
public:
    StateKind(const osgUtil::StateGraph* graph, KnownAlphas& known)
        : _known(known),
          _combines(isOn(graph, GL_COLOR_LOGIC_OP)),
          _hides(_combines ? operationHides(graph) : !isOn(graph, GL_BLEND) || alphaHides(graph)),
          _blends(!_combines && isOn(graph, GL_BLEND)),
          _writes(writesDepth(graph)),
          _showsDepthless(isShaded(graph) && isOn(graph, GL_DEPTH_TEST, true)) {
        if (!_blends || !_hides) return;
        _textures = alphasOfTextures(graph, known);
        _material = alphasOfMaterial(graph);
        _showsColors = gnomon::showsColors(graph);
    }

    Kind of(const osg::Drawable& drawable) const {
        if (!drawable.getBoundingBox().valid()) return Kind::None; // a user interface, for one, must not be drawn twice
        if (!_blends) return !_writes ? Kind::None : _hides ? Kind::Solid : Kind::Combined;
        if (!_hides) return _writes ? Kind::Clear : Kind::None;
        const osg::Array* colors = _showsColors ? colorsOf(drawable) : nullptr;
        const Alphas alphas = _textures * (colors ? alphasOf(*colors) : _material);
        if (_writes && alphas.areSolid()) return Kind::Solid;
        if (alphas.areCut() && drawable.asGeometry() && (_writes || _showsDepthless)) return Kind::Cut;
        return !_writes ? Kind::None : alphas.areCut() ? Kind::Solid : Kind::Clear;
    }

private:
    /// One is read at once.
    Alphas alphasOf(const osg::Array& colors) const {
        return colors.getNumElements() <= 1 ? alphasIn(colors) : _known.of(colors, &colors);
    }

    KnownAlphas& _known;
    const bool _combines, _hides, _blends, _writes, _showsDepthless;
    Alphas _textures, _material;
    bool _showsColors = false;
};

/// What leaves of a stage are. Those of one state mostly follow each other.
class LeafKinds {
public:
    explicit LeafKinds(osgUtil::RenderStage& stage) : _known(keptBy<KnownAlphas>(stage)) {}

    Kind of(const osgUtil::RenderLeaf& leaf) {
        if (!_kind || leaf._parent != _graph) _kind.emplace(_graph = leaf._parent, _known);
        return _kind->of(*leaf._drawable);
    }

private:
    KnownAlphas& _known;
    std::optional<StateKind> _kind;
    const osgUtil::StateGraph* _graph = nullptr;
};

} // namespace

const osgUtil::RenderLeaf* firstCut(const std::vector<DrawnLeaf>& leaves, osgUtil::RenderStage& stage) {
    LeafKinds kinds(stage);
    const auto isCut = [&kinds](const DrawnLeaf& entry) { return kinds.of(*entry.leaf) == Kind::Cut; };
    const auto found = std::find_if(leaves.begin(), leaves.end(), isCut);
    return found == leaves.end() ? nullptr : found->leaf;
}

LateReceivers lateReceivers(osgUtil::RenderStage& stage, int number) {
    LateReceivers late;
    LeafKinds kinds(stage);
    const auto& bins = stage.getRenderBinList();
    for (auto bin = bins.lower_bound(number); bin != bins.end(); ++bin)
        for (const DrawnLeaf& entry : leavesIn(*bin->second)) {
            const Kind kind = kinds.of(*entry.leaf);
            if (kind == Kind::Combined) late.combined.push_back(entry);
            if (kind == Kind::Clear) late.clear.push_back(entry);
            if (kind != Kind::Cut && kind != Kind::Solid) continue;
            late.leaves.push_back(entry);
            late.areCut = late.areCut || kind == Kind::Cut;
            late.last = bin->second.get();
        }
    return late;
}

} // namespace gnomon
