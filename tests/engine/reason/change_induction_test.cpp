// Induction from change: the examples of semantics 10.4, each guard form, and what is rejected.
#include "engine/reason/change_induction.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "tests/engine/reason/agent.h"

namespace aerascope {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Fact> HandIsAHand() {
  return {Holds(Val("h", "essence", O("hand")), kAlways)};
}

CompositeStateId StateId(const Agent& agent, const CompositeState& state) {
  const CompositeStateRecord* record = agent.Find(state);
  return record ? record->state.id : CompositeStateId{};
}

// The causal model of a move along `argument` 1: P1 := P0 op D.
Model MoveModel(const char* forward = "+", const char* backward = "-") {
  Model model;
  model.template_arguments = {V(0), Ti(V(1), V(2))};
  model.lhs = {true, Cmd("move", {V(3), V(4)}), V(5), V(6)};
  model.rhs = {true, MakeValue(V(3), O("position"), V(7)), V(8), V(9)};
  model.forward = {Assign(8, "+", V(1), D(100)), Assign(9, "+", V(2), D(100)),
                   Assign(7, forward, V(0), V(4))};
  model.backward = {Assign(1, "-", V(8), D(100)), Assign(2, "-", V(9), D(100)), Assign(5, "-", V(8), D(80)),
                    Assign(6, "-", V(9), D(100)), Assign(4, backward, V(7), V(0))};
  return model;
}

std::vector<std::string> Verdicts(const Agent& agent) {
  std::vector<std::string> verdicts;
  for (const CauseConsidered* considered : agent.events.All<CauseConsidered>()) {
    std::string text(EnumName(considered->verdict));
    if (!considered->guard_form.empty()) text += ": " + considered->guard_form;
    verdicts.push_back(text);
  }
  return verdicts;
}

// One frame before, the command or HOLD value, one frame after.
Agent After(const Term& before, const Term& command, const Term& after) {
  Agent agent(HandIsAHand(), {HandAt(1)});
  agent.Sense({before});
  agent.Do(command);
  agent.Sense({after});
  return agent;
}

TEST(ChangeInduction, Move) {
  // OpenAERA (semantics 10.4, move).
  // Given a hand at 20 that is moved by -5,
  Agent agent = After(Val("h", "position", N(20)), Cmd("move", {E("h"), N(-5)}), Val("h", "position", N(15)));
  // then the move is learned, with the sum as its formula,
  const ModelRecord* move = agent.Find(MoveModel());
  ASSERT_TRUE(move) << agent.Text();
  EXPECT_EQ(move->evidence, (Evidence{1, 1}));
  EXPECT_EQ(move->origin, Origin::kInduction);
  EXPECT_THAT(Verdicts(agent), Contains("built: sum"));
  // and that a hand at P0 is what it takes: icst S0 [v0 v1] -> imdl [v1 ti] [v0 v4 v5 v6 v7].
  Model requirement;
  requirement.lhs = {true, MakeIcst(StateId(agent, HandAt(0)), {}, {V(0), V(1)}), V(2), V(3)};
  requirement.rhs = {true, MakeImdl(move->model.id, {V(1), Ti(V(2), V(3))}, {V(0), V(4), V(5), V(6), V(7)}),
                     V(2), V(3)};
  EXPECT_TRUE(agent.Find(requirement)) << agent.Text();
}

TEST(ChangeInduction, TheSecondMoveIsPredictedAndNothingIsInduced) {
  // OpenAERA (semantics 10.4, move).
  Agent agent = After(Val("h", "position", N(20)), Cmd("move", {E("h"), N(-5)}), Val("h", "position", N(15)));
  const std::size_t runs = agent.events.All<InductionStarted>().size();
  agent.Do(Cmd("move", {E("h"), N(-10)}));
  agent.Sense({Val("h", "position", N(5))});
  EXPECT_EQ(agent.Find(MoveModel())->evidence, (Evidence{2, 2}));
  EXPECT_EQ(agent.events.All<InductionStarted>().size(), runs);
}

TEST(ChangeInduction, Coincidence) {
  // Own (semantics 10.4, coincidence): OpenAERA makes one variable of argument 5 and new position 5.
  Agent agent = After(Val("h", "position", N(0)), Cmd("move", {E("h"), N(5)}), Val("h", "position", N(5)));
  EXPECT_TRUE(agent.Find(MoveModel())) << agent.Text();
}

// A mind that takes equal numbers for the same one, as in openaera mode.
Agent LooksAtValuesAlone() {
  ReasonerParameters parameters;
  parameters.value_roles = ValueRoles::kTogether;
  return Agent(HandIsAHand(), {HandAt(1)}, {}, parameters);
}

TEST(ChangeInduction, CoincidenceInOpenaeraMode) {
  // OpenAERA (semantics 10.4, coincidence): argument 5 and new position 5 are one variable, which the guards
  // overwrite: move [v3 v4], position v4, v4 := v0 + v4 and back v4 := v4 - v0.
  Agent agent = LooksAtValuesAlone();
  agent.Sense({Val("h", "position", N(0))});
  agent.Do(Cmd("move", {E("h"), N(5)}));
  agent.Sense({Val("h", "position", N(5))});
  Model coincidence;
  coincidence.template_arguments = {V(0), Ti(V(1), V(2))};
  coincidence.lhs = {true, Cmd("move", {V(3), V(4)}), V(5), V(6)};
  coincidence.rhs = {true, MakeValue(V(3), O("position"), V(4)), V(7), V(8)};
  coincidence.forward = {Assign(7, "+", V(1), D(100)), Assign(8, "+", V(2), D(100)),
                         Assign(4, "+", V(0), V(4))};
  coincidence.backward = {Assign(1, "-", V(7), D(100)), Assign(2, "-", V(8), D(100)),
                          Assign(5, "-", V(7), D(80)), Assign(6, "-", V(8), D(100)),
                          Assign(4, "-", V(4), V(0))};
  const ModelRecord* move = agent.Find(coincidence);
  ASSERT_TRUE(move) << agent.Text();
  EXPECT_FALSE(agent.Find(MoveModel()));
  // "It survives only because guards overwrite in sequence": the next move is predicted,
  agent.Do(Cmd("move", {E("h"), N(-7)}));
  agent.Sense({Val("h", "position", N(-2))});
  EXPECT_EQ(move->evidence, (Evidence{2, 2}));
  // and a place that is wanted gives the move that leads there.
  agent.reasoner.SetDrive("h at 10", Val("h", "position", N(10)), Time{1'000'000});
  const auto wish = agent.reasoner.Decide();
  ASSERT_TRUE(wish);
  EXPECT_EQ(wish->command, Cmd("move", {E("h"), N(12)}));
}

TEST(ChangeInduction, WithoutACoincidenceBothModesLearnTheSame) {
  // OpenAERA (semantics 10.4, move), where value_roles is "together": 20, -5 and 15 are three values.
  Agent agent = LooksAtValuesAlone();
  agent.Sense({Val("h", "position", N(20))});
  agent.Do(Cmd("move", {E("h"), N(-5)}));
  agent.Sense({Val("h", "position", N(15))});
  EXPECT_TRUE(agent.Find(MoveModel())) << agent.Text();
}

TEST(ChangeInduction, Grab) {
  // OpenAERA (semantics 10.4, grab).
  // Given a hand and a cube both at 5, and other things elsewhere, when the hand grabs,
  std::vector<Fact> properties = HandIsAHand();
  for (const auto& [thing, shape, size] :
       {std::tuple{"c1", "cube", "small"}, std::tuple{"c2", "cube", "large"},
        std::tuple{"s", "sphere", "large"}}) {
    properties.push_back(Holds(Val(thing, "shape", O(shape)), kAlways));
    properties.push_back(Holds(Val(thing, "size", O(size)), kAlways));
  }
  Agent agent(properties, {HandAt(1), ThingAt(2, "shape"), ThingAt(3, "size")});
  const std::vector<Term> positions{Val("h", "position", N(5)), Val("c1", "position", N(5)),
                                    Val("c2", "position", N(10)), Val("s", "position", N(15))};
  std::vector<Term> facts = positions;
  facts.push_back(Val("h", "holding", Set({})));
  agent.Sense(facts);
  agent.Do(Cmd("grab_type1", {E("h")}));
  facts.back() = Val("h", "holding", Set({E("c1")}));
  agent.Sense(facts);
  // then the condition has an empty hand, the small cube and the hand at one place, and nothing about the
  // others.
  const auto s0 = StateId(agent, HandAt(0));
  const auto s3 = StateId(agent, ThingAt(0, "shape"));
  const auto s4 = StateId(agent, ThingAt(0, "size"));
  const CompositeState condition =
      State(0, 1,
            {MakeValue(V(0), O("holding"), Set({})), MakeIcst(s3, {}, {V(3), O("cube"), V(4)}),
             MakeIcst(s4, {}, {V(3), O("small"), V(4)}), MakeIcst(s0, {}, {V(0), V(4)})});
  ASSERT_TRUE(agent.Find(condition)) << agent.Text();
  // The causal model has no value but timing; the requirement exposes [H C T2 T3], the template is literal
  // [].
  const auto models = agent.Models(ModelKind::kCausal);
  ASSERT_EQ(models.size(), 1u);
  EXPECT_EQ(models[0]->model.template_arguments[0], Set({}));
  const auto requirements = agent.Models(ModelKind::kWeakRequirement);
  ASSERT_EQ(requirements.size(), 1u);
  Model expected;
  // Arguments of the condition in order of its variables: H, then those of the others as they come.
  const CompositeState& learned = agent.kb().Find(RequiredState(requirements[0]->model))->state;
  EXPECT_EQ(agent.kb().CanonicalOf(learned).hash, agent.kb().CanonicalOf(condition).hash);
  const Term& imdl = requirements[0]->model.rhs.payload;
  EXPECT_EQ(imdl[2].size(), 4u);
  EXPECT_EQ(imdl[1][0], Set({}));
  const Term& icst = requirements[0]->model.lhs.payload;
  EXPECT_THAT(std::vector<Term>(icst[2].items().begin(), icst[2].items().end()), Contains(imdl[2][0]));
  EXPECT_THAT(std::vector<Term>(icst[2].items().begin(), icst[2].items().end()), Contains(imdl[2][1]));
  EXPECT_THAT(Verdicts(agent), Contains("no_shared_value"));
}

// Hand, sphere in it, both at `at`.
std::vector<Term> Carrying(double at) {
  return {Val("h", "position", N(at)), Val("s", "position", N(at)), Val("h", "holding", Set({E("s")}))};
}

Agent ThatCarries(double to = 0) {
  std::vector<Fact> properties = HandIsAHand();
  properties.push_back(Holds(Val("s", "essence", O("sphere")), kAlways));
  Agent agent(properties, {HandAt(1)});
  // The move is learned with the empty hand.
  agent.Sense({Val("h", "position", N(20)), Val("s", "position", N(5)), Val("h", "holding", Set({}))});
  agent.Do(Cmd("move", {E("h"), N(-15)}));
  agent.Sense({Val("h", "position", N(5)), Val("s", "position", N(5)), Val("h", "holding", Set({}))});
  agent.Sense(Carrying(5));
  agent.Do(Cmd("move", {E("h"), N(to - 5)}));
  agent.Sense(Carrying(to));
  return agent;
}

Model CarryModel(ModelId move) {
  Model model;
  model.template_arguments = {V(0), Ti(V(1), V(2))};
  model.lhs = {true, MakeImdl(move, {V(0), Ti(V(1), V(2))}, {V(3), V(4), V(5), V(6), V(7)}), V(8), V(9)};
  model.rhs = {true, MakeValue(V(10), O("position"), V(5)), V(6), V(7)};
  model.forward = {Assign(6, "+", V(1), D(100)), Assign(7, "+", V(2), D(100))};
  model.backward = {Assign(1, "-", V(6), D(100)), Assign(2, "-", V(7), D(100)), Assign(8, "-", V(6), D(80)),
                    Assign(9, "-", V(7), D(100))};
  return model;
}

TEST(ChangeInduction, Reuse) {
  // OpenAERA (semantics 10.4, reuse).
  // Given a known move, when a sphere in the hand goes along from 5 to 0,
  Agent agent = ThatCarries();
  // then a model on the move's instance is learned: the sphere is where the move takes the hand, when it
  // does.
  const ModelRecord* move = agent.Find(MoveModel());
  ASSERT_TRUE(move);
  const ModelRecord* reuse = agent.Find(CarryModel(move->model.id));
  // The exposed variables of the move as it was learned: [H D Tc.. ] are those of the oracle.
  ASSERT_TRUE(reuse) << agent.Text();
  EXPECT_THAT(Verdicts(agent), Contains("built: given"));
  // Its condition names the hand, so that it is this hand's moves that count.
  const auto requirements = agent.kb().RequirementsOf(reuse->model.id);
  ASSERT_EQ(requirements.size(), 1u);
  const CompositeState& condition =
      agent.kb().Find(RequiredState(agent.kb().Find(requirements[0])->model))->state;
  bool holding = false;
  for (const FactPattern& component : condition.components) {
    holding = holding || (IsValue(component.payload) && component.payload[1] == O("holding"));
  }
  EXPECT_TRUE(holding) << ToText(condition);
}

TEST(ChangeInduction, ReuseIsPredictedTheNextTime) {
  // Own: what was learned on the move's instance rides on the next instance.
  Agent agent = ThatCarries();
  agent.Do(Cmd("move", {E("h"), N(30)}));
  agent.Sense(Carrying(30));
  const auto reuse = agent.Models(ModelKind::kReuse);
  ASSERT_EQ(reuse.size(), 1u);
  EXPECT_EQ(reuse[0]->evidence, (Evidence{2, 2})) << agent.Text();
}

TEST(ChangeInduction, ProductOfAnArgument) {
  // OpenAERA (semantics 5.1, guard guess: product).
  Agent agent = After(Val("h", "position", N(3)), Cmd("move", {E("h"), N(4)}), Val("h", "position", N(12)));
  EXPECT_TRUE(agent.Find(MoveModel("*", "/"))) << agent.Text();
  EXPECT_THAT(Verdicts(agent), Contains("built: product"));
}

TEST(ChangeInduction, VectorsMoveByAVector) {
  // OpenAERA (semantics 5.1: operator-bearing structures such as vec3).
  const auto vec3 = [](double x, double y, double z) { return Struct("vec3", {N(x), N(y), N(z)}); };
  Agent agent = After(Val("h", "position", vec3(1, 2, 3)), Cmd("move", {E("h"), vec3(0.5, 0, -1)}),
                      Val("h", "position", vec3(1.5, 2, 2)));
  EXPECT_TRUE(agent.Find(MoveModel())) << agent.Text();
}

// A ball at `at` with a velocity that is held.
void SenseBall(Agent* agent, double at, Term velocity) {
  agent->SenseFacts(
      {Holds(Val("b", "position", N(at)), agent->NextFrame()), agent->Hold(Val("b", "velocity", velocity))});
}

Agent BallRolling(double from, double to, const Term& velocity) {
  Agent agent({Holds(Val("b", "essence", O("ball")), kAlways)}, {});
  SenseBall(&agent, from, velocity);
  SenseBall(&agent, to, velocity);
  return agent;
}

Model BallModel(const char* attribute, Term operand, const char* op) {
  Model model;
  model.template_arguments = {V(0), Ti(V(1), V(2))};
  model.lhs = {true, MakeValue(V(3), O(attribute), V(4)), V(5), V(6)};
  model.rhs = {true, MakeValue(V(3), O("position"), V(7)), V(8), V(9)};
  model.forward = {Assign(8, "+", V(1), D(100)), Assign(9, "+", V(2), D(100)),
                   Assign(7, op, V(0), std::move(operand))};
  model.backward = {Assign(1, "-", V(8), D(100)), Assign(2, "-", V(9), D(100)), Assign(5, "-", V(8), D(80)),
                    Assign(6, "-", V(9), D(100))};
  return model;
}

TEST(ChangeInduction, RateOverThePeriod) {
  // OpenAERA (semantics 5.1: a fact with a numeric value as cause); the unit per second is own.
  Agent agent = BallRolling(1, 1.5, N(5));
  Model expected = BallModel("velocity", Struct("*", {V(4), D(100)}), "+");
  expected.backward.push_back(Assign(4, "/", Struct("-", {V(7), V(0)}), D(100)));
  EXPECT_TRUE(agent.Find(expected)) << agent.Text();
  EXPECT_THAT(Verdicts(agent), Contains("built: rate"));
  // It rolls on as it was learned, and faster when the velocity is another.
  SenseBall(&agent, 2, N(20));
  SenseBall(&agent, 4, N(20));
  EXPECT_EQ(agent.Find(expected)->evidence, (Evidence{3, 3}));
}

TEST(ChangeInduction, ConstantProduct) {
  // OpenAERA (semantics 5.1: no rate, value before is not 0).
  Agent agent = BallRolling(2, 6, N(7));
  Model expected = BallModel("velocity", N(3), "*");
  expected.backward.push_back(Assign(0, "/", V(7), N(3)));
  EXPECT_TRUE(agent.Find(expected)) << agent.Text();
}

TEST(ChangeInduction, ConstantSum) {
  // OpenAERA (semantics 5.1: no rate, value before is 0).
  Agent agent = BallRolling(0, 6, N(7));
  Model expected = BallModel("velocity", N(6), "+");
  expected.backward.push_back(Assign(0, "-", V(7), N(6)));
  EXPECT_TRUE(agent.Find(expected)) << agent.Text();
}

TEST(ChangeInduction, RejectsWhereNoFormulaLeadsFromPremiseToConsequent) {
  // Own (semantics 10.4, rejections): consequent 7, premise 5, argument 3.
  Agent agent = After(Val("h", "position", N(5)), Cmd("move", {E("h"), N(3)}), Val("h", "position", N(7)));
  EXPECT_THAT(Verdicts(agent), ElementsAre("no_guard_form"));
  EXPECT_TRUE(agent.kb().models().empty());
}

TEST(ChangeInduction, RejectsAPremiseWithNothingInStepWithIt) {
  // Own (semantics 10.4, rejections): no partner and no instance.
  Agent agent;
  agent.Sense({Val("h", "position", N(5))});
  agent.Do(Cmd("move", {E("h"), N(3)}));
  agent.Sense({Val("h", "position", N(8))});
  EXPECT_THAT(Verdicts(agent), ElementsAre("no_composite_state"));
  EXPECT_TRUE(agent.kb().models().empty());
  const auto rejected = agent.events.All<ModelRejected>();
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0]->reason, CauseVerdict::kNoCompositeState);
  EXPECT_EQ(KindOf(rejected[0]->candidate), ModelKind::kCausal);
}

