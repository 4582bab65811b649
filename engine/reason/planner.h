// The planner answers one question a frame: which command now, for this goal? It chains backwards from the
// goal (backward_chaining.h), tries the plans it finds in the head (simulation.h) and commits to the best
// (commit.h). Where no known condition leads to the goal, the best partial match is hypothesised by analogy
// (hypothesis.h), tried, and used at once.
//
// Everything is written to the journal: goals, skipped goals, comparisons with their verdicts, simulations,
// rejected plans, the choice. Work is bounded by counted nodes, not by time.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "engine/reason/backward_chaining.h"
#include "engine/reason/hypothesis.h"
#include "engine/reason/journal.h"
#include "engine/reason/parameters.h"
#include "engine/reason/simulation.h"
#include "engine/reason/situation.h"
#include "engine/reason/threats.h"

namespace aerascope {

struct PlanningTask {
  GoalEntry drive;
  Fact target;                    // what is wanted, when; confidence says how much
  std::vector<OtherGoal> others;  // other open drives
  // Commands that would undo a more important goal, as found while planning for that one.
  std::vector<Prohibition> prohibitions;
  Time now;  // goals are set now
};

// An event to be written when the choice is.
struct PendingEvent {
  EventBody body;
  std::vector<EventId> causes;
};

struct Decision {
  // The first command of the plan committed to, nil if the plan begins with waiting; nothing if no plan was
  // chosen.
  std::optional<Term> command;
  std::vector<PendingEvent> outcome;      // rejected plans, then the one committed to
  std::vector<Step> steps;                // of that plan
  std::map<ModelId, EventId> vetoed;      // models that a veto stands against, and where that is said
  std::vector<GoalLog::Line> goals;       // all goals set for this decision
  std::vector<Prohibition> prohibitions;  // commands that would undo this goal
  // Where no plan was chosen: goals that no way led on from, and comparisons that gave no hypothesis.
  std::vector<EventId> hindrances;
};

// `situation` is the present one; `offer` may extend it.
Decision PlanFor(const PlanningTask& task, const ReasonerParameters& parameters, Duration period,
                 const Situation& situation, Retrieval* retrieval, const OfferKnowledge& offer,
                 Journal* journal);

}  // namespace aerascope
