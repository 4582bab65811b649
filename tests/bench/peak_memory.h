// The most memory this process has used so far, in MiB.
#pragma once

#include <sys/resource.h>

namespace aerascope {

inline double PeakMemoryMiB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

}  // namespace aerascope
