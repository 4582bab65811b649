// Which of the tried plans is acted on (semantics 4.6), and which of several drives (semantics 4.1, 4.8).
#include "engine/reason/commit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>

#include "tests/engine/reason/toy_mind.h"

namespace aerascope::toy {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Not;

constexpr auto kReached = SimulationOutcome::kReached;

TEST(Commit, TheBestScoreWins) {
  // OpenAERA (semantics 4.6, step 3).
  const Choice choice =
      Choose({{kReached, false, 0.5, {}}, {kReached, false, 0.75, {}}, {kReached, false, 0.6, {}}});
  EXPECT_EQ(choice.chosen, 1u);
  EXPECT_EQ(choice.rejected[0], PlanRejection::kLowerScore);
  EXPECT_EQ(choice.rejected[2], PlanRejection::kLowerScore);
}

TEST(Commit, OfEqualsTheFirstWins) {
  // OpenAERA (semantics 4.6, step 3: first wins ties).
  const Choice choice = Choose({{kReached, false, 0.5, {}}, {kReached, false, 0.5, {}}});
  EXPECT_EQ(choice.chosen, 0u);
  EXPECT_EQ(choice.rejected[1], PlanRejection::kTie);
}

TEST(Commit, WhatMustBeDoneComesFirst) {
  // own (semantics 4.6, step 4: mandatory solutions are acted on too; one command a frame).
  const Choice choice = Choose({{kReached, false, 0.9, {}}, {kReached, true, 0.5, {}}});
  EXPECT_EQ(choice.chosen, 1u);
  EXPECT_EQ(choice.rejected[0], PlanRejection::kMandatoryFirst);
}

TEST(Commit, AMandatoryPlanThatHarmsAMoreImportantGoalGivesUpAll) {
  // OpenAERA (semantics 4.6, step 1).
  const Choice choice = Choose({{kReached, false, 0.9, {}}, {kReached, true, 0.5, GoalId{7}}});
  EXPECT_FALSE(choice.chosen.has_value());
  EXPECT_EQ(choice.rejected[0], PlanRejection::kMandatoryHarms);
  EXPECT_EQ(choice.rejected[1], PlanRejection::kMandatoryHarms);
}

TEST(Commit, AnOptionalPlanThatHarmsAMoreImportantGoalIsDropped) {
  // OpenAERA (semantics 4.6, step 2).
  const Choice choice = Choose({{kReached, false, 0.9, GoalId{7}}, {kReached, false, 0.5, {}}});
  EXPECT_EQ(choice.chosen, 1u);
  EXPECT_EQ(choice.rejected[0], PlanRejection::kHarms);
}

TEST(Commit, ImportanceIsConfidenceOverTheTimeThatIsLeft) {
  // OpenAERA (semantics 4.6): cfd / (before - now).
  const Fact soon{true, Term::Nil(), {Time{0}, Time{400'000}}, 1};
  const Fact later{true, Term::Nil(), {Time{0}, Time{800'000}}, 1};
  EXPECT_DOUBLE_EQ(Importance(soon, Time{0}), 2.5);
  EXPECT_GT(Importance(soon, Time{0}), Importance(later, Time{0}));
  const Fact unsure{true, Term::Nil(), {Time{0}, Time{400'000}}, 0.25};
  EXPECT_LT(Importance(unsure, Time{0}), Importance(later, Time{0}));
}

TEST(Commit, PaperModeRanksByTheProductOpenaeraModeByTheLastModelAndItsTime) {
  // paper (section 5: planning by confidence values; semantics 6.2) and OpenAERA (semantics 4.6, step 3).
  EXPECT_DOUBLE_EQ(RankingScore(AnalogyMode::kPaper, 0.5, 1, Time{400'000}, Time{0}), 0.5);
  EXPECT_DOUBLE_EQ(RankingScore(AnalogyMode::kOpenaera, 0.5, 1, Time{400'000}, Time{0}), 2.5);
}

RC_GTEST_PROP(CommitLaw, ExactlyTheFirstBestOfTheHarmlessOnesThatReachTheGoalIsChosen, ()) {
  // own. Law over generated lists of tried plans without mandatory ones.
  const auto count = *rc::gen::inRange<std::size_t>(0, 12);
  std::vector<TriedPlan> plans;
  for (std::size_t i = 0; i < count; ++i) {
    plans.push_back({static_cast<SimulationOutcome>(*rc::gen::inRange(0, 3)), false,
                     static_cast<double>(*rc::gen::inRange(0, 5)) / 4, GoalId{*rc::gen::inRange(0, 2)}});
  }
  const Choice choice = Choose(plans);
  const auto eligible = [](const TriedPlan& p) { return p.outcome == kReached && !p.harmed.valid(); };
  std::optional<std::size_t> expected;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    if (eligible(plans[i]) && (!expected || plans[i].score > plans[*expected].score)) expected = i;
  }
  RC_ASSERT(choice.chosen == expected);
  for (std::size_t i = 0; i < plans.size(); ++i)
    RC_ASSERT(choice.rejected[i].has_value() == (i != choice.chosen));
}

// ------------------------------------------------------------------------------------------------------
// what the choice says of each plan

// c is near. It can be taken at once, three times of four; or it is called, comes, and is asked for.
class Candidates : public testing::TestWithParam<AnalogyMode> {
 protected:
  Candidates() : mind_(Parameters()) {
    const CompositeState near =
        State(1, {Value(V(0), "hand", O("free")), Value(V(3), "place", O("near"))}, 1);
    const CompositeState here =
        State(2, {Value(V(0), "hand", O("free")), Value(V(3), "place", O("here"))}, 1);
    const Model take = Causal(4, Command("take", {V(2)}), Value(V(2), "has", V(3)));
    const Model ask = Causal(5, Command("ask", {V(2)}), Value(V(2), "has", V(3)));
    const Model come = Free(6, Command("call", {V(2)}), Value(V(2), "place", O("here")));
    const Model may_take = Requires(8, MakeIcst({1}, {}, {V(0), V(1)}), take, {V(0), V(1), V(5), V(6)}, 2);
    const Model may_ask = Requires(9, MakeIcst({2}, {}, {V(0), V(1)}), ask, {V(0), V(1), V(5), V(6)}, 2);
    mind_.Know({}, {near, here},
               {{take, {3, 4}, false},
                {ask, {}, false},
                {come, {}, false},
                {may_take, {}, false},
                {may_ask, {}, false}});
    mind_.StartAt(3);
    mind_.See({Value(E("h"), "hand", O("free")), Value(E("c"), "place", O("near"))});
    mind_.Want(Value(E("h"), "has", E("c")), 6);
  }
  static ReasonerParameters Parameters() {
    ReasonerParameters parameters;
    parameters.analogy_mode = GetParam();
    return parameters;
  }

  ToyMind mind_;
};

TEST_P(Candidates, EachHasItsConfidenceScoreAndTimesWhetherItWonOrLost) {
  // own (semantics 9, CommitDecision: "candidates with cfd, deadline, score"). From 310 on c is wanted until
  // 900, so a last command has until 800. Taking c would have it at 400, calling and asking at 500.
  const bool openaera = GetParam() == AnalogyMode::kOpenaera;
  EXPECT_EQ(mind_.Act(), "(cmd call [c])");
  const auto committed = mind_.All<PlanCommitted>();
  ASSERT_EQ(committed.size(), 1u);
  std::map<std::string, PlanCandidate> candidates;
  for (const PlanCandidate& candidate : committed[0]->candidates) {
    for (const SimulationStarted* tried : mind_.All<SimulationStarted>()) {
      if (tried->simulation == candidate.simulation)
        candidates[ToText(tried->steps.front().command)] = candidate;
    }
  }
  ASSERT_EQ(candidates.size(), 2u);
  const PlanCandidate& won = candidates.at("(cmd call [c])");
  const PlanCandidate& lost = candidates.at("(cmd take [h])");
  EXPECT_EQ(won.simulation, committed[0]->chosen);
  EXPECT_EQ(won.score, committed[0]->score);
  const double seconds = openaera ? 0.800 - 0.310 : 1;
  EXPECT_DOUBLE_EQ(won.confidence, 1);
  EXPECT_DOUBLE_EQ(lost.confidence, 0.75);
  EXPECT_DOUBLE_EQ(won.score, 1 / seconds);
  EXPECT_DOUBLE_EQ(lost.score, 0.75 / seconds);
  EXPECT_EQ(won.reaches, Time{500'000});
  EXPECT_EQ(lost.reaches, Time{400'000});
  for (const PlanCandidate* plan : {&won, &lost}) EXPECT_EQ(plan->deadline, Time{800'000});
  // The one that lost says the same by itself.
  const auto rejected = mind_.All<PlanRejected>();
  ASSERT_EQ(rejected.size(), 1u);
  EXPECT_EQ(rejected[0]->simulation, lost.simulation);
  EXPECT_EQ(rejected[0]->score, lost.score);
}

INSTANTIATE_TEST_SUITE_P(BothModes, Candidates, testing::Values(AnalogyMode::kPaper, AnalogyMode::kOpenaera),
                         [](const auto& mode) { return std::string(ToText(mode.param)); });

// ------------------------------------------------------------------------------------------------------
// several drives

// h can take a or b into its one hand, and let go.
void KnowTaking(ToyMind* mind) {
  const CompositeState empty = State(1, {Value(V(0), "holding", None()), Value(V(3), "kind", O("thing"))}, 1);
  const CompositeState full = State(2, {Value(V(0), "holding", Just(V(3)))}, 1);
  const Model take = Causal(3, Command("take", {V(2), V(3)}), Value(V(2), "holding", Just(V(3))));
  const Model drop = Causal(4, Command("drop", {V(2)}), Value(V(2), "holding", None()));
  const Model may_take = Requires(5, MakeIcst({1}, {}, {V(0), V(1)}), take, {V(0), V(1), V(4), V(5)}, 2);
  const Model may_drop = Requires(6, MakeIcst({2}, {}, {V(0), V(1)}), drop, {V(0), V(4), V(5)}, 2);
  mind->Know({Value(E("a"), "kind", O("thing")), Value(E("b"), "kind", O("thing"))}, {empty, full},
             {{take, {}, false}, {drop, {}, false}, {may_take, {}, false}, {may_drop, {}, false}});
}

TEST(SeveralDrives, TheMoreImportantOneActs) {
  // own. Of two open drives the one whose deadline is nearer has the frame's command.
  ToyMind mind;
  KnowTaking(&mind);
  mind.See({Value(E("h"), "holding", None())});
  mind.Want(Value(E("h"), "holding", Just(E("a"))), 20);
  mind.Want(Value(E("h"), "holding", Just(E("b"))), 4);
  EXPECT_EQ(mind.Act(), "(cmd take [h b])");
}

TEST(SeveralDrives, NothingIsDoneForOneThatWouldMakeAMoreImportantOneFail) {
  // OpenAERA (semantics 4.6, step 2). Given that b is about to be in the hand (predicted), a is not taken
  // instead.
  ToyMind mind;
  KnowTaking(&mind);
  mind.See({Value(E("h"), "holding", None())});
  mind.Want(Value(E("h"), "holding", Just(E("a"))), 20);
  mind.Want(Value(E("h"), "holding", Just(E("b"))), 4);
  mind.Act();
  // The command was executed: the goal on b is suspended. The other one may not spoil it.
  EXPECT_EQ(mind.Wish(), "");
  const auto rejected = mind.All<PlanRejected>();
  ASSERT_FALSE(rejected.empty());
  EXPECT_EQ(rejected.back()->reason, PlanRejection::kHarms);
  EXPECT_TRUE(rejected.back()->harmed.valid());
}

TEST(SeveralDrives, OneAfterTheOtherIsReached) {
  // own. Each drive has its own end.
  ToyMind mind;
  KnowTaking(&mind);
  mind.See({Value(E("h"), "holding", None())});
  mind.Want(Value(E("h"), "holding", Just(E("a"))), 20);
  mind.Want(Value(E("h"), "holding", Just(E("b"))), 4);
  EXPECT_EQ(mind.Act(), "(cmd take [h b])");
  mind.See({Value(E("h"), "holding", Just(E("b")))});
  EXPECT_EQ(mind.All<GoalAchieved>().size(), 1u);
  EXPECT_TRUE(mind.reasoner.drive_open());
  EXPECT_EQ(mind.Act(), "(cmd drop [h])");
  mind.See({Value(E("h"), "holding", None())});
  EXPECT_EQ(mind.Act(), "(cmd take [h a])");
  mind.See({Value(E("h"), "holding", Just(E("a")))});
  EXPECT_FALSE(mind.reasoner.drive_open());
  EXPECT_EQ(mind.All<GoalAchieved>().size(), 2u);
}

// ------------------------------------------------------------------------------------------------- what must
// not happen

TEST(OppositeMatch, ACommandThatWouldUndoAMoreImportantGoalIsNotGiven) {
  // own (semantics 4.2: a goal matched with opposite polarity). Ringing wakes the child; quiet is wanted
  // more.
  ToyMind mind;
  Model wakes = Free(1, Command("ring", {V(2)}), Value(E("child"), "asleep", O("yes")));
  wakes.rhs.positive = false;
  const Model calls = Free(2, Command("ring", {V(2)}), Value(V(2), "called", O("yes")));
  mind.Know({}, {}, {{wakes, {}, false}, {calls, {}, false}});
  mind.See({Value(E("bell"), "called", O("no")), Value(E("child"), "asleep", O("no"))});
  mind.Want(Value(E("child"), "asleep", O("yes")), 3);
  mind.Want(Value(E("bell"), "called", O("yes")), 20);
  EXPECT_EQ(mind.Act(), "");
  std::vector<std::string> negative_goals;
  for (const GoalSet* goal : mind.All<GoalSet>()) {
    if (!goal->target.positive) negative_goals.push_back(ToText(goal->target.payload));
  }
  EXPECT_THAT(negative_goals, ElementsAre("(cmd ring [:])"));
  ASSERT_EQ(mind.All<PlanRejected>().size(), 1u);
  EXPECT_EQ(mind.All<PlanRejected>()[0]->reason, PlanRejection::kHarms);
}

TEST(OppositeMatch, AFactThatWouldUndoTheGoalIsRemovedFirst) {
  // own (semantics 4.2, 4.4: MANDATORY). Rain puts the fire out: the roof is closed before the fire is lit.
  ToyMind mind;
  Model rain = Free(1, Value(E("roof"), "open", O("yes")), Value(E("fire"), "burns", O("yes")));
  rain.rhs.positive = false;
  Model close = Free(2, Command("close", {V(2)}), Value(V(2), "open", O("no")));
  const Model light = Free(3, Command("light", {V(2)}), Value(V(2), "burns", O("yes")));
  mind.Know({}, {}, {{rain, {}, false}, {close, {}, false}, {light, {}, false}});
  mind.See({Value(E("roof"), "open", O("yes")), Value(E("fire"), "burns", O("no"))});
  mind.Want(Value(E("fire"), "burns", O("yes")));
  EXPECT_EQ(mind.Act(), "(cmd close [roof])");
  mind.See({Value(E("roof"), "open", O("no")), Value(E("fire"), "burns", O("no"))});
  EXPECT_EQ(mind.Act(), "(cmd light [fire])");
}

// --------------------------------------------------------------------------------------------- goals that
// are given up

TEST(GoalDropped, WhatServedAClosedDriveIsSettled) {
  // own (semantics 4.8).
  ToyMind mind;
  KnowTaking(&mind);
  mind.See({Value(E("h"), "holding", None())});
  mind.Want(Value(E("h"), "holding", Just(E("a"))));
  mind.Act();
  mind.See({Value(E("h"), "holding", Just(E("a")))});
  ASSERT_FALSE(mind.All<GoalDropped>().empty());
  for (const GoalDropped* dropped : mind.All<GoalDropped>())
    EXPECT_EQ(dropped->reason, GoalDropReason::kSuperGoalClosed);
}

}  // namespace
}  // namespace aerascope::toy
