#include "viewer/draw/sheet.h"

#include <gtest/gtest.h>

#include <chrono>

#include "tests/support/slowness.h"
#include "tests/viewer/draw/scenario_run.h"
#include "tests/viewer/draw/svg_check.h"
#include "viewer/draw/png.h"
#include "viewer/draw/svg.h"

namespace aerascope {
namespace {

SheetFrames FramesFor(const Run& run, const std::string& png) {
  SheetFrames frames;
  for (const Time at : KeyMoments(run, kSheetFrames)) {
    frames.frames.push_back({at, png, {{"s1", {{1, 1}, {9, 1}, {9, 9}}, {5, 12}}, {"nobody", {}, {1, 1}}}});
  }
  return frames;
}

std::string AnyPng() {
  return *SvgToPng(SvgDocument({32, 20}, "still", "", ""));
}

TEST(Sheet, ItTellsTheOutcomeAndShowsEachKeyMoment) {
  const aerascope::Run run = PaperRun();

  const Result<std::string> svg = BuildSheetSvg(run, FramesFor(run, AnyPng()), {"paper.episode"});

  ASSERT_TRUE(svg.ok());
  EXPECT_NE(svg->find("Pick and place by analogy"), std::string::npos);
  EXPECT_NE(
      svg->find(
          "5 of 5 goals reached; 9 pieces of knowledge learned, 4 by analogy; 9 of 9 predictions came true"),
      std::string::npos);
  EXPECT_NE(svg->find("paper.episode, 15 s in 15 frames"), std::string::npos);
  EXPECT_EQ(CountOf(*svg, "<image "), 6u);
  EXPECT_NE(svg->find("What it knew at the end"), std::string::npos);
  EXPECT_EQ(CountOf(*svg, "class=\"d-curve\""), 4u) << "one curve for each analogy";
}

TEST(Sheet, OnlyObjectsThatTheCaptionNamesAreOutlined) {
  const aerascope::Run run = PaperRun();

  const Result<std::string> svg = BuildSheetSvg(run, FramesFor(run, AnyPng()));

  ASSERT_TRUE(svg.ok());
  EXPECT_EQ(CountOf(*svg, ">s1</text>"), 4u) << "two captions name s1; name and halo each";
  EXPECT_EQ(CountOf(*svg, ">nobody<"), 0u);
}

TEST(Sheet, WithoutPicturesItSaysSoAndShowsLanes) {
  const Result<std::string> svg = BuildSheetSvg(PaperRun(), {{}, "There is no renderer here."});

  ASSERT_TRUE(svg.ok());
  EXPECT_EQ(CountOf(*svg, "<image "), 0u);
  EXPECT_NE(svg->find("There is no renderer here."), std::string::npos);
  EXPECT_NE(svg->find(">Commands<"), std::string::npos);
}

TEST(Sheet, WithoutPicturesTheStoryIsToldInSentences) {
  // The turning points of this run were missing on its sheet.
  const Result<std::string> svg = BuildSheetSvg(ScenarioRun("moving_ball.toml"), {});

  ASSERT_TRUE(svg.ok());
  EXPECT_NE(svg->find("Did not come true: b at 52; seen: b at 50. 5 vetoes learned from it"),
            std::string::npos);
  EXPECT_NE(svg->find("Phased out after failures: "), std::string::npos);
  EXPECT_NE(svg->find("In use again: "), std::string::npos);
  EXPECT_NE(svg->find("5 vetoes: B speed S, with a ball"), std::string::npos) << "one sign in the lanes";
}

TEST(Sheet, WhatHasNoRoomIsCounted) {
  const aerascope::Run run = LongRun(100);

  const Result<std::string> svg = BuildSheetSvg(run, {});

  ASSERT_TRUE(svg.ok());
  EXPECT_NE(svg->find("Left out here: 88 less telling moments; the report has all."), std::string::npos);
}

TEST(Sheet, FewPicturesLeaveRoomForTheLanes) {
  // A run in which little happened had one picture, and half of the page was blank.
  PaperEpisodeOptions options;
  options.last_frame = 3;
  const aerascope::Run run = PaperRun(options);
  const SheetFrames frames = FramesFor(run, AnyPng());
  ASSERT_EQ(frames.frames.size(), 3u) << "the last frame, too";

  const Result<std::string> svg = BuildSheetSvg(run, frames);

  ASSERT_TRUE(svg.ok());
  EXPECT_NE(svg->find(">Commands<"), std::string::npos);
  const Result<std::string> many = BuildSheetSvg(PaperRun(), FramesFor(PaperRun(), AnyPng()));
  ASSERT_TRUE(many.ok());
  EXPECT_EQ(many->find(">Commands<"), std::string::npos);
}

TEST(Sheet, APictureThatIsNoPngIsAnError) {
  const aerascope::Run run = PaperRun();

  const Result<std::string> svg = BuildSheetSvg(run, FramesFor(run, "GIF89a"));

  ASSERT_FALSE(svg.ok());
  EXPECT_NE(svg.error().message.find("not a PNG"), std::string::npos);
}

TEST(Sheet, TheSameRunGivesTheSameBytes) {
  const Result<std::string> first = BuildSheetSvg(PaperRun(), {});
  const Result<std::string> second = BuildSheetSvg(PaperRun(), {});

  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(*first, *second);
  const Result<std::string> png = SvgToPng(*first);
  ASSERT_TRUE(png.ok());
  EXPECT_EQ(*png, *SvgToPng(*second));
}

TEST(Sheet, EveryRunMakesAWellFormedSheet) {
  PaperEpisodeOptions hostile;
  hostile.cylinder = "</text><script>alert(1)</script>\x1b\xe2\x80\xae";
  hostile.scenario =
      "<b>&\xff\x01 a title much longer than there is room for on the sheet, over and over again";
  PaperEpisodeOptions slips;
  slips.cylinder_slips = true;
  std::vector<aerascope::Run> runs;
  for (const PaperEpisodeOptions& options : {PaperEpisodeOptions{}, hostile, slips})
    runs.push_back(PaperRun(options));
  for (int last = 0; last < 15; ++last) {
    PaperEpisodeOptions cut;
    cut.last_frame = last;
    runs.push_back(PaperRun(cut));
  }
  runs.push_back(aerascope::Run::FromEvents({}));
  runs.push_back(LongRun(100));

  for (std::size_t i = 0; i < runs.size(); ++i) {
    SCOPED_TRACE(i);
    const Result<std::string> svg = BuildSheetSvg(runs[i], {});
    ASSERT_TRUE(svg.ok());
    EXPECT_EQ(svg->find("<script"), std::string::npos);
    const std::string said = WhatXmllintSays(*svg);
    if (said == kNoXmllint) GTEST_SKIP() << said;
    EXPECT_EQ(said, "");
  }
}

TEST(Sheet, ARunWithThousandsOfModelsStaysOnePage) {
  const aerascope::Run run = LongRun(3000);

  const auto start = std::chrono::steady_clock::now();
  const Result<std::string> svg = BuildSheetSvg(run, {});
  const auto took = std::chrono::steady_clock::now() - start;

  ASSERT_TRUE(svg.ok());
  EXPECT_LT(svg->size(), 2'000'000u);
  EXPECT_NE(svg->find("the report has all."), std::string::npos);
  EXPECT_TRUE(SvgToPng(*svg, 0.5).ok());
  EXPECT_LT(took, std::chrono::seconds(20) * Slowness());
}

}  // namespace
}  // namespace aerascope
