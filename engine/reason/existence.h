// The existence check: before learned knowledge is adopted, an equal one is looked for by content
// (semantics 3.5, white and black list). One that is alive is used in its place; one that failed and was
// deleted forbids it.
#pragma once

#include "engine/kb/knowledge_base.h"
#include "engine/reason/causal_model_builder.h"

namespace aerascope {

// The equal model that is alive or black-listed; null if there is none, or only one that was deleted for
// another reason than its own failure.
const ModelRecord* FindEqual(const Model& model, const KnowledgeBase& knowledge);

// The same instance in the variables of a known model equal to it.
ModelInstance InTermsOf(const ModelRecord& known, const ModelInstance& instance,
                        const KnowledgeBase& knowledge);

}  // namespace aerascope
