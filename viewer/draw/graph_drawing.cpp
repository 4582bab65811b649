#include "viewer/draw/graph_drawing.h"

#include <algorithm>

#include "engine/query/describe.h"
#include "engine/query/model_history.h"
#include "engine/query/story.h"
#include "viewer/draw/marks.h"
#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

constexpr int kPadding = 12;  // between the outline of a card and its text
constexpr int kRadius = 6;

Rect Moved(const Rect& rect, int dy) {
  return {rect.x, rect.y + dy, rect.width, rect.height};
}
Point Moved(Point point, int dy) {
  return {point.x, point.y + dy};
}

std::string PathData(const EdgePath& path, int dy) {
  std::string data;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    const Point point = Moved(path.points[i], dy);
    data += i == 0 ? "M" : path.cubic ? (i == 1 ? "C" : " ") : "L";
    data += std::to_string(point.x) + " " + std::to_string(point.y);
  }
  return data;
}

std::string OriginText(Origin origin, Time created) {
  const std::string at = " at " + SecondsText(created);
  switch (origin) {
    case Origin::kSeed:
      return "given";
    case Origin::kInduction:
      return "learned" + at;
    case Origin::kPredictionFailure:
      return "learned from failure" + at;
    case Origin::kGoalSuccess:
      return "learned from success" + at;
    case Origin::kAnalogy:
      return "made" + at;
  }
  return "";
}

class Drawer {
 public:
  Drawer(Svg& svg, const Run& run, const TriadLayout& layout, const ModelGraphView& view)
      : svg_(svg),
        run_(run),
        final_(run.final_knowledge()),
        now_(run.KnowledgeBaseAt(view.at)),
        layout_(layout),
        view_(view) {
    for (const EventId id : run.OfKind<AnalogyCompared>()) {
      const auto* compared = run.FindBody<AnalogyCompared>(id);
      if (compared->verdict == AnalogyVerdict::kAccepted)
        analogies_.emplace(compared->result_state, compared);
    }
  }

  void Draw() {
    ColumnHeads();
    const StackedBands stacked = StackBands(layout_, view_.open_bands);
    for (std::size_t i = 0; i < layout_.bands.size(); ++i) {
      DrawBand(layout_.bands[i], view_.open_bands.contains(i), stacked.tops[i] + kColumnHeadHeight);
    }
  }

 private:
  void ColumnHeads() {
    const bool triads = std::any_of(layout_.bands.begin(), layout_.bands.end(), [](const TriadBand& band) {
      return band.kind == BandKind::kCausalModel;
    });
    if (!triads) return;
    svg_.Text(layout_.states.x, 12, "when this holds (CST)", {"d-3", 11});
    svg_.Text(layout_.requirements.centre().x, 12, "how sure (M_req)", {"d-3", 11, TextAnchor::kMiddle});
    svg_.Text(layout_.models.x, 12, "doing this brings that (CM)", {"d-3", 11});
  }

  void DrawBand(const TriadBand& band, bool open, int top) {
    const BandForm& form = open ? band.open : band.folded;
    svg_.Open("g", {{"data-model", band.model.valid() ? IdText(band.model) : std::string("none")}});
    if (const std::string_view title = BandTitle(band.kind); !title.empty()) {
      svg_.Text(band.kind == BandKind::kDriveModels ? layout_.models.x : layout_.states.x, top + 13, title,
                {"d-3"});
    }
    for (std::size_t i = 0; i < band.edges.size(); ++i) DrawEdge(band, form, i, open, top);
    for (std::size_t i = 0; i < band.cards.size(); ++i)
      DrawCard(band.cards[i], Moved(form.cards[i], top), open);
    if (band.hidden_rows > 0) {
      svg_.Text(layout_.states.x, form.height + top - 6,
                "+ " + std::to_string(band.hidden_rows) + " more, not shown here", {"d-3"});
    }
    svg_.Close();
  }

  bool Known(const Card& card) const {
    switch (card.kind) {
      case CardKind::kState:
      case CardKind::kStateAgain:
        return now_.Find(card.state) != nullptr;
      case CardKind::kCondition:
      case CardKind::kRequirement:
      case CardKind::kModel:
        return now_.Find(card.model) != nullptr;
      case CardKind::kUnknownModel:
        return true;
    }
    return false;
  }

  // ------------------------------------------------------------------------------------------------------------
  // edges

