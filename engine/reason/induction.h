// Induction from change (CTPX, semantics 5.1): a sensed value changed and nothing had predicted it; the causes at hand
// in the frame before are each tried, and a triad is made of what fits: a composite state (the conditions), a causal
// model (command to effect), and the requirement model that joins them.
//
// Deliberate differences from OpenAERA: equal numbers become one variable only in the same role (the value of one
// attribute), never across command arguments and values (semantics 10.4); equal knowledge is recognised by canonical
// form, composite states included.
#pragma once

#include "engine/reason/journal.h"
#include "engine/reason/situation.h"

namespace aerascope {

// A sensed value in two consecutive frames.
struct Change {
  std::size_t premise = 0;   // position in the situation before
  SituationFact consequent;  // in the frame that begins now
};

// Writes InductionStarted, CauseConsidered for each input that could be a cause, and the knowledge made. `before` is
// the finished situation of the last frame: facts, instances, executed commands.
void InduceFromChange(const Change& change, const Situation& before, Time now, Journal* journal);

}  // namespace aerascope
