// A VideoWriter makes a small video of pictures: VP9 by libvpx in a WebM file.
//
// Each picture is shown equally long, a whole number of milliseconds, so that the place of a moment in the
// video follows by division. Key pictures come at fixed distances, so that any picture is reached by
// unpacking a few. Encoding runs in one thread beside the caller's with settings that do not depend on time
// or machine: the same pictures give the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "viewer/render/image.h"

namespace aerascope {

inline constexpr std::string_view kVideoMime = "video/webm; codecs=\"vp9\"";

struct VideoOptions {
  PictureSize size;              // even numbers of pixels, at least 2
  std::int64_t picture_ms = 50;  // how long each picture is shown
  int quantizer = 28;            // 0 (best) to 63 (smallest)
  int key_distance = 20;         // pictures from one key picture to the next
};

class VideoWriter {
 public:
  static Result<VideoWriter> Create(const VideoOptions& options);
  ~VideoWriter();
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;

  // The next picture; of the size of the video.
  Status Add(Image image);
  // The last picture once more; only after one was added.
  Status Repeat();
  std::size_t pictures() const;

  // The file. Nothing may be added afterwards.
  Result<std::string> Finish();

 private:
  class Encoder;
  explicit VideoWriter(std::unique_ptr<Encoder> encoder);
  std::unique_ptr<Encoder> encoder_;
};

}  // namespace aerascope
