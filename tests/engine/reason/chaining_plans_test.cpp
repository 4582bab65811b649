// What plans are made of: commands, facts to wait for, models that ride on others, nested conditions,
// conditions of conditions, anti-facts, vetoes (semantics 4.2 to 4.5).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/engine/reason/toy_mind.h"

namespace aerascope::toy {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

std::vector<std::string> SkipReasons(const ToyMind& mind) {
  std::vector<std::string> reasons;
  for (const GoalSkipped* skipped : mind.All<GoalSkipped>()) reasons.emplace_back(EnumName(skipped->reason));
  return reasons;
}

std::vector<std::string> Outcomes(const ToyMind& mind) {
  std::vector<std::string> outcomes;
  for (const SimulationEnded* ended : mind.All<SimulationEnded>())
    outcomes.emplace_back(EnumName(ended->outcome));
  return outcomes;
}

std::vector<std::string> Rejections(const ToyMind& mind) {
  std::vector<std::string> reasons;
  for (const PlanRejected* rejected : mind.All<PlanRejected>())
    reasons.emplace_back(EnumName(rejected->reason));
  return reasons;
}

// ------------------------------------------------------------------------------------------------ a fact on
// the left

// Pressing the switch closes it; a closed switch makes the lamp burn one frame later.
void KnowLamp(ToyMind* mind) {
  const Model press = Free(1, Command("press", {V(2)}), Value(V(2), "state", O("closed")));
  const Model burn = Free(2, Value(E("switch"), "state", O("closed")), Value(E("lamp"), "light", O("on")));
  mind->Know({}, {}, {{press, {}, false}, {burn, {}, false}});
}

TEST(FactOnTheLeft, BecomesASubGoalThatACommandReaches) {
  // own. Given an open switch, when light is wanted, then the switch is pressed now and the lamp is waited
  // for.
  ToyMind mind;
  KnowLamp(&mind);
  mind.See({Value(E("switch"), "state", O("open")), Value(E("lamp"), "light", O("off"))});
  mind.Want(Value(E("lamp"), "light", O("on")));
  EXPECT_EQ(mind.Act(), "(cmd press [switch])");
  const auto started = mind.All<SimulationStarted>();
  ASSERT_EQ(started.size(), 1u);
  ASSERT_EQ(started[0]->steps.size(), 2u);
  EXPECT_TRUE(started[0]->steps[1].command.is(TermKind::kNil));
  EXPECT_THAT(Outcomes(mind), ElementsAre("reached"));
}

TEST(FactOnTheLeft, WhatIsPredictedSuspendsTheGoalUntilItComes) {
  // own. Given that the switch is closed, the lamp is predicted: nothing is done for it, and it comes.
  ToyMind mind;
  KnowLamp(&mind);
  mind.See({Value(E("switch"), "state", O("closed")), Value(E("lamp"), "light", O("off"))});
  mind.Want(Value(E("lamp"), "light", O("on")));
  EXPECT_EQ(mind.Act(), "");
  ASSERT_EQ(mind.All<GoalSuspended>().size(), 1u);
  EXPECT_EQ(mind.All<GoalSet>().size(), 0u);
  mind.See({Value(E("switch"), "state", O("closed")), Value(E("lamp"), "light", O("on"))});
  EXPECT_EQ(mind.All<GoalAchieved>().size(), 1u);
  EXPECT_EQ(mind.All<GoalResumed>().size(), 0u);
}

TEST(FactOnTheLeft, WhenWhatWasPromisedFailsTheGoalIsPursuedAgain) {
  // own. Given a lamp that does not come although predicted, then the goal is resumed because of that
  // failure.
  ToyMind mind;
  KnowLamp(&mind);
  mind.See({Value(E("switch"), "state", O("closed")), Value(E("lamp"), "light", O("off"))});
  mind.Want(Value(E("lamp"), "light", O("on")));
  mind.Act();
  mind.See({Value(E("switch"), "state", O("open")), Value(E("lamp"), "light", O("off"))});
  const auto resumed = mind.Found<GoalResumed>();
  ASSERT_EQ(resumed.size(), 1u);
  bool because_of_failure = false;
  for (const EventId cause : resumed[0]->causes) {
    const Event& event = mind.events.events[static_cast<std::size_t>(cause.value - 1)];
    because_of_failure = because_of_failure || std::holds_alternative<PredictionFailed>(event.body);
  }
  EXPECT_TRUE(because_of_failure);
  EXPECT_EQ(mind.Act(), "(cmd press [switch])");
}

// Given a ball that moves 5 a frame and is at 0, it is wanted at 15.
void RollAndWant(ToyMind* mind) {
  Model roll = Free(1, Value(V(2), "position", V(3)), Value(V(2), "position", V(8)));
  roll.forward.push_back({8, Term::Struct("+", {V(3), N(5)})});
  roll.backward.push_back({3, Term::Struct("-", {V(8), N(5)})});
  mind->Know({}, {}, {{roll, {}, false}});
  mind->See({Value(E("ball"), "position", N(0))});
  mind->Want(Value(E("ball"), "position", N(15)));
  EXPECT_EQ(mind->Act(), "");
}

TEST(FactOnTheLeft, MovingThingsAreWaitedForOverSeveralFrames) {
  // own. Where nothing is predicted from predictions, the plan is to wait three frames.
  ReasonerParameters parameters;
  parameters.max_prediction_chain = 0;
  ToyMind mind(parameters);
  RollAndWant(&mind);
  const auto started = mind.All<SimulationStarted>();
  ASSERT_EQ(started.size(), 1u);
  EXPECT_EQ(started[0]->steps.size(), 3u);
  EXPECT_THAT(Outcomes(mind), ElementsAre("reached"));
  EXPECT_THAT(SkipReasons(mind), Contains("predicted"));
}

TEST(FactOnTheLeft, WhatFollowsFromPredictionsIsWaitedForWithoutAPlan) {
  // own. Where it is, the third position is predicted already, and nothing is done until it comes or fails.
  ToyMind mind;
  RollAndWant(&mind);
  EXPECT_EQ(mind.All<SimulationStarted>().size(), 0u);
  for (const int position : {5, 10}) {
    mind.See({Value(E("ball"), "position", N(position))});
    EXPECT_EQ(mind.Act(), "");
  }
  EXPECT_EQ(mind.All<GoalSuspended>().size(), 1u);
  EXPECT_EQ(mind.All<GoalResumed>().size(), 0u);
  mind.See({Value(E("ball"), "position", N(15))});
  EXPECT_EQ(mind.All<GoalAchieved>().size(), 1u);
}

// ---------------------------------------------------------------------------------------------------------
// reuse models

// The hand moves; what it holds moves with it.
void KnowCarrying(ToyMind* mind) {
  // template [P0 (ti T0 T1)]; (cmd move [H D]) -> (H position P1), P1 := P0 + D.
  Model move = Causal(2, Command("move", {V(2), V(8)}), Value(V(2), "position", V(9)));
  move.template_arguments.insert(move.template_arguments.begin(), V(3));
  move.forward.push_back({9, Term::Struct("+", {V(3), V(8)})});
  move.backward.push_back({8, Term::Struct("-", {V(9), V(3)})});
  // Exposed by move: H(2) T2(6) T3(7) D(8) P1(9).
  const CompositeState at = State(1, {Value(V(0), "essence", O("hand")), Value(V(0), "position", V(3))}, 1);
  Model may_move = Requires(3, MakeIcst({1}, {}, {V(0), V(1)}), move, {V(0), V(4), V(5), V(6), V(7)}, 2);
  may_move.rhs.payload =
      MakeImdl(move.id, {V(1), Term::Struct("ti", {V(2), V(3)})}, {V(0), V(4), V(5), V(6), V(7)});
  // (imdl move [P0 (ti T0 T1)] [H T2 T3 D P1]) -> (C position P1) [T2, T3), if H holds C.
  Model carry;
  carry.id = ModelId{4};
  carry.lhs = {true,
               MakeImdl(move.id, {V(0), Term::Struct("ti", {V(1), V(2)})}, {V(3), V(6), V(7), V(4), V(5)}),
               V(8), V(9)};
  carry.rhs = {true, Value(V(10), "position", V(5)), V(6), V(7)};
  const CompositeState held = State(5, {Value(V(0), "holding", Just(V(3)))}, 1);
  // Exposed by carry: v0..v7, v10 (all but its left side's times).
  const Model may_carry =
      Requires(6, MakeIcst({5}, {}, {V(0), V(1)}), carry,
               {Term::Wildcard(), Term::Wildcard(), Term::Wildcard(), V(0), Term::Wildcard(),
                Term::Wildcard(), Term::Wildcard(), Term::Wildcard(), V(1)},
               2);
  mind->Know({Value(E("h"), "essence", O("hand"))}, {at, held},
             {{move, {}, false}, {may_move, {}, false}, {carry, {}, false}, {may_carry, {}, false}});
}

TEST(ReuseModel, TheGoalBecomesAnInstanceOfTheModelItRidesOn) {
  // OpenAERA (the reuse model of semantics 10.4). Given s in the hand at 5, when s is wanted at 20, the hand
  // is moved.
  ToyMind mind;
  KnowCarrying(&mind);
  mind.See({Value(E("h"), "position", N(5)), Value(E("s"), "position", N(5)),
            Value(E("h"), "holding", Just(E("s")))});
  mind.Want(Value(E("s"), "position", N(20)));
  EXPECT_EQ(mind.Act(), "(cmd move [h 15])");
  EXPECT_THAT(Outcomes(mind), ElementsAre("reached"));
  bool imdl_goal = false;
  for (const GoalSet* goal : mind.All<GoalSet>()) {
    imdl_goal = imdl_goal || (IsImdl(goal->target.payload) &&
                              ToText(goal->target.payload).find("20") != std::string::npos);
  }
  EXPECT_TRUE(imdl_goal) << "the goal on the model's instance with its new position is logged";
}

TEST(ReuseModel, NeedsItsOwnConditionToo) {
  // own. Given an empty hand, when s is wanted elsewhere and nothing can put it into the hand, then nothing
  // is done.
  ToyMind mind;
  KnowCarrying(&mind);
  mind.See(
      {Value(E("h"), "position", N(5)), Value(E("s"), "position", N(5)), Value(E("h"), "holding", None())});
  mind.Want(Value(E("s"), "position", N(20)));
  EXPECT_EQ(mind.Act(), "");
}

// ---------------------------------------------------------------------------------------------------------------
// vetoes

// `go` brings h to the table if it is awake; `climb` does so too but is less sure; a wet floor vetoes `go`.
void KnowFloor(ToyMind* mind, double veto_rate, bool with_climb = true) {
  const CompositeState awake = State(1, {Value(V(0), "awake", O("yes"))}, 1);
  const CompositeState wet =
      State(2, {Value(V(0), "awake", O("yes")), Value(E("floor"), "wet", O("yes"))}, 1);
  const Model go = Causal(3, Command("go", {V(2)}), Value(V(2), "place", O("table")));
  const Model climb = Causal(4, Command("climb", {V(2)}), Value(V(2), "place", O("table")));
  const Model may_go = Requires(5, MakeIcst({1}, {}, {V(0)}), go, {V(0), V(4), V(5)}, 2);
  const Model may_climb = Requires(6, MakeIcst({1}, {}, {V(0)}), climb, {V(0), V(4), V(5)}, 2);
  const Model never = Requires(7, MakeIcst({2}, {}, {V(0)}), go, {V(0), V(4), V(5)}, 2, false);
  std::vector<SeedModelDefinition> models{
      {go, {}, false}, {climb, Evidence{3, 4}, false}, {may_go, {}, false}};
  if (with_climb) models.push_back({may_climb, {}, false});
  models.push_back({never, Evidence{veto_rate * 10, 10}, false});
  mind->Know({}, {awake, wet}, models);
}

TEST(Veto, APlanWhoseStepIsVetoedIsNotCommitted) {
  // own (semantics 3.3: a tie goes to the veto). Given a wet floor, the surer way is vetoed and the other one
  // is taken.
  ToyMind mind;
  KnowFloor(&mind, 1);
  mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door")),
            Value(E("floor"), "wet", O("yes"))});
  mind.Want(Value(E("h"), "place", O("table")));
  EXPECT_EQ(mind.Act(), "(cmd climb [h])");
  EXPECT_THAT(Rejections(mind), ElementsAre("not_enabled"));
}