  void DrawEdge(const TriadBand& band, const BandForm& form, std::size_t index, bool open, int top) {
    const Edge& edge = band.edges[index];
    if (!Known(band.cards[edge.from]) || !Known(band.cards[edge.to])) return;
    const EdgePath& path = form.edges[index];
    if (edge.kind == EdgeKind::kDerived) return DrawDerivation(band, form, index, open, top);
    const ModelId by = edge.kind == EdgeKind::kEnables ? band.cards[edge.from].model : ModelId{};
    const bool veto = IsVeto(run_, by);
    std::string classes = veto ? "d-link d-veto" : "d-link";
    if (const ModelRecord* record = now_.Find(by); record != nullptr && record->state == ModelState::kDeleted)
      classes += " d-gone";
    svg_.Path(PathData(path, top), classes);
    if (edge.kind != EdgeKind::kEnables) return;
    const Point tip = Moved(path.points.back(), top);
    // What allows ends in an arrow, what forbids in a bar.
    if (veto) {
      DrawStop(svg_, tip);
    } else if (band.cards[edge.to].kind != CardKind::kRequirement) {
      DrawArrowHead(svg_, tip);
    }
  }

  void DrawDerivation(const TriadBand& band, const BandForm& form, std::size_t index, bool open, int top) {
    const EdgePath& path = form.edges[index];
    svg_.Path(PathData(path, top), "d-derived");
    const Point tip = Moved(path.points.back(), top);
    svg_.Path("M" + std::to_string(tip.x - 5) + " " + std::to_string(tip.y - 4) + "l5 4l-5 4",
              "d-derived-tip");
    if (!open) return;
    DrawStar(svg_, Moved(path.mark, top), 7, "d-star");
    const Rect note = Moved(form.notes[index], top);
    svg_.Text(note.x, note.y + 17,
              FitText(AnalogyText(band.cards[band.edges[index].to].state), note.width + 60, 12), {"d-3"});
  }

  std::string AnalogyText(CompositeStateId result) const {
    const auto found = analogies_.find(result);
    if (found == analogies_.end()) return "by analogy";
    const AnalogyCompared& compared = *found->second;
    std::string text = "by analogy: " + std::to_string(compared.matched + compared.achievable) + " of " +
                       std::to_string(compared.total) + " conditions hold" +
                       (compared.achievable > 0 ? " or can be met" : "");
    for (const ComparedComponent& component : compared.components) {
      if (component.status != ComponentStatus::kMissed) continue;
      // What a condition is about comes first in it, in a value as in an instance.
      std::string about;
      ForEachTerm(component.pattern, [&about](const Term& term) {
        if (about.empty() && term.is(TermKind::kEntity)) about = term.name();
      });
      if (!about.empty()) return text + " for " + about;
    }
    return text;
  }

  // ------------------------------------------------------------------------------------------------------------
  // cards

  void DrawCard(const Card& card, const Rect& rect, bool open) {
    const bool state = card.state.valid();
    svg_.Open("g", {{"data-id", state ? IdText(card.state) : IdText(card.model)}});
    if (!Known(card)) {
      DrawSlot(card, rect);
    } else {
      switch (card.kind) {
        case CardKind::kState:
          open ? DrawOpenState(card, rect) : DrawFoldedState(card.state, rect, true);
          break;
        case CardKind::kStateAgain:
          DrawFoldedState(card.state, rect, false);
          break;
        case CardKind::kCondition:
          DrawCondition(card.model, rect);
          break;
        case CardKind::kRequirement:
          DrawRequirement(card.model, rect, open);
          break;
        case CardKind::kModel:
          DrawModel(card.model, rect, open);
          break;
        case CardKind::kUnknownModel:
          svg_.Box(rect, "d-slot", kRadius);
          svg_.Text(rect.x + kPadding, rect.centre().y + 4, IdText(card.model) + ", not in the episode",
                    {"d-3", 11});
          break;
      }
    }
    svg_.Close();
  }

  // The place of what is not known yet.
  void DrawSlot(const Card& card, const Rect& rect) {
    if (card.kind == CardKind::kRequirement) return;
    svg_.Box(rect, "d-slot", kRadius);
    std::string text = "not known yet";
    if (const auto* state = card.state.valid() ? final_.Find(card.state) : nullptr) {
      text = OriginText(state->origin, state->created);
    } else if (const auto* model = card.model.valid() ? final_.Find(card.model) : nullptr) {
      text = OriginText(model->origin, model->created);
    }
    svg_.Text(rect.x + kPadding, rect.centre().y + 4, text, {"d-3", 11});
  }

