// Events as bytes for another thread (see term_packing.h): what is handed over is a copy that shares nothing
// with the events and terms it was made from, so neither thread waits for the other's memory.
//
// Always true: an unpacker that reads all that one packer wrote, in order, gives events with the same
// content, their terms made in the space its thread is in.
#pragma once

#include "engine/event/event.h"
#include "engine/kb/term_packing.h"

namespace aerascope {

class EventPacker {
 public:
  void Pack(const Event& event, PackedBytes* to);

 private:
  TermPacker terms_;
};

class EventUnpacker {
 public:
  Event Unpack(PackedReader* from);

 private:
  TermUnpacker terms_;
};

}  // namespace aerascope
