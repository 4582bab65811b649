#include "viewer/draw/curves.h"

#include <algorithm>
#include <cmath>

#include "engine/query/describe.h"
#include "viewer/draw/marks.h"
#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

// "0.75 = ψ 3/4" for a model made by analogy: familiarity times the confidence of its source.
std::string WhereTheStartComesFrom(const Run& run, ModelId model) {
  for (const EventId id : run.OfKind<AnalogyCompared>()) {
    const auto* compared = run.FindBody<AnalogyCompared>(id);
    if (compared->verdict != AnalogyVerdict::kAccepted || compared->result_requirement != model) continue;
    std::string text = " = ψ " + std::to_string(compared->matched + compared->achievable) + "/" +
                       std::to_string(compared->total);
    if (compared->psi > 0 && compared->confidence < compared->psi - 1e-6) {
      text += " × " + TwoDecimals(compared->confidence / compared->psi);
    }
    return text;
  }
  return "";
}

class Curve {
 public:
  Curve(Svg& svg, const Run& run, const ModelHistory& history, const Rect& area, const CurveScale& scale)
      : svg_(svg), run_(run), history_(history), area_(area), scale_(scale) {}

  void Draw() {
    for (const double share : {1.0, scale_.lowest}) {
      svg_.Line({area_.x, Y(share)}, {scale_.time.right(), Y(share)}, "d-line");
      svg_.Text(area_.x, Y(share) - 4, TwoDecimals(share), {"d-3", 11});
    }
    if (history_.steps.empty()) return;
    DrawSteps();
    DrawEnd();
    DrawSigns();
  }

 private:
  int Y(double share) const {
    const double clean = std::isfinite(share) ? std::clamp(share, scale_.lowest, 1.0) : scale_.lowest;
    return area_.bottom() -
           static_cast<int>((clean - scale_.lowest) / (1 - scale_.lowest) * area_.height + 0.5);
  }
  Point At(const ConfidenceStep& step) const { return {scale_.time.X(step.time), Y(step.evidence.rate())}; }

  void DrawSteps() {
    const Point start = At(history_.steps.front());
    std::string path = "M" + std::to_string(start.x) + " " + std::to_string(start.y);
    for (std::size_t i = 1; i < history_.steps.size(); ++i) {
      const Point point = At(history_.steps[i]);
      path += "H" + std::to_string(point.x) + "V" + std::to_string(point.y);
    }
    if (history_.steps.back().state != ModelState::kDeleted)
      path += "H" + std::to_string(scale_.time.right());
    svg_.Path(path, "d-curve");
  }

  void DrawSigns() {
    const ConfidenceStep& first = history_.steps.front();
    const Point start = At(first);
    const ModelRecord* record = run_.final_knowledge().Find(history_.model);
    const bool analogy = record != nullptr && record->origin == Origin::kAnalogy;
    const std::string value = TwoDecimals(first.evidence.rate());
    const std::string why = analogy ? WhereTheStartComesFrom(run_, history_.model) : "";
    const int width = TextWidth(value, 12, TextWeight::kBold) + TextWidth(why, 12) + 12;
    const std::vector<TextRun> words = {{value, "d-b"}, {why, "d-2"}};
    // Left of its sign where there is room, else under it.
    const bool left = start.x - width > area_.x + 40;
    taken_.push_back(left ? Rect{start.x - 12 - width, start.y - 14, width, 14}
                          : Rect{start.x, start.y + 4, width, 14});
    if (left) {
      svg_.Text(start.x - 12, start.y - 4, words, {"", 12, TextAnchor::kEnd});
    } else if (history_.steps.size() > 1 || first.evidence.rate() < 0.995) {
      svg_.Text(start.x, start.y + 16, words, {});
    }
    for (std::size_t i = 1; i < history_.steps.size(); ++i) DrawStep(i);
    if (analogy) {
      DrawStar(svg_, start, 7, "d-star");
    } else {
      DrawDot(svg_, start, 4, "d-star");
    }
  }

