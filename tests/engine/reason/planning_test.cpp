// Planning over more than one model: chains generalised by analogy (paper, figure 1 right; semantics 6.4),
// sub-goals that keep to the individuals at hand, and searches that must end.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/kb/build_terms.h"
#include "tests/engine/reason/pick_and_place.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;

constexpr Duration kFrame = Milliseconds(100);

Term Value(Term object, const std::string& attribute, Term value) {
  return MakeValue(std::move(object), O(attribute), std::move(value));
}

CompositeState State(std::int64_t id, std::vector<Term> payloads, int after) {
  CompositeState state;
  state.id = CompositeStateId{id};
  for (Term& payload : payloads)
    state.components.push_back({true, std::move(payload), V(after), V(after + 1)});
  return state;
}

// template [(ti v0 v1)], command -> effect one frame later; v2.. are the variables of command and effect.
Model Causal(std::int64_t id, Term command, Term effect) {
  Model model;
  model.id = ModelId{id};
  model.template_arguments = {Term::Struct("ti", {V(0), V(1)})};
  model.lhs = {true, std::move(command), V(4), V(5)};
  model.rhs = {true, std::move(effect), V(6), V(7)};
  const Term period = Term::Span(kFrame);
  model.forward = {{6, Term::Struct("+", {V(0), period})}, {7, Term::Struct("+", {V(1), period})}};
  model.backward = {{0, Term::Struct("-", {V(6), period})}, {1, Term::Struct("-", {V(7), period})}};
  return model;
}

Model Requires(std::int64_t id, Term icst, const Model& causal, std::vector<Term> exposed) {
  Model model;
  model.id = ModelId{id};
  model.lhs = {true, std::move(icst), V(2), V(3)};
  model.rhs = {true, MakeImdl(causal.id, {Term::Struct("ti", {V(2), V(3)})}, std::move(exposed)), V(2), V(3)};
  return model;
}

// Pushing a large cube from the door brings it to the table; a large cube at the table can be grasped.
class PushThenGrab : public ::testing::Test {
 protected:
  PushThenGrab() : reasoner_({}, kFrame, &events_) {
    const CompositeState at_door = State(
        1,
        {Value(V(0), "place", O("door")), Value(V(0), "shape", O("cube")), Value(V(0), "size", O("large"))},
        1);
    const CompositeState at_table =
        State(2,
              {Value(V(0), "place", O("table")), Value(V(0), "shape", O("cube")),
               Value(V(0), "size", O("large")), Value(V(3), "holding", Term::Set({}))},
              1);
    const Model push = Causal(3, MakeCommand(O("push"), {V(2)}), Value(V(2), "place", O("table")));
    const Model grab = Causal(4, MakeCommand(O("grab"), {V(2)}), Value(V(2), "holding", Term::Set({V(3)})));
    const Model may_push = Requires(5, MakeIcst({1}, {}, {V(0)}), push, {V(0), V(4), V(5)});
    const Model may_grab = Requires(6, MakeIcst({2}, {}, {V(0), V(1)}), grab, {V(1), V(0), V(4), V(5)});
    const auto property = [](const Term& payload) { return Fact{true, payload, kAlways, 1}; };
    reasoner_.LoadSeed(
        {E("h"), E("s1")},
        {property(Value(E("s1"), "shape", O("sphere"))), property(Value(E("s1"), "size", O("large")))},
        {at_door, at_table},
        {{push, {}, false}, {grab, {}, false}, {may_push, {}, false}, {may_grab, {}, false}});
  }

  void See(const std::string& place, std::int64_t frame) {
    const TimeInterval interval{Time{frame * kFrame.us}, Time{(frame + 1) * kFrame.us}};
    reasoner_.BeginFrame(frame, {{true, Value(E("s1"), "place", O(place)), interval, 1},
                                 {true, Value(E("h"), "holding", Term::Set({})), interval, 1}});
  }

  EventList events_;
  Reasoner reasoner_;
};

