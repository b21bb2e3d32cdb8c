// SPDX-License-Identifier: MIT
#include <gnomon/base/RecentCache.h>
#include <gnomon/group/PerView.h>

#include <gtest/gtest.h>

#include <iterator>
#include <memory>
#include <string>

namespace {

struct Entry {
    char key;
    unsigned lastUse = 0;
};
using Cache = gnomon::RecentCache<Entry>;

/// The keys, the least recently used first.
template <class AnyCache>
std::string keysOf(const AnyCache& cache) {
    std::string keys;
    for (const auto& entry : cache) keys += entry.key;
    return keys;
}

Entry* find(Cache& cache, char key) {
    return cache.find([key](const Entry& entry) { return entry.key == key; });
}

Cache cacheOf(const std::string& keys) {
    Cache cache;
    for (const char key : keys) cache.add({key});
    return cache;
}

} // namespace

TEST(RecentCache, PutsAFoundEntryLastAndElseKeepsTheOrder) {
    Cache cache;
    EXPECT_EQ(find(cache, 'a'), nullptr);
    EXPECT_EQ(cache.add({'a'}).key, 'a');
    cache = cacheOf("abcd");
    EXPECT_EQ(keysOf(cache), "abcd");
    ASSERT_NE(find(cache, 'b'), nullptr);
    EXPECT_EQ(find(cache, 'b')->key, 'b');
    EXPECT_EQ(keysOf(cache), "acdb");
    EXPECT_EQ(find(cache, 'x'), nullptr);
    EXPECT_EQ(keysOf(cache), "acdb");
    *find(cache, 'a') = {'z'};
    EXPECT_EQ(keysOf(cache), "cdbz");
}

/// One at a time: where the owner lowers the bound by many, what is freed is spread over as many calls.
TEST(RecentCache, DropsTheOldestAboveABound) {
    Cache cache = cacheOf("abcd");
    cache.dropOldestBeyond(4);
    EXPECT_EQ(keysOf(cache), "abcd");
    find(cache, 'a');
    cache.dropOldestBeyond(1);
    EXPECT_EQ(keysOf(cache), "cda") << "b was used least recently";
}

TEST(RecentCache, NeverHoldsMoreThanABoundThatIsHeldBeforeAdding) {
    Cache cache;
    for (const char key : std::string("abcdefg")) {
        cache.dropOldestBeyond(1);
        cache.add({key});
    }
    EXPECT_EQ(keysOf(cache), "fg");
}

TEST(RecentCache, DropsWhatIsOldUpToTheFirstThatIsNot) {
    Cache cache;
    for (unsigned use = 1; use <= 4; ++use) cache.add({char('a' + use), use});
    const auto isOld = [](const Entry& entry) { return entry.lastUse < 3; };
    cache.dropWhile(isOld);
    EXPECT_EQ(keysOf(cache), "de");
    cache.dropWhile(isOld);
    EXPECT_EQ(keysOf(cache), "de");
    cache.dropWhile([](const Entry&) { return true; });
    EXPECT_EQ(keysOf(cache), "");
    cache.dropWhile(isOld);
    EXPECT_EQ(keysOf(cache), "");
}

/// As in a cache of maps: an entry is old once it was not used for two calls.
TEST(RecentCache, AnEntryThatIsUsedStays) {
    Cache cache;
    unsigned calls = 0;
    const auto use = [&](char key) {
        ++calls;
        cache.dropWhile([&](const Entry& entry) { return calls - entry.lastUse > 2; });
        Entry* known = find(cache, key);
        (known ? *known : cache.add({key})).lastUse = calls;
    };
    for (const char key : std::string("abab")) use(key);
    EXPECT_EQ(keysOf(cache), "ab");
    for (const char key : std::string("cac")) use(key);
    EXPECT_EQ(keysOf(cache), "ac");
}

TEST(RecentCache, HoldsWhatCannotBeCopiedAtOnePlace) {
    gnomon::RecentCache<std::unique_ptr<char>> cache;
    char* const first = cache.add(std::make_unique<char>('a')).get();
    for (const char key : std::string("bcd")) cache.add(std::make_unique<char>(key));
    const auto* found = cache.find([](const auto& entry) { return *entry == 'a'; });
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->get(), first);
}

TEST(RecentCache, FreesWhatItDrops) {
    gnomon::RecentCache<std::shared_ptr<int>> cache;
    const std::weak_ptr<int> first = cache.add(std::make_shared<int>(1)), second = cache.add(std::make_shared<int>(2));
    cache.dropOldestBeyond(1);
    EXPECT_TRUE(first.expired());
    EXPECT_FALSE(second.expired());
}

TEST(RecentCache, DropsAllThatAreOldWhereverTheyStand) {
    Cache cache = cacheOf("abcd");
    cache.dropIf([](const Entry& entry) { return entry.key == 'b' || entry.key == 'd'; });
    EXPECT_EQ(keysOf(cache), "ac");
}

namespace {

using PerView = gnomon::PerView<std::string>;
const int first = 0, second = 0; // stages, told apart by where they are

} // namespace

TEST(PerView, HasAValueForEachLightInEachViewAndPart) {
    PerView kept;
    const gnomon::ViewKey here{&first, 0}, part{&first, 1}, there{&second, 0};
    kept.of(here, 0, 1) = "a";
    kept.of(here, 1, 1) = "b";
    kept.of(part, 0, 1) = "c";
    kept.of(there, 0, 1) = "d";
    EXPECT_EQ(kept.of(here, 0, 2) + kept.of(here, 1, 2) + kept.of(part, 0, 2) + kept.of(there, 0, 2), "abcd");
    kept.dropIf([](const std::string& value) { return value == "c"; });
    EXPECT_EQ(kept.of(part, 0, 3), "");
}

/// 60 rounds without a question are borne, 61 are not; of two views that count no frames a round is both.
TEST(PerView, LetsGoWhatNobodyAskedForInSixtyRounds) {
    for (const bool counts : {true, false})
        for (const unsigned others : {60u, 61u}) {
            PerView kept;
            kept.of({&first, 0}, 0, 1) = "a";
            kept.of({&second, 0}, 0, 1) = "b";
            const unsigned begun = kept.round();
            for (unsigned i = 1; i <= others; ++i) EXPECT_EQ(kept.of({&second, 0}, 0, counts ? 1 + i : 1), "b");
            EXPECT_EQ(kept.round() - begun, others) << counts;
            EXPECT_EQ(std::distance(kept.begin(), kept.end()), others == 60 ? 2 : 1) << counts;
        }
}
