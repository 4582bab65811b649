#include "viewer/draw/sheet.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/episode_summary.h"
#include "engine/query/model_history.h"
#include "viewer/draw/curves.h"
#include "viewer/draw/graph_drawing.h"
#include "viewer/draw/lanes.h"
#include "viewer/draw/marks.h"
#include "viewer/draw/still_drawing.h"
#include "viewer/draw/svg.h"
#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

constexpr int kMargin = 48;
constexpr int kRight = kSheetWidth - kMargin;
constexpr int kContentWidth = kSheetWidth - 2 * kMargin;
constexpr int kHeadHeight = 136;
constexpr std::size_t kCaptionLines = 4;
constexpr int kCaptionLineHeight = 19;
constexpr int kRowGap = 28;               // under the captions of a row of pictures
constexpr std::size_t kTextMoments = 12;  // told where no pictures are
constexpr int kGraphWidth = 860;
constexpr int kCurvesLeft = 968;
constexpr std::size_t kFramesInRow = 3;
constexpr int kGap = (kContentWidth - 3 * kSheetFrameWidth) / 2;  // between pictures
constexpr int kFullGraphHeight = 560;  // bands are opened as long as the graph stays below, in its own pixels
constexpr int kLongestGraph = 1500;    // bands beyond are counted, not drawn
constexpr std::size_t kRowsOnPaper = 10;
constexpr int kCurvePitch = 160;  // at least, from one curve to the next
constexpr int kSectionHead = 72;  // heading and time axis of a group of curves
constexpr int kNoteHeight = 24;
constexpr int kLeastCurves = 4;  // drawn even where the graph is shorter

