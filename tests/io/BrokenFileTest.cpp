// SPDX-License-Identifier: MIT
// Scene files cut short or garbled: refused, or read as far as they make sense; never a crash.
#include "SceneText.h"

#include <gnomon/PlanarShadowNode.h>
#include <gnomon/ShadowCasterGroup.h>
#include <gtest/gtest.h>

#include <osg/Notify>

#include <cctype>
#include <random>

namespace {

using gnomon::PlanarShadowNode;
using gnomon::ShadowCasterGroup;

class BrokenFile : public testing::TestWithParam<const char*> {
protected:
    static void SetUpTestSuite() {
        test::usePluginsOfThisBuild();
        osg::setNotifyLevel(osg::FATAL); // else thousands of warnings
    }

    void SetUp() override {
        osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
        osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode(osg::Vec4d(0.0, 0.0, 1.0, -0.125));
        osg::ref_ptr<osg::LightSource> source = new osg::LightSource;
        group->addChild(source);
        group->addChild(node);
        group->setCasters({source, 0xffu});
        group->setComposite(ShadowCasterGroup::BLEND);
        group->setDark(0.3f);
        group->addLight(source);
        group->setLights({{1, {1.0, 2.0, 3.0, 1.0}}, {2, {4.0, 5.0, 6.0, 0.0}}});
        node->setReceiver({source, 0x0fu});
        whole = test::written(*group, kind());
        ASSERT_TRUE(test::loaded(whole, kind()));
    }

    std::string kind() const { return GetParam(); }
    bool isCutInNumber(std::size_t length) const {
        return kind() == "osgt" && (std::isdigit(static_cast<unsigned char>(whole[length])) || whole[length] == '.');
    }

    std::string whole;
};
INSTANTIATE_TEST_SUITE_P(EveryKind, BrokenFile, testing::Values("osgt", "osgb"),
                         [](const auto& test) { return std::string(test.param); });

/// Each property is the whole file's or, where the file ended before it, the default: none is half read.
void expectWholeProperties(const ShadowCasterGroup& group, const ShadowCasterGroup& whole) {
    const osg::ref_ptr<ShadowCasterGroup> fresh = new ShadowCasterGroup;
    EXPECT_TRUE(group.getCasters().mask == whole.getCasters().mask || group.getCasters() == fresh->getCasters());
    EXPECT_TRUE(group.getComposite() == whole.getComposite() || group.getComposite() == fresh->getComposite());
    EXPECT_TRUE(group.getDark() == whole.getDark() || group.getDark() == fresh->getDark());
    EXPECT_TRUE(group.getLightSources().size() == 1 || group.getLightSources().empty());
    EXPECT_TRUE(group.getLights() == whole.getLights() || group.getLights().empty());
}

/// In text OSG takes an end between two properties for the object's own; and "0." may be all of a factor, so that a
/// file cut there is left out.
TEST_P(BrokenFile, IsRefusedOrHasNoPropertyHalfReadWhereverItIsCutShort) {
    const auto uncut = test::loadedAs<ShadowCasterGroup>(whole, kind());
    const std::size_t end = whole.find_last_not_of("}\n ") + 1; // from there on no more than brackets is missing
    std::size_t refused = 0;
    for (std::size_t length = 0; length < end; ++length) {
        const auto cut = test::loadedAs<ShadowCasterGroup>(whole.substr(0, length), kind());
        if (cut && !isCutInNumber(length)) expectWholeProperties(*cut, *uncut);
        refused += !cut;
    }
    EXPECT_GE(refused, kind() == "osgb" ? end : end * 3 / 4);
}

/// Loads the file once for each of its bytes from `start` on and each of four values in its place.
void loadWithBytesChanged(const std::string& whole, std::size_t start, const std::string& kind) {
    std::mt19937 random(1);
    for (std::size_t place = start; place < whole.size(); ++place)
        for (const int byte : {0x00, 0x7f, 0xff, static_cast<int>(random() & 0xffu)}) {
            std::string garbled = whole;
            garbled[place] = static_cast<char>(byte);
            test::loaded(garbled, kind);
        }
}

TEST_P(BrokenFile, DoesNotCrashWithAnyByteChanged) {
    if (kind() == "osgt") loadWithBytesChanged(whole, 0, kind());
    // In binary only what is Gnomon's own: OSG believes the lengths of its strings, and asks for gigabytes.
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->setLights({{1, {1.0, 2.0, 3.0, 1.0}}, {2, {4.0, 5.0, 6.0, 0.0}}});
    const std::string lights = test::written(*group, kind());
    loadWithBytesChanged(lights, lights.size() - 2 * (4 + 4 * 8) - 8 - 4, kind()); // items, bracket, length
    osg::ref_ptr<PlanarShadowNode> node = new PlanarShadowNode(osg::Vec4d(0.0, 0.0, 1.0, -0.125));
    node->setReceiver({nullptr, 0xdeadbeefu});
    const std::string planes = test::written(*node, kind());
    loadWithBytesChanged(planes, std::min(planes.find("\xef\xbe\xad\xde"), planes.size() - 40), kind());
}

TEST(BrokenFileBinary, HasACompositeWhateverItsNumberIs) {
    test::usePluginsOfThisBuild();
    osg::ref_ptr<ShadowCasterGroup> group = new ShadowCasterGroup;
    group->setComposite(ShadowCasterGroup::BLEND);
    group->setCasters({nullptr, 0xdeadbeefu});
    std::string file = test::written(*group, "osgb");
    const std::size_t composite =
        file.find("\xef\xbe\xad\xde") + 4 + 2; // after the mask, "no node" and "no other nodes"
    ASSERT_EQ(file.substr(composite, 4), std::string("\1\0\0\0", 4));
    file[composite] = 77;
    const auto copy = test::loadedAs<ShadowCasterGroup>(file, "osgb");
    ASSERT_TRUE(copy);
    EXPECT_EQ(copy->getComposite(), ShadowCasterGroup::RELIGHT);
}

TEST(BrokenFileText, IsRefusedWhereANumberIsNoneOrAClassHasNoObjects) {
    test::usePluginsOfThisBuild();
    const std::pair<const char*, bool> cases[] = {
        {"gnomon::PlanarShadowNode { UniqueID 1 Planes 1 { 0 0 1 0 } }", true},
        {"gnomon::PlanarShadowNode { UniqueID 1 Planes 1 { 0 O 1 0 } }", false},
        {"gnomon::PlanarShadowNode { UniqueID 1 Planes 1 { 0 0 1 0,5 } }", false},
        {"gnomon::PlanarShadowNode { UniqueID 1 Planes 2 { 0 0 1 0 } }", false},
        {"gnomon::ShadowCasterGroup { UniqueID 1 Dark 0.5 }", true},
        {"gnomon::ShadowCasterGroup { UniqueID 1 Dark half }", false},
        {"gnomon::ShadowTechnique { UniqueID 1 }\n", false}};
    for (const auto& [object, isRead] : cases)
        EXPECT_EQ(test::loaded(std::string("#Ascii Scene\n#Version 161\n#Generator by hand\n") + object, "osgt") !=
                      nullptr,
                  isRead)
            << object;
}

} // namespace
