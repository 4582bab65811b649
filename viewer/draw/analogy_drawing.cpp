#include "viewer/draw/analogy_drawing.h"

#include <algorithm>
#include <vector>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "viewer/draw/marks.h"
#include "viewer/draw/svg.h"
#include "viewer/draw/text_fit.h"

namespace aerascope {
namespace {

constexpr int kMargin = 32;
constexpr int kCardWidth = 326;
constexpr int kFoundWidth = 300;
constexpr int kGap = 44;  // between cards and what was found, for the links
constexpr int kWidth = 2 * kMargin + 2 * kCardWidth + kFoundWidth + 2 * kGap;
constexpr int kLeft = kMargin;
constexpr int kMiddle = kLeft + kCardWidth + kGap;
constexpr int kRight = kMiddle + kFoundWidth + kGap;
constexpr int kCardTop = 132;
constexpr int kHead = 40;       // the heading of a card
constexpr int kRowHeight = 46;  // of a component
constexpr int kPadding = 14;
constexpr int kRadius = 6;
constexpr int kRing = 44;
constexpr std::size_t kMostRows = 60;

// One line of the comparison: a condition and what the situation had for it.
struct Row {
  Condition left;
  Condition right;
  ComponentStatus status = ComponentStatus::kMatched;
  std::string found;  // what the situation had there
  std::string note;   // which fact, or that there was none
};

std::string Joined(const std::vector<std::string>& words) {
  return Join(words, ", ");
}

std::vector<Row> RowsOf(const Run& run, const AnalogyCompared& compared) {
  const KnowledgeBase& knowledge = run.final_knowledge();
  const CompositeStateRecord* source = knowledge.Find(compared.source);
  if (source == nullptr) return {};
  const std::vector<Condition> left = ConditionsOf(knowledge, source->state);
  std::vector<Condition> right;
  if (compared.result_state.valid()) right = ConditionsWithPruned(knowledge, compared.result_state);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < left.size(); ++i) {
    Row row;
    row.left = left[i];
    std::vector<std::string> found, facts;
    for (const ComparedComponent& component : compared.components) {
      const auto index = static_cast<std::size_t>(component.index);
      if (std::find(left[i].components.begin(), left[i].components.end(), index) == left[i].components.end())
        continue;
      row.status = std::max(row.status, component.status);
      if (!component.counterpart.is(TermKind::kNil))
        found.push_back(PayloadText(knowledge, component.counterpart));
      if (component.found.valid()) facts.push_back(IdText(component.found));
    }
    // A result that was known already may have been derived from another state: its lines are then not these.
    row.right = right.size() == left.size() ? right[i] : left[i];
    row.right.pruned = row.status == ComponentStatus::kMissed;
    row.found = found.empty() ? "nothing" : Joined(found);
    switch (row.status) {
      case ComponentStatus::kMatched:
        row.note = facts.empty() ? "matched" : "matched by " + Joined(facts);
        break;
      case ComponentStatus::kAchievable:
        row.note = "not so yet, but can be brought about";
        break;
      case ComponentStatus::kMissed:
        row.note = found.empty() ? "missed: nothing of the kind is known" : "missed: this holds instead";
        break;
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

class Figure {
 public:
  Figure(const Run& run, const Event& event, const Theme& theme)
      : run_(run),
        knowledge_(run.final_knowledge()),
        event_(event),
        compared_(std::get<AnalogyCompared>(event.body)),
        theme_(theme),
        rows_(RowsOf(run, compared_)) {
    shown_ = std::min(rows_.size(), kMostRows);
    accepted_ = compared_.verdict == AnalogyVerdict::kAccepted;
  }

  std::string Build() {
    card_height_ = kHead + static_cast<int>(std::max<std::size_t>(shown_, 1)) * kRowHeight +
                   (shown_ < rows_.size() ? 22 : 6);
    Heading();
    ColumnHeads();
    StateCard(kLeft, compared_.source, false);
    if (accepted_) {
      StateCard(kRight, compared_.result_state, true);
    } else {
      EmptyCard();
    }
    for (std::size_t i = 0; i < shown_; ++i)
      DrawRow(rows_[i], kCardTop + kHead + static_cast<int>(i) * kRowHeight);
    const int end = Conclusion(kCardTop + card_height_ + 40);
    const Size size{kWidth, end + 24};
    Svg page;
    page.Leaf("rect", {{"width", size.width}, {"height", size.height}, {"class", "d-page"}});
    page.Append(svg_);
    return SvgDocument(size, Title(), DrawingStyle(theme_) + ".d-psi{font-size:22px}", page.content());
  }

 private:
  std::string Title() const {
    const std::string source = TitleOf(knowledge_, compared_.requirement);
    if (!accepted_) return "No analogy with “" + source + "”";
    return "“" + TitleOf(knowledge_, compared_.result_requirement) + "”, by analogy with “" + source + "”";
  }

  void Heading() {
    svg_.Text(kMargin, 40, FitText(Title(), kWidth - 2 * kMargin, 18, TextWeight::kBold), {"d-b", 18});
    std::string why = "At " + SecondsText(event_.time);
    if (const Fact* wanted = Wanted()) why += ", because it wanted " + FactText(knowledge_, *wanted);
    why += ": what it knew, condition by condition, beside what there was.";
    svg_.Text(kMargin, 64, FitText(why, kWidth - 2 * kMargin, 13), {"d-2", 13});
    svg_.Line({kMargin, 82}, {kWidth - kMargin, 82}, "d-line");
  }

  // What the comparison's goal is for: the nearest goal above it that speaks of the world, not of conditions.
  const Fact* Wanted() const {
    const Fact* wanted = nullptr;
    GoalId goal = compared_.goal;
    for (int depth = 0; depth < 100 && goal.valid(); ++depth) {
      const EventId set = run_.CreationOf(goal);
      if (const auto* drive = run_.FindBody<DriveInjected>(set)) return &drive->target;
      const auto* sub_goal = run_.FindBody<GoalSet>(set);
      if (sub_goal == nullptr) break;
      wanted = &sub_goal->target;
      if (IsValue(wanted->payload)) break;
      goal = sub_goal->super_goal;
    }
    return wanted;
  }

  void ColumnHeads() {
    const ModelRecord* source = knowledge_.Find(compared_.requirement);
    const int base_line = kCardTop - 12;
    const auto origin = [](const ModelRecord* record) {
      if (record == nullptr) return std::string("not in the episode");
      const std::string at = " at " + SecondsText(record->created);
      return record->origin == Origin::kSeed      ? std::string("given")
             : record->origin == Origin::kAnalogy ? "made by analogy" + at
                                                  : "learned" + at;
    };
    svg_.Text(kLeft, base_line, "What it knew", {"d-b", 13});
    svg_.Text(kLeft + kCardWidth, base_line, origin(source), {"d-3", 11, TextAnchor::kEnd});
    svg_.Text(kMiddle, base_line, "What there was", {"d-b", 13});
    const std::string bindings = BindingsText(BindingsOf(knowledge_, compared_.bindings));
    svg_.Text(kMiddle + kFoundWidth, base_line, FitText(bindings, kFoundWidth - 120, 11),
              {"d-3", 11, TextAnchor::kEnd});
    svg_.Text(kRight, base_line, accepted_ ? "What it made of it" : "Nothing was made of it", {"d-b", 13});
    if (!accepted_) return;
    const ModelRecord* result = knowledge_.Find(compared_.result_requirement);
    const bool known = result != nullptr && result->created < event_.time;
    svg_.Text(kRight + kCardWidth, base_line, known ? "known already" : origin(result),
              {"d-3", 11, TextAnchor::kEnd});
  }

  void StateCard(int x, CompositeStateId id, bool result) {
    svg_.Open("g", {{"data-id", IdText(id)}});
    svg_.Box({x, kCardTop, kCardWidth, card_height_}, result ? "d-card d-chosen" : "d-card", kRadius);
    int text_x = x + kPadding;
    if (result) {
      DrawStar(svg_, {x + kPadding + 6, kCardTop + 20}, 7, "d-star");
      text_x += 22;
    }
    svg_.Text(text_x, kCardTop + 25, IdText(id), {"d-id", 12});
    svg_.Text(x + kCardWidth - kPadding, kCardTop + 25, "all at the same time",
              {"d-3", 11, TextAnchor::kEnd});
    svg_.Line({x + kPadding, kCardTop + kHead}, {x + kCardWidth - kPadding, kCardTop + kHead}, "d-line");
    if (shown_ < rows_.size()) {
      svg_.Text(x + kPadding, kCardTop + card_height_ - 8,
                "+ " + std::to_string(rows_.size() - shown_) + " more conditions", {"d-3", 11});
    }
    svg_.Close();
  }

  void EmptyCard() {
    svg_.Box({kRight, kCardTop, kCardWidth, card_height_}, "d-slot", kRadius);
    int base_line = kCardTop + card_height_ / 2 - 8;
    for (const std::string& line :
         WrapText(InPrint(SentenceOf(run_, event_)), kCardWidth - 2 * kPadding, 13, 4)) {
      svg_.Text(kRight + kPadding, base_line, line, {"d-2", 13});
      base_line += 20;
    }
  }

  // ---- a component

  void DrawRow(const Row& row, int top) {
    const int middle = top + kRowHeight / 2;
    const bool missed = row.status == ComponentStatus::kMissed;
    Line(row.left, kLeft, middle, false);
    if (accepted_) Line(row.right, kRight, middle, missed);
    const Rect found{kMiddle, top + 4, kFoundWidth, kRowHeight - 8};
    svg_.Path(Level(kLeft + kCardWidth, found.x, middle), missed ? "d-cross" : "d-link");
    svg_.Box(found, missed ? "d-failed" : "d-found", kRadius);
    const Point sign{found.x + 18, middle};
    if (row.status == ComponentStatus::kMatched) DrawCheck(svg_, sign, 5);
    if (row.status == ComponentStatus::kAchievable) DrawDot(svg_, sign, 5, "d-dot");
    if (missed) DrawCross(svg_, sign, 5);
    const int text_x = found.x + 36;
    const int room = found.right() - kPadding - text_x;
    svg_.Text(text_x, middle - 2, FitText(row.found, room, 12), {});
    svg_.Text(text_x, middle + 13, FitText(row.note, room, 11), {missed ? "d-fail" : "d-3", 11});
    if (missed || !accepted_) return;
    svg_.Path(Level(found.right(), kRight - 1, middle), "d-link");
    DrawArrowHead(svg_, {kRight, middle});
  }

  static std::string Level(int from, int to, int y) {
    return "M" + std::to_string(from) + " " + std::to_string(y) + "H" + std::to_string(to);
  }

  void Line(const Condition& condition, int card, int middle, bool pruned) {
    const int x = card + kPadding;
    const int room = kCardWidth - 2 * kPadding - (pruned ? TextWidth("pruned", 12) + 14 : 0);
    const std::string fit = FitText(condition.text, room, 13);
    svg_.Text(x, middle + 5, WithVariables(fit, condition.variables, pruned ? "d-3" : ""), {"", 13});
    if (!pruned) return;
    svg_.Line({x - 2, middle}, {x + TextWidth(fit, 13) + 2, middle}, "d-cut");
    svg_.Text(card + kCardWidth - kPadding, middle + 5, "pruned", {"d-fail", 12, TextAnchor::kEnd});
  }

  // ---- what follows: psi, and the rest of both triads

  int Conclusion(int top) {
    const int centre = kMiddle + kFoundWidth / 2;
    const std::int64_t kept = compared_.matched + compared_.achievable;
    svg_.Text(centre, top + 10,
              "ψ = " + std::to_string(kept) + "/" + std::to_string(compared_.total) + " = " +
                  TwoDecimals(compared_.psi),
              {"d-b d-psi", 22, TextAnchor::kMiddle});
    std::string counts = std::to_string(compared_.matched) + " matched";
    if (compared_.achievable > 0)
      counts += ", " + std::to_string(compared_.achievable) + " can be brought about";
    counts +=
        ", " + std::to_string(compared_.total - kept) + " missed; Jaccard " + TwoDecimals(compared_.jaccard);
    svg_.Text(centre, top + 34, FitText(counts, kFoundWidth + kGap, 11), {"d-3", 11, TextAnchor::kMiddle});
    const double source_sure = compared_.psi > 0 ? compared_.confidence / compared_.psi : 0;
    if (accepted_) {
      svg_.Text(centre, top + 56,
                "confidence = ψ × " + TwoDecimals(source_sure) + " = " + TwoDecimals(compared_.confidence),
                {"d-b", 13, TextAnchor::kMiddle});
    }
    const Rect model{kMiddle + 20, top + 84, kFoundWidth - 40, 84};
    const int ring_y = model.y + model.height / 2 - kRing / 2;
    Requirement(kLeft, compared_.requirement, source_sure, ring_y, model, false);
    if (accepted_)
      Requirement(kRight, compared_.result_requirement, compared_.confidence, ring_y, model, true);
    CausalModel(model);
    return model.bottom() + 22;
  }

  void Requirement(int card, ModelId id, double sure, int ring_y, const Rect& model, bool result) {
    const Rect ring{card + kCardWidth / 2 - kRing / 2, ring_y, kRing, kRing};
    svg_.Open("g", {{"data-id", IdText(id)}});
    const int x = ring.centre().x;
    svg_.Path("M" + std::to_string(x) + " " + std::to_string(kCardTop + card_height_) + "V" +
                  std::to_string(ring.y),
              result ? "d-derived-tip" : "d-link");
    const int y = ring.centre().y;
    const int tip = card < model.x ? model.x : model.right();
    svg_.Path(Level(card < model.x ? ring.right() : ring.x, tip, y), result ? "d-derived-tip" : "d-link");
    if (card < model.x) {
      DrawArrowHead(svg_, {tip, y});
    } else {
      svg_.Path("M" + std::to_string(tip) + " " + std::to_string(y) + "l8 -4v8z", "d-star");
    }
    DrawRing(svg_, ring, sure);
    svg_.Text(x, ring.bottom() + 17, IdText(id), {"d-id", 12, TextAnchor::kMiddle});
    svg_.Text(x, ring.bottom() + 34, FitText(TitleOf(knowledge_, id), kCardWidth, 12),
              {"d-2", 12, TextAnchor::kMiddle});
    svg_.Close();
  }

  void CausalModel(const Rect& rect) {
    const ModelRecord* record = knowledge_.Find(compared_.causal_model);
    svg_.Open("g", {{"data-id", IdText(compared_.causal_model)}});
    svg_.Box(rect, "d-card", kRadius);
    svg_.Text(rect.x + kPadding, rect.y + 19, IdText(compared_.causal_model), {"d-id", 11});
    if (record != nullptr) {
      const ModelLines lines = LinesOf(knowledge_, record->model);
      const int side = (rect.height - 28) / 2;
      DrawRoundedBand(svg_, {rect.x, rect.y + 28, rect.width, side}, 0, 0, "d-lhs");
      DrawRoundedBand(svg_, {rect.x, rect.y + 28 + side, rect.width, rect.height - 28 - side}, 0, kRadius,
                      "d-rhs");
      const int room = rect.width - 2 * kPadding - 54;
      const int left = rect.y + 28 + side / 2 + 4;
      svg_.Text(rect.x + kPadding, left, WithVariables(FitText(lines.lhs, room, 12), lines.variables), {});
      svg_.Text(rect.x + kPadding, left + side, WithVariables(FitText(lines.rhs, room, 12), lines.variables),
                {});
      svg_.Text(rect.right() - kPadding, left, "if done", {"d-3", 11, TextAnchor::kEnd});
      svg_.Text(rect.right() - kPadding, left + side, "then", {"d-3", 11, TextAnchor::kEnd});
    }
    svg_.Box(rect, "d-frame", kRadius);
    svg_.Close();
  }

  const Run& run_;
  const KnowledgeBase& knowledge_;
  const Event& event_;
  const AnalogyCompared& compared_;
  const Theme& theme_;
  const std::vector<Row> rows_;
  std::size_t shown_ = 0;
  bool accepted_ = false;
  int card_height_ = 0;
  Svg svg_;
};

// How well a comparison answers to what was asked for; 0 not at all.
int Fit(const AnalogyCompared& compared, EventId event, const std::optional<ObjectId>& object) {
  const bool accepted = compared.verdict == AnalogyVerdict::kAccepted;
  if (!object || *object == ObjectId(event)) return accepted ? 2 : 1;
  const ObjectId wanted = *object;
  if (wanted == ObjectId(compared.result_requirement) || wanted == ObjectId(compared.result_state))
    return accepted ? 4 : 3;
  if (wanted == ObjectId(compared.requirement) || wanted == ObjectId(compared.source) ||
      wanted == ObjectId(compared.goal) || wanted == ObjectId(compared.causal_model))
    return accepted ? 2 : 1;
  return 0;
}

}  // namespace

Result<EventId> FindComparison(const Run& run, const std::optional<ObjectId>& object) {
  EventId best;
  int best_fit = 0;
  std::vector<std::string> made;
  for (const EventId id : run.OfKind<AnalogyCompared>()) {
    const auto& compared = *run.FindBody<AnalogyCompared>(id);
    if (compared.verdict == AnalogyVerdict::kAccepted && compared.result_requirement.valid())
      made.push_back(IdText(compared.result_requirement));
    const int fit = Fit(compared, id, object);
    if (fit <= best_fit) continue;
    best = id;
    best_fit = fit;
  }
  if (best.valid()) return best;
  std::sort(made.begin(), made.end());
  made.erase(std::unique(made.begin(), made.end()), made.end());
  constexpr std::size_t kNamed = 8;
  const bool more = made.size() > kNamed;
  if (more) made.resize(kNamed);
  if (run.OfKind<AnalogyCompared>().empty())
    return Error{"nothing was compared by analogy in this episode, so there is no such figure"};
  return Error{
      (object ? IdText(*object) + " was neither made by analogy nor compared" : std::string("nothing fits")) +
      (made.empty() ? "; no analogy was accepted in this episode"
                    : "; by analogy were made " + Joined(made) + (more ? " and others" : ""))};
}

Result<std::string> AnalogySvg(const Run& run, EventId comparison, const Theme& theme) {
  const Event* event = run.Find(comparison);
  if (event == nullptr || !std::holds_alternative<AnalogyCompared>(event->body))
    return Error{IdText(comparison) + " is not a comparison by analogy"};
  return Figure(run, *event, theme).Build();
}

}  // namespace aerascope
