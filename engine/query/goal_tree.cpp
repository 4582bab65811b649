#include "engine/query/goal_tree.h"

#include <algorithm>
#include <map>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/words.h"

namespace aerascope {
namespace {

// The command that a wanted instance of a model comes down to, through models that ride on others; nil if to
// none.
Term CommandOf(const KnowledgeBase& knowledge, const Term& payload, int depth = 0) {
  constexpr int kDeepest = 8;
  if (IsCommand(payload)) return payload;
  const std::optional<InstanceSides> sides =
      depth < kDeepest ? SidesOfInstance(knowledge, payload, {}) : std::nullopt;
  return sides ? CommandOf(knowledge, sides->lhs, depth + 1) : Term::Nil();
}

class TreeMaker {
 public:
  explicit TreeMaker(const Run& run) : run_(run) {}

  GoalTree Make() {
    for (const Event& event : run_.events()) {
      std::visit([&](const auto& body) { Note(event, body); }, event.body);
    }
    for (const IssuedCommand& command : CommandsOf(run_)) {
      if (GoalNode* goal = Find(command.goal)) goal->commands.push_back(command);
    }
    MarkChosen();
    return std::move(tree_);
  }

 private:
  // What was set in the decision that a plan came from, and asks for one of its commands or for the condition
  // of one of its steps, was on its way; so were the goals that these serve.
  void MarkChosen() {
    std::map<Time, std::vector<PlanStep>> steps;
    for (const GoalNode& goal : tree_.goals) {
      for (const PlanRecord& plan : goal.plans) {
        if (plan.committed)
          steps[plan.time].insert(steps[plan.time].end(), plan.steps.begin(), plan.steps.end());
      }
    }
    std::vector<bool> asks(tree_.goals.size(), false);
    for (std::size_t i = 0; i < tree_.goals.size(); ++i) {
      const GoalNode& goal = tree_.goals[i];
      const auto found = steps.find(goal.time);
      if (found == steps.end()) continue;
      const Term command = CommandOf(run_.final_knowledge(), goal.target.payload);
      const bool for_asked = goal.parent != i && asks[goal.parent];
      asks[i] = !command.is(TermKind::kNil) &&
                std::any_of(found->second.begin(), found->second.end(), [&](const PlanStep& step) {
                  Bindings bindings;
                  return Match(command, step.command, bindings);
                });
      const bool condition =
          for_asked && std::any_of(found->second.begin(), found->second.end(), [&](const PlanStep& step) {
            return step.requirement.valid() && step.requirement == goal.model;
          });
      if (!asks[i] && !condition) continue;
      for (std::size_t at = i; !tree_.goals[at].chosen; at = tree_.goals[at].parent)
        tree_.goals[at].chosen = true;
    }
  }

  template <class Other>
  void Note(const Event&, const Other&) {}

  void Note(const Event& event, const DriveInjected& e) {
    AddGoal(event, e.goal, {}, e.target, e.title.empty() ? "" : Printable(e.title), {});
  }
  void Note(const Event& event, const GoalSet& e) {
    AddGoal(event, e.goal, e.super_goal, e.target, "", e.model);
  }

  void AddGoal(const Event& event, GoalId goal, GoalId super_goal, const Fact& target, std::string title,
               ModelId model) {
    const std::size_t position = tree_.goals.size();
    if (!positions_.try_emplace(goal, position).second) return;  // set twice: the first one counts
    GoalNode node;
    node.goal = goal;
    node.super_goal = super_goal;
    node.drive = std::holds_alternative<DriveInjected>(event.body);
    node.title = title.empty() ? FactText(run_.final_knowledge(), target) : std::move(title);
    node.model = model;
    node.target = target;
    node.event = event.id;
    node.time = event.time;
    node.outcome_time = run_.end();
    // A super goal is older: so there are no circles.
    const auto parent = positions_.find(super_goal);
    node.parent = parent == positions_.end() ? position : parent->second;
    if (node.parent == position)
      tree_.drives.push_back(position);
    else
      tree_.goals[node.parent].sub_goals.push_back(position);
    tree_.goals.push_back(std::move(node));
  }

  void Note(const Event& event, const GoalAchieved& e) { Close(event, e.goal, Outcome::kReached); }
  void Note(const Event& event, const GoalFailed& e) { Close(event, e.goal, Outcome::kFailed); }
  void Close(const Event& event, GoalId id, Outcome outcome) {
    GoalNode* goal = Find(id);
    if (!goal || event.simulation.valid() || goal->outcome != Outcome::kOpen) return;
    goal->outcome = outcome;
    goal->outcome_event = event.id;
    goal->outcome_time = event.time;
  }

