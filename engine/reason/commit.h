// Commitment: which of the plans tried in the head is acted on (semantics 4.6).
//
// What must be done (mandatory) comes before what may be done (optional). A plan that would make a more
// important goal fail is dropped; a mandatory one that would gives up all. Among the optional plans that are
// left the best score wins, the first of equals.
#pragma once

#include <optional>
#include <vector>

#include "engine/event/event_body.h"
#include "engine/reason/parameters.h"

namespace aerascope {

// How pressing a goal is: confidence per second that is left (at least a microsecond).
double Importance(const Fact& target, Time now);

// What plans are ranked by: the product of confidences in paper mode; in openaera mode the confidence of the
// last model per second until it must fire.
double RankingScore(AnalogyMode mode, double product, double solution_confidence, Time solution_before,
                    Time now);

struct TriedPlan {
  SimulationOutcome outcome = SimulationOutcome::kNotReached;
  bool mandatory = false;
  double score = 0;
  GoalId harmed;  // a more important goal it would make fail; else invalid
};

struct Choice {
  std::optional<std::size_t> chosen;
  std::vector<std::optional<PlanRejection>> rejected;  // for each plan; nothing for the chosen one
};

Choice Choose(const std::vector<TriedPlan>& plans);

}  // namespace aerascope
