// Shipped scenarios, lived through for tests of drawings.
#pragma once

#include <string>

#include "engine/query/run.h"

namespace aerascope {

// The run of a scripted scenario of assets/scenarios, by the name of its file. One without events, and a
// failure of the test, where it cannot be run.
Run ScenarioRun(const std::string& name);

}  // namespace aerascope
