// The Journal is how the reasoner says what happens: it numbers events and objects, applies each event to the knowledge
// base with the same Apply every reader uses, and passes it on to the sink.
//
// Always true: the knowledge base is exactly the fold of the events written so far.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/event/apply.h"
#include "engine/event/event.h"

namespace aerascope {

class Journal {
 public:
  // The sink outlives the journal.
  explicit Journal(EventSink* sink) : sink_(sink) {}

  const KnowledgeBase& knowledge() const { return knowledge_; }

  // The next number of the one numbering that all objects share, as an id of the kind asked for.
  template <class IdType>
  IdType NewId() {
    return IdType{++last_object_};
  }

  // Causes that are invalid or repeated are left out.
  EventId Write(Time time, EventBody body, const std::vector<EventId>& causes = {}, SimulationId simulation = {});

  void StartFrame(std::int64_t frame) { frame_ = frame; }
  std::int64_t frame() const { return frame_; }
  EventId last_event() const { return {last_event_}; }

 private:
  EventSink* sink_;
  KnowledgeBase knowledge_;
  std::int64_t last_object_ = 0;
  std::int64_t last_event_ = 0;
  std::int64_t frame_ = 0;
};

}  // namespace aerascope
