// The difference as text, Markdown and JSON: the same items in all three.
#include "exporters/diff/diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/knowledge_edits.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using ::testing::HasSubstr;

KnowledgeBase Paper(int last_frame) {
  PaperEpisodeOptions options;
  options.last_frame = last_frame;
  return KnowledgeFrom(PaperEpisode(options));
}

TEST(DiffTextTest, SaysTotalsThenEachItem) {
  std::ostringstream out;
  ASSERT_TRUE(WriteDiffText({DiffKnowledge(Paper(2), Paper(3)), {"before", "after"}}, out));
  EXPECT_EQ(out.str(),
            "0 only in before, 2 only in after, 4 the same.\n"
            "\n"
            "+ Only after has the causal model \"grab_type_1 [X] makes X holding [Y]\" (mdl_41).\n"
            "    grab_type_1 [H]\n"
            "    H holding [C]\n"
            "\n"
            "+ Only after has the requirement model \"grab_type_1 a small cube\" (mdl_42 on cst_40).\n"
            "    C size small, at P\n"
            "    H hand at P\n"
            "    C shape cube\n"
            "    H holding []\n"
            "    grab_type_1 [H]\n"
            "    H holding [C]\n");
}

TEST(DiffTextTest, SaysWhichConditionIsWithoutACounterpart) {
  const KnowledgeBase a = Paper(6);
  const KnowledgeBase b = Paper(7);
  std::ostringstream text, markdown, json;
  const KbDiffResult difference = DiffKnowledge(a, b);
  ASSERT_TRUE(WriteDiffText({difference, {"A", "B"}}, text));
  ASSERT_TRUE(WriteDiffMarkdown({difference, {"A", "B"}}, markdown));
  ASSERT_TRUE(WriteDiffJson({difference, {"A", "B"}}, json));
  EXPECT_THAT(text.str(), HasSubstr("\"grab_type_2 a large cube\": without \"C shape cube\"."));
  EXPECT_THAT(markdown.str(), HasSubstr("without \"C shape cube\""));
  const nlohmann::json items = nlohmann::json::parse(json.str())["items"];
  const auto derived = std::find_if(items.begin(), items.end(), [](const auto& item) {
    return item["title"] == "grab_type_2 something large";
  });
  ASSERT_NE(derived, items.end());
  EXPECT_EQ((*derived)["nearest"]["right_is"], "generalised");
  EXPECT_EQ((*derived)["nearest"]["title"], "grab_type_2 a large cube");
}

TEST(DiffTextTest, WhatWasGivenUpIsCountedApartInEveryFormat) {
  const KnowledgeBase a = Paper(2);
  KnowledgeBase b = Paper(3);
  b.SetState({42}, ModelState::kDeleted);
  const KbDiffResult difference = DiffKnowledge(a, b);
  std::ostringstream text, markdown, json;
  ASSERT_TRUE(WriteDiffText({difference, {"A", "B"}}, text));
  ASSERT_TRUE(WriteDiffMarkdown({difference, {"A", "B"}}, markdown));
  ASSERT_TRUE(WriteDiffJson({difference, {"A", "B"}}, json));
  const std::string totals = "0 only in A, 1 only in B and 1 more that it gave up, 4 the same.\n";
  EXPECT_THAT(text.str(), testing::StartsWith(totals));
  EXPECT_THAT(text.str(), HasSubstr("\"grab_type_1 a small cube\" (mdl_42 on cst_40), given up.\n"));
  EXPECT_THAT(markdown.str(), HasSubstr(totals));
  EXPECT_THAT(markdown.str(), HasSubstr("## added: grab\\_type\\_1 a small cube (given up)\n"));
  const nlohmann::json read = nlohmann::json::parse(json.str());
  EXPECT_EQ(read["added"], 2);
  EXPECT_EQ(read["given_up"], (nlohmann::json{{"left", 0}, {"right", 1}}));
}

