// The Journal is how the reasoner says what happens: it numbers events and objects, applies each event to the
// knowledge base with the same Apply every reader uses, and passes it on to the sink.
//
// Kinds that are left out (report_kinds.h) are neither numbered nor applied nor passed on. Whoever names such
// an event as a cause names that event's own causes instead, so that "why?" leads on past the gap.
//
// Always true: the knowledge base is exactly the fold of the events passed on so far.
#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "engine/event/apply.h"
#include "engine/event/event.h"
#include "engine/event/report_kinds.h"

namespace aerascope {

class Journal {
 public:
  // The sink outlives the journal.
  explicit Journal(EventSink* sink) : sink_(sink) {}

  // From now on events of these kinds, which must be report kinds, are left out.
  void LeaveOut(const EventKindSet& kinds);
  // Whether events of this kind are recorded; where they are many, the work of making them can be saved.
  template <class Body>
  bool Records() const {
    return !left_out_[KindOf<Body>()];
  }

  const KnowledgeBase& knowledge() const { return knowledge_; }

  // The next number of the one numbering that all objects share, as an id of the kind asked for.
  template <class IdType>
  IdType NewId() {
    return IdType{++last_object_};
  }

  // Causes that are invalid or repeated are left out. The result names this event as a cause of later ones,
  // also if the event itself was left out, and is good for nothing else.
  EventId Write(Time time, EventBody body, const std::vector<EventId>& causes = {},
                SimulationId simulation = {});

  // The like of a black-listed model was put together again, so that it is not to be forgotten yet.
  void ComeUpAgain(ModelId black_listed) { come_up_again_.push_back(black_listed); }
  // Those since the last call.
  std::vector<ModelId> TakeComeUpAgain() { return std::exchange(come_up_again_, {}); }

  void StartFrame(std::int64_t frame) { frame_ = frame; }
  std::int64_t frame() const { return frame_; }
  // What the last Write gave.
  EventId last_event() const { return last_written_; }

 private:
  std::vector<EventId> Recorded(const std::vector<EventId>& causes) const;
  EventId StandInFor(std::vector<EventId> causes);

  EventSink* sink_;
  KnowledgeBase knowledge_;
  EventKindSet left_out_;
  // Stand-ins for events left out, where one recorded event cannot stand for them: -1, -2, ... are these
  // lists of recorded causes, each kept once.
  std::vector<std::vector<EventId>> stand_ins_;
  std::map<std::vector<EventId>, EventId> stand_in_by_causes_;
  std::vector<ModelId> come_up_again_;
  std::int64_t last_object_ = 0;
  std::int64_t last_event_ = 0;
  EventId last_written_;
  std::int64_t frame_ = 0;
};

}  // namespace aerascope
