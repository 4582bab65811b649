// Any bytes as a scenario: the reader answers with a scenario or an error.
#include <cstdint>

#include "tests/fuzz/scenario_text.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  (void)aerascope::ScenarioFromText({reinterpret_cast<const char*>(data), size});
  return 0;
}
