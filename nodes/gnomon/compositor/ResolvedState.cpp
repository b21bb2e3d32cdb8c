// SPDX-License-Identifier: MIT
#include <gnomon/compositor/ResolvedState.h>

#include <osg/ColorMask>
#include <osg/Depth>
#include <osg/PolygonMode>
#include <osg/PolygonOffset>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <typeinfo>
#include <utility>
#include <vector>

namespace gnomon {
namespace {

/// True if what a state set gives holds against what is given above it. @param overridden  that is with OVERRIDE.
bool prevails(unsigned value, bool overridden) { return !overridden || (value & osg::StateAttribute::PROTECTED); }

/// What state sets give on the way from the root to each graph. A graph takes over what its parent has.
class StateTable {
public:
    struct Mode {
        osg::StateAttribute::GLMode mode;
        bool on, overrides;
    };
    struct Attribute {
        osg::StateAttribute::Type type; ///< the first of its type alone, as of lights.
        osg::ref_ptr<const osg::StateAttribute> attribute;
        bool overrides, mayApplyProgram;
    };

    const Mode* modeOf(const osgUtil::StateGraph* graph, osg::StateAttribute::GLMode mode) {
        return found(_modes, of(graph).modes, [mode](const Mode& known) { return known.mode == mode; });
    }
    const Attribute* attributeOf(const osgUtil::StateGraph* graph, osg::StateAttribute::Type type) {
        return found(_attributes, of(graph).attributes, [type](const Attribute& known) { return known.type == type; });
    }
    /// What follows from all that a graph has: found once. @param fact  a bit of its own.
    template <class Find>
    bool holds(const osgUtil::StateGraph* graph, unsigned fact, const Find& find) {
        of(graph);
        if (!graph) return find();
        const unsigned at = _last;
        if (!(_entries[at].asked & fact)) {
            const bool found = find();
            _entries[at].asked |= fact;
            if (found) _entries[at].facts |= fact;
        }
        return (_entries[at].facts & fact) != 0;
    }
    bool mayApplyProgram(const osgUtil::StateGraph* graph) {
        return found(_attributes, of(graph).attributes, [](const Attribute& known) { return known.mayApplyProgram; });
    }
    void clear() {
        const std::size_t used = _entries.size();
        _entries.clear();
        _modes.clear();
        _attributes.clear();
        if (_slots.size() > 1024 + 16 * used) _slots.clear(); // as many as a large scene needs
        std::fill(_slots.begin(), _slots.end(), none);
        _last = none;
    }

    unsigned scopes = 0; ///< that live in the thread.

private:
    static constexpr unsigned none = ~0u;
    struct Range {
        std::size_t first = 0, end = 0;
    };
    struct Entry {
        osg::ref_ptr<const osgUtil::StateGraph> graph; ///< held, so that its address is no other's meanwhile.
        Range modes, attributes;                       ///< those of a parent where nothing is added.
        unsigned asked = 0, facts = 0;                 ///< see holds().
    };

    template <class Given, class Test>
    static const Given* found(const std::vector<Given>& all, const Range& range, const Test& test) {
        const auto end = all.begin() + std::ptrdiff_t(range.end);
        const auto at = std::find_if(all.begin() + std::ptrdiff_t(range.first), end, test);
        return at == end ? nullptr : &*at;
    }

    /// Leaves of one state mostly follow each other. @param graph  null: no state set gives anything.
    const Entry& of(const osgUtil::StateGraph* graph) {
        static const Entry nothing;
        if (!graph) return nothing;
        if (_last != none && _entries[_last].graph == graph) return _entries[_last];
        if (_slots.empty()) widen();
        if (const unsigned slot = slotOf(graph); slot != none) return _entries[_last = slot];
        Entry entry = of(graph->_parent); // which adds all that are above
        if (2 * _entries.size() >= _slots.size()) widen();
        entry.graph = graph;
        entry.asked = entry.facts = 0;
        if (graph->getStateSet()) add(*graph->getStateSet(), entry);
        _last = unsigned(_entries.size());
        slotOf(graph) = _last; // there may be more slots now
        _entries.push_back(std::move(entry));
        return _entries.back();
    }