TEST(Veto, TheSimulationNamesTheVetoThatDisabledTheStep) {
  // own. The simulation of the vetoed plan ends not enabled, because of an event that names the strong
  // requirement.
  ToyMind mind;
  KnowFloor(&mind, 1, false);
  mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door")),
            Value(E("floor"), "wet", O("yes"))});
  mind.Want(Value(E("h"), "place", O("table")));
  EXPECT_EQ(mind.Act(), "");
  EXPECT_THAT(Outcomes(mind), ElementsAre("not_enabled"));
  const ChainingDecided* decided = nullptr;
  for (const Event& event : mind.events.events) {
    if (event.simulation.valid() && std::holds_alternative<ChainingDecided>(event.body)) {
      decided = &std::get<ChainingDecided>(event.body);
    }
  }
  ASSERT_NE(decided, nullptr);
  EXPECT_EQ(decided->status, ChainingStatus::kVetoed);
  EXPECT_EQ(KindOf(mind.reasoner.knowledge().Find(decided->winner)->model), ModelKind::kStrongRequirement);
  EXPECT_THAT(SkipReasons(mind), Contains("vetoed"));
}

// The bodies of the events that caused the one event of this kind.
template <class Body>
std::vector<const Event*> CausesOfThe(const ToyMind& mind) {
  std::vector<const Event*> causes;
  for (const Event& event : mind.events.events) {
    if (!std::holds_alternative<Body>(event.body)) continue;
    for (const EventId cause : event.causes)
      causes.push_back(&mind.events.events[static_cast<std::size_t>(cause.value) - 1]);
  }
  return causes;
}
template <class Body>
const Event* OneOf(const std::vector<const Event*>& events) {
  const auto found = std::find_if(events.begin(), events.end(), [](const Event* event) {
    return std::holds_alternative<Body>(event->body);
  });
  return found == events.end() ? nullptr : *found;
}

