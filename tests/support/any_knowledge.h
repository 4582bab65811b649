// Whole knowledge bases made from a seed number, for laws that hold for all knowledge: models of every kind
// (causal with every form of guard, weak and strong requirements, requirements of requirements, reuse,
// drives), nested composite states, every kind of value, facts and anti-facts, with numbers and names in any
// order.
#pragma once

#include <cstdint>

#include "engine/replicode/seed.h"

namespace aerascope {

// The same number gives the same knowledge.
SeedKnowledge AnyKnowledge(std::uint64_t seed);

}  // namespace aerascope