    void add(const osg::StateSet& set, Entry& entry) {
        if (!set.getModeList().empty()) makeOwn(_modes, entry.modes);
        for (const auto& [mode, value] : set.getModeList())
            if (!(value & osg::StateAttribute::INHERIT))
                give(_modes, entry.modes, Mode{mode, (value & osg::StateAttribute::ON) != 0, false}, value,
                     [mode = mode](const Mode& known) { return known.mode == mode; });
        if (!set.getAttributeList().empty()) makeOwn(_attributes, entry.attributes);
        for (const auto& [key, pair] : set.getAttributeList())
            if (key.second == 0)
                give(_attributes, entry.attributes,
                     Attribute{key.first, pair.first.get(), false, gnomon::mayApplyProgram(*pair.first)}, pair.second,
                     [type = key.first](const Attribute& known) { return known.type == type; });
    }

    template <class Given>
    static void makeOwn(std::vector<Given>& all, Range& range) {
        const std::size_t first = all.size();
        for (std::size_t i = range.first; i < range.end; ++i) all.push_back(Given(all[i]));
        range = {first, all.size()};
    }

    template <class Given, class Test>
    static void give(std::vector<Given>& all, Range& range, Given given, unsigned value, const Test& isSame) {
        given.overrides = (value & osg::StateAttribute::OVERRIDE) != 0;
        const auto known = std::find_if(all.begin() + std::ptrdiff_t(range.first), all.end(), isSame);
        if (known == all.end())
            all.push_back(given);
        else if (prevails(value, known->overrides))
            *known = given;
        range.end = all.size();
    }

    unsigned& slotOf(const osgUtil::StateGraph* graph) {
        const std::size_t last = _slots.size() - 1; // all bits are set
        const auto address = std::uint64_t{reinterpret_cast<std::uintptr_t>(graph)};
        std::size_t at = (address * 0x9e3779b97f4a7c15u) >> 32 & last;
        while (_slots[at] != none && _entries[_slots[at]].graph != graph) at = (at + 1) & last;
        return _slots[at];
    }

    void widen() {
        _slots.assign(std::max<std::size_t>(64, 2 * _slots.size()), none);
        for (unsigned i = 0; i < _entries.size(); ++i) slotOf(_entries[i].graph.get()) = i;
    }

