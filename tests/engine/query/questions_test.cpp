// Causes, goals, histories, the model graph and the summary of the paper's episode.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "engine/query/episode_summary.h"
#include "engine/query/model_graph.h"
#include "engine/query/model_history.h"
#include "engine/query/why.h"
#include "tests/support/any_event.h"
#include "tests/support/paper_episode.h"

namespace aerascope {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Run PaperRun(const PaperEpisodeOptions& options = {}) {
  return Run::FromEvents({{}, PaperEpisode(options), options.last_frame == 15, std::nullopt});
}

ModelId FirstByAnalogy(const Run& run) {
  return Summarise(run).by_analogy.front();
}

// ----------------------------------------------------------------------------------------------------------------
// why

TEST(WhyTest, AModelGoesBackToWhatWasSeen) {
  const auto run = PaperRun();
  const CauseTree tree = Why(run, run.CreationOf(FirstByAnalogy(run)));
  ASSERT_FALSE(tree.nodes.empty());
  EXPECT_FALSE(tree.cut);
  EXPECT_GE(tree.levels, 4);
  ASSERT_FALSE(tree.first_causes.empty());
  for (const EventId first : tree.first_causes) EXPECT_TRUE(MayBeUncaused(run.Find(first)->body));
}

TEST(WhyTest, EveryCauseIsInTheTreeAndExpandedOnce) {
  const auto run = PaperRun();
  const EventId root = run.OfKind<EpisodeEnded>()[0];
  const CauseTree tree = Why(run, run.OfKind<GoalAchieved>().back(), {1000, 100'000});
  std::set<EventId> expanded;
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const CauseNode& node = tree.nodes[i];
    const bool leaf = run.Causes(node.event).empty();
    if (node.mark == CauseMark::kExpanded && !leaf) {
      EXPECT_TRUE(expanded.insert(node.event).second);
    }
    if (i > 0) {
      EXPECT_EQ(node.depth, tree.nodes[node.parent].depth + 1);
    }
    if (i > 0) {
      EXPECT_LT(node.parent, i);
    }
  }
  for (const CauseNode& node : tree.nodes) {
    for (const EventId cause : run.Causes(node.event)) {
      EXPECT_TRUE(std::any_of(tree.nodes.begin(), tree.nodes.end(),
                              [&](const CauseNode& n) { return n.event == cause; }));
    }
  }
  EXPECT_EQ(Why(run, root).nodes.size(), 1u);
  EXPECT_TRUE(Why(run, EventId{100000}).nodes.empty());
}

TEST(WhyTest, LedToIsWhyTurnedRound) {
  const auto run = PaperRun();
  const EventId model = run.CreationOf(FirstByAnalogy(run));
  const CauseTree tree = LedTo(run, model, {1000, 100'000});
  ASSERT_GT(tree.nodes.size(), 1u);
  for (const CauseNode& node : tree.nodes) {
    const CauseTree back = Why(run, node.event, {1000, 100'000});
    EXPECT_TRUE(std::any_of(back.nodes.begin(), back.nodes.end(),
                            [&](const CauseNode& n) { return n.event == model; }));
  }
}

TEST(WhyTest, LimitsAreKeptAndSaid) {
  const auto run = PaperRun();
  const CauseTree shallow = Why(run, run.CreationOf(FirstByAnalogy(run)), {1, 2000});
  EXPECT_EQ(shallow.levels, 2);
  EXPECT_TRUE(shallow.cut);
  EXPECT_LE(Why(run, run.CreationOf(FirstByAnalogy(run)), {1000, 5}).nodes.size(), 5u);
  EXPECT_THAT(TreeText(run, shallow), HasSubstr("(goes on)"));
}

TEST(WhyTest, TheTreeIsDrawn) {
  const auto run = PaperRun();
  const EventId drive = run.OfKind<DriveInjected>()[0];
  const EventId goal = run.OfKind<GoalSet>()[0];
  EXPECT_EQ(TreeText(run, Why(run, goal)),
            "6 s  " + std::string("Goal: grab_type_2 [H] makes H holding [C], asked for by mdl_74.  ") +
                IdText(goal) + "\n└─ 6 s  Drive: hold s1.  " + IdText(drive) + "\n");
}

// -------------------------------------------------------------------------------------------------------------
// goals

TEST(GoalTreeTest, DrivesHaveSubGoalsPlansAndCommands) {
  const auto run = PaperRun();
  const GoalTree tree = MakeGoalTree(run);
  ASSERT_EQ(tree.drives.size(), 5u);
  const GoalNode& hold = tree.goals[tree.drives[0]];
  EXPECT_EQ(hold.title, "hold s1");
  EXPECT_EQ(hold.outcome, Outcome::kReached);
  EXPECT_EQ(hold.outcome_time, Time{8'000'000});
  ASSERT_EQ(hold.plans.size(), 2u);
  EXPECT_TRUE(hold.plans[0].committed);
  EXPECT_EQ(hold.plans[0].outcome, SimulationOutcome::kReached);
  EXPECT_EQ(hold.commands.size(), 2u);
  ASSERT_EQ(hold.sub_goals.size(), 1u);
  EXPECT_EQ(tree.goals[hold.sub_goals[0]].sub_goals.size(), 1u);
  EXPECT_THAT(GoalTreeText(run, tree),
              HasSubstr("6 s  hold s1  " + IdText(hold.goal) + "  reached at 8 s\n"));
}

TEST(GoalTreeTest, AMissedDriveSaysSo) {
  PaperEpisodeOptions options;
  options.cylinder_slips = true;
  const auto run = PaperRun(options);
  const GoalTree tree = MakeGoalTree(run);
  EXPECT_EQ(tree.goals[tree.drives.back()].outcome, Outcome::kFailed);
}

// -----------------------------------------------------------------------------------------------------------
// history

TEST(ModelHistoryTest, ConfidenceMovesWithEvidence) {
  const auto run = PaperRun();
  const ModelHistory history = HistoryOf(run, FirstByAnalogy(run));
  ASSERT_EQ(history.steps.size(), 3u);
  EXPECT_EQ(history.steps[0].reason, "by analogy");
  EXPECT_EQ(history.steps[1].reason, "h holding [s1] came true");
  EXPECT_EQ(history.ConfidenceAt(Time{5'999'999}), std::nullopt);
  EXPECT_EQ(history.ConfidenceAt(Time{6'000'000}), 0.75);
  EXPECT_EQ(history.ConfidenceAt(Time{8'000'000}), 0.875);
  EXPECT_NEAR(*history.ConfidenceAt(kForever), 2.75 / 3, 1e-12);
  EXPECT_TRUE(HistoryOf(run, ModelId{99999}).steps.empty());
  const ModelUse use = UseOf(run, FirstByAnalogy(run), Time{10'000'000});
  EXPECT_EQ(use.predicted, 1);
  EXPECT_EQ(use.came_true, 1);
}

// The last step of every history is what the knowledge base holds.
TEST(ModelHistoryTest, EndsWhereTheKnowledgeBaseIs) {
  const auto run = PaperRun();
  for (const ModelHistory& history : Histories(run)) {
    const ModelRecord* record = run.final_knowledge().Find(history.model);
    EXPECT_EQ(history.steps.back().evidence, record->evidence);
    EXPECT_EQ(history.steps.back().state, record->state);
  }
}

// -------------------------------------------------------------------------------------------------------------
// graph

TEST(ModelGraphTest, TriadsStandByCausalModelBehindTheirSource) {
  const auto run = PaperRun();
  const ModelGraph graph = MakeModelGraph(run.final_knowledge());
  EXPECT_EQ(graph.nodes.size(), 24u);
  ASSERT_EQ(graph.groups.size(), 4u);
  std::vector<std::size_t> sizes;
  for (const TriadGroup& group : graph.groups) {
    sizes.push_back(group.triads.size());
    for (std::size_t i = 0; i < group.triads.size(); ++i) {
      if (!group.triads[i].derived_from.valid()) continue;
      ASSERT_GT(i, 0u);
      EXPECT_EQ(group.triads[i].derived_from, group.triads[i - 1].requirement);
      EXPECT_EQ(group.triads[i].generation, 1);
    }
  }
  EXPECT_THAT(sizes, ElementsAre(1u, 2u, 4u, 2u));
}

TEST(ModelGraphTest, EdgesAreWhatTheDefinitionsSay) {
  const auto run = PaperRun();
  const KnowledgeBase& knowledge = run.final_knowledge();
  const ModelGraph graph = MakeModelGraph(knowledge);
  std::map<ModelGraphEdgeKind, int> count;
  for (const ModelGraphEdge& edge : graph.edges) {
    ++count[edge.kind];
    const ModelGraphNode& from = graph.nodes[edge.from];
    const ModelGraphNode& to = graph.nodes[edge.to];
    if (edge.kind == ModelGraphEdgeKind::kRequires) {
      EXPECT_EQ(RequiredState(knowledge.Find(to.model)->model), from.state);
    }
    if (edge.kind == ModelGraphEdgeKind::kEnables) {
      EXPECT_EQ(TargetModel(knowledge.Find(from.model)->model), to.model);
    }
  }
  EXPECT_EQ(count[ModelGraphEdgeKind::kRequires], 9);
  EXPECT_EQ(count[ModelGraphEdgeKind::kEnables], 9);
  EXPECT_EQ(count[ModelGraphEdgeKind::kContains], 16);
  EXPECT_EQ(count[ModelGraphEdgeKind::kDerivedFrom], 8);
  EXPECT_TRUE(std::is_sorted(graph.edges.begin(), graph.edges.end()));
  EXPECT_EQ(graph.nodes[graph.Find("cst_1")].title, "H hand at P");
  EXPECT_EQ(graph.Find("cst_999"), graph.nodes.size());
}

TEST(ModelGraphTest, DeletedModelsAreShownOnlyWhenAskedFor) {
  const auto run = PaperRun();
  KnowledgeBase knowledge = run.final_knowledge();
  knowledge.SetState(FirstByAnalogy(run), ModelState::kDeleted);
  EXPECT_EQ(MakeModelGraph(knowledge).nodes.size(), 23u);
  EXPECT_EQ(MakeModelGraph(knowledge, DeletedModels::kInclude).nodes.size(), 24u);
}

// No requirement model is lost, whatever is derived from what.
TEST(ModelGraphTest, EveryRequirementModelIsInOneGroup) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    AnyEvents any(seed);
    EpisodeFile file;
    for (std::int64_t i = 1; i <= 300; ++i) file.events.push_back(any.AnyEvent(i));
    const auto run = aerascope::Run::FromEvents(std::move(file));
    const ModelGraph graph = MakeModelGraph(run.final_knowledge(), DeletedModels::kInclude);
    std::size_t requirements = 0;
    for (const auto& [id, record] : run.final_knowledge().models())
      requirements += IsRequirement(record.model) ? 1u : 0u;
    std::set<ModelId> placed;
    for (const TriadGroup& group : graph.groups) {
      for (const Triad& triad : group.triads) EXPECT_TRUE(placed.insert(triad.requirement).second);
    }
    EXPECT_EQ(placed.size(), requirements);
    // The rest only has to come to an end.
    Summarise(run);
    GoalTreeText(run, MakeGoalTree(run));
    Histories(run);
    TreeText(run, Why(run, run.events().back().id));
    TreeText(run, LedTo(run, run.events().front().id));
  }
}

TEST(ModelGraphTest, ModelsDerivedFromEachOtherInACircleAreNotLost) {
  KnowledgeBase knowledge;
  const FactPattern fact{true, MakeValue(Term::Variable(0), Term::Ontology("a"), Term::Number(1)),
                         Term::Variable(1), Term::Variable(2)};
  for (std::int64_t id : {1, 2}) {
    Model model{{id}, {}, fact, {true, MakeImdl({9}, {}, {}), Term::Variable(1), Term::Variable(2)},
                {},   {}, {}};
    knowledge.AddModel({model, Origin::kAnalogy, {3 - id}, {}, {}, {}, false, ModelState::kActive, {}});
  }
  const ModelGraph graph = MakeModelGraph(knowledge);
  ASSERT_EQ(graph.groups.size(), 1u);
  EXPECT_EQ(graph.groups[0].triads.size(), 2u);
}

// -----------------------------------------------------------------------------------------------------------
// summary

TEST(EpisodeSummaryTest, CountsWhatCameOut) {
  const auto run = PaperRun();
  const EpisodeSummary summary = Summarise(run);
  EXPECT_THAT(summary.headline,
              ElementsAre("5 of 5 goals reached", "9 pieces of knowledge learned, 4 by analogy",
                          "9 of 9 predictions came true"));
  EXPECT_EQ(summary.drives_reached, 5);
  EXPECT_EQ(summary.score.made, 9);
  ASSERT_EQ(summary.phases.size(), 2u);
  EXPECT_EQ(summary.phases[0].by, Commander::kTeacher);
  EXPECT_EQ(summary.phases[0].interval, (TimeInterval{{0}, {6'000'000}}));
  EXPECT_EQ(summary.phases[1].interval, (TimeInterval{{6'000'000}, {15'000'000}}));
  int accepted = 0;
  for (const AnalogyOfRun& analogy : summary.analogies) accepted += analogy.made_knowledge ? 1 : 0;
  EXPECT_EQ(accepted, 4);
  EXPECT_GT(summary.analogies.size(), 4u);
}

// What was given up was counted as learned, and nobody said so.
TEST(EpisodeSummaryTest, WhatWasGivenUpIsCountedApart) {
  std::vector<Event> events = PaperEpisode();
  const ModelId model = FirstByAnalogy(PaperRun());
  events.push_back({EventId{static_cast<std::int64_t>(events.size()) + 1},
                    events.back().time,
                    events.back().frame,
                    {},
                    {events.back().id},
                    ModelStateChanged{model, ModelState::kActive, ModelState::kDeleted}});
  const EpisodeSummary summary = Summarise(Run::FromEvents({{}, std::move(events), true, std::nullopt}));
  EXPECT_THAT(summary.given_up, ElementsAre(model));
  EXPECT_EQ(summary.headline[1], "9 pieces of knowledge learned, 4 by analogy, 1 given up");
}

TEST(EpisodeSummaryTest, ARunCutShortSaysWhere) {
  PaperEpisodeOptions options;
  options.last_frame = 8;
  const auto run = PaperRun(options);
  const EpisodeSummary summary = Summarise(run);
  EXPECT_FALSE(summary.complete);
  EXPECT_EQ(summary.headline.back(), "incomplete, last event " + IdText(run.events().back().id));
  EXPECT_EQ(summary.drives[0].outcome, Outcome::kOpen);
}

TEST(EpisodeSummaryTest, AFailureIsCounted) {
  PaperEpisodeOptions options;
  options.cylinder_slips = true;
  const EpisodeSummary summary = Summarise(PaperRun(options));
  EXPECT_EQ(summary.drives_reached, 4);
  EXPECT_EQ(summary.score.failed, 1);
  EXPECT_EQ(summary.headline[0], "4 of 5 goals reached");
}

}  // namespace
}  // namespace aerascope
