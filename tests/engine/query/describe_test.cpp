// Knowledge and events in words. Expected texts are written out: they are what people read.
#include "engine/query/describe.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/engine/kb/build_terms.h"
#include "tests/support/any_event.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Run PaperRun(const PaperEpisodeOptions& options = {}) {
  return Run::FromEvents({{}, PaperEpisode(options), options.last_frame == 15, std::nullopt});
}

std::vector<std::string> TextsOf(const std::vector<Condition>& conditions) {
  std::vector<std::string> texts;
  for (const Condition& condition : conditions)
    texts.push_back((condition.pruned ? "(-) " : "") + condition.text);
  return texts;
}

// The requirement model with this title.
ModelId Titled(const KnowledgeBase& knowledge, const std::string& title) {
  for (const auto& [id, record] : knowledge.models()) {
    if (TitleOf(knowledge, id) == title) return id;
  }
  ADD_FAILURE() << "no model is titled " << title;
  return {};
}

TEST(DescribeTest, NestedStatesAreWrittenOut) {
  const auto run = PaperRun();
  const KnowledgeBase& knowledge = run.final_knowledge();
  const ModelId grab = Titled(knowledge, "grab_type_2 a large cube");
  const CompositeStateId state = RequiredState(knowledge.Find(grab)->model);
  const std::vector<Condition> conditions = ConditionsOf(knowledge, knowledge.Find(state)->state);
  EXPECT_THAT(TextsOf(conditions),
              ElementsAre("H holding []", "C size large, at P", "H hand at P", "C shape cube"));
  EXPECT_EQ(OneLine(conditions), "H holding [] \u00b7 large \u00b7 cube");
  EXPECT_EQ(conditions[1].subject, "C");
  EXPECT_EQ(conditions[1].relation, "size");
  EXPECT_EQ(conditions[1].value, "large, at P");
  EXPECT_EQ(conditions[2].relation, "hand at");
  EXPECT_EQ(conditions[2].value, "P");
  EXPECT_THAT(conditions[1].variables, ElementsAre("C", "P"));
  EXPECT_THAT(conditions[2].components, ElementsAre(2u));
}

TEST(DescribeTest, ConditionsDroppedByAnalogyAreKnown) {
  const auto run = PaperRun();
  const KnowledgeBase& knowledge = run.final_knowledge();
  const ModelId grab = Titled(knowledge, "grab_type_2 something large");
  const std::vector<Condition> conditions =
      ConditionsWithPruned(knowledge, RequiredState(knowledge.Find(grab)->model));
  EXPECT_THAT(TextsOf(conditions),
              ElementsAre("H holding []", "C size large, at P", "H hand at P", "(-) C shape cube"));
  EXPECT_EQ(OneLine(conditions), "H holding [] \u00b7 large");
}

TEST(DescribeTest, WhatIsLearnedLaterOnAGeneralisedStateDroppedNothing) {
  // Given a requirement model made by analogy, whose state dropped a condition of its source,
  const auto run = PaperRun();
  KnowledgeBase knowledge = run.final_knowledge();
  const ModelRecord generalised = *knowledge.Find(Titled(knowledge, "grab_type_2 something large"));
  // when another is learned on the same state,
  ModelRecord learned = generalised;
  learned.model.id = ModelId{9000};
  learned.origin = Origin::kInduction;
  learned.derived_from = ModelId{};
  knowledge.AddModel(learned);
  // then only the first is told with what was pruned.
  EXPECT_THAT(TextsOf(ConditionsOfRequirement(knowledge, generalised.model)),
              ElementsAre("H holding []", "C size large, at P", "H hand at P", "(-) C shape cube"));
  EXPECT_THAT(TextsOf(ConditionsOfRequirement(knowledge, learned.model)),
              ElementsAre("H holding []", "C size large, at P", "H hand at P"));
}

TEST(DescribeTest, ModelsAreExplainedInASentence) {
  const auto run = PaperRun();
  const KnowledgeBase& knowledge = run.final_knowledge();
  EXPECT_EQ(ExplanationOf(knowledge, Titled(knowledge, "grab_type_2 something large")),
            "If H holding [], C size large at P and H hand at P, then grab_type_2 [H] makes H holding [C].");
  EXPECT_EQ(ExplanationOf(knowledge, Titled(knowledge, "move the hand")),
            "If H hand at P, then move [H D] makes H at P + D.");
  const ModelLines move = LinesOf(knowledge, knowledge.Find(Titled(knowledge, "move [H D]"))->model);
  EXPECT_EQ(move.lhs, "move [H D]");
  EXPECT_EQ(move.rhs, "H at P + D");
  EXPECT_THAT(move.variables, ElementsAre("H", "D", "P"));
  EXPECT_EQ(ExplanationOf(knowledge, ModelId{99999}), "");
  EXPECT_EQ(TitleOf(knowledge, ModelId{99999}), "mdl_99999");
}

