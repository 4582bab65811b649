// Time-outs: what is not met for long is put aside, and at last forgotten (semantics 3.5).
//
// A model whose left side nothing has matched for primary_thz is phased out, and for secondary_thz, counted
// from the same moment, deleted; it is not black-listed, so it may be learned anew. A model that was
// black-listed and whose like has not been put together again for secondary_thz is taken off the list. Drive
// models do not time out: nothing matches their left side forward.
//
// Own choice: a composite state stays; it is the models on it that time out, and without them nothing follows
// from it. Looked at are only the models whose time may have come, not all of them in every frame.
#pragma once

#include <map>
#include <unordered_map>
#include <vector>

#include "engine/reason/journal.h"
#include "engine/reason/parameters.h"

namespace aerascope {

class TimeOuts {
 public:
  // Both outlive it.
  TimeOuts(const ReasonerParameters& parameters, Journal* journal)
      : parameters_(parameters), journal_(*journal) {}

  // Something matched the model's left side; or, of a black-listed one, its like was put together again.
  void Met(ModelId model, Time now) { met_[model] = now; }

  // At the start of a frame, said by `frame`: puts aside what was not met for too long.
  void Check(Time now, EventId frame);

 private:
  void Register(Time now);
  // What is due is done; when to look again, nothing if never.
  std::optional<Time> LookAt(ModelId model, Time now, EventId frame);

  const ReasonerParameters& parameters_;
  Journal& journal_;
  std::unordered_map<ModelId, Time> met_;  // looked up only, never gone through
  std::map<Time, std::vector<ModelId>> to_look_at_;
  ModelId last_registered_;
};

}  // namespace aerascope
