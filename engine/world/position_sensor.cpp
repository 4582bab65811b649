#include "engine/world/position_sensor.h"

#include <algorithm>
#include <cmath>

namespace aerascope {

double GridValue(long long multiple, double resolution_m) {
  return std::round(static_cast<double>(multiple) * resolution_m * 1e9) / 1e9 + 0.0;  // + 0.0: never -0
}

long long PositionSensor::Multiple(const Axis& axis, double place_m) const {
  const double reported_m = static_cast<double>(axis.multiple) * resolution_m_;
  if (std::abs(place_m - reported_m) <= deadband_m_) return axis.multiple;
  const double offset_m = std::clamp(axis.offset_m, -deadband_m_, deadband_m_);
  const long long carried = std::llround((place_m - offset_m) / resolution_m_);
  const bool fits = std::abs(place_m - static_cast<double>(carried) * resolution_m_) <= deadband_m_;
  return fits ? carried : std::llround(place_m / resolution_m_);
}

std::array<double, 2> PositionSensor::Report(std::array<double, 2> place_m) {
  std::array<Axis, 2> now;
  for (int k = 0; k < 2; ++k) {
    const double place = std::clamp(place_m[k], -1e6, 1e6);
    now[k].multiple = last_ ? Multiple((*last_)[k], place) : std::llround(place / resolution_m_);
    now[k].offset_m = place - static_cast<double>(now[k].multiple) * resolution_m_;
  }
  last_ = now;
  return {GridValue(now[0].multiple, resolution_m_), GridValue(now[1].multiple, resolution_m_)};
}

}  // namespace aerascope
