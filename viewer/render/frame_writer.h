// A FrameWriter encodes pictures in a thread of its own, so that the next one can be drawn meanwhile.
//
// One thread adds pictures and finishes; the encoder and the sink are called in the writer's thread. Always
// true: (1) equal pictures are encoded once; (2) the sink gets the different pictures in the order in which
// they were first added, numbered from 0; (3) only a few pictures wait at a time, whatever the length of the
// film.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "engine/base/result.h"
#include "viewer/render/encode.h"
#include "viewer/render/image.h"

namespace aerascope {

class FrameWriter {
 public:
  using Sink = std::function<Status(std::size_t number, std::string bytes)>;

  FrameWriter(Encoder encoder, Sink sink);
  // Drops what waits.
  ~FrameWriter();
  FrameWriter(const FrameWriter&) = delete;
  FrameWriter& operator=(const FrameWriter&) = delete;

  // The number of this picture among the different ones. Waits while too many are in line. After a failure,
  // pictures are numbered as before but not encoded any more.
  std::size_t Add(Image image);

  // Waits until all are encoded; the first failure of encoder or sink, if there was one. Nothing may be added
  // afterwards.
  Status Finish();

 private:
  class Queue;
  std::unique_ptr<Queue> queue_;
};

}  // namespace aerascope
