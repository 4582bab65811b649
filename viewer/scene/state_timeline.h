// The recorded world states of an episode in order of time, and which of them is on show at a given moment.
#pragma once

#include <span>
#include <vector>

#include "engine/event/event.h"

namespace aerascope {

// Refers to the events it was made from, which must outlive it.
class StateTimeline {
 public:
  // Keeps the states that really were (not those of simulations). Of several at one time the last recorded
  // counts.
  explicit StateTimeline(std::span<const Event> events);

  bool empty() const { return states_.empty(); }
  // In strictly increasing order of time.
  std::span<const WorldStateRecorded* const> states() const { return states_; }

  // The state that held at `time`: the last one recorded at or before it; before the first, the first. Null
  // if empty.
  const WorldStateRecorded* At(Time time) const;

 private:
  std::vector<const WorldStateRecorded*> states_;
};

}  // namespace aerascope
