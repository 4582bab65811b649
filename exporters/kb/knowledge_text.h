// A knowledge base as text for people: causal models, under each what is known of when it works, then
// composite states that were given or are parts of others, then drive models.
#pragma once

#include <iosfwd>

#include "engine/base/result.h"
#include "engine/kb/knowledge_base.h"

namespace aerascope {

Status WriteKnowledgeText(const KnowledgeBase& knowledge, std::ostream& out);

}  // namespace aerascope
