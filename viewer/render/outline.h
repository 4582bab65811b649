// The outlines of the objects in a picture, as polygons to be drawn over it, and where to write their names.
//
// They follow what is visible: an object behind the hand has the outline of what the hand leaves of it, in as
// many pieces as there are; one that is not visible at all has none.
#pragma once

#include <string>
#include <vector>

#include "viewer/render/image.h"
#include "viewer/scene/scene_model.h"

namespace aerascope {

// In pixels from the picture's top left corner; whole numbers are borders between pixels.
struct PixelPoint {
  double x = 0;
  double y = 0;

  bool operator==(const PixelPoint&) const = default;
};

// A closed polygon without the first point repeated. Clockwise as seen: the outer border of a piece; the
// other way round: the border of a hole in one.
using Ring = std::vector<PixelPoint>;

struct Outline {
  std::string entity;
  std::vector<Ring> rings;  // sorted by the size of what they enclose, largest first
  int visible_pixels = 0;
  PixelPoint top_left;  // of the box around it
  PixelPoint bottom_right;
  PixelPoint label_anchor;  // above its middle, on the box; a name is written over this point
};

struct OutlineOptions {
  double tolerance_px = 1;       // no more than this is a polygon away from the border it stands for
  double smallest_area_px = 16;  // smaller pieces and holes are left out
};

// One outline for each entity of the model that is visible, in the model's order of entities.
std::vector<Outline> TraceOutlines(const SegmentImage& segments, const SceneModel& model,
                                   const OutlineOptions& options = {});

// The rings as the `d` of an SVG path: "M1 2L3 4...Z", coordinates rounded to 0.1. Meant for fill-rule
// evenodd.
std::string SvgPath(const std::vector<Ring>& rings);

}  // namespace aerascope
