// SPDX-License-Identifier: MIT
// Specification strings: what they set, what they add to a group, what is refused.
#include <gnomon/AutoShadowTechnique.h>
#include <gnomon/NamedNode.h>
#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowSpec.h>
#include <gnomon/ShadowVolumeTechnique.h>
#include <gnomon/TerrainShadowGeode.h>
#include <gnomon/TracedShadowTechnique.h>
#include <gnomon/spec/SpecTable.h>
#include <gtest/gtest.h>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osg/ShapeDrawable>

#include <limits>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace {

using namespace gnomon;

/// Square of this side about the origin, z = 0, seen from above.
osg::ref_ptr<osg::Geode> square(const std::string& name, float side) {
    osg::ref_ptr<osg::Geode> geode = new osg::Geode;
    geode->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(-side / 2, -side / 2, 0), osg::Vec3(side, 0, 0),
                                                       osg::Vec3(0, side, 0)));
    geode->setName(name);
    return geode;
}

osg::ref_ptr<ShadowCasterGroup> groupOf(osg::Node* scene) {
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->addChild(scene);
    return group;
}

/// What adding specifications to a group says; "accepted" if nothing.
std::string refusal(ShadowCasterGroup& group, const std::vector<std::string>& texts) {
    try {
        std::vector<ShadowSpec> specs;
        for (const std::string& text : texts) specs.push_back(parseShadowSpec(text));
        addShadows(group, specs);
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "accepted";
}
std::string refusal(const std::string& text) { return refusal(*groupOf(square("ground", 1)), {text}); }

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

TEST(ShadowSpec, KeysAreReadAndSet) {
    const ShadowSpec bare = parseShadowSpec("planar"),
                     spec = parseShadowSpec("planar:composite=blend,dark=0.25,receiver=the floor");
    EXPECT_EQ(bare.technique, "planar");
    EXPECT_FALSE(bare.composite || bare.dark);
    EXPECT_EQ(bare.receiver, "");
    EXPECT_EQ(spec.composite, ShadowCasterGroup::BLEND);
    EXPECT_EQ(spec.dark, 0.25f);
    EXPECT_EQ(spec.receiver, "the floor");
    EXPECT_EQ(parseShadowSpec("planar:composite=relight").composite, ShadowCasterGroup::RELIGHT);
    EXPECT_EQ(parseShadowSpec("planar:composite=blend,dark=0").dark, 0.0f) << "the ends of the range";
    EXPECT_EQ(parseShadowSpec("planar:dark=1,composite=blend").dark, 1.0f);

    const auto map = made<ShadowMapTechnique>(
        "map:size=2048,filter=nearest,cascades=3,edges=soft,sun-angle=2.5,lamp-size=0.25,radius=3,view=map");
    EXPECT_EQ(propertiesOf(*map), std::tuple(2048, ShadowMapTechnique::NEAREST, 3, ShadowMapTechnique::SOFT, 2.5, 0.25,
                                             3.0, ShadowMapTechnique::MAP, -1));
    EXPECT_EQ(parseShadowSpec("map:cascades=auto").map.cascades, 0);
    EXPECT_EQ(parseShadowSpec("map:filter=fine").map.filter, ShadowMapTechnique::FINE);
    EXPECT_EQ(parseShadowSpec("map:edges=smooth").map.edges, ShadowMapTechnique::SMOOTH);
    EXPECT_EQ(parseShadowSpec("map:view=texels").map.view, ShadowMapTechnique::TEXELS);

    EXPECT_EQ(parseShadowSpec("auto").budget.error, 0.0);
    const auto choice = made<AutoShadowTechnique>("auto:error=0.4,receiver=ground");
    EXPECT_EQ(choice->getError(), 0.4);
    EXPECT_EQ(made<ShadowVolumeTechnique>("volume:view=volumes")->getView(), ShadowVolumeTechnique::VOLUMES);
    EXPECT_EQ(made<TerrainShadowGeode>("box")->getMethod(), TerrainShadowGeode::BOX);
    EXPECT_EQ(made<TerrainShadowGeode>("hull")->getMethod(), TerrainShadowGeode::HULL);
    EXPECT_EQ(made<TerrainShadowGeode>("hull:edges=smooth")->getEdges(), TerrainShadowGeode::SMOOTH);
    EXPECT_EQ(made<ShadowVolumeTechnique>("volume:edges=smooth")->getEdges(), ShadowVolumeTechnique::SMOOTH);
    EXPECT_EQ(made<ShadowVolumeTechnique>("volume")->getEdges(), ShadowVolumeTechnique::HARD);
    EXPECT_EQ(made<PlanarShadowNode>("planar:edges=smooth")->getEdges(), PlanarShadowNode::SMOOTH);
    EXPECT_EQ(made<gnomon::TracedShadowTechnique>("traced:edges=smooth")->getEdges(),
              gnomon::TracedShadowTechnique::SMOOTH);
}

TEST(ShadowSpec, IsRefusedWithWhatIsAllowed) {
    const std::string names = "Allowed: none, planar, box, hull, map, volume, traced, auto.",
                      keys = "Allowed: edges, composite, dark, terminator, receiver.",
                      cannot = " cannot be used. Allowed: ";
    const std::pair<std::string, std::string> cases[] = {
        {"plane", "\"plane\" is not a shadow technique. " + names},
        {"", "\"\" is not a shadow technique. " + names},
        {"Planar", "\"Planar\" is not a shadow technique. " + names},
        {"drape:error=0.1", "there is no technique drape any more. Use hull on terrain, which is exact there, or "
                            "map or traced if other surfaces receive."},
        {"planar:size=4096", "the technique planar has no key \"size\". " + keys},
        {"planar:", "the technique planar has no key \"\". " + keys},
        {"planar:composite=blend,", "the technique planar has no key \"\". " + keys},
        {"hull:error=1", "the technique hull has no key \"error\". " + keys},
        {"planar:composite=mix", "composite=mix" + cannot + "relight, blend."},
        {"planar:receiver=", "receiver=" + cannot + "a node's name."},
        {"planar:receiver", "receiver=" + cannot + "a node's name."},
        {"planar:receiver=a,receiver=b",
         "the key \"receiver\" is given twice. Give it once in \"planar:receiver=a,receiver=b\"."},
        {"planar:dark=0.5", "dark= needs composite=blend. Add it to \"planar:dark=0.5\"."},
        {"map:size=8", "size=8" + cannot + "16 to 16384, texels."},
        {"map:cascades=0", "cascades=0" + cannot + "auto, 1 to 4."},
        {"map:cascades=5", "cascades=5" + cannot + "auto, 1 to 4."},
        {"map:filter=soft", "filter=soft" + cannot + "nearest, bilinear, bicubic, fine."},
        {"map:view=x", "view=x" + cannot + "nothing, map, texels, cascades."},
        {"volume:edges=soft", "edges=soft" + cannot + "hard, smooth."},
        {"map:edges=round", "edges=round" + cannot + "hard, smooth, soft."},
        {"map:sun-angle=21", "sun-angle=21" + cannot + "0 to 20, degrees."},
        {"map:lamp-size=-1", "lamp-size=-1" + cannot + "0 to 1e6, scene's unit."},
        {"map:radius=nan", "radius=nan" + cannot + "0 to 1e6, scene's unit."},
        {"auto:error=0", "error=0" + cannot + "auto, 0.01 to 100, pixels."},
        {"auto:time=5",
         "the technique auto has no key \"time\". Allowed: error, composite, dark, terminator, receiver."},
        {"planar:receiver=roof", "no node is named \"roof\" to receive the shadow. Names in the scene: ground. Give "
                                 "one of them as receiver=NAME."},
        {"traced:receiver=roof", "no node is named \"roof\" to receive the shadow. Names in the scene: ground. Give "
                                 "one of them as receiver=NAME."}};
    for (const auto& [text, says] : cases) EXPECT_EQ(refusal(text), says);
    for (const std::string value : {"-0.1", "1.01", "nan", "inf", "", "half", "0.5x", "1e99"})
        EXPECT_EQ(refusal("planar:composite=blend,dark=" + value), "dark=" + value + cannot + "0 to 1.");
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

std::vector<osg::Vec4d> planesOf(ShadowCasterGroup& group, const std::string& text) {
    const auto added = addShadows(group, {parseShadowSpec(text)});
    return dynamic_cast<PlanarShadowNode&>(*added.at(0)).getPlanes();
}

void expectPlane(const osg::Vec4d& seen, const osg::Vec4d& expected) {
    EXPECT_LT((seen / seen.length() - expected / expected.length()).length(), 1e-6)
        << seen.x() << " " << seen.y() << " " << seen.z() << " " << seen.w();
}

TEST(AddShadows, PlanarTakesThePlaneOfTheNodeNamedGround) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("ground", 10));
    const auto added = addShadows(*group, {parseShadowSpec("planar")});
    ASSERT_EQ(added.size(), 1u);
    EXPECT_EQ(group->getChild(1), added[0]);
    EXPECT_EQ(added[0]->getReceiver().node, group->getChild(0));
    ASSERT_EQ(dynamic_cast<PlanarShadowNode&>(*added[0]).getPlanes().size(), 1u);
    expectPlane(dynamic_cast<PlanarShadowNode&>(*added[0]).getPlanes()[0], osg::Vec4d(0, 0, 1, 0));
}

