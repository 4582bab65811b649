// Induction from change (CTPX, semantics 5.1): a sensed value changed and nothing had predicted it; the
// causes at hand in the frame before are each tried, and a triad is made of what fits: a composite state (the
// conditions), a causal model (cause to effect), and the requirement model that joins them. A cause is a
// command, a value that was set (HOLD), or the instance of a model that fired: that gives a reuse model.
//
// Deliberate differences from OpenAERA (own):
// - Values are the same only in the same role (roles.h), in what catches attention as in what is abstracted;
//   `roles` can tell it to look at values alone, as OpenAERA does.
// - Equal knowledge is recognised by canonical form, composite states included.
// - What is done (commands, model instances) is a candidate even where it starts with the premise; what is
//   sensed in step with the premise is a condition and no cause.
// - A known instance serves as the condition only if it binds what the requirement model must pass on; for a
//   reuse model, also the individuals of the model it rides on. Else the conditions are put together anew.
// - Nothing rests on absences: they are the engine's own conclusions.
// - The order in which simultaneous facts come plays no part in what is learned.
#pragma once

#include "engine/reason/journal.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"

namespace aerascope {

// A sensed value in two consecutive frames.
struct Change {
  std::size_t premise = 0;   // position in the situation before
  SituationFact consequent;  // in the frame that begins now
};

// Writes InductionStarted with what was made of each input, CauseConsidered for each that could be a cause,
// and the knowledge made or rejected. `before` is the finished situation of the last frame: facts, instances,
// executed commands.
void InduceFromChange(const Change& change, const Situation& before, ValueRoles roles, Time now,
                      Journal* journal);

}  // namespace aerascope