// "hand: (mk.val h essence hand)" and the like: what was made of each input of the last induction, in order.
std::vector<std::string> Inputs(const EventList& events) {
  std::map<FactId, std::string> facts;
  for (const Event& event : events.events) {
    if (const auto* seen = std::get_if<FactObserved>(&event.body))
      facts[seen->fact_id] = ToText(seen->fact.payload);
    if (const auto* found = std::get_if<IcstFound>(&event.body))
      facts[found->fact_id] = ToText(found->fact.payload);
  }
  std::vector<std::string> inputs;
  for (const ConsideredInput& one : events.All<InductionStarted>().back()->inputs)
    inputs.push_back(std::string(EnumName(one.verdict)) + ": " + facts.at(one.input));
  return inputs;
}

// A hand at 5 is moved by 3 while a lamp, switched on in the middle of the frame, stands elsewhere; the lamp
// is brass, and hot.
void MoveBesideALamp(Agent* agent) {
  agent->SenseFacts({Holds(Val("h", "position", N(5)), agent->NextFrame()),
                     Holds(Val("lamp", "position", N(9)), agent->NextFrame()),
                     agent->Hold(Val("lamp", "lit", O("yes")))});
  agent->Do(Cmd("move", {E("h"), N(3)}));
  agent->SenseFacts({Holds(Val("h", "position", N(8)), agent->NextFrame()),
                     Holds(Val("lamp", "position", N(9)), agent->NextFrame())});
}

