// Abduction, one step of it and without side effects: which models a goal can go through, and when such a
// model would have to fire (semantics 4.2). What is done with the answers is backward chaining
// (backward_chaining.h).
#pragma once

#include <vector>

#include "engine/kb/knowledge_base.h"

namespace aerascope {

// Known, neither deleted nor phased out: only such models are chained through backward.
inline bool IsRunning(const ModelRecord* record) {
  return record && record->state == ModelState::kActive;
}

// Models whose right side could say the target, or (for an anti-fact) another value of the same thing; by id.
std::vector<ModelId> ModelsFor(const Fact& target, const KnowledgeBase& knowledge);

// When a model must fire for its right side to hold in the target's interval: the template's interval if the
// backward guards give it, else that of the left side, else one period earlier.
TimeInterval WindowOf(const Model& model, const Bindings& bindings, const TimeInterval& target,
                      Duration period);

// The variables that stand for times: of the template's (ti after before) and of both sides' intervals.
std::vector<int> TimeVariables(const Model& model);

// The same thing is wanted; when, and how surely, does not matter (semantics 4.4, loop list).
bool SameGoal(const Fact& a, const Fact& b);

}  // namespace aerascope
