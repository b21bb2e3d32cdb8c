// SPDX-License-Identifier: MIT
#include <gnomon/base/NumberText.h>
#include <gnomon/spec/SpecTable.h>

#include <algorithm>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace gnomon {
namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

using Map = ShadowMapOptions;

constexpr const char* ground = "ground"; // receives where nothing is named and not everything can

/// What a key sets: its default, and how it is put into a specification.
template <typename Value>
struct Option {
    Value byDefault;
    std::function<void(ShadowSpec&, Value)> set;
};

template <typename Value>
Option<Value> ofMap(Value ShadowMapOptions::*option) {
    return {ShadowMapOptions().*option, [option](ShadowSpec& spec, Value value) { spec.map.*option = value; }};
}

Option<ShadowCasterGroup::Composite> composite() {
    const osg::ref_ptr<ShadowCasterGroup> fresh = new ShadowCasterGroup;
    return {fresh->getComposite(), [](ShadowSpec& spec, auto value) { spec.composite = value; }};
}

Option<float> dark() {
    const osg::ref_ptr<ShadowCasterGroup> fresh = new ShadowCasterGroup;
    return {fresh->getDark(), [](ShadowSpec& spec, float value) { spec.dark = value; }};
}

Option<bool> terminatorOffset() {
    const osg::ref_ptr<ShadowCasterGroup> fresh = new ShadowCasterGroup;
    return {fresh->getTerminatorOffset(), [](ShadowSpec& spec, bool value) { spec.terminatorOffset = value; }};
}

template <typename Number>
SpecKey numberKey(SpecKey key, const Option<Number>& option, Number least, Number most) {
    key.range = textOf(least) + " to " + textOf(most);
    key.byDefault = textOf(option.byDefault);
    key.take = [=](ShadowSpec& spec, const std::string& value) {
        const std::optional<Number> number = numberIn(value, least, most);
        if (number) option.set(spec, *number);
        return number.has_value();
    };
    return key;
}

template <typename Value>
using Words = std::vector<std::pair<std::string, Value>>;

/// Takes one of these words, or else what the key takes already.
template <typename Value>
SpecKey wordKey(SpecKey key, const Option<Value>& option, const Words<Value>& words) {
    for (const auto& [word, value] : words) {
        key.words.push_back(word);
        if (value == option.byDefault) key.byDefault = word;
    }
    key.take = [=, other = key.take](ShadowSpec& spec, const std::string& text) {
        for (const auto& [word, value] : words) {
            if (word != text) continue;
            option.set(spec, value);
            return true;
        }
        return other && other(spec, text);
    };
    return key;
}

bool takeReceiver(ShadowSpec& spec, const std::string& value) {
    spec.receiver = value;
    return !value.empty();
}

SpecKey receiverKey(const std::string& byDefault) {
    return {"receiver", "nodes that receive", "", {}, "a node's name", byDefault, takeReceiver};
}

std::string receiverOf(const SpecTechnique& technique) {
    return technique.receiver.empty() ? "everything" : technique.receiver;
}

std::vector<SpecKey> autoKeys() {
    using Budget = AutoShadowOptions;
    const Option<double> error = {0.0, [](ShadowSpec& spec, double value) { spec.budget.error = value; }};
    SpecKey key{"error", "largest error of the edge; auto is 1", "pixels"};
    key = numberKey(std::move(key), error, Budget::leastError, Budget::mostError);
    return {wordKey(std::move(key), error, {{"auto", 0.0}})};
}