TEST(AddShadows, PlanarFindsTheReceiverWhereTransformsPutIt) {
    osg::ref_ptr<osg::MatrixTransform> above = new osg::MatrixTransform(
        osg::Matrixd::rotate(osg::PI_2, osg::Vec3d(1, 0, 0)) * osg::Matrixd::translate(0, 5, 0));
    osg::ref_ptr<osg::MatrixTransform> wall = new osg::MatrixTransform(osg::Matrixd::translate(0, 0, 2));
    wall->setName("wall"); // z = 2 in `above` is y = -2 after its turn, y = 3 after its step; faces -y
    wall->addChild(square("", 1));
    above->addChild(wall);
    const std::vector<osg::Vec4d> planes = planesOf(*groupOf(above), "planar:receiver=wall");
    ASSERT_EQ(planes.size(), 1u);
    expectPlane(planes[0], osg::Vec4d(0, -1, 0, 3));
}

TEST(AddShadows, PlanarTakesTheSixSidesOfABoxAndNoSliver) {
    osg::ref_ptr<osg::Geode> box = new osg::Geode;
    box->addDrawable(new osg::ShapeDrawable(new osg::Box(osg::Vec3(), 2.0f)));
    box->addDrawable(osg::createTexturedQuadGeometry(osg::Vec3(3, 0, 3), osg::Vec3(0.1f, 0, 0), osg::Vec3(0, 0.1f, 0)));
    box->setName("ground"); // the last quad is 0.01 square, less than 1 % of a side's 4
    EXPECT_EQ(planesOf(*groupOf(box), "planar").size(), 6u);
}

