// A picture of the world inside a drawing, with the outlines and names of what the words beside it speak of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/time.h"
#include "viewer/draw/svg.h"
#include "viewer/draw/theme.h"

namespace aerascope {

struct SheetPoint {
  double x = 0;
  double y = 0;
};

// An object in a still, in pixels of the still. Outlined where the caption names it.
struct SheetObject {
  std::string name;
  std::vector<SheetPoint> outline;  // a closed polygon; empty: no outline
  SheetPoint label;                 // the middle of its name's base line
};

struct SheetFrame {
  Time at;
  std::string png;  // PNG bytes
  std::vector<SheetObject> objects;
};

// Fills `place` with the picture, cut at the sides or above and below. Outlined and named are the objects
// whose names stand in `words`. An error if the picture is not a PNG.
Status DrawStill(Svg& svg, const SheetFrame& frame, const Rect& place, std::string_view words,
                 const Theme& theme);

}  // namespace aerascope
