// Laws of the difference of two knowledge bases.
#include "engine/query/kb_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/support/knowledge_edits.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

KnowledgeBase Paper(int last_frame = 15) {
  PaperEpisodeOptions options;
  options.last_frame = last_frame;
  return KnowledgeFrom(PaperEpisode(options));
}

// Everything a reader sees of a difference.
std::vector<std::string> Told(const KbDiffResult& difference) {
  std::vector<std::string> lines = {
      std::to_string(difference.added) + " " + std::to_string(difference.removed) + " " +
      std::to_string(difference.changed) + " " + std::to_string(difference.same)};
  for (const KbDiffItem& item : difference.items) {
    lines.push_back(std::string(NameOf(item.change)) + " " + ToText(item.content) + " " +
                    SentenceOf(item, "one", "other"));
  }
  return lines;
}

TEST(KbDiffTest, NumbersOrderAndNamesPlayNoPart) {
  EXPECT_TRUE(rc::check([] {
    const KnowledgeBase knowledge = Paper(*rc::gen::inRange(1, 16));
    const KnowledgeBase same = Renumbered(knowledge, *rc::gen::arbitrary<std::uint64_t>());
    const KbDiffResult difference = DiffKnowledge(knowledge, same);
    RC_ASSERT(difference.empty());
    RC_ASSERT(difference.same ==
              static_cast<std::int64_t>(knowledge.models().size() + knowledge.composite_states().size()));
  }));
}

TEST(KbDiffTest, TheOtherWayRoundIsTheExchangedDifference) {
  EXPECT_TRUE(rc::check([] {
    const KnowledgeBase a = Renumbered(Paper(*rc::gen::inRange(1, 16)), *rc::gen::arbitrary<std::uint64_t>());
    const KnowledgeBase b = Renumbered(Paper(*rc::gen::inRange(1, 16)), *rc::gen::arbitrary<std::uint64_t>());
    RC_ASSERT(Told(DiffKnowledge(a, b)) == Told(Exchanged(DiffKnowledge(b, a))));
  }));
}

TEST(KbDiffTest, RenumberingOneSideChangesOnlyTheNumbersShown) {
  EXPECT_TRUE(rc::check([] {
    const KnowledgeBase a = Paper(*rc::gen::inRange(1, 16));
    const KnowledgeBase b = Paper(*rc::gen::inRange(1, 16));
    const KbDiffResult plain = DiffKnowledge(a, b);
    const KbDiffResult renumbered = DiffKnowledge(a, Renumbered(b, *rc::gen::arbitrary<std::uint64_t>()));
    RC_ASSERT(plain.items.size() == renumbered.items.size());
    for (std::size_t i = 0; i < plain.items.size(); ++i) {
      RC_ASSERT(plain.items[i].content == renumbered.items[i].content);
      RC_ASSERT(plain.items[i].title == renumbered.items[i].title);
      RC_ASSERT(plain.items[i].aspects == renumbered.items[i].aspects);
    }
  }));
}

TEST(KbDiffTest, WhatWasLearnedLaterIsListed) {
  const KbDiffResult difference = DiffKnowledge(Paper(6), Paper(7));
  // Frame 7 learns the release of the large cube and makes grab-large by analogy: two states, two requirement
  // models.
  EXPECT_EQ(difference.added, 4);
  EXPECT_EQ(difference.removed, 0);
  std::vector<std::string> titles;
  for (const KbDiffItem& item : difference.items) {
    if (item.kind == ModelGraphNodeKind::kRequirementModel) titles.push_back(item.title);
  }
  EXPECT_THAT(titles, ElementsAre("grab_type_2 something large", "release a large cube"));
}

TEST(KbDiffTest, OtherEvidenceOfTheSameContentIsAChange) {
  KnowledgeBase a = Paper();
  KnowledgeBase b = Paper();
  const ModelId id = a.models().begin()->first;
  b.SetEvidence(id, {3, 4}, true);
  KbDiffResult difference = DiffKnowledge(a, b);
  ASSERT_EQ(difference.items.size(), 1u);
  EXPECT_EQ(difference.changed, 1);
  EXPECT_THAT(difference.items[0].aspects, ElementsAre("confidence", "strength"));
  EXPECT_EQ(SentenceOf(difference.items[0], "A", "B"),
            "Both have the causal model \"move [X V2] makes X at P\" (mdl_30, mdl_30), with confidence 1 (5 "
            "of 5) and "
            "0.75 (3 of 4); strength open and confirmed.");
  b = Paper();
  b.SetState(id, ModelState::kDeleted);
  EXPECT_THAT(DiffKnowledge(a, b).items.at(0).aspects, Contains("state"));
}

TEST(KbDiffTest, EqualContentTwiceIsCounted) {
  const KnowledgeBase a = Paper();
  KnowledgeBase b = Paper();
  ModelRecord copy = b.models().begin()->second;
  copy.model.id = {9999};
  b.AddModel(copy);
  const KbDiffResult difference = DiffKnowledge(a, b);
  ASSERT_EQ(difference.items.size(), 1u);
  EXPECT_THAT(difference.items[0].aspects, ElementsAre("copies"));
  EXPECT_EQ(difference.items[0].right->copies, 2u);
  EXPECT_TRUE(DiffKnowledge(b, Renumbered(b, 5)).empty());
}

}  // namespace
}  // namespace aerascope