  std::string OutlineOf(bool chosen) const { return chosen ? "d-card d-chosen" : "d-card"; }

  bool IsChosenState(CompositeStateId state) const {
    const ModelRecord* chosen = view_.chosen.valid() ? final_.Find(view_.chosen) : nullptr;
    return chosen != nullptr && RequiredState(chosen->model) == state;
  }

  void IdAtRight(const Rect& rect, int base_line, const std::string& id) {
    svg_.Text(rect.right() - kPadding, base_line, id, {"d-id", 11, TextAnchor::kEnd});
  }
  static int IdWidth(const std::string& id) { return TextWidth(id, 11, TextWeight::kMono) + kPadding; }

  void DrawFoldedState(CompositeStateId id, const Rect& rect, bool first) {
    svg_.Box(rect, OutlineOf(IsChosenState(id)), kRadius);
    const CompositeStateRecord* record = final_.Find(id);
    int x = rect.x + kPadding;
    const int base_line = rect.centre().y + 4;
    // How it was made, and what was pruned for it, is told where it stands first.
    if (first && record->origin == Origin::kAnalogy) {
      DrawStar(svg_, {x + 6, rect.centre().y}, 6, "d-star");
      x += 18;
    }
    const std::string label = first ? IdText(id) : IdText(id) + " above";
    IdAtRight(rect, base_line, label);
    std::vector<Word> words = BriefWords(id);
    if (!first) std::erase_if(words, [](const Word& word) { return word.pruned; });
    DrawWords(words, x, base_line, rect.right() - kPadding - IdWidth(label) - x);
  }

  // A word or two of a folded card, perhaps struck.
  struct Word {
    std::string text;
    bool pruned = false;
    std::vector<std::string> variables;
  };

  std::vector<Word> BriefWords(CompositeStateId id) const {
    std::vector<Word> words;
    const std::vector<Condition> conditions = ConditionsWithPruned(final_, id);
    for (const Condition& condition : conditions) {
      if (!condition.brief.empty()) words.push_back({condition.brief, condition.pruned, condition.variables});
    }
    if (words.empty()) {
      for (const Condition& condition : conditions) {
        words.push_back({condition.text, condition.pruned, condition.variables});
      }
    }
    return words;
  }

