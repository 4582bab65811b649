// Forward chaining: what is equal, what holds together, and whether a model may fire (semantics 3.1 to 3.3,
// and the examples 10.1, 10.2 and 10.5).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <ostream>

#include "tests/engine/reason/agent.h"

namespace aerascope {
namespace {

// ---- 10.1, tolerance

TEST(Oracle10_1, NumbersAreEqualBelowOneInAHundredThousand) {
  // OpenAERA (semantics 10.1): 0.1 and 0.100009 are equal, 0.1 and 0.10002 are not.
  EXPECT_TRUE(SameValue(N(0.1), N(0.100009)));
  EXPECT_FALSE(SameValue(N(0.1), N(0.10002)));
}

TEST(Oracle10_1, TimesAreSynchronousBelowTenMilliseconds) {
  // OpenAERA (semantics 10.1): 700 and 709.999 ms are, 700 and 710 are not.
  EXPECT_TRUE(Synchronous(Time{700'000}, Time{709'999}));
  EXPECT_FALSE(Synchronous(Time{700'000}, Time{710'000}));
}

TEST(Oracle10_1, NarrowingKeepsWhatIsCommon) {
  // OpenAERA (semantics 10.1): [600,1000) with [700,800); [700,800) with [750,900); [700,800) with [800,900)
  // fails.
  EXPECT_EQ(Intersection(Ms(600, 1000), Ms(700, 800)), Ms(700, 800));
  EXPECT_EQ(Intersection(Ms(700, 800), Ms(750, 900)), Ms(750, 800));
  EXPECT_EQ(Intersection(Ms(700, 800), Ms(800, 900)), std::nullopt);
}

// ---- 10.2, membership of a composite state

// The conditions of what was learned from h's position going from 0 to 5 by a command, where `other` was
// sensed in the frame before the change; is it among them?
bool BecomesACondition(const Fact& other) {
  Agent agent({Holds(Val("h", "essence", O("hand")), kAlways)});
  agent.Sense({});
  agent.Sense({Val("h", "position", N(0))});
  agent.Sense({Val("h", "position", N(0))});
  Fact in_frame = other;
  agent.SenseFacts({Holds(Val("h", "position", N(0)), Ms(300, 400)), in_frame});
  agent.Do(Cmd("move", {E("h"), N(5)}));
  agent.Sense({Val("h", "position", N(5))});
  for (const auto& [id, record] : agent.kb().composite_states()) {
    for (const FactPattern& component : record.state.components) {
      if (IsValue(component.payload) && component.payload[1] == other.payload[1]) return true;
    }
  }
  EXPECT_FALSE(agent.kb().composite_states().empty()) << "nothing was learned at all";
  return false;
}

TEST(Oracle10_2, AFactOverTheSameFrameIsIn) {
  // OpenAERA (semantics 10.2): premise [300,400), axiom copy [300,400).
  EXPECT_TRUE(BecomesACondition(Holds(Val("h", "colour", O("red")), Ms(300, 400))));
}

TEST(Oracle10_2, AFactThatStartsFiveMillisecondsLaterIsIn) {
  // OpenAERA (semantics 10.2): [305,400) is within the tolerance.
  EXPECT_TRUE(BecomesACondition(Holds(Val("h", "colour", O("red")), Ms(305, 400))));
}

TEST(Oracle10_2, WhatStartsTwentyMillisecondsLaterIsOut) {
  // OpenAERA (semantics 10.2): a command, or a value held, starts at [320,400).
  EXPECT_FALSE(BecomesACondition(Holds(Val("h", "colour", O("red")), Ms(320, 400))));
}

TEST(Oracle10_2, AFactThatHasEndedIsOut) {
  // OpenAERA (semantics 10.2): premise [300,400), a fact over [200,300).
  EXPECT_FALSE(BecomesACondition(Holds(Val("h", "colour", O("red")), Ms(200, 300))));
}

TEST(Oracle10_2, ACommandIsOut) {
  // OpenAERA (semantics 10.2): premise [300,400), a command that starts 20 ms later. Given a blink before the
  // move,
  Agent agent({Holds(Val("h", "essence", O("hand")), kAlways)});
  agent.Sense({});
  agent.Sense({Val("h", "position", N(0)), Val("h", "colour", O("red"))});
  agent.Do(Cmd("blink", {E("h")}));
  agent.Do(Cmd("move", {E("h"), N(5)}));
  agent.Sense({Val("h", "position", N(5)), Val("h", "colour", O("red"))});
  // then what is learned has conditions, and neither command is one.
  ASSERT_FALSE(agent.kb().composite_states().empty()) << agent.Text();
  for (const auto& [id, record] : agent.kb().composite_states()) {
    for (const FactPattern& component : record.state.components) {
      EXPECT_FALSE(IsCommand(component.payload)) << ToText(record.state);
    }
  }
}

// ---- 10.5 and the table of 3.3: a hand that holds nothing, and a large thing at its place

// Its premise, requirement models and what a grasp then brings, with a choice of confidences; a negative one
// for none.
struct Grasp {
  double allowed = -1;
  double vetoed = -1;
  bool with_template = true;
};

Agent Grasping(const Grasp& grasp) {
  CompositeState near = State(1, 1,
                              {MakeValue(V(0), O("holding"), Set({})), MakeValue(V(3), O("size"), O("large")),
                               MakeValue(V(3), O("position"), V(4)), MakeValue(V(0), O("position"), V(4))});
  Model causal;  // template ti(0, 1); hand 2, command 3 4, thing 5, effect 6 7
  causal.id = ModelId{1};
  if (grasp.with_template) causal.template_arguments = {Ti(V(0), V(1))};
  causal.lhs = {true, Cmd("grab_type_2", {V(2)}), V(3), V(4)};
  causal.rhs = {true, MakeValue(V(2), O("holding"), grasp.with_template ? Set({V(5)}) : Set({E("s")})), V(6),
                V(7)};
  const int from = grasp.with_template ? 0 : 3;
  causal.forward = {Assign(6, "+", V(from), D(grasp.with_template ? 100 : 80)),
                    Assign(7, "+", V(from + 1), D(100))};
  std::vector<SeedModelDefinition> models{{causal, {}, false}};
  const auto require = [&](std::int64_t id, bool positive, double rate) {
    Model model;  // hand 0, thing 1, place 2, frame 3 4
    model.id = ModelId{id};
    model.lhs = {true, MakeIcst(near.id, {}, {V(0), V(1), V(2)}), V(3), V(4)};
    std::vector<Term> exposed{V(0), V(1), V(5), V(6)};
    if (!grasp.with_template) exposed = {V(0), V(5), V(6)};
    model.rhs = {
        positive,
        MakeImdl(causal.id, grasp.with_template ? std::vector<Term>{Ti(V(3), V(4))} : std::vector<Term>{},
                 exposed),
        V(3), V(4)};
    models.push_back({model, Evidence{rate, 1}, false});
  };
  if (grasp.allowed >= 0) require(2, true, grasp.allowed);
  if (grasp.vetoed >= 0) require(3, false, grasp.vetoed);
  Agent agent({Holds(Val("s", "size", O("large")), kAlways)}, {near}, models);
  for (int i = 0; i < 8; ++i) agent.Sense({});
  agent.Sense({Val("h", "holding", Set({})), Val("s", "position", N(15)), Val("h", "position", N(15))});
  agent.Do(Cmd("grab_type_2", {E("h")}));
  return agent;
}

template <class Body>
const Body* Last(const Agent& agent) {
  const auto all = agent.events.All<Body>();
  return all.empty() ? nullptr : all.back();
}

TEST(Oracle10_5, TheRequirementsConfidenceDoesNotEnterThePrediction) {
  // OpenAERA (semantics 10.5): icst cfd 1 -> requirement .6 -> predicted [900,1000) with 1; seen at 900: both
  // rated.
  Agent agent = Grasping({0.6});
  ASSERT_NE(Last<IcstFound>(agent), nullptr);
  EXPECT_EQ(Last<IcstFound>(agent)->fact.confidence, 1);
  ASSERT_NE(Last<ImdlPredicted>(agent), nullptr);
  EXPECT_NEAR(Last<ImdlPredicted>(agent)->fact.confidence, 0.6, 1e-12);
  ASSERT_NE(Last<PredictionMade>(agent), nullptr);
  EXPECT_EQ(ToText(Last<PredictionMade>(agent)->target.payload), "(mk.val h holding [s])");
  EXPECT_EQ(Last<PredictionMade>(agent)->target.interval, Ms(900, 1000));
  EXPECT_EQ(Last<PredictionMade>(agent)->target.confidence, 1);

  agent.Sense({Val("h", "holding", Set({E("s")})), Val("s", "position", N(15)), Val("h", "position", N(15))});

  EXPECT_EQ(agent.events.All<PredictionSucceeded>().size(), 1u);
  const auto rated = agent.events.All<EvidenceUpdated>();
  ASSERT_EQ(rated.size(), 2u);
  EXPECT_EQ(rated[0]->after, (Evidence{2, 2}));
  EXPECT_EQ(rated[1]->after, (Evidence{1.6, 2}));
}

struct Row {
  const char* name;
  Grasp grasp;
  ChainingStatus status;
  bool predicts;
  double confidence;
};

void PrintTo(const Row& row, std::ostream* out) {
  *out << row.name;
}

class ChainingTable : public testing::TestWithParam<Row> {};

TEST_P(ChainingTable, DecidesAsItSays) {
  // OpenAERA (semantics 3.3, the table); own: a tie goes to the veto.
  const Row& row = GetParam();
  const Agent agent = Grasping(row.grasp);
  const auto* decided = Last<ChainingDecided>(agent);
  ASSERT_NE(decided, nullptr);
  EXPECT_EQ(EnumName(decided->status), EnumName(row.status));
  const auto* predicted = Last<PredictionMade>(agent);
  ASSERT_EQ(predicted != nullptr, row.predicts);
  if (predicted) {
    EXPECT_EQ(predicted->target.confidence, row.confidence);
  }
  // Only what is really expected is in force for others to build on.
  EXPECT_EQ(agent.events.All<ImdlFired>().size(), row.predicts && row.confidence > 0 ? 1u : 0u);
}

INSTANTIATE_TEST_SUITE_P(
    Semantics3_3, ChainingTable,
    testing::Values(Row{"NoneAtAll", {-1, -1, false}, ChainingStatus::kNoRequirement, true, 1},
                    Row{"WeakAllows", {0.6, -1}, ChainingStatus::kEnabled, true, 1},
                    Row{"OnlyAVeto", {-1, 0.5, false}, ChainingStatus::kStrongDisabled, true, 0},
                    Row{"SurerThanTheVeto", {0.8, 0.5}, ChainingStatus::kEnabledAgainstVeto, true, 1},
                    Row{"VetoIsSurer", {0.6, 0.9}, ChainingStatus::kVetoed, true, 0},
                    Row{"TieGoesToTheVeto", {0.6, 0.6}, ChainingStatus::kVetoed, true, 0}),
    [](const testing::TestParamInfo<Row>& row) { return row.param.name; });

TEST(Chaining, AModelThatNeedsAConditionWhichDoesNotHoldSaysNothing) {
  // OpenAERA (semantics 3.3, WEAK_DISABLED). Given a requirement model that one failure does not end.
  Agent agent = Grasping({1});
  agent.Sense({Val("h", "holding", Set({})), Val("s", "position", N(15)), Val("h", "position", N(10))});
  const std::size_t before = agent.events.All<PredictionMade>().size();
  agent.Do(Cmd("grab_type_2", {E("h")}));
  EXPECT_EQ(Last<ChainingDecided>(agent)->status, ChainingStatus::kWeakDisabled);
  EXPECT_EQ(agent.events.All<PredictionMade>().size(), before);
}

TEST(Chaining, EachFrameSaysHowMuchItHadToDo) {
  // Own (semantics 9, Tick). Given the grasp's frame: four facts that fit, one instance, one word of a
  // requirement model.
  const Agent agent = Grasping({0.6});
  const auto* counted = Last<FrameCounted>(agent);
  ASSERT_NE(counted, nullptr);
  EXPECT_EQ(counted->facts, 5);  // with the property and the instance
  EXPECT_EQ(counted->instances, 1);
  EXPECT_EQ(counted->requirements, 1);
  EXPECT_EQ(counted->models, 2);
  EXPECT_EQ(counted->cut, 0);
}

TEST(Join, EightComponentsWithTenFactsEachAreCutAndNotAll) {
  // Own (semantics 3.1, 11.1): ten to the eighth combinations fit; the join stops at its limit and says so.
  CompositeState wide{{1}, {}, {}, {}};
  Situation situation(Ms(0, 100));
  for (int c = 0; c < 8; ++c) {
    const std::string attribute = "attribute" + std::to_string(c);
    wide.components.push_back(Component(V(c + 2), attribute.c_str(), W()));
    for (int i = 0; i < 10; ++i) {
      SituationFact fact;
      fact.fact = Holds(MakeValue(Term::Entity("x" + std::to_string(10 * c + i)), O(attribute.c_str()), N(i)),
                        Ms(0, 100));
      situation.Add(std::move(fact));
    }
  }
  JoinWork work;
  const auto matches = JointMatches(wide, situation, {}, {100, 1000}, &work);
  EXPECT_EQ(matches.size(), 100u);
  EXPECT_LE(work.steps, 1000);
  EXPECT_EQ(work.cut, 1);
}

}  // namespace
}  // namespace aerascope
