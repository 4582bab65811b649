// An Event is one thing that happened: when, what (a body, event_body.h), and because of which earlier
// events.
//
// Always true: (1) ids count up by one from 1; (2) every cause is an earlier event; (3) an event without
// causes is of a kind for which MayBeUncaused says so: everything else in an episode has an explanation.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/hash.h"
#include "engine/event/event_body.h"

namespace aerascope {

struct Event {
  EventId id;
  Time time;                    // engine time at which it happened
  std::int64_t frame = 0;       // sampling periods since the start
  SimulationId simulation;      // valid for what happened only in the head
  std::vector<EventId> causes;  // earlier events, most direct first, no repeats
  EventBody body;
};

std::string_view KindName(const EventBody& body);
// The kind with this name, as the position in EventBody; kEventKinds if there is none.
std::size_t KindOfName(std::string_view name);

// Observations, drives, seed knowledge, a teacher's command, the start, frames and the end stand for
// themselves.
bool MayBeUncaused(const EventBody& body);

// Where events go. Append may keep or copy the event; it does not fail (a sink that meets trouble reports it
// when it is finished, so that the engine's reasoning never waits for a disk).
class EventSink {
 public:
  virtual ~EventSink() = default;
  virtual void Append(Event event) = 0;
};

// One event as one line for people: "0.7s #214 PredictionMade ...", every field named.
std::string ToText(const Event& event);

// The exact content of an event as bytes: equal events, equal bytes; the digest runs over these.
std::string EncodeForDigest(const Event& event);

// The digest of an event stream: a hash over EncodeForDigest of each, in order.
class EventDigest {
 public:
  void Add(const Event& event);
  Hash128 Value() const { return hasher_.Digest(); }

 private:
  Hasher hasher_;
};

}  // namespace aerascope
