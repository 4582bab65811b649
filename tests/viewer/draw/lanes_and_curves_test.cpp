#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "engine/query/episode_summary.h"
#include "engine/query/model_history.h"
#include "tests/viewer/draw/scenario_run.h"
#include "tests/viewer/draw/svg_check.h"
#include "viewer/draw/curves.h"
#include "viewer/draw/lane_bars.h"
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

TEST(Curves, ASuccessThatBringsAModelBackIsNoCross) {
  // A cross stood over "b at 77 came true", since the model was phased out until then.
  const aerascope::Run run = ScenarioRun("moving_ball.toml");
  ModelHistory history;
  for (const EventId id : run.OfKind<ModelStateChanged>()) {
    const auto& changed = *run.FindBody<ModelStateChanged>(id);
    if (changed.after == ModelState::kActive) history = HistoryOf(run, changed.model);
  }
  ASSERT_FALSE(history.steps.empty());
  std::size_t bad = 0;
  for (const ConfidenceStep& step : history.steps) {
    bad += step.success == false || (!step.success && step.state != ModelState::kActive) ? 1 : 0;
  }
  Svg svg;

  DrawConfidenceCurve(svg, run, history, {0, 0, 960, 70}, {TimeScale({0}, run.end(), 44, 900), 0.25});

  EXPECT_EQ(CountOf(svg.content(), "class=\"d-cross\""), bad);
  EXPECT_NE(svg.content().find(">phased out<"), std::string::npos);
  EXPECT_NE(svg.content().find(">in use again<"), std::string::npos);
}

TEST(Lanes, VetoesOfOneFailureHaveOneSign) {
  const aerascope::Run run = ScenarioRun("hand_grab_sphere_learn.toml");
  Svg svg;

  DrawLanes(svg, run, Summarise(run), 1500);

  EXPECT_NE(svg.content().find(">7 vetoes: release a sphere<"), std::string::npos);
  EXPECT_EQ(svg.content().find("more</text>"), std::string::npos) << "all have room";
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

// Tags whose words had no room were empty boxes.
TEST(Lanes, ATagTooShortForItsWordsKeepsASignOrALetter) {
  const aerascope::Run run = PaperRun();
  const EpisodeSummary summary = Summarise(run);
  for (const int width : {1500, 960, 600, 300}) {
    Svg svg;

    DrawLanes(svg, run, summary, width);

    const std::string content(svg.content());
    const std::regex tag("class=\"d-(teacher|bar|card|failed)\"");
    std::size_t tags = 0;
    for (auto i = std::sregex_iterator(content.begin(), content.end(), tag); i != std::sregex_iterator();
         ++i) {
      const auto next = std::next(i);
      const auto end =
          next == std::sregex_iterator() ? content.size() : static_cast<std::size_t>(next->position());
      const std::string inside = content.substr(static_cast<std::size_t>(i->position()),
                                                end - static_cast<std::size_t>(i->position()));
      EXPECT_TRUE(std::regex_search(inside, std::regex(">[^<]+</text>|d-check|d-cross")))
          << width << ": " << inside;
      ++tags;
    }
    EXPECT_EQ(tags, 5u + 14u + 9u);
    EXPECT_EQ(content.find("too short for their words") != std::string::npos, width < 960) << width;
  }
}

TEST(Lanes, WordsOfATagBecomeFewer) {
  const aerascope::Run run = PaperRun();
  const std::vector<PredictionRecordOfRun> predictions = Summarise(run).predictions;

  std::set<std::string> targets;
  for (const auto& [prediction, target] : ShortTargets(run, predictions)) targets.insert(target);

  EXPECT_TRUE(targets.contains("at s1")) << "the thing that is at the place it speaks of";
  EXPECT_TRUE(targets.contains("[s1]"));
  EXPECT_EQ(LastResort("at s1"), "s1");
  EXPECT_EQ(LastResort("[s1 s2]"), "[s1 s2]");
  EXPECT_EQ(LastResort("not at s1"), "not") << "never the opposite of what was expected";
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