  // The sign of a step, and its reason where there is room for it: over the curve, left of the sign, or under
  // it. Reasons without room are left out; the report has all.
  void DrawStep(std::size_t index) {
    const ConfidenceStep& step = history_.steps[index];
    const Point point = At(step);
    // A model that is phased out may be right again, which brings it back.
    const bool bad = step.success ? !*step.success : step.state != ModelState::kActive;
    if (bad) {
      DrawCross(svg_, point, 5);
    } else {
      DrawDot(svg_, point, 4, "d-dot");
    }
    // The end says of itself that it is one.
    const bool phased_out = !step.success && step.state == ModelState::kPhasedOut;
    const bool back = !step.success && step.state == ModelState::kActive;
    const std::string reason = phased_out                           ? "phased out"
                               : back                               ? "in use again"
                               : step.state == ModelState::kDeleted ? ""
                                                                    : step.reason;
    // Where a success brings the model back, the return is told.
    const bool told_next =
        step.success && index + 1 < history_.steps.size() && !history_.steps[index + 1].success &&
        history_.steps[index + 1].time == step.time && history_.steps[index + 1].state == ModelState::kActive;
    if (reason.empty() || told_next) return;
    const int width = TextWidth(reason, 11);
    const int right_most = scale_.time.right() - width;
    const Rect over{std::min(point.x + 2, right_most), point.y - 20, width, 12};
    const Rect left{point.x - 10 - width, point.y - 6, width, 12};
    const Rect under{std::min(point.x + 2, right_most), point.y + 8, width, 12};
    const std::vector<Rect> places = bad    ? std::vector<Rect>{left, under}
                                     : back ? std::vector<Rect>{over, left, under}
                                            : std::vector<Rect>{over, left};
    for (const Rect& place : places) {
      if (!Free(place, index)) continue;
      taken_.push_back({place.x - 4, place.y, width + 8, place.height});
      svg_.Text(place.x, place.y + 10, reason, {bad ? "d-fail" : "d-2", 11});
      return;
    }
  }

  // Whether a label of step `index` would lie on no other text, sign or piece of the curve.
  bool Free(const Rect& box, std::size_t index) const {
    if (box.x < area_.x + 40) return false;
    if (std::any_of(taken_.begin(), taken_.end(), [&](const Rect& other) { return Overlap(other, box); }))
      return false;
    for (std::size_t i = index; i > 0 && At(history_.steps[i]).x >= box.x; --i)
      if (CurveMeets(box, i)) return false;
    for (std::size_t i = index + 1; i < history_.steps.size() && At(history_.steps[i - 1]).x <= box.right();
         ++i)
      if (CurveMeets(box, i)) return false;
    const Point last = At(history_.steps.back());
    return !(last.x <= box.right() && Overlap({last.x, last.y - 2, scale_.time.right() - last.x, 4}, box));
  }

  // The curve from the step before this one to it, and its sign.
  bool CurveMeets(const Rect& box, std::size_t index) const {
    const Point from = At(history_.steps[index - 1]);
    const Point to = At(history_.steps[index]);
    const int top = std::min(from.y, to.y);
    return Overlap({from.x, from.y - 2, to.x - from.x, 4}, box) ||
           Overlap({to.x - 2, top, 4, std::max(from.y, to.y) - top}, box) ||
           Overlap({to.x - 6, to.y - 6, 12, 12}, box);
  }

  void DrawEnd() {
    const ConfidenceStep& last = history_.steps.back();
    const bool gone = last.state == ModelState::kDeleted;
    const int x = gone ? scale_.time.X(last.time) : scale_.time.right();
    taken_.push_back({x + 5, Y(last.evidence.rate()) - 8, 80, 16});
    svg_.Text(x + 9, Y(last.evidence.rate()) + 5, gone ? "given up" : TwoDecimals(last.evidence.rate()),
              {gone ? "d-b d-fail" : "d-b", 13});
  }

  Svg& svg_;
  const Run& run_;
  const ModelHistory& history_;
  const Rect& area_;
  const CurveScale& scale_;
  std::vector<Rect> taken_;  // where words stand
};

}  // namespace

double LowestQuarter(const std::vector<ModelHistory>& histories) {
  double lowest = 0.75;
  for (const ModelHistory& history : histories) {
    for (const ConfidenceStep& step : history.steps) {
      const double rate = step.evidence.rate();
      if (std::isfinite(rate)) lowest = std::min(lowest, std::floor(std::max(0.0, rate) * 4 + 1e-9) / 4);
    }
  }
  return lowest;
}

void DrawConfidenceCurve(Svg& svg, const Run& run, const ModelHistory& history, const Rect& area,
                         const CurveScale& scale) {
  Curve(svg, run, history, area, scale).Draw();
}

void DrawTimeAxis(Svg& svg, const TimeScale& time, int base_line) {
  for (const Time tick : time.Ticks(56)) {
    svg.Text(time.X(tick), base_line, SecondsText(tick), {"d-3", 11, TextAnchor::kMiddle});
  }
}

}  // namespace aerascope