TEST(MissedDrive, NamesThePlansThatWereRejectedForItLast) {
  // own. Given a drive whose only plan is vetoed in each of three frames,
  ToyMind mind;
  KnowFloor(&mind, 1, false);
  const auto see = [&] {
    mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door")),
              Value(E("floor"), "wet", O("yes"))});
  };
  see();
  mind.Want(Value(E("h"), "place", O("table")), 3);
  for (int frame = 0; frame < 3; ++frame) {
    EXPECT_EQ(mind.Act(), "");
    see();
  }
  // when its time is over, then it was missed because of the plan rejected last, and of the veto that stood
  // against it.
  const std::vector<const Event*> causes = CausesOfThe<GoalFailed>(mind);
  EXPECT_NE(OneOf<DriveInjected>(causes), nullptr);
  const Event* rejected = OneOf<PlanRejected>(causes);
  ASSERT_NE(rejected, nullptr);
  const Event* last = nullptr;
  for (const Event& event : mind.events.events) {
    if (std::holds_alternative<PlanRejected>(event.body)) last = &event;
  }
  EXPECT_EQ(rejected, last);
  const Event* skipped = OneOf<GoalSkipped>(causes);
  ASSERT_NE(skipped, nullptr);
  EXPECT_EQ(std::get<GoalSkipped>(skipped->body).reason, GoalSkipReason::kVetoed);
}