  // Words with dots between, as many as there is room for; those without are counted.
  void DrawWords(const std::vector<Word>& words, int x, int base_line, int width) {
    constexpr double kSize = 12;
    const int end = x + width;
    const std::string dot = " · ";
    const auto rest = [&](std::size_t count) { return dot + "+" + std::to_string(count); };
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::size_t more = words.size() - i - 1;
      const int room = end - x - (more == 0 ? 0 : TextWidth(rest(more), kSize));
      if (i > 0) {
        if (room < TextWidth(dot, kSize) + TextWidth(words[i].text, kSize)) {
          svg_.Text(x, base_line, rest(more + 1), {"d-3"});
          return;
        }
        svg_.Text(x, base_line, dot, {"d-3"});
        x += TextWidth(dot, kSize);
      }
      const std::string fit = i > 0 ? words[i].text : FitText(words[i].text, room, kSize);
      const int used = TextWidth(fit, kSize);
      const std::string classes = words[i].pruned ? "d-3" : "";
      svg_.Text(x, base_line, WithVariables(fit, words[i].variables, classes), {});
      if (words[i].pruned) svg_.Line({x - 2, base_line - 4}, {x + used + 2, base_line - 4}, "d-cut");
      x += used;
    }
  }

  void DrawOpenState(const Card& card, const Rect& rect) {
    svg_.Box(rect, OutlineOf(IsChosenState(card.state)), kRadius);
    const CompositeStateRecord* record = final_.Find(card.state);
    svg_.Text(rect.x + kPadding, rect.y + 19, IdText(card.state), {"d-id"});
    svg_.Text(rect.right() - kPadding, rect.y + 19, OriginText(record->origin, record->created),
              {"d-3", 11, TextAnchor::kEnd});
    svg_.Line({rect.x + kPadding, rect.y + kCardHeadHeight},
              {rect.right() - kPadding, rect.y + kCardHeadHeight}, "d-line");
    const std::vector<Condition> conditions = ConditionsWithPruned(final_, card.state);
    const auto room = static_cast<std::size_t>(card.lines);
    const Columns columns = ColumnsFor(conditions, rect);
    int base_line = rect.y + kCardHeadHeight + 18;
    for (std::size_t i = 0; i < conditions.size() && i < room; ++i, base_line += kCardLineHeight) {
      if (i + 1 == room && conditions.size() > room) {
        svg_.Text(columns.subject, base_line,
                  "+ " + std::to_string(conditions.size() - i) + " more conditions", {"d-3"});
        break;
      }
      DrawConditionLine(conditions[i], columns, base_line);
    }
  }

  // Where the three parts of a condition begin, and where the last one ends.
  struct Columns {
    int subject = 0;
    int relation = 0;
    int value = 0;
    int end = 0;
  };
  static Columns ColumnsFor(const std::vector<Condition>& conditions, const Rect& rect) {
    int subject = 0;
    int relation = 0;
    for (const Condition& condition : conditions) {
      subject = std::max(subject, TextWidth(condition.subject, 12));
      relation = std::max(relation, TextWidth(condition.relation, 12));
    }
    Columns columns;
    columns.subject = rect.x + kPadding;
    columns.relation = columns.subject + std::clamp(subject, 16, rect.width / 4) + 8;
    columns.value = columns.relation + std::clamp(relation, 24, rect.width * 2 / 5) + 10;
    columns.end = rect.right() - kPadding;
    return columns;
  }

  void DrawConditionLine(const Condition& condition, const Columns& columns, int base_line) {
    const std::string classes = condition.pruned ? "d-3" : "";
    const auto part = [&](const std::string& text, int x, int end) {
      const std::string fit = FitText(text, end - x, 12);
      svg_.Text(x, base_line, WithVariables(fit, condition.variables, classes), {});
      return x + TextWidth(fit, 12);
    };
    part(condition.subject, columns.subject, columns.relation - 4);
    const int pruned_width = condition.pruned ? TextWidth("pruned", 11) + 8 : 0;
    int value_x = columns.relation;
    if (!condition.relation.empty()) {
      part(condition.relation, columns.relation, columns.value - 4);
      value_x = columns.value;
    }
    const int end = part(condition.value, value_x, columns.end - pruned_width);
    if (!condition.pruned) return;
    svg_.Line({columns.subject - 2, base_line - 4}, {end + 2, base_line - 4}, "d-cut");
    svg_.Text(columns.end, base_line, "pruned", {"d-3", 11, TextAnchor::kEnd});
  }

  void DrawCondition(ModelId requirement, const Rect& rect) {
    svg_.Box(rect, "d-card", kRadius);
    const ModelLines lines = LinesOf(final_, final_.Find(requirement)->model);
    svg_.Text(rect.x + kPadding, rect.centre().y + 4,
              WithVariables(FitText(lines.lhs, rect.width - 2 * kPadding, 12), lines.variables), {});
  }

  void DrawRequirement(ModelId id, const Rect& square, bool open) {
    const ModelRecord* record = now_.Find(id);
    const bool veto = IsVeto(run_, id);
    DrawRing(svg_, square, record->evidence.rate(), veto);
    const Point centre = square.centre();
    // What is said of a ring stands at its own height, where no word over or under it could be that of the
    // next one: over the link that leads to it its number, under the link what has become of it, or what it
    // forbids.
    if (open) {
      svg_.Text(centre.x, square.bottom() + 14, IdText(id), {"d-id", 11, TextAnchor::kMiddle});
    } else {
      WriteBeside(square, centre.y - 4, IdText(id), "d-id", TextWeight::kMono);
    }
    if (record->state == ModelState::kActive) {
      if (veto) WriteBeside(square, centre.y + 13, "never", "d-b d-fail", TextWeight::kBold);
      return;
    }
    DrawCross(svg_, {square.right() - 2, square.y + 2}, 4);
    WriteBeside(square, centre.y + 13, record->state == ModelState::kDeleted ? "given up" : "phased out",
                "d-fail", TextWeight::kRegular);
  }

  // Left of a ring, as large as there is room.
  void WriteBeside(const Rect& ring, int base_line, const std::string& text, const std::string& classes,
                   TextWeight weight) {
    const int end = ring.x - 6;
    const int room = end - layout_.requirements.x - 2;
    double size = 10;
    while (size > 8 && TextWidth(text, size, weight) > room) size -= 1;
    svg_.Text(end, base_line, text, {classes, size, TextAnchor::kEnd});
  }

  void DrawModel(ModelId id, const Rect& rect, bool open) {
    const ModelRecord& record = *now_.Find(id);
    const ModelLines lines = LinesOf(final_, record.model);
    const int head = open ? kCardHeadHeight : 0;
    const int side = (rect.height - head) / 2;
    svg_.Box(rect, "d-card", kRadius);
    DrawRoundedBand(svg_, {rect.x, rect.y + head, rect.width, side}, open ? 0 : kRadius, 0, "d-lhs");
    DrawRoundedBand(svg_, {rect.x, rect.y + head + side, rect.width, rect.height - head - side}, 0, kRadius,
                    "d-rhs");
    const bool chosen = id == view_.chosen;
    svg_.Box(rect,
             chosen                                ? "d-frame d-chosen"
             : record.state == ModelState::kActive ? "d-frame"
                                                   : "d-frame d-gone",
             kRadius);
    const int left = rect.y + head + side / 2 + 4;
    const int right = left + side;
    const int room = rect.width - 2 * kPadding;
    const bool command = record.model.lhs.payload.IsStruct("cmd");
    const std::string id_text = IdText(id);
    const std::string if_done = open ? (command ? "if done" : "if so") : "";
    const std::string then = open ? "then" : "";
    if (open) {
      svg_.Text(rect.x + kPadding, rect.y + 19, id_text, {"d-id"});
      svg_.Text(rect.right() - kPadding, rect.y + 19, HeadNote(id, record), {"d-3", 11, TextAnchor::kEnd});
    } else {
      IdAtRight(rect, left, id_text);
    }
    const int left_note = open ? TextWidth(if_done, 11) + 8 : IdWidth(id_text);
    svg_.Text(rect.x + kPadding, left,
              WithVariables(FitText(lines.lhs, room - left_note, 12), lines.variables), {});
    svg_.Text(
        rect.x + kPadding, right,
        WithVariables(FitText(lines.rhs, room - (open ? TextWidth(then, 11) + 8 : 0), 12), lines.variables),
        {});
    if (!open) return;
    svg_.Text(rect.right() - kPadding, left, if_done, {"d-3", 11, TextAnchor::kEnd});
    svg_.Text(rect.right() - kPadding, right, then, {"d-3", 11, TextAnchor::kEnd});
  }

  std::string HeadNote(ModelId id, const ModelRecord& record) const {
    if (record.state == ModelState::kDeleted) return "given up";
    const ModelUse use = UseOf(run_, id, view_.at);
    if (use.came_true + use.failed == 0) return OriginText(record.origin, record.created);
    return "came true " + std::to_string(use.came_true) + " of " + std::to_string(use.came_true + use.failed);
  }

  Svg& svg_;
  const Run& run_;
  const KnowledgeBase& final_;
  const KnowledgeBase now_;
  const TriadLayout& layout_;
  const ModelGraphView& view_;
  std::map<CompositeStateId, const AnalogyCompared*> analogies_;  // by what they made
};

}  // namespace

