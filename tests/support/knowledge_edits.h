// Knowledge bases compared, and changed on purpose: the same content under other numbers and in another
// order, for laws about identity.
#pragma once

#include <cstdint>
#include <string>

#include "engine/event/event.h"
#include "engine/kb/knowledge_base.h"

namespace aerascope {

// All that a knowledge base holds and what its indexes say, as text: equal texts, equal knowledge bases.
std::string Everything(const KnowledgeBase& knowledge);

// The fold of the events.
KnowledgeBase KnowledgeFrom(const std::vector<Event>& events);

// The same composite states and models with the same evidence: numbered anew, created in another order (what
// is referred to comes first), components of composite states shuffled, variables without names.
KnowledgeBase Renumbered(const KnowledgeBase& knowledge, std::uint64_t seed);

}  // namespace aerascope