TEST(DiffTextTest, SaysWhatWentInDifferentlyAndWhereTheRunsPart) {
  RunDiff runs;
  runs.settings = {{"seed", "1", "2"}, {"parameter psi", std::nullopt, "0.5"}};
  runs.files = {{"scenario.toml", true, true, {{{true, 3, "size = 1"}, {false, 3, "size = 2"}}, 4}}};
  runs.parting = PartingOfRuns{7, StoryStep{{21}, Time{2'000'000}, "Goal reached: h holding [s1]."}, {}};
  runs.drives = {{"hold s1", DriveEnding{Outcome::kReached, Time{2'000'000}}, DriveEnding{}},
                 {"hold s2", DriveEnding{}, DriveEnding{}},
                 {"hold cyl", DriveEnding{Outcome::kFailed, Time{9'000'000}}, std::nullopt}};
  const KbDiffResult nothing;
  std::ostringstream text, json;
  ASSERT_TRUE(WriteDiffText({nothing, {"A", "B"}, runs}, text));
  EXPECT_EQ(text.str(),
            "No difference: all 0 pieces of A and B are the same.\n"
            "\n"
            "The seed is 1 in A and 2 in B.\n"
            "Only B has a parameter psi: 0.5.\n"
            "The file scenario.toml differs in 6 lines.\n"
            "The stories part after 7 common steps: A has #21 at 2 s, Goal reached: h holding [s1]. B has no "
            "further step.\n"
            "Drive \"hold s1\": reached at 2 s in A, open in B.\n"
            "Drive \"hold cyl\": missed at 9 s in A, not set in B.\n"
            "\n"
            "scenario.toml\n"
            "    A:3: size = 1\n"
            "    B:3: size = 2\n"
            "    and 4 more\n");
  ASSERT_TRUE(WriteDiffJson({nothing, {"A", "B"}, runs}, json));
  const nlohmann::json read = nlohmann::json::parse(json.str())["runs"];
  EXPECT_EQ(read["settings"][0], (nlohmann::json{{"name", "seed"}, {"left", "1"}, {"right", "2"}}));
  EXPECT_EQ(read["settings"][1]["left"], nullptr);
  EXPECT_EQ(read["files"][0]["lines_left_out"], 4);
  EXPECT_EQ(read["parting"]["left"]["event"], 21);
  EXPECT_EQ(read["drives"].size(), 3u);
  EXPECT_EQ(read["drives"][2]["left"], "failed at 9 s") << "programs that read it know this word";
}

TEST(DiffTextTest, NoDifferenceIsSaidInOneLine) {
  std::ostringstream out;
  ASSERT_TRUE(WriteDiffText({DiffKnowledge(Paper(15), Renumbered(Paper(15), 3)), {"A", "B"}}, out));
  EXPECT_EQ(out.str(), "No difference: all 15 pieces of A and B are the same.\n");
}

TEST(DiffTextTest, FileNamesAreMadeSafe) {
  std::ostringstream out;
  ASSERT_TRUE(WriteDiffText({DiffKnowledge(Paper(2), Paper(3)), {"a\x1b[31m", "b"}}, out));
  EXPECT_EQ(out.str().find('\x1b'), std::string::npos);
}

TEST(DiffJsonTest, HoldsBothSidesOfEachItem) {
  std::ostringstream out;
  const KbDiffResult difference = DiffKnowledge(Paper(8), Paper(9));
  ASSERT_TRUE(WriteDiffJson({difference, {"A", "\xff"}}, out));
  const nlohmann::json json = nlohmann::json::parse(out.str());
  EXPECT_EQ(json["items"].size(), difference.items.size());
  for (const KbChange change : kKbChanges)
    EXPECT_EQ(json[std::string(NameOf(change))], difference.Count(change)) << NameOf(change);
  EXPECT_EQ(json["same"], difference.same.size());
  EXPECT_EQ(json["same_items"].size(), difference.same.size());
  for (const auto& item : json["items"]) {
    EXPECT_EQ(item["left"].is_null(), item["change"] == "added");
    EXPECT_EQ(item["right"].is_null(), item["change"] == "removed");
  }
}

TEST(DiffMarkdownTest, WordsAreNotMarkup) {
  std::ostringstream out;
  ASSERT_TRUE(WriteDiffMarkdown({DiffKnowledge(Paper(2), Paper(3)), {"<b>", "after"}}, out));
  EXPECT_THAT(out.str(), HasSubstr("0 only in &lt;b&gt;, 2 only in after"));
  EXPECT_THAT(out.str(), HasSubstr("## added: grab\\_type\\_1 a small cube\n"));
}

TEST(DiffTextTest, AStreamThatFailsIsAnError) {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  EXPECT_FALSE(WriteDiffText({KbDiffResult{}, {}}, out));
}

}  // namespace
}  // namespace aerascope
