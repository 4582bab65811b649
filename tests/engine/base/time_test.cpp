// Oracles: docs on time, and the rules of intervals (half-open, narrowing by intersection).
#include "engine/base/time.h"

#include <gtest/gtest.h>

namespace aerascope {
namespace {

constexpr TimeInterval Ms(std::int64_t after, std::int64_t before) {
  return {{after * 1000}, {before * 1000}};
}

TEST(Synchronous, IsStrictlyCloserThanTenMilliseconds) {
  EXPECT_TRUE(Synchronous({700'000}, {709'999}));
  EXPECT_TRUE(Synchronous({709'999}, {700'000}));
  EXPECT_FALSE(Synchronous({700'000}, {710'000}));
}

TEST(Interval, ContainsItsBeginningAndNotItsEnd) {
  EXPECT_TRUE(Ms(700, 800).Contains({700'000}));
  EXPECT_TRUE(Ms(700, 800).Contains({799'999}));
  EXPECT_FALSE(Ms(700, 800).Contains({800'000}));
}

TEST(Interval, NarrowingIsIntersection) {
  EXPECT_EQ(Intersection(Ms(600, 1000), Ms(700, 800)), Ms(700, 800));
  EXPECT_EQ(Intersection(Ms(700, 800), Ms(750, 900)), Ms(750, 800));
}

TEST(Interval, TouchingEndsDoNotMeet) {
  EXPECT_EQ(Intersection(Ms(700, 800), Ms(800, 900)), std::nullopt);
  EXPECT_EQ(Intersection(Ms(800, 900), Ms(700, 800)), std::nullopt);
}

TEST(Interval, InstantStrictlyInsideMeets) {
  EXPECT_EQ(Intersection(Ms(700, 800), Ms(750, 750)), Ms(750, 750));
  EXPECT_EQ(Intersection(Ms(700, 800), Ms(700, 700)), std::nullopt);
}

TEST(Interval, IncludesIsNotStrict) {
  EXPECT_TRUE(Ms(900, 1000).Includes(Ms(900, 1000)));
  EXPECT_FALSE(Ms(920, 1000).Includes(Ms(900, 1000)));
}

TEST(TimeText, HasAsManyDecimalsAsNeeded) {
  EXPECT_EQ(ToText(Time{0}), "0s");
  EXPECT_EQ(ToText(Time{3'200'000}), "3.2s");
  EXPECT_EQ(ToText(Time{760'000}), "0.76s");
  EXPECT_EQ(ToText(Time{1}), "0.000001s");
  EXPECT_EQ(ToText(Time{-1'500'000}), "-1.5s");
  EXPECT_EQ(ToText(Duration{std::numeric_limits<std::int64_t>::min()}), "-9223372036854.775808s");
  EXPECT_EQ(ToText(kForever), "forever");
  EXPECT_EQ(ToText(Ms(700, 800)), "[0.7s, 0.8s)");
}

TEST(TimeText, WhatIsWrittenIsReadBack) {
  for (const std::int64_t us : {0L, 1L, -1L, 760'000L, 3'200'000L, 123'456'789'012L}) {
    EXPECT_EQ(ParseTime(ToText(Time{us})), Time{us});
    EXPECT_EQ(ParseDuration(ToText(Duration{us})), Duration{us});
  }
  EXPECT_EQ(ParseTime("forever"), kForever);
}

TEST(TimeText, OtherUnitsAreRead) {
  EXPECT_EQ(ParseTime("700ms"), Time{700'000});
  EXPECT_EQ(ParseTime("12us"), Time{12});
  EXPECT_EQ(ParseTime("3"), Time{3'000'000});
  EXPECT_EQ(ParseTime("1e2s"), Time{100'000'000});
}

TEST(TimeText, OtherTextIsRefused) {
  for (const char* text :
       {"", "s", "ms", "x", "1.5.2s", "1 s", " 1s", "1s ", "nan", "inf", "1e300s", "--1", "0x10"}) {
    EXPECT_EQ(ParseTime(text), std::nullopt) << text;
    EXPECT_EQ(ParseDuration(text), std::nullopt) << text;
  }
  EXPECT_EQ(ParseDuration("forever"), std::nullopt);
}

}  // namespace
}  // namespace aerascope
