#include "engine/reason/journal.h"

#include <algorithm>

namespace aerascope {

EventId Journal::Write(Time time, EventBody body, const std::vector<EventId>& causes, SimulationId simulation) {
  Event event;
  event.id = EventId{++last_event_};
  event.time = time;
  event.frame = frame_;
  event.simulation = simulation;
  for (const EventId cause : causes) {
    if (cause.valid() && std::find(event.causes.begin(), event.causes.end(), cause) == event.causes.end()) {
      event.causes.push_back(cause);
    }
  }
  event.body = std::move(body);
  Apply(event, &knowledge_);
  const EventId id = event.id;
  sink_->Append(std::move(event));
  return id;
}

}  // namespace aerascope
