#include "engine/query/story.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/text.h"
#include "tests/viewer/draw/scenario_run.h"
#include "tests/viewer/draw/svg_check.h"
#include "viewer/draw/key_moments.h"

namespace aerascope {
namespace {

// What is told of the frame that begins at a time; "" where nothing is.
std::string ToldAt(const aerascope::Run& run, Time at) {
  for (const StoryMoment& moment : StoryOf(run, Summarise(run))) {
    if (run.frames()[moment.frame].interval.after == at) return Join(moment.sentences, " ");
  }
  return "";
}

bool Contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Story, AFailureIsToldWithWhatWasMadeOfIt) {
  // The sheet told neither the failure nor what was given up and learned because of it.
  const aerascope::Run run = ScenarioRun("size_pruned_first_scripted.toml");

  const std::string told = ToldAt(run, Time{600'000});

  EXPECT_TRUE(told.starts_with("Did not come true: h holding [c2]; seen: h holding [].")) << told;
  EXPECT_TRUE(Contains(told, "Given up: grab_type_1 a cube (mdl_")) << told;
  EXPECT_TRUE(Contains(told, "made by analogy")) << told;
  EXPECT_TRUE(Contains(told, "3 vetoes learned from it, against grab_type_1 a large cube")) << told;
  EXPECT_TRUE(Contains(told, "Not tried again")) << told;
  EXPECT_TRUE(Contains(ToldAt(run, Time{400'000}), "By analogy: grab_type_1 a cube. 3 of 4 conditions"));
  EXPECT_EQ(ToldAt(run, Time{900'000}), "Goal missed: h holding [c2].");
}

TEST(Story, WhatIsPhasedOutAndComesBackIsToldInOneLineAFrame) {
  const aerascope::Run run = ScenarioRun("moving_ball.toml");

  EXPECT_TRUE(
      Contains(ToldAt(run, Time{1'300'000}), "Did not come true: b at 52; seen: b at 50. 5 vetoes learned"));
  EXPECT_TRUE(Contains(ToldAt(run, Time{1'400'000}), "b at 52 came true, which a veto denied (mdl_"));
  EXPECT_TRUE(Contains(ToldAt(run, Time{1'600'000}), "Given up: 2 vetoes against B speed S, with a ball"));
  EXPECT_TRUE(Contains(ToldAt(run, Time{2'200'000}), "Phased out after failures: B speed S (mdl_"));
  EXPECT_EQ(CountOf(ToldAt(run, Time{2'300'000}), "In use again: "), 1u);
  EXPECT_EQ(CountOf(ToldAt(run, Time{2'300'000}), "mdl_"), 2u);
}

TEST(Story, VetoesThatWereLearnedAreToldUntilTheyAreGivenUp) {
  const aerascope::Run run = ScenarioRun("hand_grab_sphere_learn.toml");

  EXPECT_TRUE(Contains(ToldAt(run, Time{1'100'000}), "7 vetoes learned from it, against release a sphere"));
  EXPECT_EQ(ToldAt(run, Time{1'500'000}), "The teacher commands release [h].");
  EXPECT_TRUE(Contains(ToldAt(run, Time{1'600'000}), "h holding [] came true, which 6 vetoes denied"));
  EXPECT_TRUE(Contains(ToldAt(run, Time{2'000'000}), "Goal reached: h holding []."));
  EXPECT_TRUE(Contains(ToldAt(run, Time{2'000'000}), "Given up: 6 vetoes against release a sphere"));
}

TEST(Story, WhereRoomIsShortTheTurningPointsStayAndTheOthersAreCounted) {
  const aerascope::Run run = ScenarioRun("size_pruned_first_scripted.toml");
  const std::size_t all = StoryOf(run, Summarise(run)).size();

  const KeyStory story = KeyMomentsOf(run, 4);

  ASSERT_EQ(story.moments.size(), 4u);
  EXPECT_EQ(story.left_out, all - 4);
  std::vector<Time> times;
  for (const KeyMoment& moment : story.moments) times.push_back(moment.at);
  EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
  EXPECT_EQ(times[0], Time{400'000}) << "the analogy";
  EXPECT_EQ(times[1], Time{600'000}) << "its failure";
  EXPECT_EQ(times[2], Time{900'000}) << "the goal missed";
  EXPECT_EQ(story.moments[3].kind, MomentKind::kGoalReached);
}

TEST(Story, WhatWasGivenIsNoPartOfIt) {
  for (const StoryMoment& moment : StoryOf(PaperRun(), Summarise(PaperRun()))) {
    EXPECT_FALSE(moment.sentences.empty());
    EXPECT_TRUE(moment.event.valid());
    EXPECT_FALSE(Contains(Join(moment.sentences, " "), "Given:"));
  }
  EXPECT_TRUE(StoryOf(aerascope::Run::FromEvents({}), Summarise(aerascope::Run::FromEvents({}))).empty());
}

}  // namespace
}  // namespace aerascope
