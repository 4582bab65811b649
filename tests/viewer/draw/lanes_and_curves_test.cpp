#include <gtest/gtest.h>

#include "engine/query/episode_summary.h"
#include "engine/query/model_history.h"
#include "tests/viewer/draw/svg_check.h"
#include "viewer/draw/curves.h"
#include "viewer/draw/lanes.h"

namespace aerascope {
namespace {

TEST(TimeScale, TicksAreRoundAndNotTooClose) {
  for (const std::int64_t length : {1LL, 7LL, 900LL, 15'000'000LL, 61'000'000LL, 86'400'000'000LL}) {
    const TimeScale scale({0}, {length}, 100, 900);
    const std::vector<Time> ticks = scale.Ticks(50);
    ASSERT_FALSE(ticks.empty());
    for (std::size_t i = 1; i < ticks.size(); ++i)
      EXPECT_GE(scale.X(ticks[i]) - scale.X(ticks[i - 1]), 49) << length;
  }
  EXPECT_EQ(TimeScale({0}, {15'000'000}, 0, 870).Ticks(56).at(1), Time{1'000'000});
}

TEST(TimeScale, TimesOutsideAreHeldInside) {
  const TimeScale scale({1'000'000}, {2'000'000}, 10, 20);
  EXPECT_EQ(scale.X({0}), 10);
  EXPECT_EQ(scale.X({1'500'000}), 15);
  EXPECT_EQ(scale.X(kForever), 20);
  EXPECT_EQ(TimeScale({5}, {5}, 10, 20).X({5}), 10) << "an empty interval is no trouble";
}

TEST(Curves, AnAnalogyStartsAtPsiAndRisesWithSuccess) {
  const aerascope::Run run = PaperRun();
  const EpisodeSummary summary = Summarise(run);
  ASSERT_FALSE(summary.by_analogy.empty());
  const ModelHistory history = HistoryOf(run, summary.by_analogy.front());
  Svg svg;

  DrawConfidenceCurve(svg, run, history, {0, 0, 500, 80}, {TimeScale({0}, run.end(), 40, 440), 0.5});

  EXPECT_NE(svg.content().find(" = ψ 3/4"), std::string::npos);
  EXPECT_NE(svg.content().find(">0.75<"), std::string::npos);
  EXPECT_NE(svg.content().find(">0.92<"), std::string::npos);
  EXPECT_EQ(CountOf(svg.content(), "class=\"d-dot\""), 2u) << "two successes";
}

TEST(Curves, AFailureIsACrossInTheColourOfFailure) {
  PaperEpisodeOptions options;
  options.cylinder_slips = true;
  const aerascope::Run run = PaperRun(options);
  const ModelHistory history = HistoryOf(run, Summarise(run).by_analogy.front());
  Svg svg;

  DrawConfidenceCurve(svg, run, history, {0, 0, 500, 80}, {TimeScale({0}, run.end(), 40, 440), 0.5});

  EXPECT_EQ(CountOf(svg.content(), "class=\"d-cross\""), 1u);
  EXPECT_EQ(LowestQuarter({history}), 0.5);
}

TEST(Lanes, EveryGoalCommandAndPredictionHasItsMark) {
  const aerascope::Run run = PaperRun();
  const EpisodeSummary summary = Summarise(run);
  Svg svg;

  const int height = DrawLanes(svg, run, summary, 1500);

  EXPECT_GT(height, 100);
  EXPECT_EQ(CountOf(svg.content(), "class=\"d-teacher\""), 6u);
  EXPECT_EQ(CountOf(svg.content(), "class=\"d-bar\""), 8u);
  EXPECT_EQ(CountOf(svg.content(), "class=\"d-check\""), 5u + 9u)
      << "goals reached and predictions come true";
  EXPECT_EQ(CountOf(svg.content(), "class=\"d-star\""), 4u);
}

TEST(Lanes, WhatHasNoRoomIsCounted) {
  const aerascope::Run run = LongRun(3000);
  Svg svg;

  DrawLanes(svg, run, Summarise(run), 1500);

  EXPECT_NE(svg.content().find(" more<"), std::string::npos);
  EXPECT_LT(svg.content().size(), 1'000'000u);
}

}  // namespace
}  // namespace aerascope
