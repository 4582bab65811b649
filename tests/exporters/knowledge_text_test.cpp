// The knowledge base as text for people.
#include "exporters/kb/knowledge_text.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/support/any_event.h"
#include "tests/support/knowledge_edits.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

std::string TextAt(int last_frame) {
  PaperEpisodeOptions options;
  options.last_frame = last_frame;
  std::ostringstream out;
  EXPECT_TRUE(WriteKnowledgeText(KnowledgeFrom(PaperEpisode(options)), out));
  return out.str();
}

TEST(KnowledgeTextTest, ListsWhatIsKnownUnderWhatItMakesPossible) {
  EXPECT_EQ(
      TextAt(3),
      "Knowledge at 2 s: 2 pieces of knowledge about 2 models, 4 composite states.\n"
      "In brackets: right how often, of how often. What it was learned from counts as the first; by "
      "analogy the first counts as much as the confidence it was made with. Confirmed models are counted "
      "anew.\n"
      "\n"
      "mdl_30  move [H D] makes H at P + D.\n"
      "    causal model, confidence 1 (1 of 1), learned at 1 s\n"
      "  mdl_31  move the hand\n"
      "      requirement model, confidence 1 (1 of 1), learned at 1 s\n"
      "      if cst_1: H hand at P\n"
      "\n"
      "mdl_41  grab_type_1 [H] makes H holding [C].\n"
      "    causal model, confidence 1 (1 of 1), learned at 2 s\n"
      "  mdl_42  grab_type_1 a small cube\n"
      "      requirement model, confidence 1 (1 of 1), learned at 2 s\n"
      "      if cst_40: H holding []; C size small, at P; H hand at P; C shape cube\n"
      "\n"
      "Other composite states\n"
      "  cst_2  C shape X, at P  (given)\n"
      "  cst_3  C size X, at P  (given)\n");
}

TEST(KnowledgeTextTest, SaysWhatAnAnalogyDropped) {
  EXPECT_NE(TextAt(15).find(
                "grab_type_2 something large\n"
                "      requirement model, confidence 0.917 (2.75 of 3), by analogy with mdl_75 at 6 s\n"
                "      if cst_88: H holding []; C size large, at P; H hand at P  (without: C shape cube)\n"),
            std::string::npos);
}

// Pieces that had been given up were counted as known.
TEST(KnowledgeTextTest, WhatWasGivenUpIsNotCountedAsKnown) {
  PaperEpisodeOptions options;
  options.last_frame = 3;
  std::vector<Event> events = PaperEpisode(options);
  events.push_back({EventId{static_cast<std::int64_t>(events.size()) + 1},
                    events.back().time,
                    events.back().frame,
                    {},
                    {events.back().id},
                    ModelStateChanged{ModelId{42}, ModelState::kActive, ModelState::kDeleted}});
  std::ostringstream out;

  ASSERT_TRUE(WriteKnowledgeText(KnowledgeFrom(events), out));

  EXPECT_TRUE(
      out.str().starts_with("Knowledge at 2 s: 1 piece of knowledge about 2 models, 4 composite states; "
                            "1 piece was given up and is not counted.\n"))
      << out.str();
  EXPECT_NE(out.str().find("requirement model, confidence 1 (1 of 1), given up, learned at 2 s"),
            std::string::npos);
}

TEST(KnowledgeTextTest, NothingIsKnownAtFirst) {
  std::ostringstream out;
  ASSERT_TRUE(WriteKnowledgeText(KnowledgeBase(), out));
  EXPECT_EQ(out.str(), "Knowledge at 0 s: 0 pieces of knowledge about 0 models, 0 composite states.\n");
}

TEST(KnowledgeTextTest, AnyKnowledgeIsWritten) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    AnyEvents any(seed);
    std::vector<Event> events;
    for (std::int64_t i = 1; i <= 100; ++i) events.push_back(any.AnyEvent(i));
    std::ostringstream out;
    EXPECT_TRUE(WriteKnowledgeText(KnowledgeFrom(events), out));
  }
}

}  // namespace
}  // namespace aerascope
