#include "viewer/draw/lanes.h"

#include <algorithm>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/story.h"
#include "viewer/draw/curves.h"
#include "viewer/draw/lane_bars.h"
#include "viewer/draw/marks.h"
#include "viewer/draw/text_fit.h"
#include "viewer/draw/time_scale.h"

namespace aerascope {
namespace {

constexpr int kLabelWidth = 120;
constexpr int kRowHeight = 28;
constexpr int kBarHeight = 20;
constexpr int kTagFont = 11;
constexpr int kSignWidth = 11;
constexpr std::size_t kMaxRows = 5;      // of one lane
constexpr std::size_t kMaxMarks = 2000;  // of one lane

struct Bar {
  TimeInterval interval;
  std::vector<std::string> texts;  // the first that fits is written
  TagShape shape = TagShape::kBar;
  std::string classes;
  Outcome outcome = Outcome::kOpen;
};
struct Sign {
  Time at;
  std::string text;
  std::string vetoed;  // of a veto, what it is against
};

class Lanes {
 public:
  Lanes(Svg& svg, const Run& run, const EpisodeSummary& summary, int width)
      : svg_(svg), run_(run), summary_(summary), time_(Start(run), summary.end, kLabelWidth, width - 40) {}

  int Draw() {
    y_ = 24;
    const int top = y_;
    // Lines of the axis lie under everything, so the height is found by drawing the marks elsewhere first.
    Svg marks;
    std::swap(marks, svg_);
    DrawPhases();
    DrawBars("Goals", Goals());
    DrawBars("Commands", Commands());
    DrawBars("Predictions", Predictions());
    DrawSigns("Learned", Learned(false), false);
    DrawSigns("Made by analogy", Learned(true), true);
    std::swap(marks, svg_);
    const int bottom = y_;
    DrawTimeAxis(svg_, time_, 14);
    svg_.Text(0, 14, "Time", {"d-2"});
    for (const Time tick : time_.Ticks(56))
      svg_.Line({time_.X(tick), top}, {time_.X(tick), bottom}, "d-line");
    svg_.Append(marks);
    if (too_short_) DrawLegend();
    return y_;
  }

 private:
  static Time Start(const Run& run) {
    return run.frames().empty() ? Time{0} : run.frames().front().interval.after;
  }

  void DrawPhases() {
    if (summary_.phases.empty()) return;
    for (const Phase& phase : summary_.phases) {
      const int x = time_.X(phase.interval.after);
      const Rect rect{x, y_ + 4, std::max(2, time_.X(phase.interval.before) - x - 2), kBarHeight};
      svg_.Box(rect, "d-sunk");
      const bool teacher = phase.by == Commander::kTeacher;
      svg_.Text(
          rect.x + 6, rect.y + 14,
          WordsFor({teacher ? "The teacher commands" : "The agent commands", teacher ? "Teacher" : "Agent"},
                   rect.width - 8, 12),
          {"d-2"});
    }
    Label("Phase", 1);
  }

  std::vector<Bar> Goals() const {
    std::vector<Bar> bars;
    for (const DriveOutcome& drive : summary_.drives) {
      const std::string text =
          drive.title.empty() ? FactText(run_.final_knowledge(), drive.target) : drive.title;
      bars.push_back({InWholeFrames(run_, drive.from, drive.until),
                      {text},
                      TagShape::kPointsLeft,
                      "d-card",
                      drive.outcome});
    }
    return bars;
  }
  std::vector<Bar> Commands() const {
    std::vector<Bar> bars;
    for (const IssuedCommand& command : CommandsOf(run_)) {
      bars.push_back({InWholeFrames(run_, command.time, command.interval.before),
                      {PayloadText(run_.final_knowledge(), command.command),
                       CommandWords(run_.final_knowledge(), command.command)},
                      TagShape::kBar,
                      command.by == Commander::kTeacher ? "d-teacher" : "d-bar",
                      command.refused.valid() ? Outcome::kFailed : Outcome::kOpen});
    }
    return bars;
  }
  std::vector<Bar> Predictions() const {
    std::vector<Bar> bars;
    const std::map<PredictionId, std::string> short_targets = ShortTargets(run_, summary_.predictions);
    for (const PredictionRecordOfRun& prediction : summary_.predictions) {
      const std::string& in_short = short_targets.at(prediction.prediction);
      bars.push_back({InWholeFrames(run_, prediction.time, prediction.until),
                      {FactText(run_.final_knowledge(), prediction.target), in_short, LastResort(in_short)},
                      TagShape::kPointsRight,
                      "d-card",
                      prediction.outcome});
    }
    return bars;
  }