TEST_F(PushThenGrab, AChainIsGeneralisedFromTheGoalBackwards) {
  // Given a large sphere at the door, when it is wanted in the hand,
  See("door", 0);
  reasoner_.SetDrive("hold s1", Value(E("h"), "holding", Term::Set({E("s1")})), Time{800'000});
  const auto wish = reasoner_.Decide();
  // then grasping is generalised first (3 of 4, one of them to be brought about), then pushing (2 of 3), and
  // the plan is as sure as both together.
  ASSERT_TRUE(wish.has_value());
  EXPECT_EQ(ToText(wish->command), "(cmd push [s1])");
  std::vector<std::string> accepted;
  for (const AnalogyCompared* c : events_.All<AnalogyCompared>()) {
    if (c->verdict != AnalogyVerdict::kAccepted) continue;
    accepted.push_back(std::to_string(c->matched) + "+" + std::to_string(c->achievable) + " of " +
                       std::to_string(c->total));
  }
  EXPECT_THAT(accepted, ElementsAre("2+1 of 4", "2+0 of 3"));
  const auto committed = events_.All<PlanCommitted>();
  ASSERT_EQ(committed.size(), 1u);
  EXPECT_NEAR(committed[0]->score, 0.5, 1e-9);
}

TEST_F(PushThenGrab, TheSecondStepIsReadyWhenTheFirstHasCome) {
  See("door", 0);
  reasoner_.SetDrive("hold s1", Value(E("h"), "holding", Term::Set({E("s1")})), Time{800'000});
  const auto wish = reasoner_.Decide();
  ASSERT_TRUE(wish.has_value());
  reasoner_.Executed(wish->command,
                     reasoner_.CommandIssued(wish->command, Commander::kAgent, wish->drive, wish->event));
  See("table", 1);
  EXPECT_EQ(events_.All<PredictionSucceeded>().size(), 1u);
  const auto next = reasoner_.Decide();
  ASSERT_TRUE(next.has_value());
  EXPECT_EQ(ToText(next->command), "(cmd grab [h])");
}

TEST_F(PushThenGrab, InOpenaeraModeTwoObservedConditionsAreTooFew) {
  ReasonerParameters parameters;
  parameters.analogy_mode = AnalogyMode::kOpenaera;
  PickAndPlace task(parameters);
  task.TeachBothGrasps();
  task.Pursue({task.Holding("s1")}, 2);
  // Three of four components matched: accepted, with the branch's constant confidence.
  for (const AnalogyCompared* c : task.events.All<AnalogyCompared>()) {
    if (c->verdict == AnalogyVerdict::kAccepted) {
      EXPECT_DOUBLE_EQ(c->confidence, 0.6);
    }
    if (c->matched < 3) {
      EXPECT_EQ(c->verdict, AnalogyVerdict::kTooFewMatched);
    }
  }
}

TEST(Planning, LettingGoIsAboutWhatIsHeld) {
  // Given s1 in the hand, when nothing is wanted in it, then no plan takes another thing first in order to
  // release it.
  PickAndPlace task;
  task.TeachBothGrasps();
  EXPECT_EQ(task.Pursue({task.Holding("s1"), task.Holding("")}), 2);
  for (const GoalSet* goal : task.events.All<GoalSet>()) {
    EXPECT_NE(ToText(goal->target.payload), "(mk.val h holding [c1])");
    EXPECT_NE(ToText(goal->target.payload), "(mk.val h holding [c2])");
  }
}

TEST(Planning, AFullHandIsEmptiedFirst) {
  // Given c1 in the hand, when c2 is wanted, then it lets go, moves and grasps.
  PickAndPlace task;
  task.TeachBothGrasps();
  task.commands.clear();
  EXPECT_EQ(task.Pursue({task.Holding("c1"), task.Holding("c2")}), 2);
  EXPECT_THAT(task.commands, ElementsAre("(cmd move [h -5])", "(cmd grab_type_1 [h])", "(cmd release [h])",
                                         "(cmd move [h 5])", "(cmd grab_type_2 [h])"));
}

TEST(Planning, WhatNoModelCanChangeIsNotPursued) {
  PickAndPlace task;
  task.TeachBothGrasps();
  EXPECT_EQ(task.Pursue({MakeValue(E("c1"), O("size"), O("large"))}, 2), 0);
  const auto skipped = task.events.All<GoalSkipped>();
  ASSERT_FALSE(skipped.empty());
  EXPECT_EQ(skipped[0]->reason, GoalSkipReason::kProperty);
}

TEST(Planning, TheConditionThatNothingBringsAboutIsNamed) {
  // Given a grasp that was learned on a small cube,
  PickAndPlace task;
  task.Teach("move c1");
  task.Teach("grab_type_1");
  task.Teach("release");
  // when the large cube is wanted,
  task.Pursue({task.Holding("c2")}, 1);
  // then what stands in the way is its size, and the properties that are as they should be are not said to.
  std::vector<std::string> in_the_way;
  for (const GoalSkipped* skipped : task.events.All<GoalSkipped>())
    if (skipped->reason == GoalSkipReason::kProperty) in_the_way.push_back(ToText(skipped->target.payload));
  EXPECT_THAT(in_the_way, ElementsAre("(mk.val c2 size small)"));
}

TEST(Planning, ASearchEndsWithItsBudget) {
  ReasonerParameters parameters;
  parameters.max_simulation_nodes = 1;
  PickAndPlace task(parameters);
  task.TeachBothGrasps();
  EXPECT_EQ(task.Pursue({task.Holding("s1")}, 2), 0);
  const auto skipped = task.events.All<GoalSkipped>();
  EXPECT_TRUE(std::any_of(skipped.begin(), skipped.end(),
                          [](const GoalSkipped* s) { return s->reason == GoalSkipReason::kBudget; }));
}

}  // namespace
}  // namespace aerascope
