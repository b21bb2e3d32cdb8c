// SPDX-License-Identifier: MIT
// What work takes on a machine: kept as text, and corrected by frames.
#include <gnomon/choice/CostCorrection.h>
#include <gnomon/choice/CostRatios.h>
#include <gnomon/choice/RatioFile.h>

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <unistd.h>

namespace fs = std::filesystem;

using gnomon::CostCorrection;
using gnomon::CostRatios;

TEST(CostRatios, AreTimesOfTheDefaults) {
    CostRatios twice;
    twice.processor = 2.0;
    twice.tap = 3.0;
    const gnomon::CostRates rates = twice.rates(), usual;
    EXPECT_DOUBLE_EQ(rates.ray, 2.0 * usual.ray);
    EXPECT_DOUBLE_EQ(rates.object, 2.0 * usual.object);
    EXPECT_DOUBLE_EQ(rates.pixel, 3.0 * usual.pixel);
    EXPECT_DOUBLE_EQ(rates.call, usual.call);
}

TEST(CostRatios, ComeBackFromTheirText) {
    CostRatios given;
    given.call = 0.125;
    given.relit = 31.5;
    given.tests = 3;
    const auto read = CostRatios::parse(given.text());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->text(), given.text());
    EXPECT_EQ(read->call, 0.125);
    EXPECT_EQ(read->relit, 31.5);
    EXPECT_EQ(read->tests, 3u);
}

TEST(CostRatios, AreRefusedIfAnyIsMissingOrOutOfRange) {
    const std::string whole = CostRatios().text();
    const auto with = [&](const std::string& value) {
        std::string text = whole;
        return CostRatios::parse(text.replace(text.find(' ') + 1, 1, value));
    };
    EXPECT_TRUE(with("1"));
    for (const char* wrong : {"0", "-1", "nan", "inf", "1e5", "1e-5", "x", ""}) EXPECT_FALSE(with(wrong)) << wrong;
    EXPECT_FALSE(CostRatios::parse(whole.substr(0, whole.size() / 2)));
    EXPECT_FALSE(CostRatios::parse(whole + "more 1\n"));
    EXPECT_FALSE(CostRatios::parse(""));
}

TEST(CostRatios, AreRefusedWithoutACountOfTests) {
    std::string text = CostRatios().text();
    const std::size_t from = text.rfind('1');
    for (const char* wrong : {"0", "6", "-1", "x", ""})
        EXPECT_FALSE(CostRatios::parse(std::string(text).replace(from, 1, wrong)));
    EXPECT_TRUE(CostRatios::parse(std::string(text).replace(from, 1, "5")));
}

// What else a machine does can only make a test slower.
TEST(CostRatios, OfSeveralTestsAreTheLeast) {
    CostRatios slow, other;
    slow.call = 4.0, slow.texel = 0.5, slow.tests = 4;
    other.call = 2.0, other.texel = 3.0;
    const CostRatios least = slow.leastWith(other);
    EXPECT_EQ(least.call, 2.0);
    EXPECT_EQ(least.texel, 0.5);
    EXPECT_EQ(least.relit, 1.0);
    EXPECT_EQ(least.tests, 5u);
    EXPECT_EQ(least.leastWith(other).tests, 5u);
}

TEST(CostRatios, AreBroughtToTheirRange) {
    CostRatios wild;
    wild.call = std::numeric_limits<double>::quiet_NaN();
    wild.texel = 1e9;
    wild.tap = -2.0;
    EXPECT_TRUE(CostRatios::parse(wild.clamped().text()));
    EXPECT_EQ(wild.clamped().call, 1.0);
}

TEST(UserCache, IsWhereTheVariablesSay) {
    setenv("HOME", "/home/anna", 1);
    setenv("XDG_CACHE_HOME", "/var/anna", 1);
    EXPECT_EQ(gnomon::userCache(), std::filesystem::path("/var/anna/gnomon"));
    setenv("XDG_CACHE_HOME", "relative", 1); // which the specification has ignored
    EXPECT_EQ(gnomon::userCache(), std::filesystem::path("/home/anna/.cache/gnomon"));
    unsetenv("XDG_CACHE_HOME");
    EXPECT_EQ(gnomon::userCache(), std::filesystem::path("/home/anna/.cache/gnomon"));
    unsetenv("HOME");
    EXPECT_FALSE(gnomon::userCache());
}

TEST(RatioFile, IsAnotherForEachRenderer) {
    EXPECT_NE(gnomon::RatioFile("/tmp", "a, OpenGL 4.5").path(), gnomon::RatioFile("/tmp", "a, OpenGL 4.6").path());
    EXPECT_FALSE(gnomon::RatioFile("/nowhere", "a").read().ratios);
    EXPECT_EQ(gnomon::RatioFile("/nowhere", "a").read().trouble, "") << "that there is none is no fault";
}

