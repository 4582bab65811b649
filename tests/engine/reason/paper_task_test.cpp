// The paper's task from teaching to the last grasp, on one line: what is learned, when, and how sure
// (semantics 8, 10).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/engine/reason/pick_and_place.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

std::vector<std::string> CommandsOfCausalModels(const KnowledgeBase& kb) {
  std::vector<std::string> functions;
  for (const auto& [id, record] : kb.models()) {
    if (KindOf(record.model) == ModelKind::kCausal) functions.push_back(ToText(record.model.lhs.payload[0]));
  }
  return functions;
}

// "grab_type_2: holding [], cst S4 large, ..." reduced to what tells triads apart: function, then ontology
// words.
std::string Signature(const KnowledgeBase& kb, const ModelRecord& requirement) {
  const Model& causal = kb.Find(TargetModel(requirement.model))->model;
  std::set<std::string> words;
  for (const FactPattern& component : kb.Find(RequiredState(requirement.model))->state.components) {
    ForEachTerm(component.payload, [&](const Term& part) {
      for (const char* word : {"cube", "small", "large"}) {
        if (part == Term::Ontology(word)) words.insert(word);
      }
    });
  }
  std::string text = causal.lhs.payload[0].name();
  for (const std::string& word : words) text += " " + word;
  return text;
}

std::vector<std::string> Requirements(const KnowledgeBase& kb, Origin origin) {
  std::vector<std::string> found;
  for (const auto& [id, record] : kb.models()) {
    if (IsRequirement(record.model) && record.origin == origin) found.push_back(Signature(kb, record));
  }
  return found;
}

const ModelRecord& Requirement(const KnowledgeBase& kb, const std::string& signature) {
  for (const auto& [id, record] : kb.models()) {
    if (IsRequirement(record.model) && Signature(kb, record) == signature) return record;
  }
  ADD_FAILURE() << "no requirement model " << signature;
  return kb.models().begin()->second;
}

std::vector<Term> ThePapersDrives(const PickAndPlace& task) {
  return {task.Holding("s1"), task.Holding(""), task.Holding("s2"), task.Holding(""), task.Holding("cyl")};
}

TEST(PaperTask, TeachingGivesOneTriadALesson) {
  // Given an agent that knows three composite states and no model, when a teacher moves, grasps and releases
  // both cubes,
  PickAndPlace task;
  task.TeachBothGrasps();
  task.Pursue({task.Holding("")});
  // then there is one causal model a command and one requirement model a lesson; the second move was
  // foreseen.
  const KnowledgeBase& kb = task.reasoner.knowledge();
  EXPECT_THAT(CommandsOfCausalModels(kb), ElementsAre("move", "grab_type_1", "release", "grab_type_2"));
  EXPECT_THAT(Requirements(kb, Origin::kInduction),
              ElementsAre("move", "grab_type_1 cube small", "release cube small", "grab_type_2 cube large",
                          "release cube large"));
  EXPECT_EQ(kb.composite_states().size(), 3u + 4u);
  EXPECT_EQ(Requirement(kb, "move").evidence, (Evidence{2, 2}));
}

TEST(PaperTask, AllDrivesAreReachedWithTheGraspThatFitsTheSize) {
  PickAndPlace task;
  task.TeachBothGrasps();
  task.commands.clear();
  EXPECT_EQ(task.Pursue(ThePapersDrives(task)), 5);
  EXPECT_THAT(task.commands, ElementsAre("(cmd move [h 5])", "(cmd grab_type_2 [h])", "(cmd release [h])",
                                         "(cmd move [h 5])", "(cmd grab_type_1 [h])", "(cmd release [h])",
                                         "(cmd move [h 5])", "(cmd grab_type_2 [h])"));
}

TEST(PaperTask, AnalogyKeepsSizeAndDropsShapeOnceEach) {
  PickAndPlace task;
  task.TeachBothGrasps();
  task.Pursue(ThePapersDrives(task));
  const KnowledgeBase& kb = task.reasoner.knowledge();
  // The cylinder needs nothing new: what the sphere taught covers it.
  EXPECT_THAT(Requirements(kb, Origin::kAnalogy),
              ElementsAre("grab_type_2 large", "release large", "grab_type_1 small", "release small"));
  EXPECT_EQ(kb.composite_states().size(), 3u + 4u + 4u);
  EXPECT_EQ(kb.models().size(), 4u + 5u + 4u);
  std::set<Hash128> contents;
  for (const auto& [id, record] : kb.models()) contents.insert(record.canonical.hash);
  for (const auto& [id, record] : kb.composite_states()) contents.insert(record.canonical.hash);
  EXPECT_EQ(contents.size(), kb.models().size() + kb.composite_states().size()) << "something is there twice";
}

TEST(PaperTask, TheFirstAnalogyStartsAtThreeQuartersAndSuccessRaisesIt) {
  PickAndPlace task;
  task.TeachBothGrasps();
  task.Pursue(ThePapersDrives(task));
  const auto compared = task.events.All<AnalogyCompared>();
  const auto first = std::find_if(compared.begin(), compared.end(), [](const AnalogyCompared* c) {
    return c->verdict == AnalogyVerdict::kAccepted;
  });
  ASSERT_NE(first, compared.end());
  EXPECT_EQ((*first)->matched, 3);
  EXPECT_EQ((*first)->total, 4);
  EXPECT_DOUBLE_EQ((*first)->psi, 0.75);
  EXPECT_DOUBLE_EQ((*first)->jaccard, 0.6);
  std::vector<double> confidence;
  for (const Event& event : task.events.events) {
    const auto* created = std::get_if<ModelCreated>(&event.body);
    if (created && created->model.id == (*first)->result_requirement)
      confidence.push_back(created->evidence.rate());
    const auto* updated = std::get_if<EvidenceUpdated>(&event.body);
    if (updated && updated->model == (*first)->result_requirement)
      confidence.push_back(updated->after.rate());
  }
  EXPECT_THAT(confidence, ElementsAre(0.75, 0.875, ::testing::DoubleNear(0.916667, 1e-6)));
}

