// Builds a causal model or a reuse model from one observed change and its cause (semantics 5.1): the template
// is what was before and when, the left side the cause, the right side the effect, joined by guards.
#pragma once

#include "engine/kb/knowledge_base.h"
#include "engine/reason/guard_form.h"

namespace aerascope {

// A model together with the values its variables had in the case it was made from.
struct ModelInstance {
  Model model;
  Bindings values;
};

// All facts are ground and of one attribute of one thing before and after.
struct ObservedChange {
  Fact premise;
  Fact cause;  // a command, a value, or (imdl ...) of another model: then the result is a reuse model
  Fact consequent;
};

ModelInstance BuildCausalModel(const ObservedChange& observed, const Formula& formula,
                               const KnowledgeBase& knowledge, ValueRoles roles);

// Assigns `op(a, b)` to the variable `target`.
Guard Assignment(const Term& target, const char* op, const Term& a, const Term& b);

}  // namespace aerascope
