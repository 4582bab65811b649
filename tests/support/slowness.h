// How many times slower than usual the programs under test are. Under a sanitizer the build says so in the
// environment of every test, AERASCOPE_SLOWNESS=10; then a loop over generated cases tries fewer of them, and
// a test that looks at the clock is more patient. Python and JavaScript tests read the same variable.
#pragma once

#include <algorithm>
#include <cstdlib>

namespace aerascope {

inline int Slowness() {
  const char* said = std::getenv("AERASCOPE_SLOWNESS");
  return said == nullptr ? 1 : std::max(1, std::atoi(said));
}

// How many of that many generated cases are tried: all, or a share, but some of every law.
inline int CasesToTry(int cases) {
  return std::min(cases, std::max(20, cases / Slowness()));
}

}  // namespace aerascope
