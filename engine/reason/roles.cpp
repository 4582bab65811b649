#include "engine/reason/roles.h"

#include <algorithm>

namespace aerascope {
namespace {

// Knowledge nests as deep as it was built; a definition that refers to itself cannot be read in, so this only
// bounds the work.
constexpr int kMaxNesting = 16;

std::string RoleIn(const CompositeState& state, int variable, const KnownDefinitions& knowledge, int depth);
std::string RoleIn(const Model& model, int variable, const KnownDefinitions& knowledge, int depth);

bool Contains(const Term& term, int variable) {
  bool found = false;
  ForEachVariable(term, [&](int v) { found = found || v == variable; });
  return found;
}

// The entries of a list, with (ti a b) opened.
std::vector<Term> Flattened(const Term& list) {
  std::vector<Term> flat;
  for (const Term& item : list.items()) {
    if (item.IsStruct("ti")) {
      flat.insert(flat.end(), item.items().begin(), item.items().end());
    } else {
      flat.push_back(item);
    }
  }
  return flat;
}

// The role of the i-th entry of an instance's template or argument list.
std::string RoleOfEntry(const Term& instance, bool in_template, std::size_t i,
                        const KnownDefinitions& knowledge, int depth) {
  if (IsIcst(instance) && instance[0].is(TermKind::kCompositeState)) {
    const CompositeState* state = knowledge.Find(instance[0].composite_state());
    if (!state || in_template) return "";
    const std::vector<int> arguments = ArgumentVariables(*state);
    return i < arguments.size() ? RoleIn(*state, arguments[i], knowledge, depth + 1) : "";
  }
  if (!IsImdl(instance) || !instance[0].is(TermKind::kModel)) return "";
  const Model* model = knowledge.Find(instance[0].model());
  if (!model) return "";
  if (in_template) {
    const std::vector<Term> patterns = Flattened(Term::Set(model->template_arguments));
    if (i >= patterns.size() || !patterns[i].is(TermKind::kVariable)) return "";
    return RoleIn(*model, patterns[i].variable(), knowledge, depth + 1);
  }
  const std::vector<int> exposed = ExposedVariables(*model);
  return i < exposed.size() ? RoleIn(*model, exposed[i], knowledge, depth + 1) : "";
}

// Where in a payload the variable stands; "" if nowhere, or where no role is.
std::string RoleInPayload(const Term& payload, int variable, const KnownDefinitions& knowledge, int depth) {
  if (depth > kMaxNesting) return "";
  if (IsValue(payload)) {
    return Contains(payload[2], variable) && payload[1].is(TermKind::kOntology) ? payload[1].name() : "";
  }
  if (IsCommand(payload)) {
    for (std::size_t i = 0; i < payload[1].size(); ++i) {
      if (Contains(payload[1][i], variable)) return ArgumentRole(i);
    }
    return "";
  }
  if (!IsIcst(payload) && !IsImdl(payload)) return "";
  for (const bool in_template : {true, false}) {
    const std::vector<Term> entries = Flattened(payload[in_template ? 1 : 2]);
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (!Contains(entries[i], variable)) continue;
      std::string role = RoleOfEntry(payload, in_template, i, knowledge, depth);
      if (!role.empty()) return role;
    }
  }
  return "";
}

std::string RoleIn(const CompositeState& state, int variable, const KnownDefinitions& knowledge, int depth) {
  for (const FactPattern& component : state.components) {
    std::string role = RoleInPayload(component.payload, variable, knowledge, depth);
    if (!role.empty()) return role;
  }
  return "";
}

std::string RoleIn(const Model& model, int variable, const KnownDefinitions& knowledge, int depth) {
  if (depth > kMaxNesting) return "";
  const Term wanted = Term::Variable(variable);
  for (const Term& argument : model.template_arguments) {
    if (!argument.IsStruct("ti") || argument.size() != 2) continue;
    if (argument[0] == wanted) return kTemplateAfter;
    if (argument[1] == wanted) return kTemplateBefore;
  }
  if (model.rhs.after == wanted) return kEffectAfter;
  if (model.rhs.before == wanted) return kEffectBefore;
  if (model.lhs.after == wanted) return kCauseAfter;
  if (model.lhs.before == wanted) return kCauseBefore;
  for (const FactPattern* side : {&model.rhs, &model.lhs}) {
    std::string role = RoleInPayload(side->payload, variable, knowledge, depth);
    if (!role.empty()) return role;
  }
  // A template value from which the effect's value is computed is of the same kind: P1 := P0 + D.
  for (const Guard& guard : model.forward) {
    if (!guard.target || guard.expression.size() != 2 || !(guard.expression[0] == wanted)) continue;
    std::string role = RoleInPayload(model.rhs.payload, *guard.target, knowledge, depth);
    if (!role.empty()) return role;
  }
  return "";
}

void VisitValues(const Term& value, const std::string& role, const VisitValue& visit) {
  if (value.is(TermKind::kEntity) || value.is(TermKind::kTime) || IsQuantity(value))
    return visit(value, role);
  for (const Term& item : value.items()) VisitValues(item, role, visit);
}

}  // namespace