    std::vector<Mode> _modes;
    std::vector<Attribute> _attributes;
    std::vector<Entry> _entries;
    std::vector<unsigned> _slots; ///< by address: which of the entries.
    unsigned _last = none;        ///< that was asked for last.
};

thread_local StateTable known;

bool hasAlphaTestAlone(const osg::StateSet& set) {
    const auto isTest = [](const auto& entry) { return entry.first.first == osg::StateAttribute::ALPHAFUNC; };
    const auto isMode = [](const auto& entry) { return entry.first == GL_ALPHA_TEST; };
    const auto& attributes = set.getAttributeList();
    const auto& modes = set.getModeList();
    return std::all_of(attributes.begin(), attributes.end(), isTest) &&
           std::all_of(modes.begin(), modes.end(), isMode) && set.getTextureAttributeList().empty() &&
           set.getTextureModeList().empty() && set.getUniformList().empty();
}

/// The graph of the same sets, with others under them all.
osgUtil::StateGraph* over(const std::vector<osg::ref_ptr<osg::StateSet>>& bins, const osgUtil::StateGraph* graph) {
    std::vector<const osg::StateSet*> sets; // innermost first
    for (; graph->_parent; graph = graph->_parent)
        if (graph->getStateSet()) sets.push_back(graph->getStateSet());
    auto* result = const_cast<osgUtil::StateGraph*>(graph);
    for (const auto& set : bins) result = result->find_or_insert(set);
    for (auto set = sets.rbegin(); set != sets.rend(); ++set) result = result->find_or_insert(*set);
    return result;
}

/// @param above  sets of the bins that it is in.
void moveStates(osgUtil::RenderBin& bin, std::vector<osg::ref_ptr<osg::StateSet>> above) {
    const bool isPlain = typeid(bin) == typeid(osgUtil::RenderBin);
    if (isPlain && bin.getStateSet() && !hasAlphaTestAlone(*bin.getStateSet())) {
        above.emplace_back(bin.getStateSet());
        bin.setStateSet(nullptr); // this bin is gone with the frame
    }
    if (!above.empty()) {
        for (osgUtil::RenderLeaf* leaf : bin.getRenderLeafList()) // osgUtil drops graphs without leaves
            over(above, leaf->_parent)->addLeaf(leaf);
        for (osgUtil::StateGraph*& graph : bin.getStateGraphList()) {
            osgUtil::StateGraph* moved = over(above, graph);
            for (const auto& leaf : graph->_leaves) moved->addLeaf(leaf);
            moved->_dynamic = moved->_dynamic || graph->_dynamic;
            graph->_leaves.clear();
            graph = moved;
        }
    }
    for (const auto& [number, below] : bin.getRenderBinList()) moveStates(*below, above);
}

} // namespace

void moveBinStatesToGraphs(osgUtil::RenderBin& bin) { moveStates(bin, {}); }

KnownStates::KnownStates() { ++known.scopes; }

KnownStates::~KnownStates() {
    if (--known.scopes == 0) known.clear();
}

bool isOn(const osgUtil::StateGraph* graph, osg::StateAttribute::GLMode mode, bool unset) {
    const KnownStates scope;
    const StateTable::Mode* given = known.modeOf(graph, mode);
    return given ? given->on : unset;
}

const osg::StateAttribute* resolvedAttribute(const osgUtil::StateGraph* graph, osg::StateAttribute::Type type,
                                             bool* overrides) {
    const KnownStates scope;
    const StateTable::Attribute* given = known.attributeOf(graph, type);
    if (overrides) *overrides = given && given->overrides;
    return given ? given->attribute.get() : nullptr;
}

namespace {

/// What a texture unit has of one kind. Few states are asked for it, and once each: nothing is kept.
struct OfUnit {
    const osg::StateAttribute* attribute = nullptr; ///< of an attribute.
    unsigned value = osg::StateAttribute::OFF;      ///< as a state set gives it.
    bool overrides() const { return (value & osg::StateAttribute::OVERRIDE) != 0; }
};

/// @param given  what a state set gives; a value of INHERIT: nothing.
template <class Given>
OfUnit resolvedOfUnit(const osgUtil::StateGraph* graph, const Given& given) {
    if (!graph) return {};
    const OfUnit above = resolvedOfUnit(graph->_parent, given);
    const osg::StateSet* set = graph->getStateSet();
    const OfUnit here = set ? given(*set) : OfUnit{nullptr, osg::StateAttribute::INHERIT};
    return (here.value & osg::StateAttribute::INHERIT) || !prevails(here.value, above.overrides()) ? above : here;
}

} // namespace

const osg::StateAttribute* resolvedTextureAttribute(const osgUtil::StateGraph* graph, unsigned unit,
                                                    osg::StateAttribute::Type type) {
    const auto given = [&](const osg::StateSet& set) {
        const auto* pair = set.getTextureAttributePair(unit, type);
        return pair ? OfUnit{pair->first.get(), pair->second} : OfUnit{nullptr, osg::StateAttribute::INHERIT};
    };
    return resolvedOfUnit(graph, given).attribute;
}

bool isTextureModeOn(const osgUtil::StateGraph* graph, unsigned unit, osg::StateAttribute::GLMode mode) {
    const auto given = [&](const osg::StateSet& set) { return OfUnit{nullptr, set.getTextureMode(unit, mode)}; };
    return (resolvedOfUnit(graph, given).value & osg::StateAttribute::ON) != 0;
}

osg::Vec2d polygonOffsetOf(const osgUtil::StateGraph* graph) {
    const auto* offset = resolved<osg::PolygonOffset>(graph, osg::StateAttribute::POLYGONOFFSET);
    if (!offset || !isOn(graph, GL_POLYGON_OFFSET_FILL)) return {};
    return {offset->getFactor(), offset->getUnits()};
}

DepthPlacement depthPlacementOf(const osgUtil::StateGraph* graph) {
    DepthPlacement placement;
    if (const auto* depth = resolved<osg::Depth>(graph, osg::StateAttribute::DEPTH)) {
        placement.nearest = depth->getZNear();
        placement.farthest = depth->getZFar();
    }
    const osg::Vec2d offset = polygonOffsetOf(graph);
    placement.pixels = std::max(0.0, offset.x());
    placement.steps = std::max(0.0, offset.y());
    return placement;
}

ProgramPlaces placesIn(const osgUtil::StateGraph* graph, const std::vector<MatrixUniform>& matrices) {
    const KnownStates scope;
    if (known.mayApplyProgram(graph)) return {true, true, true, false, true};
    const auto* program = resolved<osg::Program>(graph, osg::StateAttribute::PROGRAM);
    return program && program->getNumShaders() > 0 ? placesOf(*program, matrices) : ProgramPlaces();
}

namespace {

/// Bits for StateTable::holds().
enum Fact : unsigned { Plain = 1, Opaque = 2, Filled = 4 };

bool findOpaque(const osgUtil::StateGraph* graph) {
    return writesDepth(graph) && !isOn(graph, GL_BLEND) && !isOn(graph, GL_COLOR_LOGIC_OP);
}

bool findPlain(const osgUtil::StateGraph* graph) {
    const auto* depth = resolved<osg::Depth>(graph, osg::StateAttribute::DEPTH);
    const auto* mask = resolved<osg::ColorMask>(graph, osg::StateAttribute::COLORMASK);
    return (!depth ||
            (depth->getFunction() == osg::Depth::LESS && depth->getZNear() == 0.0 && depth->getZFar() == 1.0)) &&
           (!mask || (mask->getRedMask() && mask->getGreenMask() && mask->getBlueMask() && mask->getAlphaMask())) &&
           !isOn(graph, GL_STENCIL_TEST) && !isOn(graph, GL_POLYGON_OFFSET_FILL) && findOpaque(graph);
}

bool findFilled(const osgUtil::StateGraph* graph) {
    const auto* mode = resolved<osg::PolygonMode>(graph, osg::StateAttribute::POLYGONMODE);
    return !mode || (mode->getMode(osg::PolygonMode::FRONT) == osg::PolygonMode::FILL &&
                     mode->getMode(osg::PolygonMode::BACK) == osg::PolygonMode::FILL);
}

} // namespace

bool isPlain(const osgUtil::StateGraph* graph) {
    const KnownStates scope;
    return known.holds(graph, Plain, [graph] { return findPlain(graph); });
}

bool isOpaque(const osgUtil::StateGraph* graph) {
    const KnownStates scope;
    return known.holds(graph, Opaque, [graph] { return findOpaque(graph); });
}

bool isFilled(const osgUtil::StateGraph* graph) {
    const KnownStates scope;
    return known.holds(graph, Filled, [graph] { return findFilled(graph); });
}

bool isShaded(const osgUtil::StateGraph* graph) {
    return isOn(graph, GL_LIGHTING) || resolvedAttribute(graph, osg::StateAttribute::PROGRAM);
}

bool writesDepth(const osgUtil::StateGraph* graph) {
    const auto* depth = resolved<osg::Depth>(graph, osg::StateAttribute::DEPTH);
    return isOn(graph, GL_DEPTH_TEST, true) && (!depth || depth->getWriteMask());
}

bool writesColor(const osgUtil::StateGraph* graph) {
    const auto* mask = resolved<osg::ColorMask>(graph, osg::StateAttribute::COLORMASK);
    return !mask || mask->getRedMask() || mask->getGreenMask() || mask->getBlueMask();
}

} // namespace gnomon
