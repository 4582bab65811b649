// A simulation tries a plan in the head: forward chaining from the present, command by command, with the same
// models, requirements, vetoes and timing as for real (semantics 4.5). What follows from predictions is found
// anew in each frame, since the plan may get in the way of it.
//
// Each event of it carries the simulation's number. What nothing contradicts is taken to hold on, and logged
// where a composite state of the plan rests on it. A step works only if its model is allowed to fire where
// the plan has got to: a veto that has come to hold by then disables it.
#pragma once

#include <map>
#include <vector>

#include "engine/reason/plan.h"

namespace aerascope {

// Another goal that a plan must be seen against.
struct OtherGoal {
  GoalId goal;
  Fact target;
};

struct Trial {
  SimulationId simulation;
  EventId ended;
  SimulationOutcome outcome = SimulationOutcome::kNotReached;
  Time ends;                          // the beginning of the imagined frame it ended in
  std::vector<GoalId> harmed;         // goals that something predicted in it speaks against
  std::map<ModelId, EventId> vetoed;  // models of steps that a veto disabled, and where that is said
};

Trial Simulate(const Plan& plan, const Fact& target, const GoalEntry& goal,
               const std::vector<EventId>& hypothesised, const std::vector<OtherGoal>& others,
               const PlanningContext& context, Journal* journal);

}  // namespace aerascope
