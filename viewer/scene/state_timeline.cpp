#include "viewer/scene/state_timeline.h"

#include <algorithm>
#include <variant>

namespace aerascope {

StateTimeline::StateTimeline(std::span<const Event> events) {
  for (const Event& event : events) {
    const auto* state = std::get_if<WorldStateRecorded>(&event.body);
    if (state != nullptr && !event.simulation.valid()) states_.push_back(state);
  }
  std::stable_sort(states_.begin(), states_.end(),
                   [](const auto* a, const auto* b) { return a->at < b->at; });
  // Going backwards, the first of equal times is the one recorded last.
  const auto kept = std::unique(states_.rbegin(), states_.rend(), [](const auto* later, const auto* earlier) {
    return later->at == earlier->at;
  });
  states_.erase(states_.begin(), kept.base());
}

const WorldStateRecorded* StateTimeline::At(Time time) const {
  if (states_.empty()) return nullptr;
  const auto after = std::upper_bound(states_.begin(), states_.end(), time,
                                      [](Time t, const WorldStateRecorded* state) { return t < state->at; });
  return after == states_.begin() ? states_.front() : *std::prev(after);
}

}  // namespace aerascope
