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

std::string Finish(const GraphToPlace& graph, const std::vector<TextBox>& boxes, std::size_t left_out,
                   std::string_view title, const Theme& theme) {
  const PlacedGraph placed = PlaceGraph(graph);
  Svg svg;
  Size size = placed.size;
  size.width = std::max(size.width, kBoxWidth);
  svg.Leaf("rect", {{"width", size.width},
                    {"height", size.height + (left_out > 0 ? kNoteHeight : 0)},
                    {"class", "d-page"}});
  for (const PlacedLink& link : placed.links) {
    svg.Path(CurveData(link.curve), "d-link");
    DrawArrowHead(svg, link.curve.back());
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) DrawBox(svg, boxes[i], placed.nodes[i]);
  if (left_out > 0) {
    svg.Text(8, size.height + 14, std::to_string(left_out) + " more are not drawn.", {"d-3"});
    size.height += kNoteHeight;
  }
  return SvgDocument(size, title, DrawingStyle(theme), svg.content());
}

}  // namespace

std::string CauseTreeSvg(const Run& run, const CauseTree& tree, CauseDirection direction,
                         const Theme& theme) {
  GraphToPlace graph;
  std::vector<TextBox> boxes;
  std::map<EventId, std::size_t> box_of;
  std::set<EventId> left_out;
  for (const CauseNode& node : tree.nodes) {
    if (box_of.contains(node.event)) continue;
    const Event* event = run.Find(node.event);
    if (event == nullptr || boxes.size() == kMaxDrawnBoxes) {
      left_out.insert(node.event);
      continue;
    }
    box_of[node.event] = boxes.size();
    boxes.push_back(MakeBox(IdText(node.event), SecondsText(event->time) + ", " + IdText(node.event),
                            SentenceOf(run, *event)));
    boxes.back().asked = node.depth == 0;
    graph.nodes.push_back(boxes.back().size());
  }
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const CauseNode& node = tree.nodes[i];
    if (node.parent == i || node.parent >= tree.nodes.size()) continue;
    const auto from = box_of.find(node.event);
    const auto to = box_of.find(tree.nodes[node.parent].event);
    if (from == box_of.end() || to == box_of.end()) continue;
    const bool why = direction == CauseDirection::kWhy;
    graph.links.push_back(why ? GraphLink{from->second, to->second} : GraphLink{to->second, from->second});
  }
  return Finish(graph, boxes, left_out.size(), direction == CauseDirection::kWhy ? "Why" : "What it led to",
                theme);
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
  return Finish(graph, boxes, tree.goals.size() - count, "What was wanted", theme);
}

}  // namespace aerascope
