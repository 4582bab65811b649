// Laws of the difference of two knowledge bases.
#include "engine/query/kb_diff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <random>
#include <set>

#include "engine/query/describe.h"
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
  std::vector<std::string> lines = {std::to_string(difference.same.size()) + " the same"};
  for (const KbDiffItem& item : difference.items) {
    lines.push_back(std::string(NameOf(item.change)) + " " + ToText(item.content) + " " + item.title + " " +
                    SentenceOf(item, "one", "other"));
    for (const AlignedRow& row : item.rows)
      lines.push_back(std::string(NameOf(row.status)) + " " + row.left + " | " + row.right);
  }
  return lines;
}

const KbDiffItem* ItemTitled(const KbDiffResult& difference, const std::string& title) {
  for (const KbDiffItem& item : difference.items)
    if (item.title == title) return &item;
  return nullptr;
}

// The texts of rows with this status.
std::vector<std::string> TextsOf(const KbDiffItem& item, PartStatus status) {
  std::vector<std::string> texts;
  for (const AlignedRow& row : item.rows)
    if (row.status == status) texts.push_back(row.left.empty() ? row.right : row.left);
  return texts;
}

// The same knowledge without the pieces for which `unwanted` holds; what they rest on stays.
KnowledgeBase Without(const KnowledgeBase& knowledge,
                      const std::function<bool(const ModelRecord&)>& unwanted) {
  KnowledgeBase result;
  for (const auto& [id, record] : knowledge.composite_states()) result.AddCompositeState(record);
  for (const auto& [id, record] : knowledge.models())
    if (!unwanted(record)) result.AddModel(record);
  return result;
}
KnowledgeBase Without(const KnowledgeBase& knowledge, const std::string& title) {
  return Without(knowledge,
                 [&](const ModelRecord& record) { return TitleOf(knowledge, record.model.id) == title; });
}

