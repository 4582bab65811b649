// A picture in memory, and its size.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace aerascope {

struct PictureSize {
  int width = 0;
  int height = 0;

  bool operator==(const PictureSize&) const = default;
};

// 8 bits a channel; three bytes a pixel (red, green, blue), rows from top to bottom without gaps.
struct Image {
  PictureSize size;
  std::vector<std::uint8_t> rgb;

  bool operator==(const Image&) const = default;
};

// For each pixel, rows from top to bottom, the number of the model's geom that is seen there; -1 for
// background and for shapes that are no geoms.
struct SegmentImage {
  PictureSize size;
  std::vector<std::int32_t> geom;
};

}  // namespace aerascope