std::vector<SpecKey> mapKeys() {
    return {
        numberKey({"size", "most texels on a side of a shadow map", "texels"}, ofMap(&Map::size), Map::leastSize,
                  Map::mostSize),
        wordKey(
            {"filter", "texels compared: 1, 2 x 2, 4 x 4; fine: the most"}, ofMap(&Map::filter),
            {{"nearest", Map::NEAREST}, {"bilinear", Map::BILINEAR}, {"bicubic", Map::BICUBIC}, {"fine", Map::FINE}}),
        wordKey(numberKey({"cascades", "most shadow maps of a sun, each for a part of the view"}, ofMap(&Map::cascades),
                          1, Map::mostCascades),
                ofMap(&Map::cascades), {{"auto", 0}}),
        wordKey({"edges", "lit or unlit; smooth over one pixel; or penumbras"}, ofMap(&Map::edges),
                {{"hard", Map::HARD}, {"smooth", Map::SMOOTH}, {"soft", Map::SOFT}}),
        numberKey({"sun-angle", "with edges=soft: angular diameter of a sun; 0 is a point", "degrees"},
                  ofMap(&Map::sunAngle), 0.0, Map::mostAngle),
        numberKey({"lamp-size", "with edges=soft: diameter of lamps and spots; 0 is a point", "scene's unit"},
                  ofMap(&Map::lampSize), 0.0, Map::mostLength),
        numberKey({"radius", "with edges=soft: blur radius of all edges; 0 is the filter alone", "scene's unit"},
                  ofMap(&Map::radius), 0.0, Map::mostLength),
        wordKey({"view", "debug view drawn over the picture"}, ofMap(&Map::view),
                {{"nothing", Map::NOTHING}, {"map", Map::MAP}, {"texels", Map::TEXELS}, {"cascades", Map::CASCADES}}),
    };
}

/// Of techniques that are exact.
template <typename Options>
SpecKey edgesKey(Options ShadowSpec::*options) {
    using Edges = decltype(Options::edges);
    const Option<Edges> edges = {Options().edges,
                                 [options](ShadowSpec& spec, Edges value) { (spec.*options).edges = value; }};
    return wordKey({"edges", "lit or unlit; or smooth over one pixel"}, edges,
                   {{"hard", Options::HARD}, {"smooth", Options::SMOOTH}});
}

std::vector<SpecKey> volumeKeys() {
    const Option<ShadowVolumeOptions::View> view = {
        ShadowVolumeOptions().view,
        [](ShadowSpec& spec, ShadowVolumeOptions::View value) { spec.volume.view = value; }};
    return {edgesKey(&ShadowSpec::volume),
            wordKey({"view", "debug view drawn over the picture"}, view,
                    {{"nothing", ShadowVolumeOptions::NOTHING}, {"volumes", ShadowVolumeOptions::VOLUMES}})};
}

/// "map, volume, traced, auto: everything; else: ground".
std::string receiversByDefault() {
    std::vector<std::string> everywhere;
    for (const SpecTechnique& technique : specTechniques())
        if (technique.receiver.empty() && technique.name != "none") everywhere.push_back(technique.name);
    return listed(everywhere) + ": everything; else: " + ground;
}

std::vector<SpecKey> sharedKeys(const std::string& receiver) {
    return {
        wordKey({"composite", "removes the blocked light, or multiplies the colour by dark"}, composite(),
                {{"relight", ShadowCasterGroup::RELIGHT}, {"blend", ShadowCasterGroup::BLEND}}),
        numberKey({"dark", "with composite=blend: factor for the colour in shadow"}, dark(), 0.0f, 1.0f),
        wordKey({"terminator", "smooth bodies without teeth, or shadowed as their facets are"}, terminatorOffset(),
                {{"offset", true}, {"facets", false}}),
        receiverKey(receiver),
    };
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void describeKeys(std::ostream& out, const std::vector<SpecKey>& keys) {
    for (const SpecKey& key : keys)
        out << "    " << key.name << "=  " << key.meaning << "; allowed " << key.allowed() << ", default "
            << key.byDefault << "\n";
}

const SpecKey& requireKey(const SpecTechnique& technique, const std::vector<SpecKey>& keys, const std::string& name) {
    std::vector<std::string> names;
    for (const SpecKey& key : keys) {
        if (name == key.name) return key;
        names.push_back(key.name);
    }
    refuse("the technique " + technique.name + " has no key \"" + name + "\". Allowed: " + listed(names) + ".");
}

void takePair(ShadowSpec& spec, const SpecTechnique& technique, const std::string& pair, std::set<std::string>& seen) {
    const std::size_t equals = pair.find('=');
    const std::string name = pair.substr(0, equals);
    const std::vector<SpecKey> keys = keysOf(technique);
    const SpecKey& key = requireKey(technique, keys, name);
    if (!seen.insert(name).second)
        refuse("the key \"" + name + "\" is given twice. Give it once in \"" + spec.text + "\".");
    const std::string value = equals == std::string::npos ? "" : pair.substr(equals + 1);
    if (!key.take(spec, value)) refuse(name + "=" + value + " cannot be used. Allowed: " + key.allowed() + ".");
}

void takePairs(ShadowSpec& spec, const SpecTechnique& technique, const std::string& pairs) {
    std::set<std::string> seen;
    for (std::size_t begin = 0; begin <= pairs.size();) {
        const std::size_t comma = std::min(pairs.find(',', begin), pairs.size());
        takePair(spec, technique, pairs.substr(begin, comma - begin), seen);
        begin = comma + 1;
    }
}

} // namespace

