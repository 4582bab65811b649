// A time axis: engine time to x, and the round instants that get a number.
#pragma once

#include <string>
#include <vector>

#include "engine/base/time.h"

namespace aerascope {

class TimeScale {
 public:
  // Times from..to over left..right. An empty interval is drawn as if a microsecond long.
  TimeScale(Time from, Time to, int left, int right);

  // Held inside left..right.
  int X(Time t) const;
  int left() const { return left_; }
  int right() const { return right_; }

  // Whole multiples of 1, 2 or 5 times a power of ten, at least `min_gap` pixels apart, in order.
  std::vector<Time> Ticks(int min_gap) const;

 private:
  Time from_;
  Time to_;
  int left_;
  int right_;
};

}  // namespace aerascope
