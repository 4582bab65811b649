// A Model is one rule "left side -> right side": a causal model (CM), a requirement model (M_req, weak or
// strong), a reuse model or a drive model; which one, its two sides tell (semantics 2).
//
// Template arguments are values a causal model needs but cannot read from its left side; a requirement
// supplies them. An instance is the payload `(imdl mdl_1 [template] [exposed])`, exposed being all other
// variables but the left side's interval, in order of their numbers (semantics 1.3).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/kb/fact.h"

namespace aerascope {

enum class ModelKind { kCausal, kWeakRequirement, kStrongRequirement, kReuse, kDrive };

struct Model {
  ModelId id;
  std::vector<Term> template_arguments;  // variables, or (ti after before) of two variables
  FactPattern lhs;
  FactPattern rhs;
  std::vector<Guard> forward;               // compute the right side from left side and template
  std::vector<Guard> backward;              // compute left side and template from the right side
  std::vector<std::string> variable_names;  // for people; index = variable number; not part of the identity

  bool operator==(const Model&) const = default;
};

ModelKind KindOf(const Model& model);
std::string_view ToText(ModelKind kind);  // "causal model", "requirement model", ...

inline bool IsRequirement(const Model& model) {
  const ModelKind kind = KindOf(model);
  return kind == ModelKind::kWeakRequirement || kind == ModelKind::kStrongRequirement;
}

// The causal model a requirement model speaks about, or the one a reuse model rides on; else an invalid id.
ModelId TargetModel(const Model& requirement);
// The composite state on a requirement model's left side; invalid if its left side is a plain fact.
CompositeStateId RequiredState(const Model& requirement);

// The numbers of the variables of the template arguments, and of the exposed arguments, in order.
std::vector<int> TemplateVariables(const Model& model);
std::vector<int> ExposedVariables(const Model& model);

// The payload of an instance under bindings; unbound variables stay variables of the model.
Term InstancePayload(const Model& model, const Bindings& bindings);
// Binds the model's variables from an instance's template and exposed lists. False where they do not agree.
bool BindInstance(const Model& model, const Term& imdl_payload, Bindings& bindings);

std::string ToText(const Model& model);

Term DefinitionToTerm(const Model& model);
std::optional<Model> ModelFromTerm(ModelId id, const Term& definition);

// How often a model was tried and was right: confidence (success rate) = positive / total (semantics 3.5).
struct Evidence {
  double positive = 1;
  double total = 1;

  double rate() const { return total > 0 ? positive / total : 0; }
  bool operator==(const Evidence&) const = default;
};

}  // namespace aerascope