TEST(DescribeTest, AStrongRequirementDenies) {
  KnowledgeBase knowledge;
  Model cm{{1},
           {},
           {true, MakeCommand(O("lift"), {V(0)}), V(1), V(2)},
           {true, MakeValue(V(0), O("level"), O("up")), V(3), V(4)},
           {},
           {},
           {"X"}};
  Model veto{{2},
             {},
             {true, MakeValue(V(0), O("weight"), O("heavy")), V(1), V(2)},
             {false, MakeImdl({1}, {}, {V(0), V(3), V(4)}), V(1), V(2)},
             {},
             {},
             {"X"}};
  knowledge.AddModel({cm, Origin::kSeed, {}, {}, {}, {}, false, ModelState::kActive, {}});
  knowledge.AddModel({veto, Origin::kSeed, {}, {}, {}, {}, false, ModelState::kActive, {}});
  EXPECT_EQ(TitleOf(knowledge, ModelId{2}), "veto: lift something heavy");
  EXPECT_EQ(ExplanationOf(knowledge, ModelId{2}),
            "If X weight heavy, then it is not so that lift [X] makes X level up.");
}

TEST(DescribeTest, WhatARequirementSpeaksAboutIsSaidInItsOwnNames) {
  // Given a model of a thing X, and a requirement model that calls the thing it is about B,
  KnowledgeBase knowledge;
  const Model cm{{1},
                 {},
                 {true, MakeCommand(O("lift"), {V(0)}), V(1), V(2)},
                 {true, MakeValue(V(0), O("level"), O("up")), V(3), V(4)},
                 {},
                 {},
                 {"X"}};
  const Model requirement{{2},
                          {},
                          {true, MakeValue(V(0), O("above"), V(3)), V(1), V(2)},
                          {true, MakeImdl({1}, {}, {V(3), V(4), V(5)}), V(1), V(2)},
                          {},
                          {},
                          {"X", "", "", "B"}};
  knowledge.AddModel({cm, Origin::kSeed, {}, {}, {}, {}, false, ModelState::kActive, {}});
  knowledge.AddModel({requirement, Origin::kSeed, {}, {}, {}, {}, false, ModelState::kActive, {}});
  // then the model's sides read on from the condition: it is B that is lifted, not the X of either.
  const ModelLines lines = LinesOfTarget(knowledge, requirement);
  EXPECT_EQ(lines.lhs, "lift [B]");
  EXPECT_EQ(lines.rhs, "B level up");
  EXPECT_THAT(lines.variables, ElementsAre("B"));
  EXPECT_EQ(LinesOfTarget(knowledge, cm).lhs, "");
}

TEST(DescribeTest, AConditionThatHeldEarlierIsSaidWithItsTime) {
  // Given a veto whose condition held two frames before what it forbids,
  KnowledgeBase knowledge;
  const Model cm{{1},
                 {},
                 {true, MakeCommand(O("lift"), {V(0)}), V(1), V(2)},
                 {true, MakeValue(V(0), O("level"), O("up")), V(3), V(4)},
                 {},
                 {},
                 {"X"}};
  const auto later = [](int of, std::int64_t by_ms) { return Struct("+", {V(of), D(by_ms)}); };
  const Model veto{{2},
                   {},
                   {true, MakeValue(V(0), O("weight"), O("heavy")), V(1), V(2)},
                   {false, MakeImdl({1}, {}, {V(0), V(5), V(6)}), V(3), V(4)},
                   {{3, later(1, 200)}, {4, later(2, 200)}},
                   {},
                   {"X"}};
  knowledge.AddModel({cm, Origin::kSeed, {}, {}, {}, {}, false, ModelState::kActive, {}});
  knowledge.AddModel({veto, Origin::kSeed, {}, {}, {}, {}, false, ModelState::kActive, {}});
  // then title and explanation say how long before, so that it is told from one of the same time.
  EXPECT_EQ(DelayOf(veto), Milliseconds(200));
  EXPECT_EQ(TitleOf(knowledge, ModelId{2}), "veto: lift something heavy, seen 0.2 s before");
  EXPECT_EQ(ExplanationOf(knowledge, ModelId{2}),
            "If X weight heavy, then 0.2 s later it is not so that lift [X] makes X level up.");
  // A causal model's own time from cause to effect is not meant.
  EXPECT_EQ(DelayOf(cm), std::nullopt);
}