TEST(AddShadows, OthersReceiveEverywhereUnlessAReceiverIsNamed) {
    for (const std::string name : {"map", "volume", "traced", "auto"}) {
        osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("floor", 1));
        const auto added = addShadows(*group, {parseShadowSpec(name), parseShadowSpec(name + ":receiver=floor")});
        ASSERT_EQ(added.size(), 2u);
        EXPECT_FALSE(added[0]->hasReceiver()) << name;
        EXPECT_EQ(added[1]->getReceiver().node, group->getChild(0)) << name;
    }
}

TEST(AddShadows, AllNodesOfAReceiversNameReceive) {
    osg::ref_ptr<osg::Group> town = new osg::Group;
    for (int i = 0; i < 400; ++i) { // steps of 1 in height, 300 of the area of 1, 100 of the area of 4
        const double height = i < 300 ? i % 3 : 3;
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(3 * i, 0, height));
        place->addChild(square("building", i < 300 ? 1 : 2));
        town->addChild(place);
    }
    town->addChild(square("street", 1));
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(town);
    const auto added = addShadows(*group, {parseShadowSpec("map:receiver=building")});
    EXPECT_EQ(added[0]->getReceiver().roots().size(), 400u);
    EXPECT_EQ(planesOf(*group, "planar:receiver=building").size(), 4u);
}

TEST(AddShadows, PlanarTakesWhatManySmallReceiversMakeTogether) {
    osg::ref_ptr<osg::Group> town = new osg::Group;
    for (int i = 0; i < 20; ++i) { // 20 of 1 at the height of 1, beside one of 400
        osg::ref_ptr<osg::MatrixTransform> place = new osg::MatrixTransform(osg::Matrixd::translate(3 * i, 0, 1));
        place->addChild(square("ground", 1));
        town->addChild(place);
    }
    town->addChild(square("ground", 20));
    EXPECT_EQ(planesOf(*groupOf(town), "planar").size(), 2u) << "5 %, where one alone is 0.25 %";
}

TEST(AddShadows, AMissingReceiverOrOneWithNothingFlatIsRefused) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("floor", 1));
    EXPECT_EQ(refusal(*group, {"traced", "planar"}), "no node is named \"ground\" to receive the shadow. Names in the "
                                                     "scene: floor. Give one of them as receiver=NAME.");
    EXPECT_EQ(group->getNumChildren(), 1u) << "nothing is added when something is refused";
    osg::ref_ptr<osg::Group> empty = new osg::Group;
    empty->setName("ground");
    EXPECT_EQ(refusal(*groupOf(empty), {"planar"}),
              "the receiver \"ground\" has no flat part, which planar needs. Name another one with receiver=NAME.");
}

TEST(AddShadows, CompositeBelongsToTheWholeGroup) {
    osg::ref_ptr<ShadowCasterGroup> group = groupOf(square("ground", 1));
    EXPECT_EQ(refusal(*group, {"planar", "planar:composite=blend"}),
              "composite=relight and composite=blend cannot be mixed. Give every shadow the same.");
    EXPECT_EQ(refusal(*group, {"planar:composite=blend,dark=0.3", "planar:composite=blend,dark=0.3"}), "accepted");
    EXPECT_EQ(group->getComposite(), ShadowCasterGroup::BLEND);
    EXPECT_FLOAT_EQ(group->getDark(), 0.3f);
}

TEST(NamedNode, IsTheFirstWithExactlyThatName) {
    osg::ref_ptr<osg::Group> root = new osg::Group;
    osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(1, 2, 3));
    osg::ref_ptr<osg::Node> first = square("floor", 1);
    first->setNodeMask(0);
    moved->addChild(square("floor2", 1));
    moved->addChild(first);
    root->addChild(moved);
    root->addChild(square("floor", 1));
    const auto found = findNamed(*root, "floor");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->node, first);
    EXPECT_EQ(found->rootFromParent.getTrans(), osg::Vec3d(1, 2, 3));
    EXPECT_FALSE(findNamed(*root, "Floor"));
    EXPECT_FALSE(findNamed(*root, ""));
}

} // namespace