const CompositeState* KnownDefinitions::Find(CompositeStateId id) const {
  if (in_the_making_ && in_the_making_->id == id) return in_the_making_;
  const CompositeStateRecord* record = knowledge_.Find(id);
  return record ? &record->state : nullptr;
}

const Model* KnownDefinitions::Find(ModelId id) const {
  const ModelRecord* record = knowledge_.Find(id);
  return record ? &record->model : nullptr;
}

bool IsQuantity(const Term& value) {
  if (value.is(TermKind::kNumber)) return true;
  if (!value.is(TermKind::kStruct) || value.size() == 0) return false;
  return std::all_of(value.items().begin(), value.items().end(),
                     [](const Term& item) { return item.is(TermKind::kNumber); });
}

bool HasRole(const Term& value, ValueRoles roles) {
  if (value.is(TermKind::kEntity)) return false;
  return roles == ValueRoles::kApart || !IsQuantity(value);
}

std::string ArgumentRole(std::size_t i) {
  return "argument " + std::to_string(i);
}

std::string RoleOfVariable(const CompositeState& state, int variable, const KnownDefinitions& knowledge) {
  return RoleIn(state, variable, knowledge, 0);
}

std::string RoleOfVariable(const Model& model, int variable, const KnownDefinitions& knowledge) {
  return RoleIn(model, variable, knowledge, 0);
}

void ForEachValue(const Term& payload, const KnownDefinitions& knowledge, const VisitValue& visit) {
  if (IsValue(payload)) {
    VisitValues(payload[0], "", visit);
    VisitValues(payload[2], payload[1].name(), visit);
    return;
  }
  if (IsCommand(payload)) {
    for (std::size_t i = 0; i < payload[1].size(); ++i) VisitValues(payload[1][i], ArgumentRole(i), visit);
    return;
  }
  if (IsIcst(payload) || IsImdl(payload)) {
    for (const bool in_template : {true, false}) {
      const std::vector<Term> entries = Flattened(payload[in_template ? 1 : 2]);
      for (std::size_t i = 0; i < entries.size(); ++i) {
        VisitValues(entries[i], RoleOfEntry(payload, in_template, i, knowledge, 0), visit);
      }
    }
    return;
  }
  VisitValues(payload, "", visit);
}

void SharedValues::Add(const Term& payload) {
  ForEachValue(payload, knowledge_, [&](const Term& value, const std::string& role) {
    if (!value.is(TermKind::kTime) && !Contains(value, role)) entries_.push_back({value, role});
  });
}

bool SharedValues::SharedBy(const Term& payload) const {
  bool shared = false;
  ForEachValue(payload, knowledge_, [&](const Term& value, const std::string& role) {
    shared = shared || (!value.is(TermKind::kTime) && Contains(value, role));
  });
  return shared;
}

bool SharedValues::Contains(const Term& value, const std::string& role) const {
  return std::any_of(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    return SameValue(entry.value, value) && (entry.role == role || !HasRole(value, roles_));
  });
}

}  // namespace aerascope
