// What went into two runs differently, and where their stories part.
#include "engine/query/run_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Run RunOf(PaperEpisodeOptions options, EpisodeHeader header = {}) {
  EpisodeFile file;
  file.header = std::move(header);
  file.events = PaperEpisode(options);
  file.complete = true;
  return Run::FromEvents(std::move(file));
}

EpisodeHeader HeaderWith(const std::string& scenario) {
  EpisodeHeader header;
  header.program_version = "1";
  header.files = {{"scenario.toml", scenario}};
  return header;
}

TEST(RunDiffTest, ARunDiffersFromItselfInNothing) {
  const auto run = RunOf({}, HeaderWith("seed = 1\n"));
  const RunDiff difference = DiffRuns({run}, {run});
  EXPECT_FALSE(difference.differs());
  EXPECT_FALSE(difference.parting);
  EXPECT_EQ(difference.drives.size(), 5u);
  EXPECT_THAT(SentencesOf(difference, "A", "B"), IsEmpty());
}

TEST(RunDiffTest, SettingsAreComparedByName) {
  EpisodeHeader a = HeaderWith("");
  EpisodeHeader b = HeaderWith("");
  a.settings["friction"] = "0.6";
  b.settings["friction"] = "0.05";
  b.settings["wind"] = "1";
  b.program_version = "2";
  EXPECT_THAT(
      SentencesOf(DiffRuns({RunOf({}, a)}, {RunOf({}, b)}), "A", "B"),
      ElementsAre("The program version is 1 in A and 2 in B.",
                  "The setting friction is 0.6 in A and 0.05 in B.", "Only B has a setting wind: 1."));
}

TEST(RunDiffTest, LinesOfTheScenarioThatDifferAreNamed) {
  const RunDiff difference =
      DiffRuns({RunOf({}, HeaderWith("a\nb\nc\nd\n"))}, {RunOf({}, HeaderWith("a\nx\nc\n"))});
  ASSERT_EQ(difference.files.size(), 1u);
  using Line = LineDifference::Line;
  EXPECT_THAT(difference.files[0].lines.lines,
              ElementsAre(Line{true, 2, "b"}, Line{false, 2, "x"}, Line{true, 4, "d"}));
}

TEST(RunDiffTest, FilesThatOnlyOneHasAreOneSentence) {
  // Given a run in a world of many meshes and one without, then the meshes are not a sentence each.
  EpisodeHeader meshes = HeaderWith("");
  for (const char* name : {"a", "b", "c", "d", "e"})
    meshes.files.push_back({"world/" + std::string(name) + ".msh", name});
  EpisodeHeader seed = HeaderWith("");
  seed.files.push_back({"seed.replicode", "x"});
  EXPECT_THAT(SentencesOf(DiffRuns({RunOf({}, meshes)}, {RunOf({}, seed)}), "A", "B"),
              ElementsAre("Only A has the files world/a.msh, world/b.msh, world/c.msh and 2 more.",
                          "Only B has the file seed.replicode."));
}

TEST(RunDiffTest, StoriesPartWhereTheOutcomeIsAnother) {
  PaperEpisodeOptions slips;
  slips.cylinder_slips = true;
  const auto good = RunOf({});
  const auto bad = RunOf(slips);
  const RunDiff difference = DiffRuns({good}, {bad});
  ASSERT_TRUE(difference.parting);
  ASSERT_TRUE(difference.parting->left);
  ASSERT_TRUE(difference.parting->right);
  EXPECT_GT(difference.parting->common, 20u);
  EXPECT_GE(difference.parting->left->time, (Time{14'000'000}));
  EXPECT_EQ(difference.drives.back().left->outcome, Outcome::kReached);
  EXPECT_EQ(difference.drives.back().right->outcome, Outcome::kFailed);
  EXPECT_THAT(SentencesOf(difference, "A", "B").back(), HasSubstr("missed at"));
}

TEST(RunDiffTest, WhatComesAfterTheMomentDoesNotCount) {
  const auto run = RunOf({});
  const RunDiff difference = DiffRuns({run, Time{8'000'000}}, {run});
  ASSERT_TRUE(difference.parting);
  EXPECT_FALSE(difference.parting->left);
  ASSERT_TRUE(difference.parting->right);
  EXPECT_GT(difference.parting->right->time, (Time{8'000'000}));
  EXPECT_FALSE(difference.drives.back().left);
}

TEST(LineDiffTest, EqualTextsHaveNoDifferingLines) {
  EXPECT_TRUE(DifferingLines("a\nb", "a\nb", 9).lines.empty());
  EXPECT_TRUE(DifferingLines("", "", 9).lines.empty());
}

TEST(LineDiffTest, LinesBeyondTheMostAreCounted) {
  const LineDifference difference = DifferingLines("a\nb\nc\n", "", 2);
  EXPECT_EQ(difference.lines.size(), 2u);
  EXPECT_EQ(difference.hidden, 1u);
}

TEST(LineDiffTest, LongTextsWithoutCommonLinesAreToldWithoutASearch) {
  std::string a, b;
  for (int i = 0; i < 5000; ++i) {
    a += "a" + std::to_string(i) + "\n";
    b += "b" + std::to_string(i) + "\n";
  }
  const LineDifference difference = DifferingLines(a, b, 3);
  EXPECT_EQ(difference.lines.size() + difference.hidden, 10'000u);
}

}  // namespace
}  // namespace aerascope
