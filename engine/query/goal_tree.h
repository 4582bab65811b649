// What the agent wanted and what it did about it: drives, their sub-goals, the plans tried, the commands
// issued.
#pragma once

#include <string>
#include <vector>

#include "engine/query/run.h"

namespace aerascope {

enum class Outcome { kOpen, kReached, kFailed };

struct PlanRecord {
  SimulationId simulation;
  EventId started;
  Time time;
  std::vector<PlanStep> steps;
  double score = 0;
  bool ended = false;
  SimulationOutcome outcome = SimulationOutcome::kNotReached;
  bool committed = false;
  EventId commit;  // the PlanCommitted event
};

struct IssuedCommand {
  EventId event;
  Time time;
  TimeInterval interval;
  Term command;
  Commander by = Commander::kAgent;
  GoalId goal;      // the drive it serves; none for the teacher's
  EventId refused;  // the CommandRefused event that names it as a cause; else invalid
};

struct SkippedGoal {
  EventId event;
  Fact target;
  GoalSkipReason reason = GoalSkipReason::kNoModel;
};

struct GoalNode {
  GoalId goal;
  GoalId super_goal;
  std::size_t parent = 0;  // position in GoalTree::goals; its own for a drive or an unknown super goal
  bool drive = false;
  std::string title;  // a drive's own title, else the target in words
  ModelId model;
  Fact target;
  EventId event;
  Time time;
  Outcome outcome = Outcome::kOpen;
  EventId outcome_event;
  Time outcome_time;                   // end of the run while open
  std::vector<std::size_t> sub_goals;  // positions in GoalTree::goals
  std::vector<PlanRecord> plans;
  std::vector<IssuedCommand> commands;
  std::vector<SkippedGoal> skipped;
  bool chosen = false;  // on the way of a plan that was committed to
};

struct GoalTree {
  std::vector<GoalNode> goals;      // by event
  std::vector<std::size_t> drives;  // positions of those without a super goal
};

GoalTree MakeGoalTree(const Run& run);
// All commands of the run in order, the teacher's included.
std::vector<IssuedCommand> CommandsOf(const Run& run);
std::string GoalTreeText(const Run& run, const GoalTree& tree);

}  // namespace aerascope
