// What Replicode can say: the shape knowledge must have so that its text is read back as the same knowledge.
//
// Knowledge that an agent gives itself or reads always has this shape; knowledge from a damaged file, or from
// a test, may not, and is then refused in a sentence instead of written as a text that means something else.
#pragma once

#include "engine/base/result.h"
#include "engine/replicode/seed.h"

namespace aerascope {

// `seed` is normalised. An error names what cannot be said.
Status CheckSayable(const SeedKnowledge& seed);

}  // namespace aerascope