std::string SpecKey::allowed() const {
    std::vector<std::string> parts = words;
    for (const std::string& part : {range, unit})
        if (!part.empty()) parts.push_back(part);
    return listed(parts);
}

const std::vector<SpecTechnique>& specTechniques() {
    static const std::vector<SpecTechnique> table = {
        {"none", "no shadow"},
        {"planar",
         "flattens the casters onto the receiver's planes; exact on flat receivers",
         ground,
         {edgesKey(&ShadowSpec::planar)}},
        {"box", "bounding-box method of ARL-TN-156 on terrain, as published", ground},
        {"hull",
         "silhouettes of the casters' convex parts, followed into the terrain",
         ground,
         {edgesKey(&ShadowSpec::hull)},
         OptionalPart::Terrain},
        {"map", "shadow maps; on every visible surface", "", mapKeys()},
        {"volume", "stencil volumes; exact on every visible surface", "", volumeKeys()},
        {"traced",
         "one ray for each pixel by Embree; exact on every visible surface",
         "",
         {edgesKey(&ShadowSpec::traced)},
         OptionalPart::Traced},
        {"auto", "the cheapest of the others that keeps an error", "", autoKeys()},
    };
    return table;
}

const SpecTechnique& requireTechnique(const std::string& name) {
    for (const SpecTechnique& technique : specTechniques()) {
        if (name != technique.name) continue;
        if (const std::string why = technique.whyUnavailable(); !why.empty())
            refuse("the technique " + name + " cannot be used. " + why);
        return technique;
    }
    if (name == "drape")
        refuse("there is no technique drape any more. Use hull on terrain, which is exact there, or map or traced if "
               "other surfaces receive.");
    refuse("\"" + name + "\" is not a shadow technique. Allowed: " + listed(shadowTechniques()) + ".");
}

std::vector<SpecKey> keysOf(const SpecTechnique& technique) {
    std::vector<SpecKey> keys = technique.keys;
    for (const SpecKey& key : sharedKeys(receiverOf(technique))) keys.push_back(key);
    return keys;
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

std::vector<std::string> shadowTechniques() {
    std::vector<std::string> names;
    for (const SpecTechnique& technique : specTechniques())
        if (technique.whyUnavailable().empty()) names.push_back(technique.name);
    return names;
}

std::string shadowSpecHelp(const std::vector<std::string>& names) {
    std::ostringstream out;
    for (const SpecTechnique& technique : specTechniques()) {
        if (!has(names, technique.name)) continue;
        out << "  " << technique.name << "  " << technique.meaning << "\n";
        describeKeys(out, technique.keys);
    }
    out << "  keys of every technique, as NAME:key=value,key=value\n";
    describeKeys(out, sharedKeys(receiversByDefault()));
    return out.str();
}

ShadowSpec parseShadowSpec(const std::string& text) {
    ShadowSpec spec;
    spec.text = text;
    const std::size_t colon = text.find(':');
    spec.technique = text.substr(0, colon);
    const SpecTechnique& technique = requireTechnique(spec.technique);
    if (colon != std::string::npos) takePairs(spec, technique, text.substr(colon + 1));
    if (spec.dark && spec.composite != ShadowCasterGroup::BLEND)
        refuse("dark= needs composite=blend. Add it to \"" + text + "\".");
    return spec;
}

} // namespace gnomon
