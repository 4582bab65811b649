// Induction from goals (GTPX, semantics 5.3): what was wanted came about unexpectedly.
#include "engine/reason/goal_induction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/engine/reason/toy_mind.h"

namespace aerascope::toy {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

ReasonerParameters OnlySideEffects() {
  ReasonerParameters parameters;
  parameters.goal_induction = GoalInduction::kSideEffects;
  return parameters;
}

void Do(ToyMind* mind, const Term& command) {
  mind->reasoner.Executed(command, mind->reasoner.CommandIssued(command, Commander::kTeacher, {}, {}));
}

std::vector<const ModelRecord*> Learned(const ToyMind& mind) {
  std::vector<const ModelRecord*> learned;
  for (const auto& [id, record] : mind.reasoner.knowledge().models()) {
    if (record.origin == Origin::kGoalSuccess) learned.push_back(&record);
  }
  return learned;
}

std::size_t Inductions(const ToyMind& mind) {
  const auto all = mind.All<InductionStarted>();
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const InductionStarted* started) {
    return started->induction == InductionKind::kGoalSuccess;
  }));
}

// "(cmd press [lamp]) built", what induction from goals thought of each input.
std::vector<std::string> Verdicts(const ToyMind& mind) {
  std::map<FactId, std::string> facts;
  bool ours = false;
  std::vector<std::string> verdicts;
  for (const Event& event : mind.events.events) {
    if (const auto* seen = std::get_if<FactObserved>(&event.body))
      facts[seen->fact_id] = ToText(seen->fact.payload);
    if (const auto* started = std::get_if<InductionStarted>(&event.body))
      ours = started->induction == InductionKind::kGoalSuccess;
    const auto* considered = std::get_if<CauseConsidered>(&event.body);
    if (ours && considered)
      verdicts.push_back(facts[considered->fact_id] + " " + std::string(EnumName(considered->verdict)));
  }
  return verdicts;
}

// ---- the side effect of a command

// h goes away from the door, where c is beside it, as a model says that has a condition.
void KnowGoing(ToyMind* mind) {
  const CompositeState near = State(1, {Value(V(0), "place", O("door")), Value(V(3), "beside", V(0))}, 1);
  const Model go = Causal(2, Command("go", {V(2), V(3)}), Value(V(2), "place", O("table")));
  const Model may = Requires(3, MakeIcst({1}, {}, {V(0), V(1)}), go, {V(0), V(4), V(5), V(6)}, 2);
  mind->Know({}, {near}, {{go, {}, false}, {may, {}, false}});
}

// c is to be beside h no longer; a teacher lets h go, which is known to bring h to the table, and c stays
// behind.
void LoseCompany(ToyMind* mind) {
  KnowGoing(mind);
  mind->See({Value(E("h"), "place", O("door")), Value(E("c"), "beside", E("h"))});
  mind->Want(Value(E("c"), "beside", E("h")), 8, false);
  EXPECT_EQ(mind->Act(), "") << "nothing is known to help";
  Do(mind, Command("go", {E("h"), N(5)}));
  mind->See({Value(E("h"), "place", O("table")), Value(E("c"), "beside", E("wall"))});
}

TEST(GoalInduction, TheSideEffectOfACommandIsLearned) {
  // OpenAERA (semantics 5.3, the path that works): cmd -> |fact, the argument frozen in the backward guards,
  // and a requirement on the condition of the command's model.
  ToyMind mind(OnlySideEffects());
  LoseCompany(&mind);
  ASSERT_EQ(mind.All<GoalAchieved>().size(), 1u);
  const auto learned = Learned(mind);
  ASSERT_EQ(learned.size(), 2u);
  const Model& causal = learned[0]->model;
  EXPECT_EQ(KindOf(causal), ModelKind::kCausal);
  EXPECT_FALSE(causal.rhs.positive);
  EXPECT_TRUE(causal.template_arguments.empty());
  EXPECT_EQ(causal.lhs.payload[0], O("go"));
  EXPECT_EQ(causal.rhs.payload[2], causal.lhs.payload[1][0]) << "the same h";
  ASSERT_FALSE(causal.backward.empty());
  EXPECT_EQ(causal.backward.back().expression, N(5));
  EXPECT_EQ(KindOf(learned[1]->model), ModelKind::kWeakRequirement);
  EXPECT_EQ(TargetModel(learned[1]->model), causal.id);
  EXPECT_TRUE(RequiredState(learned[1]->model).valid()) << "the condition under which it went";
  EXPECT_THAT(Verdicts(mind), ElementsAre("(cmd go [h 5]) built"));
}

TEST(GoalInduction, WhatWasLearnedIsUsed) {
  // own. Given the lesson above, when another thing is to be away from h at the door, then h goes, as far as
  // then.
  ToyMind mind(OnlySideEffects());
  LoseCompany(&mind);
  mind.See({Value(E("h"), "place", O("door")), Value(E("d"), "beside", E("h"))});
  mind.Want(Value(E("d"), "beside", E("h")), 8, false);
  EXPECT_EQ(mind.Act(), "(cmd go [h 5])");
  mind.See({Value(E("h"), "place", O("table")), Value(E("d"), "beside", E("wall"))});
  EXPECT_EQ(mind.All<GoalAchieved>().size(), 2u);
  EXPECT_EQ(Inductions(mind), 1u) << "this time it was expected";
}

TEST(GoalInduction, WithoutASideEffectOpenaeraLearnsNothing) {
  // OpenAERA (semantics 5.3: pass_through, no inputs).
  ToyMind mind(OnlySideEffects());
  mind.See({});
  mind.Want(Value(E("lamp"), "state", O("on")));
  Do(&mind, Command("press", {E("lamp")}));
  mind.See({Value(E("lamp"), "state", O("on"))});
  EXPECT_EQ(mind.All<GoalAchieved>().size(), 1u);
  EXPECT_EQ(Inductions(mind), 0u);
  EXPECT_THAT(Learned(mind), IsEmpty());
}

