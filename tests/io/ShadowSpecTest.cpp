// SPDX-License-Identifier: MIT
#include "SpecScene.h"

#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/spec/SpecTable.h>
#include <gtest/gtest.h>

#include <limits>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace {

using namespace gnomon;
using test::groupOf;
using test::square;

std::string refusal(const std::string& text) {
    try {
        parseShadowSpec(text);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}

/// Does not compile with a field more or less: then the tests below need a look.
auto fieldsOf(const ShadowMapOptions& options) {
    const auto [size, filter, cascades, edges, sunAngle, lampSize, radius, view, programUnit] = options;
    return std::tuple(size, filter, cascades, edges, sunAngle, lampSize, radius, view, programUnit);
}

auto fieldsOf(const TerrainShadowOptions& options) { return std::tuple(options.method); }

auto propertiesOf(const ShadowMapTechnique& map) {
    return std::tuple(map.getSize(), map.getFilter(), map.getCascades(), map.getEdges(), map.getSunAngle(),
                      map.getLampSize(), map.getRadius(), map.getView(), map.getProgramUnit());
}

/// A technique as a specification makes it, receiving on a square named "ground".
template <typename Technique>
osg::ref_ptr<Technique> made(const std::string& text) {
    return dynamic_cast<Technique*>(addShadows(*groupOf(square("ground", 1)), {parseShadowSpec(text)}).at(0).get());
}

TEST(Options, OfAFreshTechniqueAreTheDefaults) {
    osg::ref_ptr<ShadowMapTechnique> map = new ShadowMapTechnique;
    EXPECT_EQ(fieldsOf(map->getOptions()), fieldsOf(ShadowMapOptions()));
    EXPECT_EQ(propertiesOf(*map), fieldsOf(ShadowMapOptions()));
    osg::ref_ptr<TerrainShadowGeode> terrain = new TerrainShadowGeode;
    EXPECT_EQ(fieldsOf(terrain->getOptions()), fieldsOf(TerrainShadowOptions()));
    EXPECT_EQ(std::tuple(terrain->getMethod()), fieldsOf(TerrainShadowOptions()));
}

TEST(Options, OfASpecificationWithoutKeysAreTheDefaults) {
    EXPECT_EQ(propertiesOf(*made<ShadowMapTechnique>("map")), fieldsOf(ShadowMapOptions()));
    EXPECT_EQ(made<TerrainShadowGeode>("hull")->getMethod(), TerrainShadowOptions().method);
}

TEST(Options, AreMadeUsableAsTheSettersMakeThem) {
    ShadowMapOptions odd;
    odd.size = 1;
    odd.filter = ShadowMapTechnique::Filter(7);
    odd.cascades = 9;
    odd.edges = ShadowMapTechnique::Edges(-1);
    odd.sunAngle = 90.0;
    odd.lampSize = std::numeric_limits<double>::quiet_NaN();
    odd.radius = -1.0;
    odd.view = ShadowMapTechnique::View(4);
    odd.programUnit = 32;
    osg::ref_ptr<ShadowMapTechnique> map = new ShadowMapTechnique;
    map->setOptions(odd);
    EXPECT_EQ(propertiesOf(*map), std::tuple(16, ShadowMapTechnique::BICUBIC, 4, ShadowMapTechnique::HARD, 20.0, 0.0,
                                             0.0, ShadowMapTechnique::NOTHING, -1));
    osg::ref_ptr<TerrainShadowGeode> terrain = new TerrainShadowGeode;
    terrain->setOptions({TerrainShadowGeode::Method(3)});
    EXPECT_EQ(fieldsOf(terrain->getOptions()), fieldsOf(TerrainShadowOptions()));
    terrain->setOptions({TerrainShadowGeode::BOX});
    EXPECT_EQ(fieldsOf(terrain->getOptions()), std::tuple(TerrainShadowGeode::BOX));
}

TEST(SpecTable, PrintsTheDefaultsThatAreSet) {
    osg::ref_ptr<ShadowCasterGroup> fresh = new ShadowCasterGroup;
    for (const SpecTechnique& technique : specTechniques())
        for (const SpecKey& key : keysOf(technique)) {
            if (key.name == "receiver") continue;
            ShadowSpec spec;
            EXPECT_TRUE(key.take(spec, key.byDefault)) << technique.name << ": " << key.name << "=" << key.byDefault;
            EXPECT_EQ(fieldsOf(spec.map), fieldsOf(ShadowMapOptions())) << key.name;
            EXPECT_EQ(spec.composite.value_or(fresh->getComposite()), fresh->getComposite());
            EXPECT_EQ(spec.dark.value_or(fresh->getDark()), fresh->getDark());
        }
}

TEST(SpecTable, HasAKeyForEachOptionButTheUnitOfAProgram) {
    EXPECT_EQ(requireTechnique("map").keys.size() + 1, std::tuple_size_v<decltype(fieldsOf(ShadowMapOptions()))>);
}

TEST(SpecTable, NamesOnlyTechniquesThatCanBeAdded) {
    for (const std::string& name : shadowTechniques()) {
        const auto added = addShadows(*groupOf(square("ground", 1)), {parseShadowSpec(name)});
        EXPECT_EQ(added.size(), name == "none" ? 0u : 1u) << name;
    }
}

TEST(ShadowSpec, ANameAloneHasNothingElseSet) {
    const ShadowSpec spec = parseShadowSpec("planar");
    EXPECT_EQ(spec.technique, "planar");
    EXPECT_FALSE(spec.composite);
    EXPECT_FALSE(spec.dark);
    EXPECT_EQ(spec.receiver, "");
}

TEST(ShadowSpec, KeysOfMapAreReadAndSet) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("floor", 1));
    const auto added =
        addShadows(*group, {parseShadowSpec("map"), parseShadowSpec("map:size=2048,filter=nearest,cascades=3")});
    const auto &plain = dynamic_cast<ShadowMapTechnique&>(*added.at(0)),
               &asked = dynamic_cast<ShadowMapTechnique&>(*added.at(1));
    EXPECT_EQ(plain.getSize(), 1024);
    EXPECT_EQ(plain.getFilter(), ShadowMapTechnique::BICUBIC);
    EXPECT_EQ(plain.getCascades(), 0);
    EXPECT_FALSE(plain.hasReceiver());
    EXPECT_EQ(asked.getCascades(), 3);
    EXPECT_EQ(asked.getSize(), 2048);
    EXPECT_EQ(asked.getFilter(), ShadowMapTechnique::NEAREST);
    EXPECT_EQ(refusal("map:size=8"), "size=8 cannot be used. Allowed: 16 to 16384, texels.");
    EXPECT_EQ(parseShadowSpec("map:cascades=auto").map.cascades, 0);
    EXPECT_EQ(refusal("map:cascades=0"), "cascades=0 cannot be used. Allowed: auto, 1 to 4.");
    EXPECT_EQ(refusal("map:cascades=5"), "cascades=5 cannot be used. Allowed: auto, 1 to 4.");
    EXPECT_EQ(plain.getEdges(), ShadowMapTechnique::HARD);
    EXPECT_EQ(parseShadowSpec("map:filter=fine").map.filter, ShadowMapTechnique::FINE);
    EXPECT_EQ(refusal("map:filter=soft"), "filter=soft cannot be used. Allowed: nearest, bilinear, bicubic, fine.");
}

