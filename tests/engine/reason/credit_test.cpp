// Credit and what falls with a deleted model: semantics 3.5, the last row of 10.3, and the black list.
#include "engine/reason/credit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/reason/agent.h"

namespace aerascope {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

// A journal with models of every kind that may rest on one another, all at 1 of 1.
class Credit : public ::testing::Test {
 protected:
  ModelId Add(Model model) {
    model.id = journal.NewId<ModelId>();
    const ModelId id = model.id;
    journal.Write({}, ModelCreated{std::move(model), {}, false, Origin::kSeed, {}});
    return id;
  }
  ModelId AddCausal() {
    Model model;
    model.template_arguments = {V(0), Ti(V(1), V(2))};
    model.lhs = {true, Cmd("push", {V(3)}), V(4), V(5)};
    model.rhs = {true, MakeValue(V(3), O("position"), V(0)), V(6), V(7)};
    return Add(model);
  }
  ModelId AddRequirement(ModelId target, bool weak, const char* condition = "ready") {
    Model model;
    model.lhs = {true, MakeValue(V(0), O(condition), V(1)), V(2), V(3)};
    model.rhs = {weak, MakeImdl(target, {V(1), Ti(V(2), V(3))}, {V(0), V(4), V(5)}), V(2), V(3)};
    return Add(model);
  }
  ModelId AddReuse(ModelId ridden) {
    Model model;
    model.template_arguments = {V(0), Ti(V(1), V(2))};
    model.lhs = {true, MakeImdl(ridden, {V(0), Ti(V(1), V(2))}, {V(3), V(4), V(5)}), V(6), V(7)};
    model.rhs = {true, MakeValue(V(8), O("position"), V(0)), V(4), V(5)};
    return Add(model);
  }
  void Give(ModelId model, const std::vector<ModelId>& requirements, bool success) {
    GiveCredit({model, requirements, success, {}}, {}, {}, &journal);
  }
  const ModelRecord& Record(ModelId id) const { return *journal.knowledge().Find(id); }