TEST(MissedDrive, NamesThePromiseThatWasNotKept) {
  // own. Given a drive that a step promised to reach in time, and the step does nothing,
  ToyMind mind;
  KnowFloor(&mind, 1, false);
  const auto see = [&] { mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door"))}); };
  see();
  mind.Want(Value(E("h"), "place", O("table")), 1);
  EXPECT_EQ(mind.Act(), "(cmd go [h])");
  see();
  // then it was missed because of the prediction that failed.
  EXPECT_NE(OneOf<PredictionFailed>(CausesOfThe<GoalFailed>(mind)), nullptr);
}

TEST(Veto, OneThatIsLessSureThanWhatAllowsTheStepDoesNotStopIt) {
  // OpenAERA (semantics 3.3). Given a veto of .5 against a requirement of 1, then the step is taken.
  ToyMind mind;
  KnowFloor(&mind, 0.5);
  mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door")),
            Value(E("floor"), "wet", O("yes"))});
  mind.Want(Value(E("h"), "place", O("table")));
  EXPECT_EQ(mind.Act(), "(cmd go [h])");
}

TEST(Veto, OneThatComesToHoldOnTheWayDisablesALaterStep) {
  // own (semantics 4.5: a later strong requirement). Given that opening the tap makes the floor wet, a plan
  // that opens it first and goes then is disabled at its second step.
  ToyMind mind;
  const CompositeState ready = State(1, {Value(V(0), "glass", O("full"))}, 1);
  const CompositeState wet =
      State(2, {Value(V(0), "glass", O("full")), Value(E("floor"), "wet", O("yes"))}, 1);
  const Model open = Free(3, Command("open", {V(2)}), Value(V(2), "glass", O("full")));
  const Model spill = Free(4, Command("open", {V(2)}), Value(E("floor"), "wet", O("yes")));
  const Model go = Causal(5, Command("go", {V(2)}), Value(V(2), "place", O("table")));
  const Model may_go = Requires(6, MakeIcst({1}, {}, {V(0)}), go, {V(0), V(4), V(5)}, 2);
  const Model never = Requires(7, MakeIcst({2}, {}, {V(0)}), go, {V(0), V(4), V(5)}, 2, false);
  mind.Know(
      {}, {ready, wet},
      {{open, {}, false}, {spill, {}, false}, {go, {}, false}, {may_go, {}, false}, {never, {}, false}});
  mind.See({Value(E("h"), "glass", O("empty")), Value(E("h"), "place", O("door")),
            Value(E("floor"), "wet", O("no"))});
  mind.Want(Value(E("h"), "place", O("table")));
  EXPECT_EQ(mind.Act(), "");
  const auto started = mind.All<SimulationStarted>();
  ASSERT_EQ(started.size(), 1u);
  EXPECT_EQ(started[0]->steps.size(), 2u);
  EXPECT_THAT(Outcomes(mind), ElementsAre("not_enabled"));
}

