// How sure the agent was of a model over time: every step with the event that caused it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/query/run.h"

namespace aerascope {

struct ConfidenceStep {
  Time time;
  EventId event;      // ModelCreated, EvidenceUpdated or ModelStateChanged
  Evidence evidence;  // from this event on
  bool strong = false;
  ModelState state = ModelState::kActive;
  std::optional<bool> success;  // of an outcome; none for creation and change of state
  std::string reason;           // short: "learned", "by analogy", "h holding [s1]", "not h holding [cyl]"
};

struct ModelHistory {
  ModelId model;
  std::vector<ConfidenceStep> steps;  // by event; the first is the creation

  std::optional<double> ConfidenceAt(Time t) const;  // after all events up to t; none before the creation
};

// Empty steps if there is no such model.
ModelHistory HistoryOf(const Run& run, ModelId model);
// Of all models, by number.
std::vector<ModelHistory> Histories(const Run& run);

// How often a model predicted by time t (in earnest, not in simulations), and what came of it.
struct ModelUse {
  std::int64_t predicted = 0;
  std::int64_t came_true = 0;
  std::int64_t failed = 0;
};
ModelUse UseOf(const Run& run, ModelId model, Time t);

}  // namespace aerascope