  EventList events;
  Journal journal{&events};
};

TEST_F(Credit, AVetoIsRightWhenWhatItWarnedOfFailed) {
  // OpenAERA (semantics 3.5, credit assignment).
  const ModelId causal = AddCausal();
  const ModelId weak = AddRequirement(causal, true);
  const ModelId strong = AddRequirement(causal, false);
  Give(causal, {weak, strong}, false);
  EXPECT_EQ(Record(causal).evidence, (Evidence{1, 2}));
  EXPECT_EQ(Record(weak).evidence, (Evidence{1, 2}));
  EXPECT_EQ(Record(strong).evidence, (Evidence{2, 2}));
}

TEST_F(Credit, ReachesRequirementsOnRequirements) {
  // OpenAERA (semantics 3.5: recursively for requirements on requirements).
  const ModelId causal = AddCausal();
  const ModelId weak = AddRequirement(causal, true);
  const ModelId strong = AddRequirement(causal, false, "blocked");
  const ModelId weak_on_weak = AddRequirement(weak, true);
  const ModelId strong_on_weak = AddRequirement(weak, false);
  const ModelId weak_on_strong = AddRequirement(strong, true);
  const ModelId strong_on_strong = AddRequirement(strong, false);
  Give(causal, {weak, strong, weak_on_weak, strong_on_weak, weak_on_strong, strong_on_strong}, false);
  EXPECT_EQ(Record(weak_on_weak).evidence, (Evidence{1, 2}));
  EXPECT_EQ(Record(strong_on_weak).evidence, (Evidence{2, 2}));
  EXPECT_EQ(Record(weak_on_strong).evidence, (Evidence{2, 2}));
  EXPECT_EQ(Record(strong_on_strong).evidence, (Evidence{1, 2}));
}

TEST_F(Credit, WhatRestsOnADeletedModelFallsWithIt) {
  // OpenAERA (semantics 3.5, deletion): the orphaned model, and all that speaks about it or rides on it.
  const ModelId causal = AddCausal();
  const ModelId weak = AddRequirement(causal, true);
  const ModelId strong = AddRequirement(causal, false);
  const ModelId reuse = AddReuse(causal);
  const ModelId on_reuse = AddRequirement(reuse, true);
  // Given a requirement model that is wrong twice, alone,
  const EventId outcome = journal.last_event();
  for (int i = 0; i < 2; ++i) GiveCredit({weak, {}, false, outcome}, {}, {}, &journal);
  // then everything is gone, each for its reason, and only what failed is black-listed.
  std::vector<std::pair<ModelId, StateChangeReason>> changes;
  for (const ModelStateChanged* change : events.All<ModelStateChanged>()) {
    EXPECT_EQ(change->after, ModelState::kDeleted);
    changes.emplace_back(change->model, change->reason);
  }
  EXPECT_THAT(changes, ElementsAre(std::pair{weak, StateChangeReason::kRating},
                                   std::pair{causal, StateChangeReason::kOrphaned},
                                   std::pair{strong, StateChangeReason::kRefersToDeleted},
                                   std::pair{reuse, StateChangeReason::kRefersToDeleted},
                                   std::pair{on_reuse, StateChangeReason::kRefersToDeleted}));
  EXPECT_TRUE(Record(weak).black_listed);
  for (const ModelId id : {causal, strong, reuse, on_reuse}) EXPECT_FALSE(Record(id).black_listed);
}

TEST_F(Credit, AModelWithAnotherRequirementLeftIsNoOrphan) {
  // OpenAERA (semantics 3.5).
  const ModelId causal = AddCausal();
  const ModelId first = AddRequirement(causal, true);
  AddRequirement(causal, true, "willing");
  for (int i = 0; i < 2; ++i) Give(first, {}, false);
  EXPECT_EQ(Record(first).state, ModelState::kDeleted);
  EXPECT_EQ(Record(causal).state, ModelState::kActive);
}

// A hand at 5 that holds `thing`, or nothing.
std::vector<Term> Hand(const char* thing) {
  return {Val("h", "position", N(5)), Val("c", "position", N(5)), Val("d", "position", N(5)),
          Val("h", "holding", thing ? Set({E(thing)}) : Set({}))};
}

TEST(CreditInLife, Row12_AReleaseThatFailsOnceAndWorksAgain) {
  // OpenAERA (semantics 10.3, row 12; 10.4, release of c2): CM 2, 1; M_req 1, 1 | F, then S.
  // Given a release that worked twice on a cube, and once on a sphere, where it only needed a new condition,
  Agent agent({Holds(Val("h", "essence", O("hand")), kAlways), Holds(Val("c", "shape", O("cube")), kAlways),
               Holds(Val("d", "shape", O("sphere")), kAlways)},
              {HandAt(1), ThingAt(2, "shape")});
  for (const char* thing : {"c", "c", "d"}) {
    agent.Sense(Hand(thing));
    agent.Do(Cmd("release", {E("h")}));
    agent.Sense(Hand(nullptr));
  }
  const auto causal = agent.Models(ModelKind::kCausal);
  const auto weak = agent.Models(ModelKind::kWeakRequirement);
  ASSERT_EQ(causal.size(), 1u) << agent.Text();
  ASSERT_EQ(weak.size(), 2u) << agent.Text();
  const ModelRecord& release = *causal[0];
  const ModelRecord& sphere = *weak[1];
  ASSERT_EQ(release.evidence, (Evidence{2, 2}));
  ASSERT_EQ(sphere.evidence, (Evidence{1, 1}));
  // when it fails on the sphere,
  agent.Sense(Hand("d"));
  agent.Do(Cmd("release", {E("h")}));
  agent.Sense(Hand("d"));
  EXPECT_EQ(release.evidence, (Evidence{2, 3}));
  EXPECT_EQ(sphere.evidence, (Evidence{1, 2}));
  EXPECT_FALSE(agent.Models(ModelKind::kStrongRequirement).empty());
  // and then works although it was vetoed, then all are rated, the vetoes down.
  agent.Do(Cmd("release", {E("h")}));
  agent.Sense(Hand(nullptr));
  EXPECT_EQ(release.evidence, (Evidence{3, 4}));
  EXPECT_EQ(sphere.evidence, (Evidence{2, 3}));
  bool halved = false;
  for (const ModelRecord* veto : agent.Models(ModelKind::kStrongRequirement)) {
    halved = halved || veto->evidence == Evidence{1, 2};
  }
  EXPECT_TRUE(halved);
}

TEST(CreditInLife, AReleaseOfAnotherThingNeedsOnlyANewCondition) {
  // OpenAERA (semantics 10.4, release of c2): the causal model exists, only a composite state and a
  // requirement model are created. Given a release learned on a cube,
  Agent agent({Holds(Val("h", "essence", O("hand")), kAlways), Holds(Val("c", "shape", O("cube")), kAlways),
               Holds(Val("d", "shape", O("sphere")), kAlways)},
              {HandAt(1), ThingAt(2, "shape")});
  agent.Sense(Hand("c"));
  agent.Do(Cmd("release", {E("h")}));
  agent.Sense(Hand(nullptr));
  ASSERT_EQ(agent.Models(ModelKind::kCausal).size(), 1u) << agent.Text();
  const std::size_t states = agent.kb().composite_states().size();
  const std::size_t models = agent.kb().models().size();
  // when a sphere is released,
  agent.Sense(Hand("d"));
  agent.Do(Cmd("release", {E("h")}));
  agent.Sense(Hand(nullptr));
  // then one composite state and one requirement model are new.
  EXPECT_EQ(agent.Models(ModelKind::kCausal).size(), 1u);
  EXPECT_EQ(agent.kb().composite_states().size(), states + 1);
  EXPECT_EQ(agent.kb().models().size(), models + 1);
}

TEST(CreditInLife, WhatFailedIsNotLearnedAgain) {
  // OpenAERA (semantics 3.5, deleted-model memory): a black-listed CM also blocks its M_req.
  Agent agent({Holds(Val("h", "essence", O("hand")), kAlways)}, {HandAt(1)});
  const auto move = [&](double from, double to) {
    agent.Sense({Val("h", "position", N(from))});
    agent.Do(Cmd("move", {E("h"), N(to - from)}));
    agent.Sense({Val("h", "position", N(to))});
  };
  move(0, 5);
  const ModelId learned = agent.Models(ModelKind::kCausal).at(0)->model.id;
  for (int i = 0; i < 2; ++i) {
    Journal& journal = agent.reasoner.journal();
    GiveCredit({learned, {}, false, journal.last_event()}, agent.kb().now(), {}, &journal);
  }
  ASSERT_EQ(agent.kb().Find(learned)->state, ModelState::kDeleted);
  const std::size_t models = agent.kb().models().size();
  agent.Sense({Val("h", "position", N(5))});
  move(5, 9);
  EXPECT_EQ(agent.kb().models().size(), models);
  const auto rejected = agent.events.All<ModelRejected>();
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0]->reason, CauseVerdict::kBlackListed);
  EXPECT_EQ(rejected[0]->same_as, learned);
}

TEST(CreditInLife, WhatOnlyFellWithAnotherMayBeLearnedAnew) {
  // Own (semantics 3.5: the black list holds what failed).
  Agent agent({Holds(Val("h", "essence", O("hand")), kAlways)}, {HandAt(1)});
  const auto move = [&](double from, double to) {
    agent.Sense({Val("h", "position", N(from))});
    agent.Do(Cmd("move", {E("h"), N(to - from)}));
    agent.Sense({Val("h", "position", N(to))});
  };
  move(0, 5);
  const Model learned = agent.Models(ModelKind::kCausal).at(0)->model;
  Journal& journal = agent.reasoner.journal();
  Delete(learned.id, StateChangeReason::kOrphaned, journal.last_event(), agent.kb().now(), &journal);
  agent.Sense({Val("h", "position", N(5))});
  move(5, 9);
  const ModelRecord* again = agent.Find(learned);
  ASSERT_TRUE(again);
  EXPECT_NE(again->model.id, learned.id);
  EXPECT_EQ(again->state, ModelState::kActive);
}

}  // namespace
}  // namespace aerascope