// ---- whatever came before

TEST(GoalInduction, ACommandThatCameBeforeIsACause) {
  // own (semantics 5.3, as it is meant). Given a lamp that is first seen when it is on, after a press, then
  // pressing is learned, and done when the lamp is wanted again. What shares nothing with the goal is passed
  // over.
  ToyMind mind;
  mind.See({Value(E("door"), "state", O("open"))});
  mind.Want(Value(E("lamp"), "state", O("on")));
  Do(&mind, Command("press", {E("lamp")}));
  mind.See({Value(E("lamp"), "state", O("on")), Value(E("door"), "state", O("open"))});
  EXPECT_THAT(Verdicts(mind),
              UnorderedElementsAre("(cmd press [lamp]) built", "(mk.val door state open) no_shared_value"));
  std::vector<std::string_view> inputs;
  for (const ConsideredInput& one : mind.All<InductionStarted>().at(0)->inputs)
    inputs.push_back(EnumName(one.verdict));
  EXPECT_THAT(inputs, ElementsAre("cause", "no_shared_value")) << "what is kept is named first";
  ASSERT_EQ(Learned(mind).size(), 1u);
  mind.See({});
  mind.Want(Value(E("lamp"), "state", O("on")));
  EXPECT_EQ(mind.Act(), "(cmd press [lamp])");
}

TEST(GoalInduction, OnlyWhatCameSinceTheGoalWasGiven) {
  // own. A press before the goal was given is not looked at.
  ToyMind mind;
  mind.See({});
  Do(&mind, Command("press", {E("lamp")}));
  mind.See({});
  mind.Want(Value(E("lamp"), "state", O("on")));
  mind.See({Value(E("lamp"), "state", O("on"))});
  EXPECT_EQ(Inductions(mind), 1u);
  EXPECT_THAT(Verdicts(mind), IsEmpty());
}

TEST(GoalInduction, AStateThatHeldLeadsToTheGoal) {
  // own (semantics 5.3: cause or icst -> goal target). A plug alone is a cause by itself; within a composite
  // state, that one is.
  for (const bool known : {false, true}) {
    ToyMind mind;
    const CompositeState ready = State(1, {Value(V(0), "plug", O("in")), Value(V(0), "switch", O("on"))}, 1);
    if (known) mind.Know({}, {ready}, {});
    mind.See({Value(E("lamp"), "plug", O("in")), Value(E("lamp"), "switch", O("on"))});
    mind.Want(Value(E("lamp"), "state", O("on")));
    mind.See({Value(E("lamp"), "plug", O("in")), Value(E("lamp"), "switch", O("on")),
              Value(E("lamp"), "state", O("on"))});
    const auto learned = Learned(mind);
    ASSERT_EQ(learned.size(), known ? 1u : 2u);
    for (const ModelRecord* record : learned) EXPECT_EQ(IsIcst(record->model.lhs.payload), known);
  }
}

TEST(GoalInduction, AnEffectThatNothingGivesIsRejected) {
  // own (as in semantics 5.1: free variable). Which thing is held, neither the command nor anything else
  // says.
  ToyMind mind;
  mind.See({});
  mind.Want(Value(E("h"), "holding", Just(E("c"))));
  Do(&mind, Command("reach", {E("h")}));
  mind.See({Value(E("h"), "holding", Just(E("c")))});
  EXPECT_THAT(Verdicts(mind), ElementsAre("(cmd reach [h]) free_variable"));
  ASSERT_EQ(mind.All<ModelRejected>().size(), 1u);
  EXPECT_EQ(mind.All<ModelRejected>()[0]->induction, InductionKind::kGoalSuccess);
  EXPECT_THAT(Learned(mind), IsEmpty());
}

TEST(GoalInduction, WhatWasPromisedTeachesNothing) {
  // OpenAERA (semantics 5.3: unexpectedly).
  ToyMind mind;
  mind.Know({}, {}, {{Free(1, Command("press", {V(0)}), Value(V(0), "state", O("on"))), {}, false}});
  mind.See({});
  mind.Want(Value(E("lamp"), "state", O("on")));
  EXPECT_EQ(mind.Act(), "(cmd press [lamp])");
  mind.See({Value(E("lamp"), "state", O("on"))});
  EXPECT_EQ(Inductions(mind), 0u);
}

TEST(GoalInduction, AModelThatFailedIsNotMadeAgain) {
  // own (semantics 3.5, black list). Given that pressing was learned, failed twice and was deleted, when the
  // lamp comes on by chance after a press, then it is not learned again.
  ToyMind mind;
  mind.See({});
  mind.Want(Value(E("lamp"), "state", O("on")), 3);
  Do(&mind, Command("press", {E("lamp")}));
  mind.See({Value(E("lamp"), "state", O("on"))});
  for (int i = 0; i < 2; ++i) {
    Do(&mind, Command("press", {E("lamp")}));
    mind.See({});
    mind.See({});
  }
  ASSERT_EQ(Learned(mind).size(), 1u);
  ASSERT_EQ(Learned(mind)[0]->state, ModelState::kDeleted);
  mind.Want(Value(E("lamp"), "state", O("on")), 3);
  Do(&mind, Command("press", {E("lamp")}));
  mind.See({Value(E("lamp"), "state", O("on"))});
  EXPECT_EQ(Verdicts(mind).back(), "(cmd press [lamp]) black_listed");
  EXPECT_EQ(Learned(mind).size(), 1u);
}

}  // namespace
}  // namespace aerascope::toy