TEST(DescribeTest, WhatTwoNestedStatesSayIsSaidOnce) {
  // Given a state of two states that both say where the hand is,
  KnowledgeBase knowledge;
  const auto state = [](std::int64_t id, std::vector<FactPattern> components) {
    return CompositeStateRecord{{{id}, std::move(components), {}, {"H", "P"}}, Origin::kSeed, {}, {}, {}, {}};
  };
  const FactPattern at{true, MakeValue(V(0), O("position"), V(1)), V(2), V(3)};
  knowledge.AddCompositeState(state(1, {at, {true, MakeValue(V(0), O("essence"), O("hand")), V(2), V(3)}}));
  knowledge.AddCompositeState(state(2, {{true, MakeValue(V(0), O("grip"), O("open")), V(2), V(3)}, at}));
  const auto instance = [](std::int64_t of) {
    return FactPattern{true, MakeIcst({of}, {}, {V(0), V(1)}), V(2), V(3)};
  };
  knowledge.AddCompositeState(state(3, {instance(1), instance(2)}));
  // then what the second says besides is told whole, and what it says again is left out.
  const auto state_of = [&](std::int64_t id) { return knowledge.Find(CompositeStateId{id})->state; };
  EXPECT_THAT(TextsOf(ConditionsOf(knowledge, state_of(3))), ElementsAre("H hand at P", "H grip open, at P"));
  // Given one that says nothing new, then what says it stands for both components.
  knowledge.AddCompositeState(state(4, {instance(1), at}));
  const std::vector<Condition> conditions = ConditionsOf(knowledge, state_of(4));
  EXPECT_THAT(TextsOf(conditions), ElementsAre("H hand at P"));
  EXPECT_THAT(conditions[0].components, ElementsAre(0u, 1u));
}

TEST(DescribeTest, MissingNamesAreMadeByRole) {
  KnowledgeBase knowledge;
  CompositeState state{
      {1}, {Component(V(2), "colour", V(3)), Component(V(4), "left_of", Set({V(2)}))}, {}, {}};
  EXPECT_THAT(VariableNames(knowledge, state), ElementsAre("T", "T2", "X", "C", "Y"));
  EXPECT_THAT(TextsOf(ConditionsOf(knowledge, state)), ElementsAre("X colour C", "Y left_of [X]"));
  state.variable_names = {"", "", "C", "C"};
  EXPECT_THAT(VariableNames(knowledge, state), ElementsAre("T", "T2", "C", "C2", "X"));
}

TEST(DescribeTest, AttributesOfOneThingHaveLinesOfTheirOwn) {
  KnowledgeBase knowledge;
  CompositeState state{{1},
                       {Component(V(2), "position", V(3)), Component(V(2), "size", O("large")),
                        Component(V(2), "colour", O("red")), Component(V(2), "essence", O("ball"))},
                       {},
                       {"", "", "B", "P"}};
  state.components.push_back({false, MakeValue(V(2), O("held_by"), E("h")), V(0), V(1)});
  EXPECT_THAT(TextsOf(ConditionsOf(knowledge, state)),
              ElementsAre("B ball size large, at P", "B colour red", "B not held_by h"));
}