std::map<CompositeStateId, int> LineCounts(const KnowledgeBase& final_knowledge) {
  std::map<CompositeStateId, int> counts;
  for (const auto& [id, record] : final_knowledge.composite_states()) {
    counts[id] =
        static_cast<int>(std::min<std::size_t>(ConditionsWithPruned(final_knowledge, id).size(), 1000));
  }
  return counts;
}

TriadLayout LayOutKnowledge(const Run& run, TriadOptions options) {
  if (options.lines.empty()) options.lines = LineCounts(run.final_knowledge());
  return LayOutTriads(run.final_knowledge(), options);
}

Size ModelGraphSize(const TriadLayout& layout, const ModelGraphView& view) {
  return {layout.width, kColumnHeadHeight + StackBands(layout, view.open_bands).height + 1};
}

void DrawModelGraph(Svg& svg, const Run& run, const TriadLayout& layout, const ModelGraphView& view) {
  Drawer(svg, run, layout, view).Draw();
}

std::string ModelGraphSvg(const Run& run, const TriadLayout& layout, const ModelGraphView& view,
                          const Theme& theme) {
  const Size size = ModelGraphSize(layout, view);
  Svg svg;
  svg.Leaf("rect", {{"width", size.width}, {"height", size.height}, {"class", "d-page"}});
  DrawModelGraph(svg, run, layout, view);
  return SvgDocument(size, "What was known at " + SecondsText(view.at), DrawingStyle(theme), svg.content());
}

}  // namespace aerascope