std::string Plural(std::size_t count, const std::string& one, const std::string& many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

class Sheet {
 public:
  Sheet(const Run& run, const SheetFrames& frames, const SheetOptions& options)
      : run_(run), frames_(frames), options_(options), summary_(Summarise(run)) {}

  Result<std::string> Build() {
    DrawHead();
    y_ = kHeadHeight;
    if (frames_.frames.empty()) {
      DrawLanesInsteadOfFrames();
    } else if (const Status status = DrawFrames(); !status) {
      return status.error();
    }
    svg_.Line({kMargin, y_}, {kRight, y_}, "d-line");
    y_ += 40;
    const int top = y_;
    const int graph_end = DrawGraph(top);
    const int curves_end = DrawCurves(top, graph_end - top);
    y_ = std::max(graph_end, curves_end) + 28;
    DrawFoot();
    const Size size{kSheetWidth, y_ + 24};
    Svg page;
    page.Leaf("rect", {{"width", size.width}, {"height", size.height}, {"class", "d-page"}});
    page.Append(svg_);
    return SvgDocument(size, run_.title(), DrawingStyle(LightTheme()), page.content());
  }

 private:
  void Heading(int x, int y, const std::string& text) { svg_.Text(x, y, text, {"d-b", 18}); }

  void DrawHead() {
    constexpr int kProvenanceWidth = 480;
    constexpr int kTitleWidth = kContentWidth - kProvenanceWidth - 24;
    svg_.Text(kMargin, 70, FitText(run_.title(), kTitleWidth, 32, TextWeight::kBold), {"d-b", 32});
    int base_line = 106;
    for (const std::string& line : WrapText(Join(summary_.headline, "; "), kContentWidth, 19, 2)) {
      svg_.Text(kMargin, base_line, line, {"d-2", 19});
      base_line += 24;
    }
    const std::vector<std::string> provenance = Provenance();
    base_line = 50;
    for (const std::string& line : provenance) {
      svg_.Text(kRight, base_line, FitText(line, kProvenanceWidth, 13), {"d-3", 13, TextAnchor::kEnd});
      base_line += 19;
    }
  }

  std::vector<std::string> Provenance() const {
    std::string first = options_.file_name.empty() ? "" : options_.file_name + ", ";
    first += SecondsText(summary_.end) + " in " +
             Plural(static_cast<std::size_t>(summary_.frames), "frame", "frames") + ", " +
             Plural(static_cast<std::size_t>(summary_.events), "event", "events");
    std::string second;
    if (!run_.header().program_version.empty()) second = run_.header().program_version + ", ";
    if (!run_.started().world.empty()) second += run_.started().world + " world, ";
    second += "seed " + std::to_string(run_.started().seed);
    if (run_.stored_digest()) second += ", digest " + ToText(*run_.stored_digest()).substr(0, 8);
    return {first, second};
  }

  // -----------------------------------------------------------------------------------------------------------
  // frames

  Status DrawFrames() {
    std::vector<Time> times;
    const std::size_t count = std::min(frames_.frames.size(), kSheetFrames);
    for (std::size_t i = 0; i < count; ++i) times.push_back(frames_.frames[i].at);
    const KeyStory story = MomentsAt(run_, times);
    for (std::size_t i = 0; i < count; i += kFramesInRow) {
      int bottom = y_;
      for (std::size_t k = i; k < std::min(count, i + kFramesInRow); ++k) {
        const Rect place{kMargin + static_cast<int>(k - i) * (kSheetFrameWidth + kGap), y_, kSheetFrameWidth,
                         kSheetFrameHeight};
        auto end = DrawFrame(frames_.frames[k], story.moments[k], place);
        if (!end) return end.error();
        bottom = std::max(bottom, *end);
      }
      y_ = bottom + kRowGap;
    }
    NoteLeftOut(story.left_out);
    // Few pictures leave room for the course of things.
    if (count <= kFramesInRow) {
      y_ += 18;
      DrawLanesHere("");
    }
    return Ok();
  }

  // Returns where its caption ends.
  Result<int> DrawFrame(const SheetFrame& frame, const KeyMoment& moment, const Rect& place) {
    const std::string time = SecondsText(frame.at);
    const int indent = TextWidth(time, 15, TextWeight::kBold) + 10;
    const std::string caption = FitSentences(moment.sentences, place.width - indent, 14, kCaptionLines);
    if (Status drawn = DrawStill(svg_, frame, place, caption, LightTheme()); !drawn) return drawn.error();
    int base_line = place.bottom() + 23;
    svg_.Text(place.x, base_line, time, {"d-b", 15});
    for (const std::string& line : WrapText(caption, place.width - indent, 14, kCaptionLines)) {
      svg_.Text(place.x + indent, base_line, line, {"d-2", 14});
      base_line += kCaptionLineHeight;
    }
    return base_line - kCaptionLineHeight;
  }

  void NoteLeftOut(std::size_t moments) {
    if (moments == 0) return;
    svg_.Text(kMargin, y_,
              "Left out here: " + Plural(moments, "less telling moment", "less telling moments") +
                  "; the report has all.",
              {"d-3", 13});
    y_ += 28;
  }

  void DrawLanesInsteadOfFrames() {
    DrawLanesHere(frames_.note.empty() ? "No pictures were made for this sheet." : frames_.note);
    DrawSentences();
  }

  void DrawLanesHere(const std::string& note) {
    Heading(kMargin, y_ + 18, "What happened");
    svg_.Text(kRight, y_ + 18, FitText(note, 900, 13), {"d-3", 13, TextAnchor::kEnd});
    svg_.Open("g",
              {{"transform", "translate(" + std::to_string(kMargin) + " " + std::to_string(y_ + 40) + ")"}});
    const int height = DrawLanes(svg_, run_, summary_, kContentWidth);
    svg_.Close();
    y_ += 40 + height + 36;
  }

  // Where no picture tells the story, the captions do.
  void DrawSentences() {
    constexpr int kIndent = 70;
    const KeyStory story = KeyMomentsOf(run_, kTextMoments);
    for (const KeyMoment& moment : story.moments) {
      svg_.Text(kMargin, y_, SecondsText(moment.at), {"d-b", 15});
      const std::string text = FitSentences(moment.sentences, kContentWidth - kIndent, 14, 2);
      for (const std::string& line : WrapText(text, kContentWidth - kIndent, 14, 2)) {
        svg_.Text(kMargin + kIndent, y_, line, {"d-2", 14});
        y_ += kCaptionLineHeight;
      }
      y_ += 7;
    }
    NoteLeftOut(story.left_out);
    y_ += 10;
  }

  // ------------------------------------------------------------------------------------------------------------
  // graph

  int DrawGraph(int top) {
    Heading(kMargin, top,
            summary_.complete ? "What it knew at the end" : "What it knew when the record ends");
    TriadOptions options;
    options.max_rows = kRowsOnPaper;
    TriadLayout layout = LayOutKnowledge(run_, options);
    ModelGraphView view;
    view.at = kForever;
    const std::string left_out = LeaveOut(layout);
    if (layout.bands.empty()) {
      svg_.Text(kMargin, top + 34, "Nothing was known: no causal model was given or learned.", {"d-2", 14});
      return top + 60;
    }
    view.open_bands = BandsToOpen(layout);
    const double scale = static_cast<double>(kGraphWidth) / layout.width;
    const Size size = ModelGraphSize(layout, view);
    svg_.Open("g", {{"transform", "translate(" + std::to_string(kMargin - 8) + " " +
                                      std::to_string(top + 24) + ") scale(" + SvgNumber(scale) + ")"}});
    DrawModelGraph(svg_, run_, layout, view);
    svg_.Close();
    int end = top + 24 + static_cast<int>(size.height * scale);
    if (!left_out.empty()) {
      end += 26;
      svg_.Text(kMargin, end, FitText(left_out, kGraphWidth, 13), {"d-3", 13});
    }
    return end;
  }

  // Takes out what has no room on paper, and says so.
  static std::string LeaveOut(TriadLayout& layout) {
    std::size_t parts = 0;
    std::size_t drives = 0;
    std::erase_if(layout.bands, [&](const TriadBand& band) {
      if (band.kind == BandKind::kCausalModel) return false;
      (band.kind == BandKind::kDriveModels ? drives : parts) = band.rows + band.hidden_rows;
      return true;
    });
    std::size_t bands = 0;
    std::size_t rows = 0;
    while (layout.bands.size() > 1 && StackBands(layout, {}).height > kLongestGraph) {
      ++bands;
      rows += layout.bands.back().rows + layout.bands.back().hidden_rows;
      layout.bands.pop_back();
    }
    std::vector<std::string> sentences;
    if (bands > 0) {
      sentences.push_back("No room for " + Plural(bands, "more model", "more models") + " with " +
                          Plural(rows, "requirement", "requirements") + "; the report has all.");
    }
    if (parts > 0) {
      sentences.push_back("Not drawn: " + Plural(parts, "composite state", "composite states") +
                          " that no requirement asks for directly.");
    }
    if (drives > 0) {
      sentences.push_back((parts > 0 ? "Nor " : "Not drawn: ") +
                          Plural(drives, "drive model", "drive models") + ".");
    }
    return Join(sentences, " ");
  }

  // The band of the first analogy in time, then others as long as the page stays short.
  std::set<std::size_t> BandsToOpen(const TriadLayout& layout) const {
    std::vector<std::pair<CompositeStateId, std::size_t>>
        order;  // by the first state that was derived in the band
    for (std::size_t i = 0; i < layout.bands.size(); ++i) {
      CompositeStateId first{std::numeric_limits<std::int64_t>::max()};
      for (const Edge& edge : layout.bands[i].edges) {
        const CompositeStateId state = layout.bands[i].cards[edge.to].state;
        if (edge.kind == EdgeKind::kDerived && state.valid()) first = std::min(first, state);
      }
      order.emplace_back(first, i);
    }
    std::sort(order.begin(), order.end());
    std::set<std::size_t> open;
    for (const auto& [derived, band] : order) {
      open.insert(band);
      const bool first = open.size() == 1 && layout.bands[band].open.height < kLongestGraph / 2;
      if (!first && StackBands(layout, open).height > kFullGraphHeight) open.erase(band);
    }
    return open;
  }

  // -----------------------------------------------------------------------------------------------------------
  // curves

  struct CurveSection {
    std::string heading;
    std::vector<ModelHistory> histories;
    std::size_t left_out = 0;
  };

  // What was made by analogy; then what was learned otherwise and became more or less sure, as far as there
  // is room beside the graph. Where nothing was learned: whatever was put to the test.
  std::vector<CurveSection> Sections(int height) const {
    CurveSection analogies{"How sure it was of what it made by analogy", {}, 0};
    CurveSection lessons{"How sure it was of what it learned", {}, 0};
    CurveSection given{"How sure it was", {}, 0};
    const std::set<ModelId> learned(summary_.learned.begin(), summary_.learned.end());
    const std::set<ModelId> by_analogy(summary_.by_analogy.begin(), summary_.by_analogy.end());
    for (ModelHistory& history : Histories(run_)) {
      const bool tested = history.steps.size() > 1;
      if (by_analogy.contains(history.model)) {
        analogies.histories.push_back(std::move(history));
      } else if (learned.contains(history.model) && (Moved(history) || by_analogy.empty())) {
        lessons.histories.push_back(std::move(history));
      } else if (learned.empty() && tested) {
        given.histories.push_back(std::move(history));
      }
    }
    std::vector<CurveSection> sections;
    int room = std::max(kLeastCurves * kCurvePitch, height);
    for (CurveSection* section : {&analogies, &lessons, &given}) {
      const int most = (room - kSectionHead) / kCurvePitch;
      if (section->histories.empty() || most < 1) continue;
      KeepMostTested(*section, static_cast<std::size_t>(most));
      room -= kSectionHead + static_cast<int>(section->histories.size()) * kCurvePitch;
      sections.push_back(std::move(*section));
    }
    return sections;
  }

  static bool Moved(const ModelHistory& history) {
    return std::any_of(history.steps.begin(), history.steps.end(), [&](const ConfidenceStep& step) {
      return step.evidence.rate() != history.steps.front().evidence.rate() ||
             step.state != ModelState::kActive;
    });
  }

  // Those with the most outcomes, in their old order.
  static void KeepMostTested(CurveSection& section, std::size_t most) {
    if (section.histories.size() <= most) return;
    section.left_out = section.histories.size() - most;
    std::vector<std::size_t> order(section.histories.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return section.histories[a].steps.size() > section.histories[b].steps.size();
    });
    order.resize(most);
    std::sort(order.begin(), order.end());
    std::vector<ModelHistory> kept;
    for (const std::size_t i : order) kept.push_back(std::move(section.histories[i]));
    section.histories = std::move(kept);
  }

  int DrawCurves(int top, int height) {
    const std::vector<CurveSection> sections = Sections(height);
    if (sections.empty()) {
      Heading(kCurvesLeft, top, "How sure it was");
      svg_.Text(kCurvesLeft, top + 34, "No model was learned, and none was put to the test.", {"d-2", 14});
      return top + 60;
    }
    std::size_t curves = 0;
    int heads = 0;
    for (const CurveSection& section : sections) {
      curves += section.histories.size();
      heads += kSectionHead + (section.left_out > 0 ? kNoteHeight : 0);
    }
    const int pitch = std::clamp((height - heads) / static_cast<int>(curves), kCurvePitch, 196);
    int y = top;
    for (const CurveSection& section : sections) y = DrawCurveSection(section, y, pitch);
    return y - kSectionHead / 2;
  }

  int DrawCurveSection(const CurveSection& section, int y, int pitch) {
    const Time from = run_.frames().empty() ? Time{0} : run_.frames().front().interval.after;
    const CurveScale scale{TimeScale(from, summary_.end, kCurvesLeft + 44, kRight - 62),
                           LowestQuarter(section.histories)};
    Heading(kCurvesLeft, y, section.heading);
    y += 40;
    for (const ModelHistory& history : section.histories) {
      DrawCurveHead(history.model, y);
      DrawConfidenceCurve(svg_, run_, history, {kCurvesLeft, y + 46, kRight - kCurvesLeft, pitch - 90},
                          scale);
      y += pitch;
    }
    DrawTimeAxis(svg_, scale.time, y - 12);
    if (section.left_out > 0) {
      svg_.Text(
          kCurvesLeft, y + 10,
          "Not drawn: " + Plural(section.left_out, "more model", "more models") + "; the report has all.",
          {"d-3", 13});
      y += kNoteHeight;
    }
    return y + kSectionHead - 40;
  }

  void DrawCurveHead(ModelId id, int y) {
    const ModelRecord* record = run_.final_knowledge().Find(id);
    const bool analogy = record != nullptr && record->origin == Origin::kAnalogy;
    const Point sign{kCurvesLeft + 7, y - 5};
    analogy ? DrawStar(svg_, sign, 7, "d-star") : DrawDot(svg_, sign, 5, "d-mark");
    std::string ids = IdText(id);
    if (record != nullptr && record->derived_from.valid()) ids += " from " + IdText(record->derived_from);
    const int ids_width = TextWidth(ids, 12, TextWeight::kMono) + 16;
    svg_.Text(kCurvesLeft + 22, y,
              FitText(TitleOf(run_.final_knowledge(), id), kRight - kCurvesLeft - 22 - ids_width, 16,
                      TextWeight::kBold),
              {"d-b", 16});
    svg_.Text(kRight, y, ids, {"d-id", 12, TextAnchor::kEnd});
  }

  void DrawFoot() {
    std::vector<std::string> signs;
    if (!summary_.by_analogy.empty()) signs.push_back("Star: made by analogy. Struck: condition pruned.");
    signs.push_back("Ring: confidence. Red and green: the two sides of a model.");
    svg_.Text(kMargin, y_, Join(signs, " "), {"d-3", 13});
    svg_.Text(kRight, y_, "aerascope", {"d-3", 13, TextAnchor::kEnd});
  }

  const Run& run_;
  const SheetFrames& frames_;
  const SheetOptions& options_;
  const EpisodeSummary summary_;
  Svg svg_;
  int y_ = 0;
};

}  // namespace

Result<std::string> BuildSheetSvg(const Run& run, const SheetFrames& frames, const SheetOptions& options) {
  return Sheet(run, frames, options).Build();
}

}  // namespace aerascope
