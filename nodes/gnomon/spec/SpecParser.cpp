// SPDX-License-Identifier: MIT
#include <gnomon/ShadowSpec.h>
#include <gnomon/spec/SpecTable.h>

#include <algorithm>
#include <set>
#include <stdexcept>

namespace gnomon {
namespace {

[[noreturn]] void refuse(const std::string& sentence) { throw std::invalid_argument(sentence); }

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
