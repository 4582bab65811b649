#include "viewer/draw/views.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "engine/query/describe.h"
#include "engine/query/episode_summary.h"
#include "engine/query/model_history.h"
#include "viewer/draw/curves.h"
#include "viewer/draw/graph_drawing.h"
#include "viewer/draw/key_moments.h"
#include "viewer/draw/lanes.h"
#include "viewer/draw/marks.h"
#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

constexpr int kMargin = 24;
constexpr int kWidth = 960;
constexpr int kOpenHeight = 900;  // bands are opened as long as the drawing stays below
constexpr std::size_t kMostCurves = 40;
constexpr int kCurvePitch = 150;

// The drawing on a page with a margin around it.
std::string OnPage(const Svg& drawing, Size size, const std::string& title, const Theme& theme) {
  Svg page;
  const Size whole{size.width + 2 * kMargin, size.height + 2 * kMargin};
  page.Leaf("rect", {{"width", whole.width}, {"height", whole.height}, {"class", "d-page"}});
  page.Open("g",
            {{"transform", "translate(" + std::to_string(kMargin) + " " + std::to_string(kMargin) + ")"}});
  page.Append(drawing);
  page.Close();
  return SvgDocument(whole, title, DrawingStyle(theme), page.content());
}

bool Speaks(const TriadBand& band, ModelId model) {
  return band.model == model || std::any_of(band.cards.begin(), band.cards.end(),
                                            [&](const Card& card) { return card.model == model; });
}

std::vector<ModelHistory> MostTested(const Run& run, std::size_t* left_out) {
  std::vector<ModelHistory> histories;
  const EpisodeSummary summary = Summarise(run);
  const std::set<ModelId> learned(summary.learned.begin(), summary.learned.end());
  for (ModelHistory& history : Histories(run)) {
    if (history.steps.size() > 1 || learned.contains(history.model)) histories.push_back(std::move(history));
  }
  *left_out = histories.size() > kMostCurves ? histories.size() - kMostCurves : 0;
  std::stable_sort(histories.begin(), histories.end(), [](const ModelHistory& a, const ModelHistory& b) {
    return a.steps.size() > b.steps.size();
  });
  histories.resize(histories.size() - *left_out);
  std::sort(histories.begin(), histories.end(),
            [](const ModelHistory& a, const ModelHistory& b) { return a.model < b.model; });
  return histories;
}

}  // namespace

std::string KnowledgeViewSvg(const Run& run, Time at, ModelId chosen, const Theme& theme) {
  const TriadLayout layout = LayOutKnowledge(run);
  ModelGraphView view;
  view.at = at;
  view.chosen = chosen;
  for (std::size_t i = 0; i < layout.bands.size(); ++i) {
    if (chosen.valid() && Speaks(layout.bands[i], chosen)) view.open_bands.insert(i);
  }
  if (!chosen.valid()) {
    for (std::size_t i = 0; i < layout.bands.size(); ++i) {
      view.open_bands.insert(i);
      if (StackBands(layout, view.open_bands).height > kOpenHeight) view.open_bands.erase(i);
    }
  }
  Svg svg;
  DrawModelGraph(svg, run, layout, view);
  return OnPage(svg, ModelGraphSize(layout, view),
                "What was known at " + SecondsText(std::min(at, run.end())), theme);
}

std::string LanesSvg(const Run& run, const Theme& theme) {
  Svg svg;
  // Room for a word in each frame of a short run; a longer one is shortened.
  const int width =
      std::clamp(160 + 44 * static_cast<int>(std::min<std::size_t>(run.frames().size(), 100)), kWidth, 1600);
  const int height = DrawLanes(svg, run, Summarise(run), width);
  return OnPage(svg, {width, height + 4}, run.title(), theme);
}

std::string CurvesSvg(const Run& run, const std::vector<ModelId>& models, const Theme& theme) {
  std::size_t left_out = 0;
  std::vector<ModelHistory> histories;
  if (models.empty()) {
    histories = MostTested(run, &left_out);
  } else {
    for (const ModelId model : models) histories.push_back(HistoryOf(run, model));
  }
  const Time from = run.frames().empty() ? Time{0} : run.frames().front().interval.after;
  const CurveScale scale{TimeScale(from, run.end(), 44, kWidth - 62), LowestQuarter(histories)};
  Svg svg;
  int y = 18;
  for (const ModelHistory& history : histories) {
    const ModelRecord* record = run.final_knowledge().Find(history.model);
    const bool analogy = record != nullptr && record->origin == Origin::kAnalogy;
    analogy ? DrawStar(svg, {7, y - 5}, 7, "d-star") : DrawDot(svg, {7, y - 5}, 5, "d-mark");
    svg.Text(22, y,
             FitText(TitleOf(run.final_knowledge(), history.model), kWidth - 140, 15, TextWeight::kBold),
             {"d-b", 15});
    svg.Text(kWidth, y, IdText(history.model), {"d-id", 12, TextAnchor::kEnd});
    DrawConfidenceCurve(svg, run, history, {0, y + 36, kWidth, kCurvePitch - 80}, scale);
    y += kCurvePitch;
  }
  if (histories.empty()) {
    svg.Text(0, y, "No model was learned, and none was put to the test.", {"d-2", 13});
    return OnPage(svg, {kWidth, y + 8}, "How sure it was", theme);
  }
  DrawTimeAxis(svg, scale.time, y - 16);
  if (left_out > 0) {
    y += 20;
    svg.Text(0, y - 8, "Not drawn: " + std::to_string(left_out) + " more models, less often tested.",
             {"d-3", 12});
  }
  return OnPage(svg, {kWidth, y}, "How sure it was", theme);
}

Result<std::string> MomentSvg(const Run& run, const SheetFrame& frame, const Theme& theme) {
  const std::vector<KeyMoment> moments = MomentsAt(run, {frame.at}).moments;
  const Rect place{0, 0, kWidth, kWidth * 9 / 16};
  Svg svg;
  const std::string time = SecondsText(frame.at);
  const int indent = TextWidth(time, 17, TextWeight::kBold) + 12;
  const std::string caption =
      moments.empty() ? "" : FitSentences(moments.front().sentences, kWidth - indent, 16, 3);
  if (Status drawn = DrawStill(svg, frame, place, caption, theme); !drawn) return drawn.error();
  int y = place.height + 30;
  svg.Text(0, y, time, {"d-b", 17});
  for (const std::string& line : WrapText(caption, kWidth - indent, 16, 3)) {
    svg.Text(indent, y, line, {"d-2", 16});
    y += 23;
  }
  return OnPage(svg, {kWidth, y - 12}, run.title() + " at " + time, theme);
}

}  // namespace aerascope
