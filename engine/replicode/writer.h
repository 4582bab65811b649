// Writes knowledge as Replicode text that ReadReplicode reads back to the same content (the same canonical
// hashes).
#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/replicode/seed.h"

namespace aerascope {

// Fails only where something has no form in Replicode, e.g. a name with a space.
Result<std::string> WriteReplicode(const SeedKnowledge& seed);

// One payload, as it would stand inside a fact; references are written cst_12, mdl_14.
Result<std::string> WritePayload(const Term& payload);

}  // namespace aerascope