TEST(DescribeTest, ValuesReadAsPeopleWriteThem) {
  EXPECT_EQ(ValueText(Struct("vec3", {N(0.15), N(-0.0700001), N(0)})), "(0.15, -0.07, 0)");
  EXPECT_EQ(ValueText(N(-1e-9)), "-1e-09");
  EXPECT_EQ(ValueText(N(12345678)), "12345678");
  EXPECT_EQ(ValueText(Struct("+", {V(0), Struct("*", {N(2), V(1)})}), {"P", "D"}), "P + (2 * D)");
  EXPECT_EQ(ValueText(Set({E("s1"), W()})), "[s1 anything]");
  EXPECT_EQ(SecondsText(Time{700'000}), "0.7 s");
  EXPECT_EQ(SecondsText(kForever), "forever");
}

TEST(DescribeTest, InstancesAreWrittenWithTheirArguments) {
  const auto run = PaperRun();
  const KnowledgeBase& knowledge = run.final_knowledge();
  const auto* compared = run.FindBody<AnalogyCompared>(run.OfKind<AnalogyCompared>()[1]);
  EXPECT_EQ(PayloadText(knowledge, compared->components[1].pattern,
                        VariableNames(knowledge, knowledge.Find(compared->source)->state)),
            "s1 size large at P");
  EXPECT_EQ(BindingsText(BindingsOf(knowledge, compared->bindings)), "H = h, C = s1");
  EXPECT_EQ(PayloadText(knowledge, MakeCommand(O("release"), {E("h")})), "release [h]");
}

TEST(DescribeTest, EventsAreSentences) {
  const auto run = PaperRun();
  const auto sentence = [&](EventId id) { return SentenceOf(run, *run.Find(id)); };
  EXPECT_EQ(sentence(run.OfKind<EpisodeStarted>()[0]),
            "The episode \"Pick and place by analogy\" begins, in a world of kind scripted.");
  const auto& compared = run.OfKind<AnalogyCompared>();
  EXPECT_THAT(sentence(compared[0]),
              HasSubstr("2 of 4 conditions of cst_40 hold for s1: not familiar enough (ψ 0.5)."));
  EXPECT_THAT(sentence(compared[1]),
              HasSubstr("3 of 4 conditions of cst_73 hold for s1; `C shape cube` is pruned: mdl_"));
  EXPECT_THAT(sentence(compared[1]), HasSubstr(" starts at 0.75."));
  EXPECT_EQ(sentence(run.OfKind<GoalAchieved>()[0]), "Goal reached: h holding [s1].");
  EXPECT_EQ(sentence(run.OfKind<DriveInjected>()[0]), "Drive: hold s1.");
  EXPECT_EQ(sentence(run.OfKind<EpisodeEnded>()[0]), "The episode ends: 5 of 5 goals reached.");
}

TEST(DescribeTest, AFrameIsToldByWhatMattersMost) {
  const auto run = PaperRun();
  EXPECT_EQ(SentenceOfFrame(run, 0), "The teacher commands move [h (-0.16, -0.02)].");
  EXPECT_EQ(SentenceOfFrame(run, 1), "Learned: move the hand. The teacher commands grab_type_1 [h].");
  EXPECT_EQ(SentenceOfFrame(run, 6),
            "Drive: hold s1. By analogy: grab_type_2 something large, sure at 0.75.");
  EXPECT_THAT(SentenceOfFrame(run, 8),
              HasSubstr("Goal reached: h holding [s1]. The analogy was right: mdl_"));
  EXPECT_EQ(SentenceOfFrame(run, 99), "");
}

TEST(DescribeTest, FailuresAreTold) {
  PaperEpisodeOptions options;
  options.cylinder_slips = true;
  const auto run = PaperRun(options);
  EXPECT_THAT(SentenceOfFrame(run, 14), HasSubstr("Did not come true: h holding [cyl]"));
  EXPECT_THAT(SentenceOf(run, *run.Find(run.OfKind<GoalFailed>()[0])),
              HasSubstr("Goal missed: h holding [cyl]."));
}

TEST(DescribeTest, HostileNamesStayOnOneLine) {
  PaperEpisodeOptions options;
  options.cylinder = "cyl\n\x1b[2J\"<script>";
  const auto run = PaperRun(options);
  for (const Event& event : run.events()) {
    const std::string sentence = SentenceOf(run, event);
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
    EXPECT_EQ(sentence.find('\x1b'), std::string::npos);
  }
}

// Whatever a file may hold, there are words for it.
TEST(DescribeTest, AnyEventsCanBeDescribed) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    AnyEvents any(seed);
    EpisodeFile file;
    for (std::int64_t i = 1; i <= 150; ++i) file.events.push_back(any.AnyEvent(i));
    const auto run = aerascope::Run::FromEvents(std::move(file));
    const KnowledgeBase& knowledge = run.final_knowledge();
    for (const Event& event : run.events()) {
      const std::string sentence = SentenceOf(run, event);
      EXPECT_FALSE(sentence.empty());
      EXPECT_EQ(sentence.find('\n'), std::string::npos);
    }
    for (std::size_t i = 0; i < run.frames().size(); ++i) EXPECT_FALSE(SentenceOfFrame(run, i).empty());
    for (const auto& [id, record] : knowledge.composite_states()) {
      EXPECT_FALSE(ConditionsWithPruned(knowledge, id).empty());
      EXPECT_FALSE(CanonicalConditions(knowledge, record).empty());
    }
    for (const auto& [id, record] : knowledge.models()) {
      EXPECT_FALSE(ExplanationOf(knowledge, id).empty());
      EXPECT_FALSE(TitleOf(knowledge, id).empty());
    }
  }
}

// A composite state that contains itself is written to a depth and a size, and no further.
TEST(DescribeTest, ACircleOfStatesEnds) {
  KnowledgeBase knowledge;
  CompositeState state{{1}, {Component(V(2), "size", O("large"))}, {}, {}};
  for (int i = 0; i < 8; ++i) state.components.push_back({true, MakeIcst({1}, {}, {V(2)}), V(0), V(1)});
  knowledge.AddCompositeState({state, Origin::kSeed, {1}, {}, {}, {}});
  const std::size_t lines = ConditionsOf(knowledge, state).size();
  EXPECT_GT(lines, 8u);
  EXPECT_LE(lines, 2000u);
}

}  // namespace
}  // namespace aerascope
