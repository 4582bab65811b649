#include "viewer/draw/key_moments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/text.h"
#include "tests/viewer/draw/svg_check.h"

namespace aerascope {
namespace {

bool Has(const std::vector<KeyMoment>& moments, MomentKind kind) {
  return std::any_of(moments.begin(), moments.end(),
                     [kind](const KeyMoment& moment) { return moment.kind == kind; });
}

TEST(KeyMoments, ThePapersStoryHasALessonTheFirstAnalogyAndTheLastGoal) {
  const std::vector<KeyMoment> moments = KeyMomentsOf(PaperRun(), 6).moments;

  ASSERT_EQ(moments.size(), 6u);
  EXPECT_TRUE(Has(moments, MomentKind::kLearned));
  const auto analogy = std::find_if(moments.begin(), moments.end(), [](const KeyMoment& moment) {
    return moment.kind == MomentKind::kAnalogy;
  });
  ASSERT_NE(analogy, moments.end());
  EXPECT_EQ(analogy->at, Time{6'000'000});
  EXPECT_NE(Join(analogy->sentences, " ").find("3 of 4"), std::string::npos);
  EXPECT_EQ(moments.back().kind, MomentKind::kGoalReached);
  EXPECT_NE(Join(moments.back().sentences, " ").find("cyl"), std::string::npos);
}

TEST(KeyMoments, AFailureIsNeverLeftOut) {
  PaperEpisodeOptions options;
  options.cylinder_slips = true;

  const std::vector<KeyMoment> moments = KeyMomentsOf(PaperRun(options), 1).moments;

  ASSERT_EQ(moments.size(), 1u);
  EXPECT_EQ(moments[0].kind, MomentKind::kFailure);
  EXPECT_NE(Join(moments[0].sentences, " ").find("Goal missed: h holding [cyl]."), std::string::npos);
}

TEST(KeyMoments, TheyAreInOrderAndAtDifferentTimes) {
  for (std::size_t max = 0; max < 20; ++max) {
    const std::vector<Time> times = KeyMoments(PaperRun(), max);
    EXPECT_LE(times.size(), max);
    EXPECT_TRUE(std::is_sorted(times.begin(), times.end()));
    EXPECT_EQ(std::adjacent_find(times.begin(), times.end()), times.end());
  }
}

TEST(KeyMoments, ARunInWhichNothingHappenedGivesFirstAndLastFrame) {
  PaperEpisodeOptions options;
  options.last_frame = 1;
  EXPECT_EQ(KeyMoments(PaperRun(options), 6).size(), 1u);
  EXPECT_TRUE(KeyMoments(aerascope::Run::FromEvents({}), 6).empty());
}

TEST(KeyMoments, AnyTimeHasSomethingToSay) {
  const aerascope::Run run = PaperRun();

  const KeyStory story = MomentsAt(run, {Time{6'000'000}, Time{7'000'000}, Time{99'000'000}});
  const std::vector<KeyMoment>& moments = story.moments;

  ASSERT_EQ(moments.size(), 3u);
  EXPECT_EQ(moments[0].kind, MomentKind::kAnalogy);
  for (const KeyMoment& moment : moments) EXPECT_FALSE(moment.sentences.empty());
  const auto told = static_cast<std::size_t>(std::count_if(
      moments.begin(), moments.end(), [](const KeyMoment& moment) { return moment.event.valid(); }));
  EXPECT_EQ(story.left_out, KeyMomentsOf(run, 0).left_out - told);
}

}  // namespace
}  // namespace aerascope