TEST(RatioFile, IsReadAsItWasWrittenAndSaysWhatItCannotRead) {
    const fs::path folder = fs::temp_directory_path() / ("gnomon-ratios-" + std::to_string(getpid()));
    const gnomon::RatioFile file(folder / "made" / "anew", "renderer\nof two lines");
    CostRatios given;
    given.texel = 2.5;
    EXPECT_EQ(file.write(given), "");
    ASSERT_TRUE(file.read().ratios);
    EXPECT_EQ(file.read().ratios->texel, 2.5);
    EXPECT_EQ(std::distance(fs::directory_iterator(file.path().parent_path()), {}), 1) << "nothing else is left";
    const std::string whole = "gnomon cost ratios 2\nrenderer of two lines\n" + given.text();
    for (const std::string& broken :
         {std::string(), whole.substr(0, 40), whole + "1", "x" + whole, std::string(1 << 17, ' ')}) {
        std::ofstream(file.path()) << broken;
        EXPECT_FALSE(file.read().ratios) << broken.size();
        EXPECT_NE(file.read().trouble.find("cannot be read as measured costs"), std::string::npos) << broken.size();
    }
    fs::remove(file.path());
    fs::create_directory(file.path());
    EXPECT_NE(file.read().trouble, "") << "a folder in its place";
    EXPECT_NE(file.write(given).find("cannot be written"), std::string::npos);
    EXPECT_EQ(std::distance(fs::directory_iterator(file.path().parent_path()), {}), 1)
        << "nothing half-written is left";
    fs::remove_all(folder);
}

TEST(RatioFile, ThatWasUsedLastIsKnownWithoutItsRenderer) {
    const fs::path folder = fs::temp_directory_path() / ("gnomon-last-" + std::to_string(getpid()));
    EXPECT_FALSE(gnomon::RatioFile::usedLast(folder)) << "there is none";
    const gnomon::RatioFile first(folder, "a"), second(folder, "b"), broken(folder, "c");
    CostRatios one, two;
    one.call = 1.5;
    two.call = 2.5;
    for (const auto& [file, ratios] : {std::make_pair(&first, one), {&second, two}, {&broken, one}})
        EXPECT_EQ(file->write(ratios), "");
    std::ofstream(broken.path()) << "nonsense";
    std::ofstream(folder / "notes.txt") << "gnomon cost ratios 2\nd\n" << CostRatios().text();
    const auto now = fs::file_time_type::clock::now();
    fs::last_write_time(first.path(), now - std::chrono::hours(2));
    fs::last_write_time(second.path(), now - std::chrono::hours(1));
    ASSERT_TRUE(gnomon::RatioFile::usedLast(folder));
    EXPECT_EQ(gnomon::RatioFile::usedLast(folder)->call, 2.5);
    first.touch();
    EXPECT_EQ(gnomon::RatioFile::usedLast(folder)->call, 1.5);
    fs::remove_all(folder);
}

TEST(CostCorrection, IsTheMiddleOfWhatFramesTookOnceThreeAgree) {
    CostCorrection correction;
    EXPECT_FALSE(correction.add(3.0, 1.0));
    EXPECT_FALSE(correction.add(3.0, 1.0));
    EXPECT_EQ(correction.factor(), 1.0);
    EXPECT_TRUE(correction.add(100.0, 1.0)) << "the middle of three";
    EXPECT_DOUBLE_EQ(correction.factor(), 3.0);
}

TEST(CostCorrection, LetsSmallErrorsAndOddFramesBe) {
    CostCorrection correction;
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(correction.add(i % 5 == 0 ? 50.0 : 1.2, 1.0));
    EXPECT_EQ(correction.factor(), 1.0);
    for (int i = 0; i < 20; ++i) correction.add(1.3, 1.0);
    EXPECT_DOUBLE_EQ(correction.factor(), 1.3);
    for (int i = 0; i < 20; ++i) EXPECT_FALSE(correction.add(1.2, 1.0)) << "it stays";
}

TEST(CostCorrection, HasItsRangeAndTakesNumbersOnly) {
    CostCorrection correction;
    for (const double wrong : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()})
        for (int i = 0; i < 5; ++i) EXPECT_FALSE(correction.add(wrong, 1.0) || correction.add(1.0, wrong)) << wrong;
    for (int i = 0; i < 5; ++i) correction.add(1e6, 1.0);
    EXPECT_EQ(correction.factor(), CostCorrection::range);
}
