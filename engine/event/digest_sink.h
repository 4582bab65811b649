// A DigestSink keeps nothing of the events but their digest: to compare runs without storing them.
#pragma once

#include "engine/event/event.h"

namespace aerascope {

class DigestSink : public EventSink {
 public:
  void Append(Event event) override { digest_.Add(event); }
  Hash128 Value() const { return digest_.Value(); }

 private:
  EventDigest digest_;
};

}  // namespace aerascope