// What the requirement model says, it says of a frame later than its condition.
Model Delayed(Model requirement, int frames) {
  const Term& after = requirement.lhs.after;
  const Term later = Term::Span(kFrame * frames);
  const Term template_interval = Term::Struct("ti", {V(20), V(21)});
  requirement.forward = {{20, Term::Struct("+", {after, later})},
                         {21, Term::Struct("+", {requirement.lhs.before, later})}};
  const Term imdl = requirement.rhs.payload;
  requirement.rhs = {requirement.rhs.positive,
                     Term::Struct("imdl", {imdl[0], Term::Set({template_interval}), imdl[2]}), V(20), V(21)};
  return requirement;
}

// The glass is filled through an open tap, and h goes with a full glass. Opening the tap makes the floor wet,
// filling dries it. A wet floor vetoes `go` so many frames later.
void KnowTap(ToyMind* mind, int frames) {
  const CompositeState open_tap = State(1, {Value(V(0), "tap", O("open"))}, 1);
  const CompositeState full = State(2, {Value(V(0), "glass", O("full"))}, 1);
  const CompositeState wet = State(3, {Value(V(0), "floor", O("wet"))}, 1);
  const Model open = Free(4, Command("open", {V(2)}), Value(V(2), "tap", O("open")));
  const Model spill = Free(5, Command("open", {V(2)}), Value(V(2), "floor", O("wet")));
  const Model fill = Causal(6, Command("fill", {V(2)}), Value(V(2), "glass", O("full")));
  const Model dry = Free(7, Command("fill", {V(2)}), Value(V(2), "floor", O("dry")));
  const Model go = Causal(8, Command("go", {V(2)}), Value(V(2), "place", O("table")));
  const auto on = [&](std::int64_t id, std::int64_t state, const Model& model, bool positive) {
    return Requires(id, MakeIcst({state}, {}, {V(0)}), model, {V(0), V(4), V(5)}, 2, positive);
  };
  mind->Know({}, {open_tap, full, wet},
             {{open, {}, false},
              {spill, {}, false},
              {fill, {}, false},
              {dry, {}, false},
              {go, {}, false},
              {on(9, 1, fill, true), {}, false},
              {on(10, 2, go, true), {}, false},
              {Delayed(on(11, 3, go, false), frames), {}, false}});
}