std::vector<Fact> HandAndLamp() {
  return {Holds(Val("h", "essence", O("hand")), kAlways),
          Holds(Val("lamp", "material", O("brass")), kAlways)};
}

TEST(ChangeInduction, EachInputIsKeptOrDroppedWithAReason) {
  // OpenAERA (semantics 5.1, inputs; 9, "inputs kept / dropped with reason"). The hand's property, and that
  // it is a hand at 5, are kept as conditions, and the command as a possible cause; what is known of the lamp
  // is dropped, properties included, and so is the instance that holds of the lamp.
  Agent agent(HandAndLamp(), {HandAt(1), ThingAt(2, "material")});
  MoveBesideALamp(&agent);
  const std::string hand_at = "(icst cst_" + std::to_string(StateId(agent, HandAt(0)).value) + " [] [h 5])";
  const std::string lamp_at =
      "(icst cst_" + std::to_string(StateId(agent, ThingAt(0, "material")).value) + " [] [lamp brass 9])";
  const auto inputs = Inputs(agent.events);
  EXPECT_THAT(inputs, ::testing::UnorderedElementsAre(
                          "condition: (mk.val h essence hand)", "condition: " + hand_at,
                          "cause: (cmd move [h 3])", "no_shared_value: (mk.val lamp material brass)",
                          "no_shared_value: (mk.val lamp position 9)",
                          "no_shared_value: (mk.val lamp lit yes)", "part_not_shared: " + lamp_at));
  // What was kept is named first.
  EXPECT_THAT(std::vector(inputs.begin(), inputs.begin() + 3),
              ::testing::Each(::testing::Not(::testing::HasSubstr("shared"))));
}

