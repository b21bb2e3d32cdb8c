// SPDX-License-Identifier: MIT
#include <gnomon/ShadowSpec.h>

#include <gnomon/FlatParts.h>
#include <gnomon/NamedNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>
#include <stdexcept>

namespace gnomon {
namespace {

constexpr const char* defaultReceiver = "ground";
constexpr unsigned mostPlanes = 8;
constexpr double smallestPart = 0.01; // of the largest
constexpr double mostError = 1e6;

using Techniques = std::vector<osg::ref_ptr<ShadowTechnique>>;
/// `receiver` is null where none is named and the technique can do without.
using Adder = osg::ref_ptr<ShadowTechnique> (*)(const ShadowSpec& spec, const NamedNode* receiver);

/// A key of the specification string. `take` reads its value into the spec; false if it is out of range.
struct Key {
    const char* name;
    const char* range;
    const char* fallback;
    const char* says;
    bool (*take)(ShadowSpec&, const std::string& value);
};

/// A technique; one without `add` draws nothing. Those planned have `built` false.
struct Technique {
    const char* name;
    bool built;
    const char* says;
    Adder add;
    bool onEverything; ///< what receives where no receiver is named: everything, or the node named "ground".
    std::vector<Key> keys;
};

bool takeComposite(ShadowSpec& spec, const std::string& value) {
    if (value == "relight")
        spec.composite = ShadowCasterGroup::RELIGHT;
    else if (value == "blend")
        spec.composite = ShadowCasterGroup::BLEND;
    else
        return false;
    return true;
}

/// The whole text as a number; nullopt if it is none, or not within the limits.
template <typename Number>
std::optional<Number> numberIn(const std::string& text, Number low, Number high) {
    Number number{};
    const char* end = text.data() + text.size();
    const std::from_chars_result read = std::from_chars(text.data(), end, number);
    if (read.ec != std::errc() || read.ptr != end || !(number >= low && number <= high)) return std::nullopt;
    return number;
}

bool takeDark(ShadowSpec& spec, const std::string& value) {
    spec.dark = numberIn(value, 0.0f, 1.0f);
    return spec.dark.has_value();
}

bool takeError(ShadowSpec& spec, const std::string& value) {
    spec.error = numberIn(value, 0.0, mostError);
    return spec.error.has_value();
}

bool takeSize(ShadowSpec& spec, const std::string& value) {
    spec.size = numberIn(value, 16, 16384);
    return spec.size.has_value();
}

bool takeFilter(ShadowSpec& spec, const std::string& value) {
    if (value == "nearest")
        spec.filter = ShadowMapTechnique::NEAREST;
    else if (value == "bilinear")
        spec.filter = ShadowMapTechnique::BILINEAR;
    else if (value == "bicubic")
        spec.filter = ShadowMapTechnique::BICUBIC;
    else if (value == "fine")
        spec.filter = ShadowMapTechnique::FINE;
    return spec.filter.has_value();
}

bool takeCascades(ShadowSpec& spec, const std::string& value) {
    spec.cascades = value == "auto" ? 0 : numberIn(value, 1, 4);
    return spec.cascades.has_value();
}

bool takeEdges(ShadowSpec& spec, const std::string& value) {
    if (value == "hard")
        spec.edges = ShadowMapTechnique::HARD;
    else if (value == "smooth")
        spec.edges = ShadowMapTechnique::SMOOTH;
    else if (value == "soft")
        spec.edges = ShadowMapTechnique::SOFT;
    return spec.edges.has_value();
}

bool takeSunAngle(ShadowSpec& spec, const std::string& value) {
    spec.sunAngle = numberIn(value, 0.0, 20.0);
    return spec.sunAngle.has_value();
}

bool takeLampSize(ShadowSpec& spec, const std::string& value) {
    spec.lampSize = numberIn(value, 0.0, 1e6);
    return spec.lampSize.has_value();
}

bool takeRadius(ShadowSpec& spec, const std::string& value) {
    spec.radius = numberIn(value, 0.0, 1e6);
    return spec.radius.has_value();
}

bool takeView(ShadowSpec& spec, const std::string& value) {
    using Map = ShadowMapTechnique;
    for (const auto& [name, view] : {std::pair("nothing", Map::NOTHING), std::pair("map", Map::MAP),
                                     std::pair("texels", Map::TEXELS), std::pair("cascades", Map::CASCADES)})
        if (value == name) spec.view = view;
    return spec.view.has_value();
}

bool takeReceiver(ShadowSpec& spec, const std::string& value) {
    spec.receiver = value;
    return !value.empty();
}

/// Plane of the receiver's own frame, in the group's.
osg::Vec4d inGroup(const osg::Vec4d& plane, const NamedNode& receiver) {
    return osg::Matrixd::inverse(receiver.rootFromParent) * plane;
}

osg::ref_ptr<ShadowTechnique> makePlanar(const ShadowSpec&, const NamedNode* named) {
    const NamedNode& receiver = *named;
    const std::vector<FlatPart> parts = flatParts(*receiver.node, mostPlanes);
    if (parts.empty())
        throw std::invalid_argument("the receiver \"" + receiver.node->getName() +
                                    "\" has no flat part, which planar needs. Name another one with receiver=NAME.");
    osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode;
    for (const FlatPart& part : parts)
        if (part.area >= smallestPart * parts.front().area) node->addPlane(inGroup(part.plane, receiver));
    return node;
}

osg::ref_ptr<ShadowTechnique> makeTraced(const ShadowSpec&, const NamedNode*) { return new TracedShadowTechnique; }

osg::ref_ptr<ShadowTechnique> makeMap(const ShadowSpec& spec, const NamedNode*) {
    osg::ref_ptr<ShadowMapTechnique> node = new ShadowMapTechnique;
    if (spec.size) node->setSize(*spec.size);
    if (spec.filter) node->setFilter(*spec.filter);
    if (spec.cascades) node->setCascades(*spec.cascades);
    if (spec.edges) node->setEdges(*spec.edges);
    if (spec.sunAngle) node->setSunAngle(*spec.sunAngle);
    if (spec.lampSize) node->setLampSize(*spec.lampSize);
    if (spec.radius) node->setRadius(*spec.radius);
    if (spec.view) node->setView(*spec.view);
    return node;
}

template <TerrainShadowGeode::Method method>
osg::ref_ptr<ShadowTechnique> makeTerrain(const ShadowSpec& spec, const NamedNode*) {
    osg::ref_ptr<TerrainShadowGeode> node = new TerrainShadowGeode;
    node->setMethod(method);
    if (spec.error) node->setError(*spec.error);
    return node;
}

const std::vector<Key>& sharedKeys() {
    static const std::vector<Key> keys = {
        {"composite", "relight, blend", "relight", "remove exactly the blocked light, or multiply the colour by dark",
         takeComposite},
        {"dark", "0 to 1", "0.5", "with composite=blend: factor for the colour in shadow", takeDark},
        {"receiver", "a node's name", "map, traced: everything; else: ground", "node that receives the shadow",
         takeReceiver},
    };
    return keys;
}

const std::vector<Technique>& techniques() {
    static const Key error = {"error", "0 to 1e6, scene's unit", "0.1",
                              "greatest error of a draped edge in plan; 0 is exact", takeError};
    static const Key size = {"size", "16 to 16384, texels", "1024", "side of a light's shadow map", takeSize};
    static const Key filter = {"filter", "nearest, bilinear, bicubic, fine", "bicubic",
                               "texels compared: 1, 2 x 2 or 4 x 4; fine: 16 times 2 x 2 with edges=smooth",
                               takeFilter};
    static const Key cascades = {"cascades", "auto, 1 to 4", "auto",
                                 "shadow maps of a sun, each for a part of the view", takeCascades};
    static const Key edges = {"edges", "hard, smooth, soft", "hard",
                              "lit or unlit; smooth over one pixel; or penumbras", takeEdges};
    static const Key sunAngle = {"sun-angle", "0 to 20, degrees", "0.533",
                                 "with edges=soft: angular diameter of a sun; 0 is a point", takeSunAngle};
    static const Key lampSize = {"lamp-size", "0 to 1e6, scene's unit", "0",
                                 "with edges=soft: diameter of lamps and spots; 0 is a point", takeLampSize};
    static const Key radius = {"radius", "0 to 1e6, scene's unit", "0",
                               "with edges=soft: least radius of the blurred edge; 0 is the filter's own", takeRadius};
    static const Key view = {"view", "nothing, map, texels, cascades", "nothing", "debug view drawn over the picture",
                             takeView};
    static const std::vector<Technique> table = {
        {"none", true, "no shadow", nullptr, true, {}},
        {"planar",
         true,
         "flattens the casters onto the receiver's planes; exact on flat receivers",
         makePlanar,
         false,
         {}},
        {"box",
         true,
         "bounding-box method of ARL-TN-156 on terrain, as published",
         makeTerrain<TerrainShadowGeode::BOX>,
         false,
         {}},
        {"hull",
         true,
         "polygons on terrain: silhouettes of the casters' convex parts, one ray for each corner",
         makeTerrain<TerrainShadowGeode::HULL>,
         false,
         {error}},
        {"drape",
         true,
         "the terrain's triangles, cut by the casters' shadows to within error",
         makeTerrain<TerrainShadowGeode::DRAPE>,
         false,
         {error}},
        {"map",
         true,
         "shadow maps; on every visible surface",
         makeMap,
         true,
         {size, filter, cascades, edges, sunAngle, lampSize, radius, view}},
        {"volume", false, "", nullptr, true, {}},
        {"traced", true, "one ray for each pixel by Embree; exact on every visible surface", makeTraced, true, {}},
        {"auto", false, "", nullptr, true, {}},
    };
    return table;
}

std::string join(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

const Technique& requireTechnique(const std::string& name) {
    for (const Technique& technique : techniques()) {
        if (name != technique.name) continue;
        if (!technique.built) refuse("\"" + name + "\" is not built yet. Allowed: " + join(shadowTechniques()) + ".");
        return technique;
    }
    refuse("\"" + name + "\" is not a shadow technique. Allowed: " + join(shadowTechniques()) + ".");
}

std::vector<Key> keysOf(const Technique& technique) {
    std::vector<Key> keys = technique.keys;
    keys.insert(keys.end(), sharedKeys().begin(), sharedKeys().end());
    return keys;
}

const Key& requireKey(const Technique& technique, const std::vector<Key>& keys, const std::string& name) {
    std::vector<std::string> names;
    for (const Key& key : keys) {
        if (name == key.name) return key;
        names.push_back(key.name);
    }
    refuse(std::string("the technique ") + technique.name + " has no key \"" + name + "\". Allowed: " + join(names) +
           ".");
}

void takePair(ShadowSpec& spec, const Technique& technique, const std::string& pair, std::set<std::string>& seen) {
    const std::size_t equals = pair.find('=');
    const std::string name = pair.substr(0, equals);
    const std::vector<Key> keys = keysOf(technique);
    const Key& key = requireKey(technique, keys, name);
    if (!seen.insert(name).second)
        refuse("the key \"" + name + "\" is given twice. Give it once in \"" + spec.text + "\".");
    const std::string value = equals == std::string::npos ? "" : pair.substr(equals + 1);
    if (!key.take(spec, value)) refuse(name + "=" + value + " cannot be used. Allowed: " + key.range + ".");
}

void takePairs(ShadowSpec& spec, const Technique& technique, const std::string& pairs) {
    std::set<std::string> seen;
    for (std::size_t begin = 0; begin <= pairs.size();) {
        const std::size_t comma = std::min(pairs.find(',', begin), pairs.size());
        takePair(spec, technique, pairs.substr(begin, comma - begin), seen);
        begin = comma + 1;
    }
}

bool blends(const ShadowSpec& spec) { return spec.composite == ShadowCasterGroup::BLEND; }

void setComposite(ShadowCasterGroup& group, const std::vector<ShadowSpec>& specs) {
    for (const ShadowSpec& spec : specs) {
        if (blends(spec) != blends(specs.front()))
            refuse("composite=relight and composite=blend cannot be mixed. Give every shadow the same.");
        if (spec.dark && specs.front().dark != spec.dark)
            refuse("dark= differs between the shadows. Give every shadow the same.");
    }
    if (specs.empty()) return;
    group.setComposite(blends(specs.front()) ? ShadowCasterGroup::BLEND : ShadowCasterGroup::RELIGHT);
    if (specs.front().dark) group.setDark(*specs.front().dark);
}

NamedNode requireReceiver(osg::Node& root, const std::string& name) {
    if (const std::optional<NamedNode> found = findNamed(root, name)) return *found;
    const std::string names = join(nodeNames(root));
    refuse("no node is named \"" + name +
           "\" to receive the shadow. Names in the scene: " + (names.empty() ? "none" : names) + ".");
}

osg::ref_ptr<ShadowTechnique> makeTechnique(ShadowCasterGroup& group, const ShadowSpec& spec) {
    const Technique& technique = requireTechnique(spec.technique);
    if (!technique.add) return nullptr;
    std::optional<NamedNode> receiver;
    if (!spec.receiver.empty() || !technique.onEverything)
        receiver = requireReceiver(group, spec.receiver.empty() ? defaultReceiver : spec.receiver);
    osg::ref_ptr<ShadowTechnique> node = technique.add(spec, receiver ? &*receiver : nullptr);
    Selection selection;
    if (receiver) selection.node = receiver->node;
    node->setReceiver(selection);
    node->setName(spec.text);
    return node;
}

void describeKeys(std::ostream& out, const std::vector<Key>& keys, const char* indent) {
    for (const Key& key : keys)
        out << indent << key.name << "=  " << key.says << "; allowed " << key.range << ", default " << key.fallback
            << "\n";
}

} // namespace

ShadowSpec parseShadowSpec(const std::string& text) {
    ShadowSpec spec;
    spec.text = text;
    const std::size_t colon = text.find(':');
    spec.technique = text.substr(0, colon);
    const Technique& technique = requireTechnique(spec.technique);
    if (colon != std::string::npos) takePairs(spec, technique, text.substr(colon + 1));
    if (spec.dark && !blends(spec)) refuse("dark= needs composite=blend. Add it to \"" + text + "\".");
    return spec;
}

std::vector<std::string> shadowTechniques() {
    std::vector<std::string> names;
    for (const Technique& technique : techniques())
        if (technique.built) names.push_back(technique.name);
    return names;
}

std::string shadowSpecHelp(const std::vector<std::string>& names) {
    std::ostringstream out;
    for (const Technique& technique : techniques()) {
        if (!technique.built || std::find(names.begin(), names.end(), technique.name) == names.end()) continue;
        out << "  " << technique.name << "  " << technique.says << "\n";
        describeKeys(out, technique.keys, "    ");
    }
    out << "  keys of every technique, as NAME:key=value,key=value\n";
    describeKeys(out, sharedKeys(), "    ");
    return out.str();
}

std::vector<osg::ref_ptr<ShadowTechnique>> addShadows(ShadowCasterGroup& group, const std::vector<ShadowSpec>& specs) {
    Techniques made;
    for (const ShadowSpec& spec : specs)
        if (osg::ref_ptr<ShadowTechnique> node = makeTechnique(group, spec)) made.push_back(node);
    setComposite(group, specs);
    for (const osg::ref_ptr<ShadowTechnique>& node : made) group.addChild(node);
    return made;
}

} // namespace gnomon
