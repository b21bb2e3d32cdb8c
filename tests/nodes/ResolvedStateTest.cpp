// SPDX-License-Identifier: MIT
// What state sets give to a leaf, against osg::State itself.
#include <gnomon/compositor/ResolvedState.h>

#include <gtest/gtest.h>
#include <osg/CullFace>
#include <osg/Depth>
#include <osg/PolygonOffset>
#include <osg/State>
#include <osgUtil/StateGraph>

#include <random>
#include <vector>

namespace {

using A = osg::StateAttribute;

constexpr GLenum modes[] = {GL_BLEND, GL_LIGHTING, GL_CULL_FACE, GL_STENCIL_TEST};
constexpr A::Type types[] = {A::DEPTH, A::CULLFACE, A::POLYGONOFFSET};

osg::ref_ptr<osg::StateAttribute> attributeOf(A::Type type) {
    if (type == A::DEPTH) return new osg::Depth;
    if (type == A::CULLFACE) return new osg::CullFace;
    return new osg::PolygonOffset;
}

/// Gives each mode and attribute or not, with any flags.
osg::ref_ptr<osg::StateSet> anySet(std::mt19937& random) {
    const auto chance = [&random](int of) { return int(random() % unsigned(of)) == 0; };
    const auto flags = [&] { return (chance(3) ? A::OVERRIDE : 0u) | (chance(3) ? A::PROTECTED : 0u); };
    osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
    for (const GLenum mode : modes)
        if (chance(2)) set->setMode(mode, (chance(2) ? A::ON : A::OFF) | flags());
    for (const A::Type type : types)
        if (chance(2)) set->setAttribute(attributeOf(type), A::ON | flags());
    return set;
}

/// A graph below `above`, and the state sets on the way to it.
struct Place {
    osgUtil::StateGraph* graph;
    std::vector<const osg::StateSet*> sets;
};

/// A tree of graphs, as a cull leaves it: some have no state set.
struct Tree {
    explicit Tree(unsigned seed) : random(seed) {
        for (int i = 0; i < 40; ++i) {
            const Place above = places.empty() ? Place{root.get(), {}} : places[random() % places.size()];
            Place place = above;
            kept.push_back(anySet(random));
            place.graph = above.graph->find_or_insert(kept.back());
            place.sets.push_back(kept.back());
            places.push_back(place);
        }
    }
    std::mt19937 random;
    osg::ref_ptr<osgUtil::StateGraph> root = new osgUtil::StateGraph;
    std::vector<osg::ref_ptr<osg::StateSet>> kept;
    std::vector<Place> places;
};

void expectAsOsgHasIt(const Place& place) {
    const osg::ref_ptr<osg::State> state = new osg::State;
    for (const osg::StateSet* set : place.sets) state->pushStateSet(set);
    const osg::ref_ptr<osg::StateSet> resolved = new osg::StateSet;
    state->captureCurrentState(*resolved);
    for (const GLenum mode : modes) {
        const auto value = resolved->getMode(mode);
        const bool given = !(value & A::INHERIT);
        for (const bool unset : {false, true})
            EXPECT_EQ(gnomon::isOn(place.graph, mode, unset), given ? (value & A::ON) != 0 : unset) << mode;
    }
    for (const A::Type type : types)
        EXPECT_EQ(gnomon::resolvedAttribute(place.graph, type), resolved->getAttribute(type)) << type;
}

} // namespace

TEST(ResolvedState, IsThatOfOsgStateWithinAScopeAndWithoutOne) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const Tree tree(seed);
        for (const Place& place : tree.places) expectAsOsgHasIt(place);
        const gnomon::KnownStates scope;
        for (const Place& place : tree.places) expectAsOsgHasIt(place);
        for (const Place& place : tree.places) expectAsOsgHasIt(place); // known by now
    }
}

TEST(ResolvedState, IsFoundAnewInTheNextScopeAndStaysInOneThatHoldsAnother) {
    Tree tree(3);
    const osgUtil::StateGraph* graph = tree.places.front().graph;
    osg::StateSet& set = *tree.kept.front();
    set.setMode(GL_FOG, A::ON);
    {
        const gnomon::KnownStates scope;
        EXPECT_TRUE(gnomon::isOn(graph, GL_FOG));
    }
    set.setMode(GL_FOG, A::OFF);
    const gnomon::KnownStates outer;
    EXPECT_FALSE(gnomon::isOn(graph, GL_FOG));
    {
        const gnomon::KnownStates inner;
        EXPECT_FALSE(gnomon::isOn(graph, GL_FOG));
    }
    set.setMode(GL_FOG, A::ON);
    EXPECT_FALSE(gnomon::isOn(graph, GL_FOG)) << "resolved once, until the outer scope ends";
}

TEST(ResolvedState, OfALongChainIsThatOfItsTop) {
    for (const int known : {0, 31, 100}) {
        const osg::ref_ptr<osgUtil::StateGraph> root = new osgUtil::StateGraph;
        std::vector<osg::ref_ptr<osg::StateSet>> sets;
        const gnomon::KnownStates scope;
        const auto below = [&](osgUtil::StateGraph* graph) {
            sets.push_back(new osg::StateSet);
            return graph->find_or_insert(sets.back());
        };
        for (int i = 0; i < known; ++i) EXPECT_FALSE(gnomon::isOn(below(root), GL_FOG));
        osgUtil::StateGraph* graph = below(root);
        sets.back()->setMode(GL_FOG, A::ON);
        for (int i = 0; i < 1000; ++i) graph = below(graph);
        EXPECT_TRUE(gnomon::isOn(graph, GL_FOG));
    }
}

/// As one that a cull has let go, and a new one at its address.
TEST(ResolvedState, OfAGraphThatTookTheAddressOfAnotherIsItsOwn) {
    const gnomon::KnownStates scope;
    for (int i = 0; i < 100; ++i) {
        osg::ref_ptr<osgUtil::StateGraph> root = new osgUtil::StateGraph;
        const osg::ref_ptr<osg::StateSet> set = new osg::StateSet;
        set->setMode(GL_FOG, i % 2 ? A::ON : A::OFF);
        EXPECT_EQ(gnomon::isOn(root->find_or_insert(set), GL_FOG), i % 2 == 1);
    }
}
