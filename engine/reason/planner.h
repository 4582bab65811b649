// The Planner answers one question a frame: which command now, for this goal? It chains backwards from the goal through
// causal models and the composite states that allow them, tries the plans it finds by forward chaining in the head, and
// chooses the one with the highest product of confidences (semantics 4 and 6.2). Where no fully known condition leads
// to the goal, the best partial match is hypothesised by analogy, tried, and used at once.
//
// Everything is written to the journal: goals, skipped goals, comparisons with their verdicts, simulations, the choice.
// Work is bounded by counted nodes, not by time.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/reason/analogy.h"
#include "engine/reason/journal.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"

namespace aerascope {

struct Decision {
  Term command;
  EventId event;  // PlanCommitted
};

struct PlanningTask {
  GoalId drive;
  EventId drive_event;
  Term goal;               // payload wanted; variables and wildcards match anything
  bool positive = true;
  TimeInterval interval;   // when it is wanted
  Time now;                // goals are set now
  Time commit_time;        // the choice is written then
};

// Called when a hypothesis became knowledge, so that the present situation is offered to it at once.
using OfferKnowledge = std::function<void(CompositeStateId, ModelId)>;

// The first command of the best plan, or nothing if none leads to the goal. `situation` is the present one; `offer` may
// extend it.
std::optional<Decision> PlanFor(const PlanningTask& task, const ReasonerParameters& parameters, Duration period,
                                const Situation& situation, const OfferKnowledge& offer, Journal* journal);

}  // namespace aerascope
