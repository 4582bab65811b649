// A knowledge base as Replicode: what can be read back as a seed.
#pragma once

#include <iosfwd>

#include "engine/base/result.h"
#include "engine/kb/knowledge_base.h"

namespace aerascope {

// Fails, having written nothing, where something has no form in Replicode.
Status WriteKnowledgeAsReplicode(const KnowledgeBase& knowledge, std::ostream& out);

}  // namespace aerascope
