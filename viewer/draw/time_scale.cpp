#include "viewer/draw/time_scale.h"

#include <algorithm>

namespace aerascope {

TimeScale::TimeScale(Time from, Time to, int left, int right)
    : from_(from), to_(std::max(to, from + Duration{1})), left_(left), right_(std::max(left, right)) {}

int TimeScale::X(Time t) const {
  const Time inside = std::clamp(t, from_, to_);
  const double share = static_cast<double>((inside - from_).us) / static_cast<double>((to_ - from_).us);
  return left_ + static_cast<int>(share * (right_ - left_) + 0.5);
}

std::vector<Time> TimeScale::Ticks(int min_gap) const {
  const std::int64_t length = (to_ - from_).us;
  const std::int64_t most = std::max(1, (right_ - left_) / std::max(1, min_gap));
  // The factors 2, 5/2, 2 in turn give 1, 2, 5, 10, 20 and so on.
  std::int64_t step = 1;
  for (int round = 0; length / step > most && step < length; ++round)
    step = round % 3 == 1 ? step / 2 * 5 : step * 2;
  std::vector<Time> ticks;
  const std::int64_t first = from_.us <= 0 ? from_.us / step : (from_.us + step - 1) / step;
  for (std::int64_t k = first; k * step <= to_.us; ++k) ticks.push_back({k * step});
  return ticks;
}

}  // namespace aerascope
