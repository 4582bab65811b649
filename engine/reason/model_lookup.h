// Which models could speak about a payload, by their left or right side: candidates, ascending by number,
// without deleted ones. A candidate may still fail to match.
#pragma once

#include <vector>

#include "engine/kb/knowledge_base.h"

namespace aerascope {

std::vector<ModelId> CandidatesByRhs(const KnowledgeBase& knowledge, const Term& payload);
std::vector<ModelId> CandidatesByLhs(const KnowledgeBase& knowledge, const Term& payload);

}  // namespace aerascope