TEST(KbDiffTest, NumbersOrderAndNamesPlayNoPart) {
  EXPECT_TRUE(rc::check([] {
    const KnowledgeBase knowledge = Paper(*rc::gen::inRange(1, 16));
    const KnowledgeBase same = Renumbered(knowledge, *rc::gen::arbitrary<std::uint64_t>());
    const KbDiffResult difference = DiffKnowledge(knowledge, same);
    RC_ASSERT(difference.empty());
    std::size_t states = 0;  // that no requirement model tells
    for (const auto& [id, record] : knowledge.composite_states())
      states += std::none_of(knowledge.models().begin(), knowledge.models().end(),
                             [&](const auto& entry) { return RequiredState(entry.second.model) == id; });
    RC_ASSERT(difference.same.size() == knowledge.models().size() + states);
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
  // Frame 7 learns the release of the large cube and makes grab-large by analogy, each with its composite
  // state.
  EXPECT_EQ(difference.Count(KbChange::kAdded), 2);
  EXPECT_EQ(difference.items.size(), 2u);
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
  EXPECT_EQ(difference.Count(KbChange::kChanged), 1);
  EXPECT_THAT(difference.items[0].aspects, ElementsAre("confidence", "strength"));
  EXPECT_EQ(SentenceOf(difference.items[0], "A", "B"),
            "Both have the causal model \"move [X V2] makes X at P\" (mdl_30, mdl_30), with confidence 1 (5 "
            "of 5) and "
            "0.75 (3 of 4); strength open and confirmed.");
  b = Paper();
  b.SetState(id, ModelState::kDeleted);
  EXPECT_THAT(DiffKnowledge(a, b).items.at(0).aspects, Contains("state"));
}

TEST(KbDiffTest, WhatWasGivenUpIsCountedApartAndSaidToBe) {
  // Given what only one side has, one piece of it given up and one phased out there.
  const KnowledgeBase a = Paper(6);
  KnowledgeBase b = Paper(7);
  const auto id_of = [&](const std::string& title) {
    for (const auto& [id, record] : b.models())
      if (TitleOf(b, id) == title) return id;
    return ModelId{};
  };
  b.SetState(id_of("grab_type_2 something large"), ModelState::kDeleted);
  b.SetState(id_of("release a large cube"), ModelState::kPhasedOut);
  const KbDiffResult difference = DiffKnowledge(a, b);
  EXPECT_EQ(difference.Count(KbChange::kAdded), 2);
  EXPECT_EQ(difference.CountGivenUp(KbChange::kAdded), 1);
  EXPECT_EQ(difference.CountGivenUp(KbChange::kRemoved), 0);
  EXPECT_EQ(Exchanged(difference).CountGivenUp(KbChange::kRemoved), 1);
  const KbDiffItem* gone = ItemTitled(difference, "grab_type_2 something large");
  const KbDiffItem* aside = ItemTitled(difference, "release a large cube");
  ASSERT_TRUE(gone && aside);
  EXPECT_EQ(gone->state(), ModelState::kDeleted);
  EXPECT_THAT(SentenceOf(*gone, "A", "B"),
              testing::MatchesRegex("Only B had the requirement model \"grab_type_2 something large\" "
                                    "\\(mdl_[0-9]+ on cst_[0-9]+\\), given up, more general than .*"));
  EXPECT_THAT(SentenceOf(*aside, "A", "B"),
              testing::MatchesRegex("Only B has the requirement model \"release a large cube\" "
                                    "\\(mdl_[0-9]+ on cst_[0-9]+\\), phased out.*"));
}

TEST(KbDiffTest, OfAPairItIsSaidThatBothGaveItUp) {
  // Given a piece that both gave up, after other evidence.
  KnowledgeBase a = Paper();
  KnowledgeBase b = Paper();
  const ModelId id = a.models().begin()->first;
  a.SetState(id, ModelState::kDeleted);
  b.SetState(id, ModelState::kDeleted);
  b.SetEvidence(id, {3, 4}, false);
  const KbDiffResult difference = DiffKnowledge(a, b);
  EXPECT_THAT(SentenceOf(difference.items.at(0), "A", "B"), testing::HasSubstr("; given up in both."));
  // Where only one gave it up, there is no state of both.
  EXPECT_EQ(DiffKnowledge(a, Paper()).items.at(0).state(), ModelState::kActive);
}

TEST(KbDiffTest, StatesAndOriginsAreToldInTheWordsOfReports) {
  // It said "state active and deleted", which no report does.
  const KnowledgeBase a = Paper(3);
  KnowledgeBase b;
  for (const auto& [id, record] : a.composite_states()) b.AddCompositeState(record);
  for (const auto& [id, record] : a.models()) {
    ModelRecord other = record;
    if (id == ModelId{42}) {
      other.state = ModelState::kDeleted;
      other.origin = Origin::kPredictionFailure;
    }
    b.AddModel(other);
  }

  const KbDiffResult difference = DiffKnowledge(a, b);

  ASSERT_EQ(difference.items.size(), 1u);
  const std::string told = SentenceOf(difference.items[0], "A", "B");
  EXPECT_NE(told.find("state active and given up"), std::string::npos) << told;
  EXPECT_NE(told.find("origin learned and learned from a failed prediction"), std::string::npos) << told;
}

TEST(KbDiffTest, AVetoIsToldToPreventItsEffect) {
  // Given a veto on one side: a requirement model turned to speak against its effect.
  const KnowledgeBase a = Without(Paper(), "grab_type_2 a large cube");
  KnowledgeBase b = a;
  const KnowledgeBase whole = Paper();
  for (const auto& [id, record] : whole.models()) {
    if (TitleOf(whole, id) != "grab_type_2 a large cube") continue;
    ModelRecord veto = record;
    veto.model.rhs.positive = false;
    b.AddModel(veto);
  }
  const KbDiffResult difference = DiffKnowledge(a, b);
  const KbDiffItem* told = ItemTitled(difference, "veto: grab_type_2 a large cube");
  ASSERT_NE(told, nullptr);
  EXPECT_EQ(told->kind, ModelGraphNodeKind::kStrongRequirementModel);
  EXPECT_THAT(TextsOf(*told, PartStatus::kRightOnly),
              testing::IsSupersetOf({"grab_type_2 [H]", "not H holding [C]"}));
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

TEST(KbDiffTest, APieceThatOnlyOneSideHasIsComparedWithItsNearestRelative) {
  const KbDiffResult difference = DiffKnowledge(Paper(6), Paper(7));
  const KbDiffItem* derived = ItemTitled(difference, "grab_type_2 something large");
  ASSERT_NE(derived, nullptr);
  EXPECT_EQ(derived->change, KbChange::kAdded);
  ASSERT_TRUE(derived->relative);
  EXPECT_EQ(derived->relative->title, "grab_type_2 a large cube");
  EXPECT_EQ(derived->relative->relation, PieceRelation::kGeneralised);
  EXPECT_THAT(TextsOf(*derived, PartStatus::kLeftOnly), ElementsAre("C shape cube"));
  EXPECT_THAT(TextsOf(*derived, PartStatus::kRightOnly), ElementsAre());
  EXPECT_THAT(
      TextsOf(*derived, PartStatus::kSame),
      ElementsAre("C size large, at P", "H hand at P", "H holding []", "grab_type_2 [H]", "H holding [C]"));
  EXPECT_THAT(SentenceOf(*derived, "A", "B"),
              testing::MatchesRegex("Only B has the requirement model \"grab_type_2 something large\" "
                                    "\\(mdl_[0-9]+ on cst_[0-9]+\\), more general than mdl_[0-9]+ of A, "
                                    "\"grab_type_2 a large cube\": without \"C shape cube\"."));
}

TEST(KbDiffTest, APieceWithOneConditionLessIsItsMoreGeneralForm) {
  // Given one side with the taught piece and the other with the one made from it, but not with both.
  const KnowledgeBase a = Without(Paper(15), "grab_type_2 something large");
  const KnowledgeBase b = Without(Paper(15), "grab_type_2 a large cube");
  const KbDiffResult difference = DiffKnowledge(a, b);
  ASSERT_EQ(difference.items.size(), 1u);
  const KbDiffItem& item = difference.items[0];
  EXPECT_EQ(item.change, KbChange::kGeneralised);
  EXPECT_EQ(item.left->title, "grab_type_2 a large cube");
  EXPECT_EQ(item.right->title, "grab_type_2 something large");
  EXPECT_THAT(TextsOf(item, PartStatus::kLeftOnly), ElementsAre("C shape cube"));
  EXPECT_THAT(item.aspects, ElementsAre("confidence"));
  // And seen from the other side it is more specific.
  EXPECT_EQ(DiffKnowledge(b, a).items.at(0).change, KbChange::kSpecialised);
  EXPECT_EQ(Told(DiffKnowledge(b, a)), Told(Exchanged(difference)));
}

TEST(KbDiffTest, AnotherNumberInARuleIsNoOtherRule) {
  const KnowledgeBase a = Paper();
  KnowledgeBase b;
  for (const auto& [id, record] : a.composite_states()) b.AddCompositeState(record);
  for (const auto& [id, record] : a.models()) {
    ModelRecord changed = record;
    for (std::vector<Guard>* guards : {&changed.model.forward, &changed.model.backward}) {
      for (Guard& guard : *guards)
        if (guard.expression.is(TermKind::kStruct) && guard.expression.size() == 2)
          guard.expression = Term::Struct(
              "+", {guard.expression, Term::Struct("vec2", {Term::Number(0.25), Term::Number(0)})});
    }
    b.AddModel(changed);
  }
  KnowledgeBase c;
  for (const auto& [id, record] : b.composite_states()) c.AddCompositeState(record);
  for (const auto& [id, record] : b.models()) {
    ModelRecord changed = record;
    for (std::vector<Guard>* guards : {&changed.model.forward, &changed.model.backward})
      for (Guard& guard : *guards)
        guard.expression = Rewritten(guard.expression, [](const Term& term) -> std::optional<Term> {
          if (term.is(TermKind::kNumber) && term.number() == 0.25) return Term::Number(0.5);
          return std::nullopt;
        });
    c.AddModel(changed);
  }
  const KbDiffResult difference = DiffKnowledge(b, c);
  // The model, and each requirement model that speaks about it.
  EXPECT_EQ(difference.Count(KbChange::kOtherValues), static_cast<std::int64_t>(difference.items.size()));
  ASSERT_FALSE(difference.items.empty());
  const KbDiffItem& item = difference.items[0];
  EXPECT_EQ(item.kind, ModelGraphNodeKind::kCausalModel);
  std::vector<std::string> left, right;
  for (const AlignedRow& row : item.rows) {
    if (row.status != PartStatus::kOtherValue) continue;
    left.push_back(row.left);
    right.push_back(row.right);
  }
  EXPECT_THAT(left, Contains(testing::HasSubstr("(0.25, 0)")));
  EXPECT_THAT(right, Contains(testing::HasSubstr("(0.5, 0)")));
  // A guard more is another rule, however.
  EXPECT_GT(DiffKnowledge(a, b).Count(KbChange::kAdded), 0);
}

TEST(KbDiffTest, WhatIsAboutAnotherCommandHasNoRelative) {
  const KnowledgeBase a = Paper();
  const KnowledgeBase b = Without(
      a, [&](const ModelRecord& record) { return TitleOf(a, record.model.id).starts_with("grab_type_2"); });
  const KbDiffResult difference = DiffKnowledge(a, b);
  ASSERT_FALSE(difference.items.empty());
  for (const KbDiffItem& item : difference.items) {
    EXPECT_FALSE(item.relative) << item.title;
    for (const AlignedRow& row : item.rows) EXPECT_EQ(row.status, PartStatus::kLeftOnly);
  }
}

TEST(KbDiffTest, EvidenceThatIsNoNumberIsTheSameAsItself) {
  // Once such evidence differed from itself.
  KnowledgeBase a = Paper();
  const double none = std::numeric_limits<double>::quiet_NaN();
  a.SetEvidence(a.models().begin()->first, {none, none}, false);
  EXPECT_TRUE(DiffKnowledge(a, a).empty());
}

// ---- of any knowledge

// Some of the composite states' components and some of the models are left out, with new numbers.
KnowledgeBase Thinned(const KnowledgeBase& knowledge, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  return Renumbered(Without(knowledge, [&](const ModelRecord&) { return random() % 4 == 0; }), seed);
}

TEST(KbDiffTest, EveryPieceIsListedOnceWhateverIsCompared) {
  EXPECT_TRUE(rc::check([] {
    const KnowledgeBase whole = Paper(*rc::gen::inRange(3, 16));
    const KnowledgeBase a = Thinned(whole, *rc::gen::arbitrary<std::uint64_t>());
    const KnowledgeBase b = Thinned(whole, *rc::gen::arbitrary<std::uint64_t>());
    const KbDiffResult difference = DiffKnowledge(a, b);
    std::multiset<std::string> left, right;
    for (const std::vector<KbDiffItem>* items : {&difference.items, &difference.same}) {
      for (const KbDiffItem& item : *items) {
        if (item.left && item.left->id.starts_with("mdl")) left.insert(item.left->id);
        if (item.right && item.right->id.starts_with("mdl")) right.insert(item.right->id);
      }
    }
    RC_ASSERT(left.size() == a.models().size());
    RC_ASSERT(right.size() == b.models().size());
    RC_ASSERT(std::set<std::string>(left.begin(), left.end()).size() == left.size());
    RC_ASSERT(Told(DiffKnowledge(a, b)) == Told(Exchanged(DiffKnowledge(b, a))));
  }));
}

}  // namespace
}  // namespace aerascope
