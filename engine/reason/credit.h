// Credit: when an outcome is known, the model that predicted and the requirement models that spoke about it
// are rated, and what falls with a model falls with it (semantics 3.5).
//
// A weak requirement model is right when the model it spoke about was, a strong one (a veto) when that was
// wrong; the same holds one level up, for requirement models on requirement models. Deleting a model takes
// with it the requirement models and reuse models on it (refers_to_deleted), and a model that needs values
// from a requirement model when the last one is gone (orphaned). Only models that failed are black-listed;
// what fell with another may be learned anew.
#pragma once

#include <vector>

#include "engine/event/event_body.h"
#include "engine/reason/journal.h"
#include "engine/reason/parameters.h"

namespace aerascope {

struct Outcome {
  ModelId model;                      // that predicted
  std::vector<ModelId> requirements;  // that spoke about it then, for or against, at any level
  bool success = false;
  EventId event;
  // Of these, the requirement models whose own requirement models did not allow them to speak: they are rated
  // only when they would have been right.
  std::vector<ModelId> silenced = {};
};

void GiveCredit(const Outcome& outcome, Time now, const ReasonerParameters& parameters, Journal* journal);

// Deletes a model and what falls with it.
void Delete(ModelId id, StateChangeReason reason, EventId cause, Time now, Journal* journal);

}  // namespace aerascope