TEST(ChangeInduction, AnInputThatComesWithTheConsequentIsTooLate) {
  // OpenAERA (semantics 5.1, inputs, 1). What holds from the next frame on cannot have caused what is seen
  // then.
  Agent agent(HandIsAHand(), {HandAt(1)});
  const TimeInterval next = agent.NextFrame();
  agent.SenseFacts({Holds(Val("h", "position", N(5)), next),
                    Holds(Val("h", "mood", O("good")), {next.before, next.before + Milliseconds(100)})});
  agent.Sense({Val("h", "position", N(8))});
  EXPECT_THAT(Inputs(agent.events), Contains("too_late: (mk.val h mood good)"));
}

TEST(ChangeInduction, WhatTheEngineConcludedIsNotEligible) {
  // Own: nothing rests on absences. That x was not there in time is concluded, and listed as not eligible.
  Model wrong;
  wrong.id = {7};
  wrong.lhs = {true, Cmd("call", {E("h")}), V(0), V(1)};
  wrong.rhs = {true, Val("h", "mood", O("good")), V(2), V(3)};
  wrong.forward = {Assign(2, "+", V(0), D(80)), Assign(3, "+", V(1), D(100))};
  Agent agent(HandIsAHand(), {HandAt(1)}, {{wrong, {}, false}});
  agent.Sense({Val("h", "position", N(5))});
  agent.Do(Cmd("call", {E("h")}));
  agent.Sense({Val("h", "position", N(5))});
  agent.Sense({Val("h", "position", N(5))});
  agent.Do(Cmd("move", {E("h"), N(3)}));
  agent.Sense({Val("h", "position", N(8))});
  EXPECT_THAT(Inputs(agent.events), Contains("not_eligible: (mk.val h mood good)"));
}

