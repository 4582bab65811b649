// Induction from goals (GTPX, semantics 5.3): what was wanted came about, and nothing had predicted it. What
// came before it may be what brings it about: each becomes a model "this, and the goal is reached".
//
// Two ways, after what OpenAERA does and what it was to do:
// - Side effect: an anti-fact was wanted, and came about with the predicted success of a command. The command
//   gets a second causal model with the goal on its right side, under the conditions of the first; backward,
//   its quantities are what they were (constants), since the goal does not say them.
// - All else that was seen or done since the goal was given, no longer back than the horizon: a command leads
// to
//   the goal, and so does each outermost composite state that held (a fact by itself where none contains it).
//   No template, no condition: only the time between them. Over-generates, as failure induction does; ratings
//   prune. In OpenAERA's standard setting (pass_through) the inputs never get here, so that only side effects
//   are learned.
//
// This project's own rules: only goals that were given (drives) are looked at, since all others live inside
// simulations; what shares no value with the goal is passed over; nothing rests on absences; a model whose
// right side would hold something that its left side does not give is rejected (free variable); a command
// that a known model leads from to what was seen is no news (duplicate).
#pragma once

#include <vector>

#include "engine/reason/journal.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"

namespace aerascope {

struct ReachedGoal {
  Fact target;  // what was wanted, since when
  FactId shown_by;
  Fact evidence;                // the fact that shows it
  std::vector<EventId> events;  // that it was reached
};

// A command's prediction that came true when the goal was reached.
struct PredictedCommand {
  SituationFact command;
  const Situation* frame = nullptr;         // in which it was done
  std::size_t condition = Situation::npos;  // what allowed its model, as a position there
};

// `frames` are finished situations, the latest first.
void InduceFromGoal(const ReachedGoal& goal, const std::vector<PredictedCommand>& came_true,
                    const std::vector<const Situation*>& frames, const ReasonerParameters& parameters,
                    Time now, Journal* journal);

}  // namespace aerascope
