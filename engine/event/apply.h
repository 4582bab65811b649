// Apply moves a knowledge base forward by one event: the one function used by the live reasoner and by every
// reader of a finished episode, so that what is shown cannot drift from what the agent had. Any moment is a
// fold of Apply over the events up to it.
#pragma once

#include "engine/event/event.h"
#include "engine/kb/knowledge_base.h"

namespace aerascope {

// Events in order of id. Events of simulations, and kinds that are only reported, change nothing but the
// clock.
void Apply(const Event& event, KnowledgeBase* knowledge_base);

}  // namespace aerascope
