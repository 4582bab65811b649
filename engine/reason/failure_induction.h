// Induction from a failed prediction (PTPX, semantics 5.2): a model fired and its right side did not come
// true. What held in the frame of the firing, and in the frames before it, may be why: each such condition
// becomes a strong requirement model (a veto) "under this, the model will be wrong". It over-generates on
// purpose; ratings prune.
//
// For each frame back to the horizon: facts and instances that share a value with the failed instance are
// kept, sensed facts of equal attribute and value are taken back in, and so are instances that contain them.
// Then each eligible cause gives a veto on every outermost instance that contains it, one on a composite
// state put together of all that was in step with it, or, where there is neither, one on the fact itself.
// Conditions of earlier frames get guards that say by how much they came before.
//
// This project's own rules, within what the semantics leaves open:
// - The first cause tried in a frame is what the model was to change; the others follow in order of content,
//   as far as no composite state has taken them up. So the order of simultaneous facts plays no part.
// - As in induction from change, a veto must bind the individuals of the effect: one that says "whatever it
// is
//   done to" is rejected (free variable).
// - A condition that is put together and holds in more than max_veto_ways ways at once is no veto (too many
//   ways). Of many things that nothing tells apart (all at one place, all of them off) it would say the same
//   of each choice and order of them: what is gained is one warning, what it costs are thousands of instances
//   in every frame from then on, and further warnings on each of these when the next prediction fails.
// - A veto is not made on a condition that is part of another under which the model has never been wrong:
// what
//   was right already refutes it (contradicted).
// - Nothing rests on absences; equal knowledge is recognised by canonical form.
#pragma once

#include <vector>

#include "engine/reason/journal.h"
#include "engine/reason/parameters.h"
#include "engine/reason/situation.h"

namespace aerascope {

struct FailedPrediction {
  ModelId model;
  Term instance;                // its ground (imdl ...) payload
  FactId input;                 // what it fired on
  FactId shown_by;              // the fact that speaks against it; invalid if nothing came
  Fact target;                  // what was predicted
  std::vector<EventId> events;  // the outcome, and the prediction
};

// `frames` are situations, the latest first: the first is the latest that may hold a reason.
void InduceFromFailure(const FailedPrediction& failed, const std::vector<const Situation*>& frames,
                       const ReasonerParameters& parameters, Time now, Journal* journal);

}  // namespace aerascope
