// The difference as text, Markdown and JSON: the same items in all three.
#include "exporters/diff/diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  ASSERT_TRUE(WriteDiffText(DiffKnowledge(Paper(2), Paper(3)), {"before", "after"}, out));
  EXPECT_EQ(out.str(),
            "0 only in before, 3 only in after, 0 with other evidence or state, 5 the same.\n"
            "\n"
            "+ Only after has the composite state \"small \u00b7 cube \u00b7 Y holding []\" (cst_40).\n"
            "    H holding []\n"
            "    C size small, at P\n"
            "    H hand at P\n"
            "    C shape cube\n"
            "\n"
            "+ Only after has the causal model \"grab_type_1 [X] makes X holding [Y]\" (mdl_41).\n"
            "    grab_type_1 [H]\n"
            "    H holding [C]\n"
            "\n"
            "+ Only after has the requirement model \"grab_type_1 a small cube\" (mdl_42).\n"
            "    H holding [], C size small at P, H hand at P and C shape cube\n"
            "    grab_type_1 [H] makes H holding [C]\n");
}

TEST(DiffTextTest, NoDifferenceIsSaidInOneLine) {
  std::ostringstream out;
  ASSERT_TRUE(WriteDiffText(DiffKnowledge(Paper(15), Renumbered(Paper(15), 3)), {"A", "B"}, out));
  EXPECT_EQ(out.str(), "No difference: all 24 pieces of A and B are the same.\n");
}

TEST(DiffTextTest, FileNamesAreMadeSafe) {
  std::ostringstream out;
  ASSERT_TRUE(WriteDiffText(DiffKnowledge(Paper(2), Paper(3)), {"a\x1b[31m", "b"}, out));
  EXPECT_EQ(out.str().find('\x1b'), std::string::npos);
}

TEST(DiffJsonTest, HoldsBothSidesOfEachItem) {
  std::ostringstream out;
  const KbDiffResult difference = DiffKnowledge(Paper(8), Paper(9));
  ASSERT_TRUE(WriteDiffJson(difference, {"A", "\xff"}, out));
  const nlohmann::json json = nlohmann::json::parse(out.str());
  EXPECT_EQ(json["items"].size(), difference.items.size());
  EXPECT_EQ(json["added"], difference.added);
  for (const auto& item : json["items"]) {
    EXPECT_EQ(item["left"].is_null(), item["change"] == "added");
    EXPECT_EQ(item["right"].is_null(), item["change"] == "removed");
  }
}

TEST(DiffMarkdownTest, WordsAreNotMarkup) {
  std::ostringstream out;
  ASSERT_TRUE(WriteDiffMarkdown(DiffKnowledge(Paper(2), Paper(3)), {"<b>", "after"}, out));
  EXPECT_THAT(out.str(), HasSubstr("0 only in &lt;b&gt;, 3 only in after"));
  EXPECT_THAT(out.str(), HasSubstr("## added: grab\\_type\\_1 a small cube\n"));
}

TEST(DiffTextTest, AStreamThatFailsIsAnError) {
  std::ostringstream out;
  out.setstate(std::ios::badbit);
  EXPECT_FALSE(WriteDiffText({}, {}, out));
}

}  // namespace
}  // namespace aerascope