TEST(DelayedVeto, WhatHoldsNowVetoesAStepOfTheNextFrame) {
  // OpenAERA (semantics 5.2: guards of one or two frames; 3.2: entries live as long as their interval). Given
  // a wet floor now and an open tap, the glass can be filled, but what comes next is vetoed.
  for (const bool wet : {true, false}) {
    ToyMind mind;
    KnowTap(&mind, 1);
    mind.See({Value(E("h"), "tap", O("open")), Value(E("h"), "glass", O("empty")),
              Value(E("h"), "floor", O(wet ? "wet" : "dry")), Value(E("h"), "place", O("door"))});
    mind.Want(Value(E("h"), "place", O("table")));
    EXPECT_EQ(mind.Wish(), wet ? "" : "(cmd fill [h])");
    EXPECT_THAT(Outcomes(mind), ElementsAre(wet ? "not_enabled" : "reached"));
  }
}

TEST(DelayedVeto, WhatHoldsNowDoesNotVetoAStepOfThisFrame) {
  // own. It speaks of the next frame only.
  ToyMind mind;
  KnowTap(&mind, 1);
  mind.See({Value(E("h"), "tap", O("open")), Value(E("h"), "glass", O("full")),
            Value(E("h"), "floor", O("wet")), Value(E("h"), "place", O("door"))});
  mind.Want(Value(E("h"), "place", O("table")));
  EXPECT_EQ(mind.Wish(), "(cmd go [h])");
}

TEST(DelayedVeto, IsCarriedFromAnImaginedFrameToALaterOne) {
  // own (semantics 4.5: the same machinery). Given a closed tap, the plan is open, fill, go: the floor is wet
  // in the second frame only, and that vetoes the third; two frames later it vetoes nothing of the plan.
  for (const int frames : {1, 2}) {
    ToyMind mind;
    KnowTap(&mind, frames);
    mind.See({Value(E("h"), "tap", O("closed")), Value(E("h"), "glass", O("empty")),
              Value(E("h"), "floor", O("dry")), Value(E("h"), "place", O("door"))});
    mind.Want(Value(E("h"), "place", O("table")));
    EXPECT_EQ(mind.Wish(), frames == 1 ? "" : "(cmd open [h])");
    ASSERT_FALSE(mind.All<SimulationStarted>().empty());
    EXPECT_EQ(mind.All<SimulationStarted>()[0]->steps.size(), 3u);
    EXPECT_THAT(Outcomes(mind), ElementsAre(frames == 1 ? "not_enabled" : "reached"));
  }
}

TEST(DelayedVeto, WhatWasSeenEarlierStillVetoesInTheHead) {
  // own. Given a floor that was wet a frame ago and is dry now, a veto two frames later stops the second
  // step.
  ToyMind mind;
  KnowTap(&mind, 2);
  const auto see = [&](const char* floor) {
    mind.See({Value(E("h"), "tap", O("open")), Value(E("h"), "glass", O("empty")),
              Value(E("h"), "floor", O(floor)), Value(E("h"), "place", O("door"))});
  };
  see("wet");
  see("dry");
  mind.Want(Value(E("h"), "place", O("table")));
  EXPECT_EQ(mind.Wish(), "");
  EXPECT_THAT(Outcomes(mind), ElementsAre("not_enabled"));
}