TEST(ShadowSpec, KeysOfSoftMapsAreReadAndSet) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("floor", 1));
    const auto added =
        addShadows(*group, {parseShadowSpec("map:edges=soft,sun-angle=2.5,lamp-size=0.25,radius=3,view=map"),
                            parseShadowSpec("map:edges=hard"), parseShadowSpec("map:edges=smooth")});
    const auto& soft = dynamic_cast<ShadowMapTechnique&>(*added.at(0));
    EXPECT_EQ(soft.getEdges(), ShadowMapTechnique::SOFT);
    EXPECT_EQ(soft.getSunAngle(), 2.5);
    EXPECT_EQ(soft.getLampSize(), 0.25);
    EXPECT_EQ(soft.getRadius(), 3.0);
    EXPECT_EQ(soft.getView(), ShadowMapTechnique::MAP);
    EXPECT_EQ(dynamic_cast<ShadowMapTechnique&>(*added.at(1)).getEdges(), ShadowMapTechnique::HARD);
    EXPECT_EQ(dynamic_cast<ShadowMapTechnique&>(*added.at(2)).getEdges(), ShadowMapTechnique::SMOOTH);
    EXPECT_EQ(parseShadowSpec("map:view=texels").map.view, ShadowMapTechnique::TEXELS);
    EXPECT_EQ(refusal("map:view=x"), "view=x cannot be used. Allowed: nothing, map, texels, cascades.");
    EXPECT_EQ(refusal("map:edges=round"), "edges=round cannot be used. Allowed: hard, smooth, soft.");
    EXPECT_EQ(refusal("map:sun-angle=21"), "sun-angle=21 cannot be used. Allowed: 0 to 20, degrees.");
    EXPECT_EQ(refusal("map:lamp-size=-1"), "lamp-size=-1 cannot be used. Allowed: 0 to 1e6, scene's unit.");
    EXPECT_EQ(refusal("map:radius=nan"), "radius=nan cannot be used. Allowed: 0 to 1e6, scene's unit.");
}