  void Note(const Event& event, const GoalSkipped& e) {
    if (GoalNode* goal = Find(e.super_goal)) goal->skipped.push_back({event.id, e.target, e.reason});
  }

  void Note(const Event& event, const SimulationStarted& e) {
    GoalNode* goal = Find(e.goal);
    if (!goal) return;
    PlanRecord plan;
    plan.simulation = e.simulation;
    plan.started = event.id;
    plan.time = event.time;
    plan.steps = e.steps;
    plan.score = e.score;
    plans_[e.simulation] = {e.goal, goal->plans.size()};
    goal->plans.push_back(std::move(plan));
  }
  void Note(const Event&, const SimulationEnded& e) {
    if (PlanRecord* plan = Find(e.simulation)) {
      plan->ended = true;
      plan->outcome = e.outcome;
    }
  }
  void Note(const Event& event, const PlanCommitted& e) {
    if (PlanRecord* plan = Find(e.chosen)) {
      plan->committed = true;
      plan->commit = event.id;
    }
  }

  GoalNode* Find(GoalId id) {
    const auto it = positions_.find(id);
    return it == positions_.end() ? nullptr : &tree_.goals[it->second];
  }
  PlanRecord* Find(SimulationId id) {
    const auto it = plans_.find(id);
    return it == plans_.end() ? nullptr : &Find(it->second.first)->plans[it->second.second];
  }

  const Run& run_;
  GoalTree tree_;
  std::map<GoalId, std::size_t> positions_;
  std::map<SimulationId, std::pair<GoalId, std::size_t>> plans_;
};

std::string_view OutcomeText(Outcome outcome) {
  switch (outcome) {
    case Outcome::kOpen:
      return "open";
    case Outcome::kReached:
      return "reached";
    case Outcome::kFailed:
      return "missed";
  }
  return {};
}

std::string PlanText(const Run& run, const PlanRecord& plan) {
  std::vector<std::string> steps;
  for (const PlanStep& step : plan.steps) steps.push_back(StepText(run.final_knowledge(), step));
  std::string text = "plan " + IdText(plan.simulation) + ": " + Join(steps, ", ") + ", score " +
                     FormatConfidence(plan.score);
  if (plan.ended) text += ", " + std::string(EnumName(plan.outcome));
  return plan.committed ? text + ", chosen" : text;
}

}  // namespace

GoalTree MakeGoalTree(const Run& run) {
  return TreeMaker(run).Make();
}

std::vector<IssuedCommand> CommandsOf(const Run& run) {
  std::vector<IssuedCommand> commands;
  std::map<EventId, std::size_t> positions;
  for (const EventId id : run.OfKind<CommandIssued>()) {
    const Event& event = *run.Find(id);
    if (event.simulation.valid()) continue;
    const auto& issued = std::get<CommandIssued>(event.body);
    positions[id] = commands.size();
    commands.push_back({id, event.time, issued.interval, issued.command, issued.by, issued.goal, {}});
  }
  for (const EventId id : run.OfKind<CommandRefused>()) {
    for (const EventId cause : run.Causes(id)) {
      const auto it = positions.find(cause);
      if (it != positions.end()) commands[it->second].refused = id;
    }
  }
  return commands;
}

std::string GoalTreeText(const Run& run, const GoalTree& tree) {
  std::string text;
  std::vector<std::pair<std::size_t, int>> open;
  for (auto drive = tree.drives.rbegin(); drive != tree.drives.rend(); ++drive) open.emplace_back(*drive, 0);
  while (!open.empty()) {
    const auto [position, depth] = open.back();
    open.pop_back();
    const GoalNode& goal = tree.goals[position];
    const std::string indent(static_cast<std::size_t>(std::min(depth, 40)) * 2, ' ');
    text += indent + SecondsText(goal.time) + "  " + goal.title + "  " + IdText(goal.goal);
    if (goal.outcome != Outcome::kOpen || goal.drive) text += "  " + std::string(OutcomeText(goal.outcome));
    if (goal.outcome != Outcome::kOpen) text += " at " + SecondsText(goal.outcome_time);
    text += "\n";
    for (const PlanRecord& plan : goal.plans) text += indent + "  " + PlanText(run, plan) + "\n";
    for (const IssuedCommand& command : goal.commands) {
      text += indent + "  command " + PayloadText(run.final_knowledge(), command.command) + " at " +
              SecondsText(command.time) + (command.refused.valid() ? ", not done as asked" : "") + "\n";
    }
    for (auto sub = goal.sub_goals.rbegin(); sub != goal.sub_goals.rend(); ++sub)
      open.emplace_back(*sub, depth + 1);
  }
  return text;
}

}  // namespace aerascope