// ---------------------------------------------------------------------------------- conditions within and of
// conditions

TEST(NestedState, ItsPartsAreBroughtAboutOneByOne) {
  // own (semantics 4.3). Given a condition whose nested state lacks one part, that part becomes the goal.
  ToyMind mind;
  const CompositeState dressed = State(1, {Value(V(0), "hat", O("on")), Value(V(0), "coat", O("on"))}, 1);
  CompositeState ready = State(2, {MakeIcst({1}, {}, {V(0)}), Value(V(0), "place", O("door"))}, 1);
  const Model put_on = Free(3, Command("put_on", {V(2)}), Value(V(2), "coat", O("on")));
  const Model leave = Causal(4, Command("leave", {V(2)}), Value(V(2), "place", O("street")));
  const Model may_leave = Requires(5, MakeIcst({2}, {}, {V(0)}), leave, {V(0), V(4), V(5)}, 2);
  mind.Know({}, {dressed, ready}, {{put_on, {}, false}, {leave, {}, false}, {may_leave, {}, false}});
  mind.See(
      {Value(E("h"), "hat", O("on")), Value(E("h"), "coat", O("off")), Value(E("h"), "place", O("door"))});
  mind.Want(Value(E("h"), "place", O("street")));
  EXPECT_EQ(mind.Act(), "(cmd put_on [h])");
  EXPECT_THAT(Outcomes(mind), ElementsAre("reached"));
}

TEST(RequirementOfARequirement, IsBroughtAboutToo) {
  // own (semantics 3.5: requirements on requirements). Going is allowed to who is awake, but only in
  // daylight.
  ToyMind mind;
  const CompositeState awake = State(1, {Value(V(0), "awake", O("yes"))}, 1);
  const CompositeState day = State(2, {Value(E("room"), "light", O("on"))}, 1);
  const Model go = Causal(3, Command("go", {V(2)}), Value(V(2), "place", O("table")));
  const Model may_go = Requires(4, MakeIcst({1}, {}, {V(0)}), go, {V(0), V(4), V(5)}, 2);
  Model by_day = Requires(5, MakeIcst({2}, {}, {}), may_go, {V(2), V(3), V(4), V(5)}, 0);
  by_day.rhs.payload = MakeImdl(may_go.id, {}, {V(2), V(3), V(4)});
  const Model light = Free(6, Command("switch", {}), Value(E("room"), "light", O("on")));
  mind.Know({}, {awake, day},
            {{go, {}, false}, {may_go, {}, false}, {by_day, {}, false}, {light, {}, false}});
  mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door")),
            Value(E("room"), "light", O("off"))});
  mind.Want(Value(E("h"), "place", O("table")));
  EXPECT_EQ(mind.Act(), "(cmd switch [])");
  EXPECT_THAT(Outcomes(mind), ElementsAre("reached"));
  mind.See({Value(E("h"), "awake", O("yes")), Value(E("h"), "place", O("door")),
            Value(E("room"), "light", O("on"))});
  EXPECT_EQ(mind.Act(), "(cmd go [h])");
}

// -----------------------------------------------------------------------------------------------------------
// anti-facts

TEST(AntiFactGoal, IsReachedByAnotherValueOfTheSameThing) {
  // own (semantics 1.6: counter-evidence is evidence for an anti-fact). When h is not to hold s, it lets go.
  ToyMind mind;
  const CompositeState held = State(1, {Value(V(0), "holding", Just(V(3)))}, 1);
  const Model release = Causal(2, Command("release", {V(2)}), Value(V(2), "holding", None()));
  const Model may_release = Requires(3, MakeIcst({1}, {}, {V(0), V(1)}), release, {V(0), V(4), V(5)}, 2);
  mind.Know({}, {held}, {{release, {}, false}, {may_release, {}, false}});
  mind.See({Value(E("h"), "holding", Just(E("s")))});
  mind.Want(Value(E("h"), "holding", Just(E("s"))), 8, false);
  EXPECT_EQ(mind.Act(), "(cmd release [h])");
  mind.See({Value(E("h"), "holding", None())});
  EXPECT_EQ(mind.All<GoalAchieved>().size(), 1u);
}

