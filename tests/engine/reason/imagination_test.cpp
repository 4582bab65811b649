// What holds on in the head and what ends it (semantics 3.1: promotion and its defeat), in single frames and
// in simulations; and what becomes of an old plan when its condition is contradicted (semantics 4.8).
#include "engine/reason/imagination.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tests/engine/reason/toy_mind.h"

namespace aerascope::toy {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

constexpr TimeInterval kNow{Time{0}, Time{100'000}};
constexpr TimeInterval kNext{Time{100'000}, Time{200'000}};
constexpr TimeInterval kAfterNext{Time{200'000}, Time{300'000}};

SituationFact Holds(const Term& payload, TimeInterval interval = kNow, bool positive = true,
                    bool permanent = false) {
  SituationFact fact;
  fact.fact = {positive, payload, interval, 1};
  fact.permanent = permanent;
  return fact;
}

std::vector<std::string> In(const ImaginedFrame& frame) {
  std::vector<std::string> facts;
  for (const SituationFact& fact : frame.situation().facts()) {
    facts.push_back((fact.fact.positive ? "" : "not ") + ToText(fact.fact.payload));
  }
  return facts;
}

ImaginedFrame PresentWith(const std::vector<SituationFact>& facts, std::vector<SituationFact> pending = {}) {
  Situation situation(kNow);
  for (const SituationFact& fact : facts) situation.Add(fact);
  return ImaginedFrame::Present(std::move(situation), std::move(pending));
}

TEST(Persistence, WhatNothingContradictsHoldsOn) {
  // OpenAERA (semantics 3.1). The cup stays where it is while the hand moves.
  const ImaginedFrame frame =
      PresentWith({Holds(Value(E("cup"), "position", N(5))), Holds(Value(E("h"), "position", N(0)))});
  const auto next = frame.Next({Holds(Value(E("h"), "position", N(9)), kNext)}, kFrame);
  EXPECT_THAT(In(next.frame), UnorderedElementsAre("(mk.val cup position 5)", "(mk.val h position 9)"));
  ASSERT_EQ(next.defeated.size(), 1u);
  EXPECT_EQ(next.defeated[0].fact.fact.payload, Value(E("h"), "position", N(0)));
}

TEST(Persistence, CommandsAndInstancesPass) {
  // own. What was done in a frame, and what was derived in it, ends with it.
  const ImaginedFrame frame =
      PresentWith({Holds(Command("go", {E("h")})), Holds(MakeIcst({1}, {}, {E("h")}))});
  EXPECT_THAT(In(frame.Next({}, kFrame).frame), IsEmpty());
}

TEST(Persistence, AnAntiFactEndsTheFactAndNothingElse) {
  // OpenAERA (semantics 3.1: either polarity). It says nothing about other values.
  const ImaginedFrame frame = PresentWith(
      {Holds(Value(E("h"), "holding", Just(E("a")))), Holds(Value(E("g"), "holding", Just(E("b"))))});
  const auto next = frame.Next({Holds(Value(E("h"), "holding", Just(E("a"))), kNext, false)}, kFrame);
  EXPECT_THAT(In(next.frame), UnorderedElementsAre("not (mk.val h holding [a])", "(mk.val g holding [b])"));
  const auto other = frame.Next({Holds(Value(E("h"), "holding", Just(E("c"))), kNext, false)}, kFrame);
  EXPECT_THAT(In(other.frame), Contains("(mk.val h holding [a])"));
}

TEST(Persistence, PropertiesAreNeverEnded) {
  // own. A property of a thing is in force in every frame.
  const ImaginedFrame frame = PresentWith({Holds(Value(E("cup"), "size", O("small")), kAlways, true, true)});
  const auto next = frame.Next({Holds(Value(E("cup"), "size", O("large")), kNext)}, kFrame);
  EXPECT_THAT(In(next.frame), Contains("(mk.val cup size small)"));
}

TEST(Persistence, WhatIsPredictedForLaterComesInItsFrame) {
  // own. An effect two frames away is not there in the next one.
  const ImaginedFrame frame = PresentWith({}, {Holds(Value(E("lamp"), "light", O("on")), kAfterNext)});
  const auto next = frame.Next({}, kFrame);
  EXPECT_THAT(In(next.frame), IsEmpty());
  EXPECT_THAT(In(next.frame.Next({}, kFrame).frame), ElementsAre("(mk.val lamp light on)"));
}

TEST(Persistence, WhatComesAtOnceDefeatsWhatWasCarriedIntoTheSameFrame) {
  // OpenAERA (semantics 3.1: a promoted copy is defeasible).
  const ImaginedFrame frame = PresentWith({Holds(Value(E("floor"), "wet", O("no")))});
  const auto next = frame.Next({}, kFrame);
  ASSERT_THAT(In(next.frame), ElementsAre("(mk.val floor wet no)"));
  const auto later = next.frame.Next({Holds(Value(E("floor"), "wet", O("yes")), kNext)}, Duration{0});
  EXPECT_THAT(In(later.frame), ElementsAre("(mk.val floor wet yes)"));
  EXPECT_EQ(later.frame.interval(), kNext);
}

RC_GTEST_PROP(PersistenceLaw, EachFactHoldsOnOrIsRenewedOrIsDefeated, ()) {
  // own. Law over generated facts and effects: nothing vanishes without a reason, nothing contradicts what
  // came about.
  const auto any = [](TimeInterval interval) {
    return Holds(Value(E("e" + std::to_string(*rc::gen::inRange(0, 4))),
                       "a" + std::to_string(*rc::gen::inRange(0, 2)), N(*rc::gen::inRange(0, 3))),
                 interval, *rc::gen::inRange(0, 4) != 0);
  };
  std::vector<SituationFact> facts;
  std::vector<SituationFact> effects;
  for (int i = *rc::gen::inRange(0, 8); i > 0; --i) facts.push_back(any(kNow));
  for (int i = *rc::gen::inRange(0, 5); i > 0; --i) effects.push_back(any(kNext));
  const auto next = PresentWith(facts).Next(effects, kFrame);
  const auto& after = next.frame.situation().facts();
  for (const SituationFact& fact : facts) {
    const bool there = std::any_of(after.begin(), after.end(), [&](const SituationFact& f) {
      return f.fact.positive == fact.fact.positive && f.fact.payload == fact.fact.payload;
    });
    const bool defeated =
        std::any_of(next.defeated.begin(), next.defeated.end(), [&](const ImaginedFrame::Defeat& d) {
          return d.fact.fact.positive == fact.fact.positive && d.fact.fact.payload == fact.fact.payload;
        });
    RC_ASSERT(there || defeated);
  }
  for (const ImaginedFrame::Defeat& defeat : next.defeated)
    RC_ASSERT(PutsAnEndTo(defeat.by.fact, defeat.fact.fact));
  for (const SituationFact& fact : after) RC_ASSERT(fact.fact.interval == kNext);
}

// ------------------------------------------------------------------------------------------------------ in
// simulations

// h takes what lies where it is; it goes anywhere.
void KnowTakingAt(ToyMind* mind) {
  const CompositeState there =
      State(1, {Value(V(0), "holding", None()), Value(V(0), "place", V(4)), Value(V(3), "place", V(4))}, 1);
  const Model go = Free(2, Command("go", {E("h"), V(3)}), Value(E("h"), "place", V(3)));
  const Model take = Causal(3, Command("take", {V(2)}), Value(V(2), "holding", Just(V(3))));
  const Model may = Requires(4, MakeIcst({1}, {}, {V(0), V(1), V(4)}), take, {V(0), V(1), V(5), V(6)}, 2);
  mind->Know({}, {there}, {{go, {}, false}, {take, {}, false}, {may, {}, false}});
}

TEST(Promotion, IsLoggedForWhatTheNextStepRestsOn) {
  // OpenAERA (semantics 3.1). Going to the cup leaves the hand empty and the cup in its place; the sofa is no
  // matter.
  ToyMind mind;
  KnowTakingAt(&mind);
  mind.See({Value(E("h"), "holding", None()), Value(E("h"), "place", O("door")),
            Value(E("cup"), "place", O("table")), Value(E("sofa"), "place", O("wall"))});
  mind.Want(Value(E("h"), "holding", Just(E("cup"))));
  EXPECT_EQ(mind.Act(), "(cmd go [h table])");
  std::vector<std::string> promoted;
  for (const Event* event : mind.Found<FactPromoted>()) {
    EXPECT_TRUE(event->simulation.valid());
    promoted.push_back(ToText(std::get<FactPromoted>(event->body).fact.payload));
  }
  EXPECT_THAT(promoted, UnorderedElementsAre("(mk.val h holding [])", "(mk.val cup place table)"));
}

TEST(Promotion, ItsDefeatIsLoggedWithThePredictionAgainstIt) {
  // OpenAERA (semantics 3.1). Taking the cup ends the empty hand that the plan rested on.
  ToyMind mind;
  KnowTakingAt(&mind);
  mind.See({Value(E("h"), "holding", None()), Value(E("h"), "place", O("table")),
            Value(E("cup"), "place", O("table"))});
  mind.Want(Value(E("h"), "holding", Just(E("cup"))));
  EXPECT_EQ(mind.Act(), "(cmd take [h])");
  const auto defeated = mind.All<PromotionDefeated>();
  ASSERT_EQ(defeated.size(), 1u);
  EXPECT_EQ(ToText(defeated[0]->fact.payload), "(mk.val h holding [])");
  EXPECT_TRUE(defeated[0]->by.valid());
}

// ------------------------------------------------------------------------------------------- plans given up

// h goes anywhere, and takes the cup where both are; also scoops it, less surely unless `scoop` says
// otherwise. What is wet slips. `may_take` is how sure the condition for taking is.
class Replanning : public testing::Test {
 protected:
  void Know(Evidence may_take_evidence, Evidence scoop_evidence, bool scoop_needs_wet) {
    const CompositeState there = State(1, {Value(V(0), "place", V(4)), Value(V(3), "place", V(4))}, 1);
    const CompositeState wet = State(2, {Value(V(0), "place", V(4)), Value(V(0), "wet", O("yes"))}, 1);
    const CompositeState wet_there =
        State(9, {Value(V(0), "place", V(4)), Value(V(3), "place", V(4)), Value(V(0), "wet", O("yes"))}, 1);
    const Model go = Free(3, Command("go", {E("h"), V(3)}), Value(E("h"), "place", V(3)));
    const Model take = Causal(4, Command("take", {V(2)}), Value(V(2), "holding", Just(V(3))));
    const Model scoop = Causal(5, Command("scoop", {V(2)}), Value(V(2), "holding", Just(V(3))));
    const std::vector<Term> exposed{V(0), V(1), V(5), V(6)};
    const Model may_take = Requires(6, MakeIcst({1}, {}, {V(0), V(1), V(4)}), take, exposed, 2);
    const Model may_scoop =
        Requires(7, MakeIcst({scoop_needs_wet ? 9 : 1}, {}, {V(0), V(1), V(4)}), scoop, exposed, 2);
    const Model slips = Requires(8, MakeIcst({2}, {}, {V(0), V(4)}), take,
                                 {V(0), Term::Wildcard(), Term::Wildcard(), Term::Wildcard()}, 2, false);
    std::vector<SeedModelDefinition> models{{go, {}, false},
                                            {take, {}, false},
                                            {scoop, scoop_evidence, false},
                                            {may_take, may_take_evidence, false},
                                            {may_scoop, {}, false}};
    if (!scoop_needs_wet) models.push_back({slips, {}, false});
    mind_.Know({}, {there, wet, wet_there}, models);
  }

  // The hand's place and whether it is wet; the cup is on the table, if it is to be seen.
  void See(const char* place, const char* wet, bool cup = true) {
    std::vector<Term> facts{Value(E("h"), "place", O(place)), Value(E("h"), "wet", O(wet)),
                            Value(E("h"), "holding", None()), Value(E("key"), "place", O("door"))};
    if (cup) facts.push_back(Value(E("cup"), "place", O("table")));
    mind_.See(facts);
  }
  void WantTheCup() { mind_.Want(Value(E("h"), "holding", Just(E("cup")))); }

  // "reason: kinds of its causes", for each goal dropped.
  std::vector<std::string> Dropped() const {
    std::vector<std::string> dropped;
    for (const Event* event : mind_.Found<GoalDropped>()) {
      std::string text(EnumName(std::get<GoalDropped>(event->body).reason));
      text += ":";
      for (const EventId cause : event->causes) text += " " + std::string(KindName(At(cause).body));
      dropped.push_back(std::move(text));
    }
    return dropped;
  }
  const Event& At(EventId id) const { return mind_.events.events[static_cast<std::size_t>(id.value) - 1]; }
  // What is given as the cause of the first goal dropped.
  const Event& Reason() const { return At(mind_.Found<GoalDropped>().at(0)->causes.at(0)); }

  ToyMind mind_;
};

TEST_F(Replanning, WhenTheConditionOfThePlanIsContradictedTheDriveIsPlannedAnew) {
  // OpenAERA (semantics 4.8: abduce again from the super-goal). Given a plan to go and take, when taking is
  // vetoed by what has become of the hand, then the goal on its condition is dropped as contradicted, by the
  // veto's word in the simulation that tried it again, and another way is found.
  Know({}, {3, 4}, false);
  See("door", "no");
  WantTheCup();
  EXPECT_EQ(mind_.Act(), "(cmd go [h table])");
  EXPECT_EQ(mind_.All<PlanCommitted>().back()->score, 1);
  // It has begun to rain.
  See("table", "yes");
  EXPECT_EQ(mind_.Act(), "(cmd scoop [h])");
  EXPECT_THAT(Dropped(), ElementsAre("requirement_contradicted: ChainingDecided PlanCommitted GoalSet"));
  EXPECT_EQ(std::get<ChainingDecided>(Reason().body).status, ChainingStatus::kVetoed);
  EXPECT_TRUE(Reason().simulation.valid());
}

TEST_F(Replanning, WhenTheConditionOfThePlanIsDeletedTheGoalOnItIsDroppedBecauseOfThat) {
  // OpenAERA (semantics 4.8). Given a plan to go and take on a doubtful condition, when taking something else
  // fails meanwhile, so that the condition is deleted, then the goal on it is dropped because of that.
  Know({1, 2}, {1, 4}, false);
  See("door", "no");
  const Term take = Command("take", {E("h")});
  mind_.reasoner.Executed(take, mind_.reasoner.CommandIssued(take, Commander::kTeacher, {}, {}));
  WantTheCup();
  EXPECT_EQ(mind_.Act(), "(cmd go [h table])");
  See("table", "no");
  mind_.Act();
  EXPECT_THAT(Dropped(), ElementsAre("requirement_contradicted: ModelStateChanged PlanCommitted GoalSet"));
  EXPECT_EQ(std::get<ModelStateChanged>(Reason().body).after, ModelState::kDeleted);
}

TEST_F(Replanning, WhatASurerPlanDoesNotUseIsReplacedByIt) {
  // own. Given a plan to go and take, when a wet hand lets the cup be scooped more surely, then the goal on
  // the condition for taking is dropped because of the new plan.
  Know({3, 4}, {}, true);
  See("door", "no");
  WantTheCup();
  EXPECT_EQ(mind_.Act(), "(cmd go [h table])");
  See("table", "yes");
  EXPECT_EQ(mind_.Act(), "(cmd scoop [h])");
  EXPECT_THAT(Dropped(), ElementsAre("replaced: PlanCommitted PlanCommitted GoalSet"));
  EXPECT_EQ(Reason().id, mind_.Found<PlanCommitted>().back()->id);
}

TEST_F(Replanning, WhereNothingLeadsToTheGoalAnyMoreThePlanIsGivenUp) {
  // own. Given a plan to go and take, when the cup is gone, then the goal on the condition is dropped for
  // want of a plan; the cause is that the same was wanted again, in vain.
  Know({}, {3, 4}, false);
  See("door", "no");
  WantTheCup();
  EXPECT_EQ(mind_.Act(), "(cmd go [h table])");
  See("table", "no", false);
  EXPECT_EQ(mind_.Act(), "");
  EXPECT_THAT(Dropped(), ElementsAre("no_plan: GoalSet PlanCommitted GoalSet"));
  EXPECT_EQ(Reason().time, Time{110'000});
}

TEST_F(Replanning, AsLongAsThePlanIsKeptNothingIsDropped) {
  // own. Going on as planned drops nothing before the drive is settled.
  Know({}, {3, 4}, false);
  See("door", "no");
  WantTheCup();
  mind_.Act();
  See("table", "no");
  EXPECT_EQ(mind_.Act(), "(cmd take [h])");
  EXPECT_THAT(Dropped(), IsEmpty());
}

RC_GTEST_PROP(PlanningLaw, TheOrderOfSimultaneousFactsDoesNotMatterToThePlan, ()) {
  // own. Law over generated scenes: the command and the score of the plan are the same whatever the order of
  // facts.
  std::vector<Term> facts{Value(E("h"), "holding", None()), Value(E("h"), "place", O("door"))};
  for (int i = 0; i < 4; ++i) {
    facts.push_back(
        Value(E("x" + std::to_string(i)), "place", O("p" + std::to_string(*rc::gen::inRange(0, 3)))));
  }
  const auto plan = [](const std::vector<Term>& scene) {
    ToyMind mind;
    KnowTakingAt(&mind);
    mind.See(scene);
    mind.Want(Value(E("h"), "holding", Just(E("x2"))));
    const std::string command = mind.Wish();
    return command + " " + std::to_string(mind.All<PlanCommitted>().size());
  };
  const std::string expected = plan(facts);
  for (std::size_t i = facts.size(); i > 1; --i)
    std::swap(facts[i - 1], facts[*rc::gen::inRange<std::size_t>(0, i)]);
  RC_ASSERT(plan(facts) == expected);
}

}  // namespace
}  // namespace aerascope::toy
