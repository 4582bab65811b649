// A position sensor reports a place in the plane as multiples of its resolution. The report stays as it is
// until the true place is further from it than the deadband, so that it neither flickers nor follows small
// slips.
//
// When the report changes, of the multiples within the deadband it takes the one that leaves the offset
// between the true and the reported place as it was: a thing that was carried by d is reported to have moved
// by d.
#pragma once

#include <array>
#include <optional>

namespace aerascope {

class PositionSensor {
 public:
  // With a deadband of 0 (or below half the resolution) the report is always the nearest multiple.
  PositionSensor(double resolution_m, double deadband_m)
      : resolution_m_(resolution_m), deadband_m_(deadband_m) {}

  // The report for this true place.
  std::array<double, 2> Report(std::array<double, 2> place_m);

 private:
  struct Axis {
    long long multiple = 0;
    double offset_m = 0;  // true minus reported, at the last report
  };
  long long Multiple(const Axis& axis, double place_m) const;

  double resolution_m_;
  double deadband_m_;
  std::optional<std::array<Axis, 2>> last_;
};

// multiple * resolution, as the double nearest to its decimal value.
double GridValue(long long multiple, double resolution_m);

}  // namespace aerascope