  std::vector<Sign> Learned(bool by_analogy) const {
    std::vector<Sign> signs;
    for (const ModelId id : summary_.learned) {
      const ModelRecord* record = run_.final_knowledge().Find(id);
      if (record == nullptr || (record->origin == Origin::kAnalogy) != by_analogy) continue;
      signs.push_back({record->created, TitleOf(run_.final_knowledge(), id), VetoedBy(id)});
    }
    return TogetherByVeto(signs);
  }
  std::string VetoedBy(ModelId id) const { return IsVeto(run_, id) ? WhatIsVetoed(run_, id) : ""; }

  // A failure may leave many vetoes against one thing, which differ in their conditions: one sign for all of
  // them.
  static std::vector<Sign> TogetherByVeto(const std::vector<Sign>& signs) {
    std::vector<Sign> together;
    std::vector<int> counts;
    for (const Sign& sign : signs) {
      if (!together.empty() && !sign.vetoed.empty() && together.back().at == sign.at &&
          together.back().vetoed == sign.vetoed) {
        ++counts.back();
        together.back().text = std::to_string(counts.back()) + " vetoes: " + sign.vetoed;
        continue;
      }
      together.push_back(sign);
      counts.push_back(1);
    }
    return together;
  }

  void Label(const std::string& text, std::size_t rows) {
    svg_.Text(0, y_ + 18, text, {"d-2"});
    y_ += static_cast<int>(rows) * kRowHeight;
  }

  void DrawBars(const std::string& label, const std::vector<Bar>& bars) {
    if (bars.empty()) return;
    std::vector<int> ends;  // of the rows, where the last bar ends
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < bars.size(); ++i) {
      const int x = time_.X(bars[i].interval.after);
      const int end = std::max(x + 4, time_.X(bars[i].interval.before) - 2);
      const auto row = std::find_if(ends.begin(), ends.end(), [x](int used) { return used <= x; });
      if (i >= kMaxMarks || (row == ends.end() && ends.size() == kMaxRows)) {
        ++left_out;
        continue;
      }
      const auto index = static_cast<std::size_t>(row - ends.begin());
      if (row == ends.end()) ends.push_back(0);
      ends[index] = end;
      DrawBar(bars[i], {x, y_ + 4 + static_cast<int>(index) * kRowHeight, end - x, kBarHeight});
    }
    if (left_out > 0)
      svg_.Text(0, y_ + 18 + kRowHeight - 14, "+ " + std::to_string(left_out) + " more", {"d-3", 11});
    Label(label, std::max<std::size_t>(1, ends.size()));
  }

