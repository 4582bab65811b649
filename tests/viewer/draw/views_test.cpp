#include "viewer/draw/views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "engine/query/episode_summary.h"
#include "engine/query/model_history.h"
#include "tests/viewer/draw/svg_check.h"
#include "viewer/draw/analogy_drawing.h"
#include "viewer/draw/curves.h"
#include "viewer/draw/graph_drawing.h"
#include "viewer/draw/marks.h"
#include "viewer/draw/png.h"

namespace aerascope {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string FigureOf(const Run& run, const std::optional<ObjectId>& object = std::nullopt) {
  const Result<EventId> comparison = FindComparison(run, object);
  if (!comparison) return comparison.error().message;
  const Result<std::string> svg = AnalogySvg(run, *comparison, LightTheme());
  return svg ? *svg : svg.error().message;
}

// Paper, section 4.3: three of four conditions hold for the large sphere; its shape is pruned.
TEST(AnalogyFigure, ShowsEachConditionKeptOrPrunedAndWhatFollows) {
  const aerascope::Run run = PaperRun();

  const std::string svg = FigureOf(run);

  EXPECT_EQ(CountOf(svg, "class=\"d-found\""), 3u);
  EXPECT_EQ(CountOf(svg, "class=\"d-failed\""), 1u);
  EXPECT_EQ(CountOf(svg, "class=\"d-check\""), 3u);
  EXPECT_EQ(CountOf(svg, ">matched by fact_"), 3u);
  EXPECT_EQ(CountOf(svg, ">pruned<"), 1u);
  EXPECT_EQ(CountOf(svg, "class=\"d-cut\""), 1u);
  EXPECT_THAT(svg, HasSubstr("ψ = 3/4 = 0.75"));
  EXPECT_THAT(svg, HasSubstr("confidence = ψ × 1.00 = 0.75"));
  EXPECT_THAT(svg, HasSubstr("3 matched, 1 missed; Jaccard 0.60"));
  EXPECT_THAT(svg, HasSubstr("grab_type_2 something large”, by analogy with “grab_type_2 a large cube"));
}

TEST(AnalogyFigure, IsFoundByWhatItMadeByWhatItComparedAndByItself) {
  const aerascope::Run run = PaperRun();
  const EpisodeSummary summary = Summarise(run);
  ASSERT_EQ(summary.by_analogy.size(), 4u);
  for (const ModelId made : summary.by_analogy) {
    const Result<EventId> found = FindComparison(run, ObjectId(made));
    ASSERT_TRUE(found) << found.error().message;
    const auto* compared = run.FindBody<AnalogyCompared>(*found);
    EXPECT_EQ(compared->result_requirement, made);
    EXPECT_EQ(*FindComparison(run, ObjectId(compared->result_state)), *found);
    EXPECT_EQ(*FindComparison(run, ObjectId(*found)), *found);
  }
  EXPECT_THAT(FigureOf(run, ObjectId(ModelId{9999})),
              HasSubstr("mdl_9999 was neither made by analogy nor compared"));
}

TEST(AnalogyFigure, ARejectedComparisonSaysWhyInTheEmptyPlace) {
  const aerascope::Run run = PaperRun();
  for (const EventId id : run.OfKind<AnalogyCompared>()) {
    if (run.FindBody<AnalogyCompared>(id)->verdict == AnalogyVerdict::kAccepted) continue;
    const std::string svg = FigureOf(run, ObjectId(id));
    EXPECT_THAT(svg, HasSubstr("No analogy with"));
    EXPECT_THAT(svg, HasSubstr("Nothing was made of it"));
    EXPECT_THAT(svg, HasSubstr("class=\"d-slot\""));
    EXPECT_THAT(svg, Not(HasSubstr(">pruned<")));
    return;
  }
  FAIL() << "the paper's episode has no rejected comparison";
}

TEST(AnalogyFigure, ARunWithoutComparisonsSaysSo) {
  EXPECT_THAT(FigureOf(LongRun(3)), HasSubstr("nothing was compared by analogy"));
  EXPECT_THAT(AnalogySvg(LongRun(3), EventId{1}, LightTheme()).error().message,
              HasSubstr("is not a comparison by analogy"));
}

TEST(Views, AreWellFormedTheSameTwiceAndHaveTwoThemes) {
  const aerascope::Run run = PaperRun();
  const auto all = [&run](const Theme& theme) {
    return std::vector<std::string>{
        *AnalogySvg(run, *FindComparison(run, std::nullopt), theme),
        KnowledgeViewSvg(run, run.end(), ModelId{}, theme),
        KnowledgeViewSvg(run, Time{7'500'000}, Summarise(run).by_analogy[0], theme), LanesSvg(run, theme),
        CurvesSvg(run, {}, theme)};
  };
  const std::vector<std::string> light = all(LightTheme());
  EXPECT_EQ(light, all(LightTheme()));
  const std::vector<std::string> dark = all(DarkTheme());
  for (std::size_t i = 0; i < light.size(); ++i) {
    EXPECT_NE(light[i], dark[i]);
    for (const std::string& svg : {light[i], dark[i]}) {
      const std::string said = WhatXmllintSays(svg);
      if (said == kNoXmllint) GTEST_SKIP() << said;
      EXPECT_EQ(said, "") << i;
    }
  }
}

TEST(Views, HostileNamesStayText) {
  PaperEpisodeOptions options;
  options.cylinder = "</text><script>alert(1)</script>\x1b\xe2\x80\xae";
  options.scenario = "<b>&\xff\x01";
  const aerascope::Run run = PaperRun(options);
  for (const std::string& svg : {FigureOf(run), LanesSvg(run, LightTheme()), CurvesSvg(run, {}, LightTheme()),
                                 KnowledgeViewSvg(run, run.end(), ModelId{}, LightTheme())}) {
    EXPECT_THAT(svg, Not(HasSubstr("<script")));
    const std::string said = WhatXmllintSays(svg);
    if (said == kNoXmllint) GTEST_SKIP() << said;
    EXPECT_EQ(said, "");
  }
}

TEST(Views, CurvesBeyondTheLimitAreCounted) {
  const std::string svg = CurvesSvg(LongRun(200), {}, LightTheme());
  EXPECT_THAT(svg, HasSubstr("more models, less often tested."));
  EXPECT_EQ(CountOf(svg, "class=\"d-curve\""), 40u);
  EXPECT_EQ(CountOf(CurvesSvg(PaperRun(), {Summarise(PaperRun()).by_analogy[0]}, LightTheme()),
                    "class=\"d-curve\""),
            1u);
}

TEST(Views, AMomentNeedsAPicture) {
  const aerascope::Run run = PaperRun();
  SheetFrame frame;
  frame.at = Time{9'000'000};
  frame.png = "no picture";
  EXPECT_THAT(MomentSvg(run, frame, LightTheme()).error().message, HasSubstr("is not a PNG"));
}

// The name of a thing was cut by the outline of the one that held it.
TEST(Views, NamesInAPictureLieOverAllOutlinesAndNotOnEachOther) {
  const std::string png = *SvgToPng(SvgDocument({960, 540}, "still", "", ""));
  const std::vector<SheetPoint> square = {{400, 200}, {500, 200}, {500, 300}, {400, 300}};
  const SheetFrame frame{Time{0}, png, {{"cyl", square, {450, 205}}, {"h", square, {450, 200}}}};
  Svg svg;

  ASSERT_TRUE(DrawStill(svg, frame, {0, 0, 960, 540}, "h holding [cyl]", LightTheme()).ok());

  const std::string content(svg.content());
  EXPECT_LT(content.rfind("<path"), content.find(">cyl<"));
  EXPECT_LT(content.rfind("<path"), content.find(">h<"));
  std::vector<double> lines;
  for (const std::string_view name : {">h<", ">cyl<"}) {
    const std::size_t element = content.rfind("<text", content.find(name));
    lines.push_back(std::stod(content.substr(content.find(" y=\"", element) + 4)));
  }
  EXPECT_EQ(lines[0], 200);
  EXPECT_GE(lines[1], 214) << "the lower name moves down";
}

// The left and right ends of texts on the same line, in order.
TEST(Curves, ReasonsOfDenseOutcomesNeverLieOnEachOther) {
  // Given a model that was tried a hundred times in three seconds
  const aerascope::Run run = PaperRun();
  ModelHistory history;
  history.model = Summarise(run).by_analogy.front();
  double right = 1, tried = 1;
  for (int i = 0; i < 100; ++i) {
    const bool success = i % 7 != 3;
    right += success ? 1 : 0;
    tried += 1;
    ConfidenceStep step;
    step.time = Time{i * 30'000};
    step.evidence = {right, tried};
    step.success = success;
    step.reason = success ? "b at 52 came true" : "b at 52 did not come true";
    history.steps.push_back(step);
  }
  Svg svg;

  // When it is drawn as small as on the sheet
  DrawConfidenceCurve(svg, run, history, {0, 0, 500, 80}, {TimeScale({0}, {3'000'000}, 40, 440), 0.5});

  // Then at least the first reason is written, and no two of them meet
  struct Label {
    double x, y;
  };
  std::vector<Label> labels;
  const std::string& text = svg.content();
  for (std::size_t at = text.find("<text"); at != std::string::npos; at = text.find("<text", at + 1)) {
    const std::size_t end = text.find("</text>", at);
    if (text.substr(at, end - at).find("come true") == std::string::npos &&
        text.substr(at, end - at).find("came true") == std::string::npos)
      continue;
    labels.push_back({std::stod(text.substr(text.find("x=\"", at) + 3)),
                      std::stod(text.substr(text.find("y=\"", at) + 3))});
  }
  ASSERT_GE(labels.size(), 1u);
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_TRUE(std::abs(labels[i].y - labels[k].y) >= 12 || std::abs(labels[i].x - labels[k].x) >= 90)
          << i << " " << k;
}

// Paper, section 3.2: a strong requirement says that what it speaks about will not work.
TEST(GraphDrawing, AVetoIsBarredAndSaysNever) {
  Svg plain, veto;
  DrawRing(plain, {0, 0, 36, 36}, 0.75);
  DrawRing(veto, {0, 0, 36, 36}, 0.75, true);
  EXPECT_EQ(CountOf(plain.content(), "d-bars"), 0u);
  EXPECT_EQ(CountOf(veto.content(), "d-bars"), 2u);
  EXPECT_THAT(veto.content(), HasSubstr("d-arc d-veto"));

  const aerascope::Run run = LongRun(2, true);
  const TriadLayout layout = LayOutKnowledge(run);
  for (const bool open : {false, true}) {
    ModelGraphView view;
    view.at = run.end();
    if (open) view.open_bands = {0};
    const std::string svg = ModelGraphSvg(run, layout, view, LightTheme());
    EXPECT_EQ(CountOf(svg, ">never<"), 1u) << open;
    EXPECT_EQ(CountOf(svg, "class=\"d-link d-veto\""), 1u) << open;
    EXPECT_EQ(CountOf(svg, "class=\"d-bars\""), 3u) << "two at the ring, one at the end of its link";
  }
}

}  // namespace
}  // namespace aerascope
