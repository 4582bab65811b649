// The most memory this process has used so far, in MiB.
#pragma once

#include <sys/resource.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace aerascope {

inline double PeakMemoryMiB() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;  // Linux counts in KiB
}

// The same since the last ForgetPeakMemory, where the system can forget; else since the start.
inline void ForgetPeakMemory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}
inline double RecentPeakMemoryMiB() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    long kib = 0;
    if (std::sscanf(line.c_str(), "VmHWM: %ld kB", &kib) == 1) return static_cast<double>(kib) / 1024;
  }
  return PeakMemoryMiB();
}

}  // namespace aerascope
