// A WebM file in memory: one video track of pictures that each last equally long, with an index of its key
// pictures (Cues) in front, so that a player can go to any of them at once.
//
// The layout is Matroska's as far as WebM uses it (RFC 9559): EBML header; Segment of SeekHead, Info, Tracks,
// Cues, Clusters. All sizes are known and written, times are whole milliseconds, and no date, random
// identifier or name of a library is inside: equal pictures give equal bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "viewer/render/image.h"

namespace aerascope {

// A picture as a codec packed it.
struct PackedPicture {
  std::string bytes;
  bool key = false;  // can be unpacked without those before it
};

struct WebmTrack {
  std::string_view codec = "V_VP9";
  PictureSize size;
  std::int64_t picture_ms = 50;  // how long each picture is shown; at least 1
};

// Picture i is shown from i * picture_ms on. The first picture should be a key one.
std::string WebmFile(const WebmTrack& track, const std::vector<PackedPicture>& pictures);

}  // namespace aerascope
