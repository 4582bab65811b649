#include "viewer/draw/tree_drawing.h"

#include <algorithm>
#include <map>
#include <set>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "viewer/draw/marks.h"
#include "viewer/draw/svg.h"
#include "viewer/draw/text_fit.h"
#include "viewer/layout/graph_layout.h"

namespace aerascope {
namespace {

constexpr int kBoxWidth = 240;
constexpr int kLineHeight = 17;
constexpr std::size_t kBoxLines = 3;
constexpr int kNoteHeight = 24;

struct TextBox {
  std::string id;       // as IdText writes it
  std::string heading;  // in grey over the text: when, which
  std::vector<std::string> lines;
  std::vector<std::string> notes = {};  // in grey below the text
  bool asked = false;                   // the one the drawing is about, or on the way that was taken
  Outcome outcome = Outcome::kOpen;

  Size size() const {
    return {kBoxWidth,
            26 + kLineHeight * static_cast<int>(std::max<std::size_t>(1, lines.size()) + notes.size())};
  }
};

TextBox MakeBox(std::string id, std::string heading, std::string_view text) {
  return {std::move(id), std::move(heading), WrapText(text, kBoxWidth - 24, 12, kBoxLines)};
}

std::string CurveData(const std::vector<Point>& curve) {
  std::string data;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    data += i == 0 ? "M" : i == 1 ? "C" : " ";
    data += std::to_string(curve[i].x) + " " + std::to_string(curve[i].y);
  }
  return data;
}

void DrawBox(Svg& svg, const TextBox& box, const Rect& rect) {
  svg.Open("g", {{"data-id", box.id}});
  const bool failed = box.outcome == Outcome::kFailed;
  svg.Box(rect, failed ? "d-failed" : box.asked ? "d-card d-chosen" : "d-card", 6);
  svg.Text(rect.x + 12, rect.y + 16, box.heading, {"d-3", 11});
  const Point sign{rect.right() - 16, rect.y + 12};
  if (box.outcome == Outcome::kReached) DrawCheck(svg, sign, 4);
  if (failed) DrawCross(svg, sign, 4);
  int base_line = rect.y + 33;
  for (const std::string& line : box.lines) {
    svg.Text(rect.x + 12, base_line, line, {});
    base_line += kLineHeight;
  }
  for (const std::string& note : box.notes) {
    svg.Text(rect.x + 12, base_line, note, {"d-3", 11});
    base_line += kLineHeight;
  }
  svg.Close();
}

std::string Finish(const GraphToPlace& graph, const std::vector<TextBox>& boxes, const std::string& note,
                   std::string_view title, const Theme& theme) {
  const PlacedGraph placed = PlaceGraph(graph);
  Svg svg;
  Size size = placed.size;
  size.width = std::max({size.width, kBoxWidth, TextWidth(note, 12) + 16});
  svg.Leaf("rect", {{"width", size.width},
                    {"height", size.height + (!note.empty() ? kNoteHeight : 0)},
                    {"class", "d-page"}});
  for (const PlacedLink& link : placed.links) {
    svg.Path(CurveData(link.curve), "d-link");
    DrawArrowHead(svg, link.curve.back());
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) DrawBox(svg, boxes[i], placed.nodes[i]);
  if (!note.empty()) {
    svg.Text(8, size.height + 14, note, {"d-3"});
    size.height += kNoteHeight;
  }
  return SvgDocument(size, title, DrawingStyle(theme), svg.content());
}

// The events that a cause tree speaks of, each once, the nearest first, with all links between them.
class CauseGraph {
 public:
  CauseGraph(const Run& run, EventId root, CauseDirection direction)
      : run_(run), why_(direction == CauseDirection::kWhy) {
    // As far as anybody will count.
    constexpr CauseLimits kLimits{.depth = 1000, .nodes = 20'000};
    const CauseTree tree = why_ ? Why(run, root, kLimits) : LedTo(run, root, kLimits);
    cut_ = tree.cut;
    for (const CauseNode& node : tree.nodes) {
      const auto [found, fresh] = steps_.emplace(node.event, node.depth);
      if (!fresh) found->second = std::min(found->second, node.depth);
      if (node.depth == 0) continue;
      const EventId parent = tree.nodes[node.parent].event;
      links_.emplace(why_ ? node.event : parent, why_ ? parent : node.event);
    }
    for (const auto& [event, steps] : steps_) farthest_ = std::max(farthest_, steps);
  }

  // Steps from the root, by event.
  const std::map<EventId, int>& steps() const { return steps_; }
  // From cause to effect.
  const std::set<std::pair<EventId, EventId>>& links() const { return links_; }
  int farthest() const { return farthest_; }
  bool cut() const { return cut_; }  // there is more than could be counted

  // The nearest events up to a number of steps, at most so many. None without what joins it to the root.
  std::vector<EventId> Within(int depth, std::size_t most) const {
    std::vector<EventId> chosen = NearestFirst();
    std::erase_if(chosen, [&](EventId event) { return steps_.at(event) > depth; });
    if (chosen.size() > most) chosen.resize(most);
    return chosen;
  }
  // The nearest events that stand side by side on a page, behind nothing that has no room there.
  std::vector<EventId> Readable() const {
    constexpr std::size_t kMostTried = 10 * kReadableBoxes;
    const std::vector<EventId> near = NearestFirst();
    std::set<EventId> chosen;
    for (std::size_t i = 0; i < near.size() && i < kMostTried && chosen.size() < kReadableBoxes; ++i) {
      if (!chosen.empty() && !Joins(near[i], chosen)) continue;
      chosen.insert(near[i]);
      if (Columns(chosen) > kReadableColumns) chosen.erase(near[i]);
    }
    return {chosen.begin(), chosen.end()};
  }

 private:
  std::vector<EventId> NearestFirst() const {
    std::vector<EventId> events;
    for (const auto& [event, steps] : steps_) events.push_back(event);
    std::stable_sort(events.begin(), events.end(),
                     [&](EventId a, EventId b) { return steps_.at(a) < steps_.at(b); });
    return events;
  }
  bool Joins(EventId event, const std::set<EventId>& chosen) const {
    const std::span<const EventId> nearer = why_ ? run_.Effects(event) : run_.Causes(event);
    return std::any_of(nearer.begin(), nearer.end(), [&](EventId one) { return chosen.contains(one); });
  }
  // How many of the events stand behind each other. Causes come before their effects, so one pass in order is
  // enough.
  int Columns(const std::set<EventId>& events) const {
    std::map<EventId, int> columns;
    int most = 0;
    for (const EventId event : events) {
      int& column = columns[event];
      for (const EventId cause : run_.Causes(event)) {
        const auto before = columns.find(cause);
        if (before != columns.end()) column = std::max(column, before->second);
      }
      most = std::max(most, ++column);
    }
    return most;
  }

  const Run& run_;
  bool why_;
  bool cut_ = false;
  int farthest_ = 0;
  std::map<EventId, int> steps_;
  std::set<std::pair<EventId, EventId>> links_;
};

std::string Steps(int count) {
  return std::to_string(count) + (count == 1 ? " step" : " steps");
}

}  // namespace

std::string CauseTreeSvg(const Run& run, EventId root, CauseDirection direction, const Theme& theme,
                         std::optional<int> depth) {
  const bool why = direction == CauseDirection::kWhy;
  const CauseGraph causes(run, root, direction);
  const std::vector<EventId> drawn = depth ? causes.Within(*depth, kMaxDrawnBoxes) : causes.Readable();
  GraphToPlace graph;
  std::vector<TextBox> boxes;
  std::map<EventId, std::size_t> box_of;
  int farthest_drawn = 0;
  for (const EventId id : drawn) {
    const Event& event = *run.Find(id);
    box_of[id] = boxes.size();
    boxes.push_back(
        MakeBox(IdText(id), SecondsText(event.time) + ", " + IdText(id), InPrint(SentenceOf(run, event))));
    boxes.back().asked = id == root;
    farthest_drawn = std::max(farthest_drawn, causes.steps().at(id));
  }
  std::set<std::size_t> go_on;  // boxes behind which something is left out
  for (const auto& [cause, effect] : causes.links()) {
    const auto from = box_of.find(cause);
    const auto to = box_of.find(effect);
    if (from != box_of.end() && to != box_of.end()) {
      graph.links.push_back({from->second, to->second});
    } else if (const auto known = why ? to : from; known != box_of.end()) {
      go_on.insert(known->second);
    }
  }
  for (const std::size_t box : go_on) boxes[box].notes.push_back("goes on");
  for (const TextBox& box : boxes) graph.nodes.push_back(box.size());
  const std::size_t left_out = causes.steps().size() - boxes.size();
  std::string note;
  if (left_out > 0) {
    note = "Drawn: " + std::to_string(boxes.size()) + " events, up to " + Steps(farthest_drawn) +
           " away. Left out: " + (causes.cut() ? "more than " : "") + std::to_string(left_out) +
           " more, up to " + Steps(causes.farthest()) + " away.";
  }
  return Finish(graph, boxes, note, why ? "Why" : "What it led to", theme);
}

namespace {

// A plan in a line: what came of it, how sure it was, its commands.
std::string PlanNote(const Run& run, const PlanRecord& plan) {
  std::vector<std::string> steps;
  for (const PlanStep& step : plan.steps) steps.push_back(StepText(run.final_knowledge(), step));
  return FitText((plan.committed ? "chosen, " : "not chosen, ") + FormatConfidence(plan.score) + ": " +
                     (steps.empty() ? "nothing" : Join(steps, ", then ")),
                 kBoxWidth - 24, 11);
}

}  // namespace

std::string GoalTreeSvg(const Run& run, const GoalTree& tree, const Theme& theme) {
  constexpr std::size_t kMostPlans = 6;
  GraphToPlace graph;
  std::vector<TextBox> boxes;
  const std::size_t count = std::min(tree.goals.size(), kMaxDrawnBoxes);
  for (std::size_t i = 0; i < count; ++i) {
    const GoalNode& goal = tree.goals[i];
    std::string heading = SecondsText(goal.time) + (goal.drive ? ", drive" : ", sub-goal");
    if (goal.model.valid()) heading += " by " + IdText(goal.model);
    boxes.push_back(MakeBox(IdText(goal.goal), std::move(heading), goal.title));
    boxes.back().outcome = goal.outcome;
    boxes.back().asked = goal.chosen;
    for (const PlanRecord& plan : goal.plans) {
      if (boxes.back().notes.size() == kMostPlans) break;
      boxes.back().notes.push_back(PlanNote(run, plan));
    }
    if (goal.plans.size() > kMostPlans)
      boxes.back().notes.push_back("and " + std::to_string(goal.plans.size() - kMostPlans) + " more plans");
    graph.nodes.push_back(boxes.back().size());
    if (goal.parent != i && goal.parent < count) graph.links.push_back({goal.parent, i});
  }
  const std::size_t left_out = tree.goals.size() - count;
  return Finish(graph, boxes, left_out > 0 ? std::to_string(left_out) + " more are not drawn." : "",
                "What was wanted", theme);
}

}  // namespace aerascope
