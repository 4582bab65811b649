// Threats to a goal: models that would undo it (opposite matches, semantics 4.2), as far as the present
// situation allows them to fire. What they need becomes mandatory: a command not to be given, a fact that has
// to go first.
#pragma once

#include <vector>

#include "engine/reason/plan.h"

namespace aerascope {

// A command that would undo the goal, as far as the present situation allows it.
struct Prohibition {
  Term command;  // wildcards match anything
  GoalEntry goal;
};

// A fact that would undo the goal and holds: it must cease to.
struct MandatoryGoal {
  GoalEntry goal;
  Fact target;
};

struct Threats {
  std::vector<Prohibition> prohibitions;
  std::vector<MandatoryGoal> mandatory;
};

// Sets a goal for each, and skips what does not hold anyway.
Threats FindThreats(const Fact& target, const GoalEntry& goal, ImaginedFrame* present,
                    const PlanningContext& context, GoalLog* goals);

}  // namespace aerascope