TEST(PaperTask, ComparisonsSayWhyTheyWereNotTaken) {
  PickAndPlace task;
  task.TeachBothGrasps();
  task.Pursue({task.Holding("s1")});
  const KnowledgeBase& kb = task.reasoner.knowledge();
  std::vector<std::string> verdicts;
  for (const AnalogyCompared* c : task.events.All<AnalogyCompared>()) {
    verdicts.push_back(Signature(kb, *kb.Find(c->requirement)) + ": " + std::string(EnumName(c->verdict)));
  }
  // In the first frame grab-large is generalised and grab-small is too unfamiliar (2 of 4). In the second the
  // generalised condition holds as it is; the taught one would do as well but is not needed.
  EXPECT_THAT(verdicts,
              ElementsAre("grab_type_1 cube small: not_familiar", "grab_type_2 cube large: accepted",
                          "grab_type_1 cube small: not_familiar", "grab_type_2 cube large: not_required"));
}

TEST(PaperTask, AKnownObjectNeedsNoAnalogy) {
  // Given the taught cubes only, when c2 (elsewhere) is wanted, then the known condition is met by moving
  // there.
  PickAndPlace task;
  task.TeachBothGrasps();
  task.commands.clear();
  EXPECT_EQ(task.Pursue({task.Holding("c1"), task.Holding(""), task.Holding("c2")}), 3);
  EXPECT_THAT(Requirements(task.reasoner.knowledge(), Origin::kAnalogy), ElementsAre());
  EXPECT_THAT(task.commands, ElementsAre("(cmd move [h -5])", "(cmd grab_type_1 [h])", "(cmd release [h])",
                                         "(cmd move [h 5])", "(cmd grab_type_2 [h])"));
}

TEST(PaperTask, AnObjectOfUnknownKindIsLeftAlone) {
  ScriptedWorldConfig config = PickAndPlace::Config();
  config.objects[2].properties.clear();
  PickAndPlace task({}, config);
  task.TeachBothGrasps();
  EXPECT_EQ(task.Pursue({task.Holding("s1")}, 3), 0);
  EXPECT_THAT(Requirements(task.reasoner.knowledge(), Origin::kAnalogy), ElementsAre());
  EXPECT_EQ(task.events.All<GoalFailed>().size(), 1u);
}

TEST(PaperTask, AFailedAnalogyIsDeletedAndNotMadeAgain) {
  // Given a world in which only cubes can be held, when s1 is wanted, then the analogy is tried, fails, is
  // deleted (0.75 -> 0.375), and the same hypothesis is not made a second time.
  ScriptedWorldConfig config = PickAndPlace::Config();
  config.commands[2].holds = {{"shape", "cube"}};
  PickAndPlace task({}, config);
  task.TeachBothGrasps();
  EXPECT_EQ(task.Pursue({task.Holding("s1")}, 6), 0);
  const KnowledgeBase& kb = task.reasoner.knowledge();
  const ModelRecord& hypothesis = Requirement(kb, "grab_type_2 large");
  EXPECT_EQ(hypothesis.state, ModelState::kDeleted);
  EXPECT_DOUBLE_EQ(hypothesis.evidence.rate(), 0.375);
  EXPECT_EQ(Requirements(kb, Origin::kAnalogy).size(), 1u);
  const auto compared = task.events.All<AnalogyCompared>();
  EXPECT_TRUE(std::any_of(compared.begin(), compared.end(), [](const AnalogyCompared* c) {
    return c->verdict == AnalogyVerdict::kBlackListed;
  }));
}

TEST(PaperTask, EveryEventHasItsCausesAndTheKnowledgeIsTheFoldOfTheEvents) {
  PickAndPlace task;
  task.TeachBothGrasps();
  task.Pursue(ThePapersDrives(task));
  KnowledgeBase folded;
  std::int64_t expected_id = 0;
  for (const Event& event : task.events.events) {
    ASSERT_EQ(event.id.value, ++expected_id);
    EXPECT_TRUE(!event.causes.empty() || MayBeUncaused(event.body)) << ToText(event);
    for (const EventId cause : event.causes) EXPECT_LT(cause, event.id) << ToText(event);
    Apply(event, &folded);
  }
  const KnowledgeBase& kb = task.reasoner.knowledge();
  ASSERT_EQ(folded.models().size(), kb.models().size());
  for (const auto& [id, record] : kb.models()) {
    EXPECT_EQ(folded.Find(id)->evidence, record.evidence);
    EXPECT_EQ(folded.Find(id)->canonical.hash, record.canonical.hash);
  }
}

TEST(PaperTask, TheSameTaskGivesTheSameEvents) {
  const auto digest = [] {
    PickAndPlace task;
    task.TeachBothGrasps();
    task.Pursue(ThePapersDrives(task));
    EventDigest events;
    for (const Event& event : task.events.events) events.Add(event);
    return events.Value();
  };
  EXPECT_EQ(digest(), digest());
}

}  // namespace
}  // namespace aerascope
