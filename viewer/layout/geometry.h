// Whole-number geometry of drawings: y grows downwards, one unit is one CSS pixel at scale 1.
#pragma once

#include <compare>
#include <cstddef>

namespace aerascope {

struct Point {
  int x = 0;
  int y = 0;
  auto operator<=>(const Point&) const = default;
};

struct Size {
  int width = 0;
  int height = 0;
  auto operator<=>(const Size&) const = default;
};

struct Rect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  auto operator<=>(const Rect&) const = default;

  constexpr int right() const { return x + width; }
  constexpr int bottom() const { return y + height; }
  constexpr Point centre() const { return {x + width / 2, y + height / 2}; }
};

// Whether the insides meet; rectangles that only touch do not overlap.
constexpr bool Overlap(const Rect& a, const Rect& b) {
  return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

}  // namespace aerascope