TEST(ShadowSpec, KeysAreRead) {
    const ShadowSpec spec = parseShadowSpec("planar:composite=blend,dark=0.25,receiver=the floor");
    EXPECT_EQ(spec.composite, ShadowCasterGroup::BLEND);
    EXPECT_EQ(spec.dark, 0.25f);
    EXPECT_EQ(spec.receiver, "the floor");
    EXPECT_EQ(parseShadowSpec("planar:composite=relight").composite, ShadowCasterGroup::RELIGHT);
}

TEST(ShadowSpec, AutoTakesAnErrorAndATime) {
    EXPECT_EQ(parseShadowSpec("auto").budget.error, 0.0);
    EXPECT_EQ(parseShadowSpec("auto:error=0.4,time=5").budget.error, 0.4);
    EXPECT_EQ(parseShadowSpec("auto:error=0.4,time=5").budget.time, 5.0);
    EXPECT_EQ(refusal("auto:error=0"), "error=0 cannot be used. Allowed: auto, 0.01 to 100, pixels.");
    EXPECT_EQ(refusal("auto:time=fast"), "time=fast cannot be used. Allowed: unlimited, 0.01 to 10000, ms.");
    const auto group = groupOf(square("floor", 1));
    const auto added = addShadows(*group, {parseShadowSpec("auto:error=0.4,time=5,receiver=floor")});
    const auto& shadow = dynamic_cast<const gnomon::AutoShadowTechnique&>(*added.at(0));
    EXPECT_EQ(shadow.getError(), 0.4);
    EXPECT_EQ(shadow.getTime(), 5.0);
    EXPECT_TRUE(shadow.hasReceiver());
}

TEST(ShadowSpec, UnknownNamesAreRefusedWithThoseAllowed) {
    const std::string allowed = "Allowed: none, planar, box, hull, map, volume, traced, auto.";
    EXPECT_EQ(refusal("plane"), "\"plane\" is not a shadow technique. " + allowed);
    EXPECT_EQ(refusal(""), "\"\" is not a shadow technique. " + allowed);
    EXPECT_EQ(refusal("Planar"), "\"Planar\" is not a shadow technique. " + allowed);
}

