#include "viewer/draw/graph_drawing.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <set>

#include "engine/query/goal_tree.h"
#include "engine/query/why.h"
#include "tests/viewer/draw/scenario_run.h"
#include "tests/viewer/draw/svg_check.h"
#include "viewer/draw/tree_drawing.h"

namespace aerascope {
namespace {

// The same card has the same outline whatever the time.
std::vector<std::string> PlacesOfCards(const Run& run, const TriadLayout& layout, Time at) {
  ModelGraphView view;
  view.at = at;
  const std::string svg = ModelGraphSvg(run, layout, view, LightTheme());
  std::vector<std::string> places;
  for (std::size_t begin = svg.find("data-id=\"cst"); begin != std::string::npos;
       begin = svg.find("data-id=\"cst", begin + 1)) {
    const std::size_t rect = svg.find("<rect", begin);
    places.push_back(svg.substr(begin, svg.find('>', begin) - begin) +
                     svg.substr(rect, svg.find("class", rect) - rect));
  }
  return places;
}

TEST(GraphDrawing, NoCardMovesAsTimeMoves) {
  const aerascope::Run run = PaperRun();
  const TriadLayout layout = LayOutKnowledge(run);
  const std::vector<std::string> at_the_end = PlacesOfCards(run, layout, run.end());

  EXPECT_EQ(at_the_end.size(), run.final_knowledge().composite_states().size());
  for (int second = 0; second < 15; ++second) {
    EXPECT_EQ(PlacesOfCards(run, layout, Time{second * 1'000'000}), at_the_end) << second;
  }
}

TEST(GraphDrawing, WhatIsKnownLaterIsADottedPlaceThatSaysWhen) {
  const aerascope::Run run = PaperRun();
  const TriadLayout layout = LayOutKnowledge(run);
  ModelGraphView view;
  view.at = Time{7'000'000};

  const std::string during = ModelGraphSvg(run, layout, view, LightTheme());
  view.at = run.end();
  const std::string at_the_end = ModelGraphSvg(run, layout, view, LightTheme());

  EXPECT_EQ(CountOf(during, "class=\"d-slot\""), 3u) << "three analogies are still to come";
  EXPECT_NE(during.find("made at 9 s"), std::string::npos);
  EXPECT_EQ(CountOf(at_the_end, "class=\"d-slot\""), 0u);
}

TEST(GraphDrawing, DroppedConditionsAreStruckInBothForms) {
  const aerascope::Run run = PaperRun();
  const TriadLayout layout = LayOutKnowledge(run);
  ModelGraphView view;
  view.at = run.end();

  const std::string folded = ModelGraphSvg(run, layout, view, LightTheme());
  for (std::size_t band = 0; band < layout.bands.size(); ++band) view.open_bands.insert(band);
  const std::string open = ModelGraphSvg(run, layout, view, LightTheme());

  EXPECT_EQ(CountOf(folded, "class=\"d-cut\""), 4u);
  EXPECT_EQ(CountOf(open, "class=\"d-cut\""), 4u);
  EXPECT_EQ(CountOf(open, ">pruned<"), 4u);
  EXPECT_NE(open.find("by analogy: 3 of 4 conditions hold for s1"), std::string::npos);
}

TEST(GraphDrawing, ConfidenceIsThatOfTheTime) {
  const aerascope::Run run = PaperRun();
  const TriadLayout layout = LayOutKnowledge(run);
  ModelGraphView view;
  view.at = Time{7'000'000};
  EXPECT_EQ(CountOf(ModelGraphSvg(run, layout, view, LightTheme()), ">.75<"), 1u);

  view.at = run.end();
  const std::string svg = ModelGraphSvg(run, layout, view, LightTheme());

  EXPECT_EQ(CountOf(svg, ">.75<"), 0u);
  EXPECT_EQ(CountOf(svg, ">.88<"), 3u);
  EXPECT_EQ(CountOf(svg, ">.92<"), 1u);
}

TEST(GraphDrawing, EverySvgIsWellFormedAlsoWithHostileNames) {
  PaperEpisodeOptions hostile;
  hostile.cylinder = "</text><script>alert(1)</script>\x1b\xe2\x80\xae";
  hostile.scenario = "<b>&\xff\x01";
  const aerascope::Run run = PaperRun(hostile);
  ModelGraphView view;
  view.at = run.end();
  view.open_bands = {0, 1, 2, 3};
  EventId reached;
  for (const EventId id : run.OfKind<GoalAchieved>()) reached = id;

  for (const std::string& svg : {ModelGraphSvg(run, LayOutKnowledge(run), view, DarkTheme()),
                                 CauseTreeSvg(run, reached, CauseDirection::kWhy, LightTheme()),
                                 CauseTreeSvg(run, EventId{1}, CauseDirection::kLedTo, LightTheme()),
                                 GoalTreeSvg(run, MakeGoalTree(run), LightTheme())}) {
    const std::string said = WhatXmllintSays(svg);
    if (said == kNoXmllint) GTEST_SKIP() << said;
    EXPECT_EQ(said, "");
    EXPECT_EQ(svg.find("<script"), std::string::npos);
  }
}

TEST(GraphDrawing, ACauseTreeHasABoxForEachEventAndMarksTheOneAskedAbout) {
  const aerascope::Run run = PaperRun();
  const EventId reached = run.OfKind<GoalAchieved>().front();
  std::set<EventId> causes;
  for (const CauseNode& node : Why(run, reached).nodes) causes.insert(node.event);

  const std::string svg = CauseTreeSvg(run, reached, CauseDirection::kWhy, LightTheme(), 12);

  EXPECT_EQ(CountOf(svg, "data-id=\"#"), causes.size());
  EXPECT_EQ(CountOf(svg, "class=\"d-card d-chosen\""), 1u);
  EXPECT_EQ(svg.find("Left out"), std::string::npos);
  EXPECT_EQ(svg.find("goes on"), std::string::npos);
}

TEST(GraphDrawing, ACauseTreeStaysReadableAndSaysWhatItLeavesOut) {
  // What an analogy led to was a picture of 7744 pixels, which nobody could read.
  const aerascope::Run run = ScenarioRun("size_pruned_first_scripted.toml");
  EventId made;
  for (const EventId id : run.OfKind<AnalogyCompared>()) {
    const auto& compared = *run.FindBody<AnalogyCompared>(id);
    if (compared.verdict == AnalogyVerdict::kAccepted) made = run.CreationOf(compared.result_requirement);
  }
  ASSERT_TRUE(made.valid());

  const std::string svg = CauseTreeSvg(run, made, CauseDirection::kLedTo, LightTheme());

  int width = 0;
  ASSERT_EQ(std::sscanf(svg.c_str() + svg.find(" width="), " width=\"%d", &width), 1);
  EXPECT_LE(width, 1800);
  EXPECT_LE(CountOf(svg, "data-id=\"#"), kReadableBoxes);
  EXPECT_NE(svg.find("Left out: "), std::string::npos);
  EXPECT_NE(svg.find(">goes on<"), std::string::npos);
}

TEST(GraphDrawing, ACauseTreeGoesAsFarAsIsAsked) {
  const aerascope::Run run = PaperRun();
  const EventId compared = run.OfKind<AnalogyCompared>().front();

  const std::string one = CauseTreeSvg(run, compared, CauseDirection::kWhy, LightTheme(), 1);

  EXPECT_EQ(CountOf(one, "data-id=\"#"), 1 + run.Causes(compared).size());
  EXPECT_GT(CountOf(CauseTreeSvg(run, compared, CauseDirection::kWhy, LightTheme(), 2), "data-id=\"#"),
            CountOf(one, "data-id=\"#"));
  EXPECT_NE(one.find("events, up to 1 step away. Left out: "), std::string::npos);
}

TEST(GraphDrawing, AGoalTreeSaysWhichPlansWereChosenAndMarksTheirWay) {
  // Given a run of drives that plans were committed to,
  const aerascope::Run run = PaperRun();
  const GoalTree tree = MakeGoalTree(run);

  const std::string svg = GoalTreeSvg(run, tree, LightTheme());

  // then each plan stands in the goal it was made for, and the goals it went through are marked, with all
  // above them.
  EXPECT_EQ(CountOf(svg, ">chosen, "), run.OfKind<PlanCommitted>().size());
  EXPECT_GE(CountOf(svg, "class=\"d-card d-chosen\""), 2u);
}

TEST(GraphDrawing, TreesBeyondTheLimitSayWhatIsLeftOut) {
  const aerascope::Run run = LongRun(400);

  const std::string svg = CauseTreeSvg(run, EventId{1}, CauseDirection::kLedTo, LightTheme(), 3);

  EXPECT_EQ(CountOf(svg, "data-id=\"#"), kMaxDrawnBoxes);
  EXPECT_NE(svg.find("Drawn: 400 events"), std::string::npos);
  EXPECT_EQ(CountOf(CauseTreeSvg(run, EventId{1}, CauseDirection::kLedTo, LightTheme()), "data-id=\"#"),
            kReadableBoxes);
}

TEST(GraphDrawing, AFoldedVetoKeepsItsNumberAndCountsWhatHasNoRoom) {
  // It had no number, and ended in a dot behind which nothing came.
  const aerascope::Run run = ScenarioRun("size_pruned_first_scripted.toml");
  ModelGraphView view;
  view.at = run.end();

  const std::string svg = ModelGraphSvg(run, LayOutKnowledge(run), view, LightTheme());

  int vetoes = 0;
  for (const auto& [id, record] : run.final_knowledge().models()) {
    if (KindOf(record.model) != ModelKind::kStrongRequirement) continue;
    ++vetoes;
    const std::size_t card = svg.find("<g data-id=\"" + IdText(id) + "\">");
    ASSERT_NE(card, std::string::npos);
    const std::string drawn = svg.substr(card, svg.find("</g>", card) - card);
    EXPECT_NE(drawn.find(">" + IdText(id) + "<"), std::string::npos);
    EXPECT_NE(drawn.find(">never<"), std::string::npos);
  }
  EXPECT_EQ(vetoes, 3);
  EXPECT_GE(CountOf(svg, "> · +"), 3u);
}

// The drawing of one triad, small enough to be read.
TEST(GraphDrawing, OneTriadIsDrawnAsInTheGoldenFile) {
  const aerascope::Run run = LongRun(1);
  ModelGraphView view;
  view.at = run.end();
  view.open_bands = {0};
  Svg svg;
  DrawModelGraph(svg, run, LayOutKnowledge(run), view);

  const std::string path = std::string(AERASCOPE_SOURCE_DIR) + "/tests/viewer/draw/golden/one_triad.svg.txt";
  std::ifstream file(path, std::ios::binary);
  const std::string golden((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());

  EXPECT_EQ(svg.content(), golden) << "if the new drawing is right, put it into " << path;
}

}  // namespace
}  // namespace aerascope
