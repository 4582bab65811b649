#include "engine/episode/recorded_world.h"

#include "engine/event/event.h"

namespace aerascope {

RecordedWorld::RecordedWorld(const EpisodeFile& episode, std::size_t seed_facts) {
  Recorded* frame = nullptr;
  Time frame_start;
  for (const Event& event : episode.events) {
    if (const auto* started = std::get_if<FrameStarted>(&event.body)) {
      frame_start = started->interval.after;
      frame = &frames_[frame_start];
    } else if (const auto* fact = std::get_if<FactObserved>(&event.body)) {
      if (fact->source == FactSource::kProperty) properties_.push_back(fact->fact);
      if (!frame) continue;
      if (fact->source == FactSource::kSensor) frame->observed.push_back(fact->fact);
      if (fact->source == FactSource::kExecuted) frame->acted.executed.push_back(fact->fact.payload);
    } else if (const auto* state = std::get_if<WorldStateRecorded>(&event.body)) {
      if (!frame) continue;
      WorldState recorded{state->at, state->qpos, state->qvel, state->ctrl};
      if (state->at == frame_start) {
        frame->at_start = std::move(recorded);
      } else {
        frame->acted.states.push_back(std::move(recorded));
      }
    } else if (const auto* refused = std::get_if<CommandRefused>(&event.body)) {
      if (frame) frame->acted.notes.push_back(refused->reason);
    }
  }
  properties_.resize(properties_.size() - std::min(seed_facts, properties_.size()));
  current_ = frames_.end();
}

Result<std::vector<Fact>> RecordedWorld::Observe(TimeInterval frame) {
  current_ = frames_.find(frame.after);
  if (current_ == frames_.end()) {
    return Error{"the episode has no frame at " + ToText(frame.after) + ", but the reasoner wants to go on"};
  }
  state_ = current_->second.at_start;
  return current_->second.observed;
}

Result<ActOutcome> RecordedWorld::Act(std::span<const Term>, TimeInterval) {
  if (current_ == frames_.end()) return Error{"nothing was observed yet in this replay"};
  return current_->second.acted;
}

}  // namespace aerascope