TEST(ShadowSpec, BoxAndHullTakeTheTerrain) {
    const auto group = groupOf(square("hills", 1));
    const auto added =
        addShadows(*group, {parseShadowSpec("box:receiver=hills"), parseShadowSpec("hull:receiver=hills")});
    ASSERT_EQ(added.size(), 2u);
    for (unsigned i = 0; i < 2; ++i) {
        const auto& shadow = dynamic_cast<const gnomon::TerrainShadowGeode&>(*added[i]);
        EXPECT_EQ(shadow.getMethod(), i == 0 ? gnomon::TerrainShadowGeode::BOX : gnomon::TerrainShadowGeode::HULL);
        EXPECT_EQ(shadow.getReceiver().node->getName(), "hills");
    }
    EXPECT_EQ(refusal("hull:error=1"), "the technique hull has no key \"error\". Allowed: composite, dark, receiver.");
}

TEST(ShadowSpec, DrapeIsRefusedWithWhatTakesItsPlace) {
    EXPECT_EQ(refusal("drape:error=0.1"),
              "there is no technique drape any more. Use hull on terrain, which is exact there, or "
              "map or traced if other surfaces receive.");
}

TEST(ShadowSpec, UnknownKeysAreRefusedWithThoseAllowed) {
    EXPECT_EQ(refusal("planar:size=4096"),
              "the technique planar has no key \"size\". Allowed: composite, dark, receiver.");
    EXPECT_EQ(refusal("planar:"), "the technique planar has no key \"\". Allowed: composite, dark, receiver.");
    EXPECT_EQ(refusal("planar:composite=blend,"),
              "the technique planar has no key \"\". Allowed: composite, dark, receiver.");
}

TEST(ShadowSpec, ValuesOutOfRangeAreRefusedWithTheRange) {
    for (const char* value : {"-0.1", "1.01", "nan", "inf", "", "half", "0.5x", "1e99"})
        EXPECT_EQ(refusal(std::string("planar:composite=blend,dark=") + value),
                  std::string("dark=") + value + " cannot be used. Allowed: 0 to 1.");
    EXPECT_EQ(refusal("planar:composite=mix"), "composite=mix cannot be used. Allowed: relight, blend.");
    EXPECT_EQ(refusal("planar:receiver="), "receiver= cannot be used. Allowed: a node's name.");
    EXPECT_EQ(refusal("planar:receiver"), "receiver= cannot be used. Allowed: a node's name.");
}

TEST(ShadowSpec, TheEndsOfARangeAreAllowed) {
    EXPECT_EQ(parseShadowSpec("planar:composite=blend,dark=0").dark, 0.0f);
    EXPECT_EQ(parseShadowSpec("planar:dark=1,composite=blend").dark, 1.0f);
}

TEST(ShadowSpec, AKeyGivenTwiceIsRefused) {
    EXPECT_EQ(refusal("planar:receiver=a,receiver=b"),
              "the key \"receiver\" is given twice. Give it once in \"planar:receiver=a,receiver=b\".");
}

TEST(ShadowSpec, DarkWithoutBlendIsRefused) {
    EXPECT_EQ(refusal("planar:dark=0.5"), "dark= needs composite=blend. Add it to \"planar:dark=0.5\".");
}

TEST(ShadowSpec, HelpNamesEveryTechniqueAndKey) {
    const std::string help = shadowSpecHelp();
    for (const std::string& name : shadowTechniques()) EXPECT_NE(help.find("  " + name + "  "), std::string::npos);
    for (const SpecTechnique& technique : specTechniques())
        for (const SpecKey& key : keysOf(technique)) {
            EXPECT_NE(help.find("    " + key.name + "=  "), std::string::npos) << key.name;
            EXPECT_NE(help.find("allowed " + key.allowed() + ", default "), std::string::npos) << key.name;
        }
    EXPECT_NE(help.find("default map, volume, traced, auto: everything; else: ground"), std::string::npos);
    std::istringstream lines(help);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120u) << line;
}

} // namespace
