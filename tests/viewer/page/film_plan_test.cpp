#include "viewer/page/film_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/viewer/page/page_fixture.h"

namespace aerascope {
namespace {

using ::testing::HasSubstr;

// A run of empty frames, with a command of the teacher every `command_every` of them.
Run LongRun(int frames, std::int64_t period_us, int command_every) {
  EpisodeFile file;
  const auto add = [&](Time at, std::int64_t frame, EventBody body) {
    Event event;
    event.id = EventId{static_cast<std::int64_t>(file.events.size()) + 1};
    event.time = at;
    event.frame = frame;
    event.body = std::move(body);
    file.events.push_back(std::move(event));
    return file.events.back().id;
  };
  EpisodeStarted started;
  started.sampling_period_us = period_us;
  add({}, 0, started);
  for (int i = 0; i < frames; ++i) {
    const TimeInterval interval{{i * period_us}, {(i + 1) * period_us}};
    const EventId begun = add(interval.after, i, FrameStarted{interval});
    if (i % command_every != command_every - 1) continue;
    CommandIssued command;
    command.command = Term::Struct("cmd", {Term::Ontology("push"), Term::Set({Term::Entity("h")})});
    command.interval = interval;
    file.events[static_cast<std::size_t>(add(interval.after, i, command).value) - 1].causes = {begun};
  }
  return Run::FromEvents(std::move(file));
}

TEST(FilmPlan, ShortEpisodesHaveAStillForEachFrameAndASmoothVideo) {
  const auto run = PaperRun();
  const FilmPlan plan = PlanFilm(run);
  ASSERT_EQ(plan.stills.size(), run.frames().size());
  for (std::size_t i = 0; i < plan.stills.size(); ++i)
    EXPECT_EQ(plan.stills[i], run.frames()[i].interval.after);
  EXPECT_EQ(plan.views, plan.stills);
  EXPECT_EQ(plan.video_picture.us, 50'000);
  const Time begin = run.frames().front().interval.after;
  EXPECT_EQ(plan.video_from, begin);
  EXPECT_GE(begin.us + plan.video_pictures * 50'000, run.end().us);
  EXPECT_LT(begin.us + (plan.video_pictures - 1) * 50'000, run.end().us);
  EXPECT_EQ(plan.note, "");
  // Outlines are finer than stills, for what moves in the video.
  EXPECT_GT(plan.outlines.size(), 3 * plan.stills.size());
  EXPECT_TRUE(
      std::includes(plan.outlines.begin(), plan.outlines.end(), plan.stills.begin(), plan.stills.end()));
}

TEST(FilmPlan, WithoutVideoThereAreStillsInBetween) {
  const auto run = PaperRun();
  const FilmPlan plan = PlanFilm(run, {.video = false});
  EXPECT_EQ(plan.video_pictures, 0);
  EXPECT_EQ(plan.stills.size(), 4 * run.frames().size());
  EXPECT_EQ(PlanFilm(run, {.video = false, .stills_per_second = 0}).stills.size(), run.frames().size());
}

TEST(FilmPlan, TenMinutesAreKeptSmall) {
  const auto run = LongRun(6000, 100'000, 60);
  const FilmPlan plan = PlanFilm(run);
  EXPECT_EQ(plan.video_pictures, 3000);
  EXPECT_EQ(plan.video_picture.us, 200'000);
  EXPECT_LE(plan.stills.size(), kMostStills);
  EXPECT_LE(plan.views.size(), kMostViewStills);
  EXPECT_LE(plan.outlines.size(), kMostOutlines + kMostStills);
  EXPECT_THAT(plan.note, HasSubstr("sharp stills of 6000 frames"));
  // The commanded moments are among the stills, and so are beginning and end.
  std::size_t commanded = 0;
  for (int i = 59; i < 6000; i += 60)
    commanded += std::binary_search(plan.stills.begin(), plan.stills.end(), Time{i * 100'000}) ? 1 : 0;
  EXPECT_EQ(commanded, 100u);
  EXPECT_EQ(plan.stills.front(), run.frames().front().interval.after);
  EXPECT_EQ(plan.stills.back(), run.frames().back().interval.after);
  EXPECT_TRUE(std::is_sorted(plan.stills.begin(), plan.stills.end()));
}

TEST(FilmPlan, AnyLengthHasABoundedVideo) {
  for (const std::int64_t period_us : {10'000LL, 1'000'000LL, 3'600'000'000LL}) {
    const FilmPlan plan = PlanFilm(LongRun(500, period_us, 7));
    EXPECT_GT(plan.video_pictures, 0) << period_us;
    EXPECT_LE(plan.video_pictures, kMostVideoPictures) << period_us;
    EXPECT_EQ(plan.video_picture.us % 1000, 0) << period_us;
  }
}

TEST(FilmPlan, WhatIsAskedForIsDone) {
  const auto run = PaperRun();
  EXPECT_EQ(PlanFilm(run, {.video_fps = 10}).video_picture.us, 100'000);
  for (const int rate : VideoRates()) EXPECT_EQ(1000 % rate, 0) << rate;
  EXPECT_GT(PlanFilm(run, {.stills_per_second = 20}).stills.size(), 280u);
}

TEST(FilmPlan, ARunWithoutFramesHasOneStill) {
  const FilmPlan plan = PlanFilm(Run::FromEvents({}));
  EXPECT_EQ(plan.stills.size(), 1u);
  EXPECT_EQ(plan.video_pictures, 0);
}

}  // namespace
}  // namespace aerascope