TEST(AntiFactGoal, IsReachedByAModelThatPredictsIt) {
  // own. A model with an anti-fact on the right brings about an anti-fact.
  ToyMind mind;
  Model clear = Free(1, Command("clear", {V(2)}), Value(V(2), "on", O("table")));
  clear.rhs.positive = false;
  mind.Know({}, {}, {{clear, {}, false}});
  mind.See({Value(E("cup"), "on", O("table"))});
  mind.Want(Value(E("cup"), "on", O("table")), 8, false);
  EXPECT_EQ(mind.Act(), "(cmd clear [cup])");
  EXPECT_THAT(Outcomes(mind), ElementsAre("reached"));
}

// ------------------------------------------------------------------------------------------------- branches
// not taken

TEST(Skipped, WhatWouldHaveToBeginBeforeNow) {
  // own (semantics 4.2). Given one frame until the deadline, a plan of two steps is too late, and that is
  // said.
  ToyMind mind;
  KnowLamp(&mind);
  mind.See({Value(E("switch"), "state", O("open")), Value(E("lamp"), "light", O("off"))});
  mind.Want(Value(E("lamp"), "light", O("on")), 1);
  EXPECT_EQ(mind.Act(), "");
  EXPECT_THAT(SkipReasons(mind), Contains("too_late"));
}

TEST(Skipped, WhatNothingIsLeftOfAfterTheConfidencesOnTheWay) {
  // own. Given a model that was never right, its condition is not pursued.
  ToyMind mind;
  const Model press = Free(1, Command("press", {V(2)}), Value(V(2), "state", O("closed")));
  const Model burn = Free(2, Value(E("switch"), "state", O("closed")), Value(E("lamp"), "light", O("on")));
  mind.Know({}, {}, {{press, {}, false}, {burn, Evidence{0, 3}, false}});
  mind.See({Value(E("switch"), "state", O("open")), Value(E("lamp"), "light", O("off"))});
  mind.Want(Value(E("lamp"), "light", O("on")));
  EXPECT_EQ(mind.Act(), "");
  EXPECT_THAT(SkipReasons(mind), Contains("low_confidence"));
}

TEST(Skipped, ACommandThatStaysOpen) {
  // own. Given a command with an argument that nothing binds, then the goal is skipped as unbound.
  ToyMind mind;
  const Model pour = Free(1, Command("pour", {V(2), V(3)}), Value(V(2), "state", O("full")));
  mind.Know({}, {}, {{pour, {}, false}});
  mind.See({Value(E("cup"), "state", O("empty"))});
  mind.Want(Value(E("cup"), "state", O("full")));
  EXPECT_EQ(mind.Act(), "");
  EXPECT_THAT(SkipReasons(mind), Contains("unbound"));
}

TEST(Skipped, ALoop) {
  // own (semantics 4.4, the loop list). Given that b leads to a and a leads to b, wanting a does not run in
  // circles.
  ToyMind mind;
  const Model a = Free(1, Value(E("x"), "b", O("yes")), Value(E("x"), "a", O("yes")));
  const Model b = Free(2, Value(E("x"), "a", O("yes")), Value(E("x"), "b", O("yes")));
  mind.Know({}, {}, {{a, {}, false}, {b, {}, false}});
  mind.See({Value(E("x"), "a", O("no")), Value(E("x"), "b", O("no"))});
  mind.Want(Value(E("x"), "a", O("yes")));
  EXPECT_EQ(mind.Act(), "");
  EXPECT_THAT(SkipReasons(mind), Contains("loop"));
}

}  // namespace
}  // namespace aerascope::toy
