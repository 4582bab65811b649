// Builds a requirement model from one case: under this condition that model was right (weak), or wrong
// (strong). What condition and model instance have in common becomes a shared variable (semantics 5.1, M1,
// and 5.2).
#pragma once

#include <optional>

#include "engine/kb/knowledge_base.h"
#include "engine/reason/causal_model_builder.h"
#include "engine/reason/roles.h"

namespace aerascope {

struct RequirementCase {
  Fact condition;        // ground: an instance of a composite state, or a plain fact
  ModelInstance target;  // of the model spoken about
  TimeInterval valid;    // when it was right or wrong; later than the condition, guards add the difference
  bool right = true;
};

// Nothing if the model's effect holds a value that neither its left side nor the condition gives. The id is
// left invalid.
std::optional<Model> BuildRequirement(const RequirementCase& observed, const KnownDefinitions& knowledge,
                                      ValueRoles roles);

// The variables of a model's effect that must come from a requirement model: template, left side and guards
// do not give them.
std::vector<int> EffectVariablesLeftOpen(const Model& model);

// The two instants of a template list such as [v (ti a b)] or [v a b], if it has them: the interval for which
// a requirement speaks.
std::optional<TimeInterval> TemplateInterval(const Term& ground_template);

}  // namespace aerascope