TEST(ChangeInduction, WithItsReportOffTheSameIsLearned) {
  // Own: who leaves InductionStarted out pays for no list and learns the same.
  Agent loud(HandAndLamp(), {HandAt(1), ThingAt(2, "material")});
  MoveBesideALamp(&loud);
  Agent quiet(HandAndLamp(), {HandAt(1), ThingAt(2, "material")});
  EventKindSet off;
  off.set(KindOf<InductionStarted>());
  quiet.reasoner.journal().LeaveOut(off);
  MoveBesideALamp(&quiet);
  EXPECT_THAT(quiet.events.All<InductionStarted>(), IsEmpty());
  EXPECT_EQ(loud.events.All<InductionStarted>().size(), 1u);
  EXPECT_EQ(quiet.Text(), loud.Text());
  EXPECT_EQ(Verdicts(quiet), Verdicts(loud));
}

TEST(ChangeInduction, AnAntiFactIsNotWatched) {
  // Own (semantics 10.4, rejections).
  Agent agent(HandIsAHand(), {HandAt(1)});
  agent.SenseFacts({HoldsNot(Val("h", "position", N(5)), agent.NextFrame())});
  agent.Do(Cmd("move", {E("h"), N(3)}));
  agent.SenseFacts({Holds(Val("h", "position", N(8)), agent.NextFrame())});
  EXPECT_THAT(agent.events.All<InductionStarted>(), IsEmpty());
}

TEST(ChangeInduction, RejectsAnEffectThatNothingBinds) {
  // OpenAERA (semantics 5.1, reject: free variable): c appears in the hand, and nothing was known about it.
  Agent agent(HandIsAHand(), {});
  agent.Sense({Val("h", "position", N(5)), Val("h", "holding", Set({}))});
  agent.Do(Cmd("grab", {E("h")}));
  agent.Sense({Val("h", "position", N(5)), Val("h", "holding", Set({E("c")}))});
  EXPECT_THAT(Verdicts(agent), Contains("free_variable"));
  EXPECT_TRUE(agent.kb().models().empty());
  EXPECT_TRUE(agent.kb().composite_states().empty());
}

}  // namespace
}  // namespace aerascope