  void DrawBar(const Bar& bar, const Rect& rect) {
    const bool failed = bar.outcome == Outcome::kFailed;
    const bool decided = bar.outcome != Outcome::kOpen;
    DrawTag(svg_, rect, bar.shape, failed ? "d-failed" : bar.classes);
    const int pad = bar.shape == TagShape::kPointsLeft ? 9 : 5;
    const int room = rect.width - pad - (bar.shape == TagShape::kPointsRight ? 6 : 3);
    const std::string text = WordsFor(bar.texts, decided ? room - kSignWidth : room, kTagFont);
    if (!text.empty()) {
      svg_.Text(rect.x + pad, rect.y + 14, text, {"", 11});
    } else {
      too_short_ = true;
    }
    // Where only one of both has room, the sign of what came of it; of what is open, the first letter.
    if (decided) {
      const Point sign{text.empty() ? rect.centre().x : rect.x + pad + room - kSignWidth / 2 + 1,
                       rect.centre().y};
      failed ? DrawCross(svg_, sign, 3) : DrawCheck(svg_, sign, 4);
    } else if (text.empty()) {
      const std::string letter(FirstLetter(bar.texts.back()));
      svg_.Text(rect.centre().x, rect.y + 14, letter, {"", 11, TextAnchor::kMiddle});
    }
  }

  // The first text that fits whole, else as much of the last as says something: two letters, and the number
  // at its end, which tells names apart ("grab 1", "grab 2"). Empty where not even that has room.
  static std::string WordsFor(const std::vector<std::string>& texts, int room, int font) {
    for (const std::string& text : texts)
      if (!text.empty() && TextWidth(text, font) <= room) return text;
    const std::string& last = texts.back();
    const bool numbered = last.size() > 1 && last.back() >= '0' && last.back() <= '9' && last[0] > '9';
    const std::string tail = numbered ? last.substr(last.size() - 1) : "";
    const std::string cut = FitText(last, room - TextWidth(tail, font), font);
    const std::string least = std::string(FirstLetter(last)) + "\u2026";
    return cut.size() > least.size() ? cut + tail : "";
  }
  void DrawLegend() {
    static constexpr std::string_view kLegend =
        "Tags too short for their words: a check came true or was reached, a cross failed, a letter begins "
        "the "
        "name of a command. The report names each.";
    for (const std::string& line : WrapText(kLegend, time_.right(), kTagFont, 3)) {
      svg_.Text(0, y_ + 14, line, {"d-3", kTagFont});
      y_ += 16;
    }
    y_ += 8;
  }

  void DrawSigns(const std::string& label, const std::vector<Sign>& signs, bool stars) {
    if (signs.empty()) return;
    std::vector<int> ends;
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < signs.size(); ++i) {
      const int x = time_.X(signs[i].at);
      const std::string text = FitText(signs[i].text, 190, 11);
      // A text that would leave the drawing stands left of its sign.
      const int width = TextWidth(text, 11);
      const bool left = x + 12 + width > time_.right() + 40;
      const int begin = left ? x - 12 - width : x - 6;
      const int end = left ? x + 8 : x + 20 + width;
      const auto row = std::find_if(ends.begin(), ends.end(), [begin](int used) { return used <= begin; });
      if (i >= kMaxMarks || (row == ends.end() && ends.size() == kMaxRows)) {
        ++left_out;
        continue;
      }
      const auto index = static_cast<std::size_t>(row - ends.begin());
      if (row == ends.end()) ends.push_back(0);
      ends[index] = end;
      const Point at{x, y_ + 14 + static_cast<int>(index) * kRowHeight};
      stars ? DrawStar(svg_, at, 6, "d-star") : DrawDot(svg_, at, 4, "d-mark");
      svg_.Text(left ? x - 10 : x + 10, at.y + 4, text,
                {"", 11, left ? TextAnchor::kEnd : TextAnchor::kStart});
    }
    if (left_out > 0) svg_.Text(0, y_ + 32, "+ " + std::to_string(left_out) + " more", {"d-3", 11});
    Label(label, std::max<std::size_t>(1, ends.size()));
  }

  Svg& svg_;
  const Run& run_;
  const EpisodeSummary& summary_;
  const TimeScale time_;
  int y_ = 0;
  bool too_short_ = false;  // some tag has no room for its words
};

}  // namespace

int DrawLanes(Svg& svg, const Run& run, const EpisodeSummary& summary, int width) {
  return Lanes(svg, run, summary, width).Draw();
}

}  // namespace aerascope
