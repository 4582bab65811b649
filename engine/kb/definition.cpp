// Composite states and models: what their instances expose, and their definitions as text and as terms.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <set>

#include "engine/base/text.h"
#include "engine/kb/composite_state.h"
#include "engine/kb/model.h"

namespace aerascope {
namespace {

// Variables in ascending order. Numbers are small: the first 64 are bits.
class VariableSet {
 public:
  void Add(int variable) {
    if (variable < 64) {
      few_ |= std::uint64_t{1} << variable;
    } else {
      many_.insert(variable);
    }
  }
  void Add(const Term& term) {
    ForEachVariable(term, [&](int v) { Add(v); });
  }
  void Add(const FactPattern& pattern) {
    Add(pattern.payload);
    Add(pattern.after);
    Add(pattern.before);
  }
  void Add(const std::vector<Guard>& guards) {
    for (const Guard& guard : guards) {
      if (guard.target) Add(*guard.target);
      Add(guard.expression);
    }
  }
  void Erase(const Term& term) {
    if (term.is(TermKind::kVariable)) Erase(term.variable());
  }
  void Erase(int variable) {
    if (variable < 64) {
      few_ &= ~(std::uint64_t{1} << variable);
    } else {
      many_.erase(variable);
    }
  }
  std::vector<int> Ascending() const {
    std::vector<int> variables;
    variables.reserve(static_cast<std::size_t>(std::popcount(few_)) + many_.size());
    for (std::uint64_t rest = few_; rest != 0; rest &= rest - 1) variables.push_back(std::countr_zero(rest));
    variables.insert(variables.end(), many_.begin(), many_.end());
    return variables;
  }

 private:
  std::uint64_t few_ = 0;
  std::set<int> many_;
};

Term ToTerm(const Guard& guard) {
  if (!guard.target) return guard.expression;
  return Term::Struct(":=", {Term::Variable(*guard.target), guard.expression});
}

Term ToTerm(const std::vector<Guard>& guards) {
  std::vector<Term> terms;
  for (const Guard& guard : guards) terms.push_back(ToTerm(guard));
  return Term::Set(std::move(terms));
}

std::optional<std::vector<Guard>> GuardsFromTerm(const Term& term) {
  if (!term.is(TermKind::kSet)) return std::nullopt;
  std::vector<Guard> guards;
  for (const Term& item : term.items()) {
    if (!item.is(TermKind::kStruct) || item.size() != 2) return std::nullopt;
    if (item.name() != ":=") {
      guards.push_back({std::nullopt, item});
    } else if (item[0].is(TermKind::kVariable)) {
      guards.push_back({item[0].variable(), item[1]});
    } else {
      return std::nullopt;
    }
  }
  return guards;
}

Term NamesToTerm(const std::vector<std::string>& names) {
  std::vector<Term> terms;
  for (const std::string& name : names) terms.push_back(Term::String(name));
  return Term::Set(std::move(terms));
}

std::optional<std::vector<std::string>> NamesFromTerm(const Term& term) {
  if (!term.is(TermKind::kSet)) return std::nullopt;
  std::vector<std::string> names;
  for (const Term& item : term.items()) {
    if (!item.is(TermKind::kString)) return std::nullopt;
    names.push_back(item.name());
  }
  return names;
}

bool BindList(const Term& pattern_list, const Term& values, Bindings& bindings) {
  return values.is(TermKind::kSet) && values.size() == pattern_list.size() &&
         Match(pattern_list, values, bindings);
}

Term VariableList(const std::vector<int>& variables) {
  std::vector<Term> terms;
  terms.reserve(variables.size());
  for (const int v : variables) terms.push_back(Term::Variable(v));
  return Term::Set(terms);
}

// The values of the variables; one that is not bound stays itself.
Term ValueList(const std::vector<int>& variables, const Bindings& bindings) {
  std::vector<Term> terms;
  terms.reserve(variables.size());
  for (const int v : variables) {
    const Term* value = bindings.Find(v);
    terms.push_back(value ? *value : Term::Variable(v));
  }
  return Term::Set(terms);
}

std::string GuardLines(std::string_view title, const std::vector<Guard>& guards,
                       std::span<const std::string> variable_names) {
  std::string text;
  for (const Guard& guard : guards) text += "  " + std::string(title) + ToText(guard, variable_names) + "\n";
  return text;
}

}  // namespace

std::vector<int> ArgumentVariables(const CompositeState& state) {
  VariableSet variables;
  for (const FactPattern& component : state.components) variables.Add(component);
  variables.Add(state.guards);
  if (!state.components.empty()) {
    variables.Erase(state.components[0].after);
    variables.Erase(state.components[0].before);
  }
  return variables.Ascending();
}

Term InstancePayload(const CompositeState& state, const Bindings& bindings) {
  return Term::Struct("icst", {Term::Reference(state.id), Term::Set(std::span<const Term>{}),
                               ValueList(ArgumentVariables(state), bindings)});
}

bool BindInstance(const CompositeState& state, const Term& icst_payload, Bindings& bindings) {
  return IsIcst(icst_payload) && BindList(VariableList(ArgumentVariables(state)), icst_payload[2], bindings);
}

std::string ToText(const CompositeState& state) {
  std::string text = "cst_" + std::to_string(state.id.value) + "\n";
  for (const FactPattern& component : state.components) {
    text += "  " + ToText(component, state.variable_names) + "\n";
  }
  return text + GuardLines("where ", state.guards, state.variable_names);
}

Term DefinitionToTerm(const CompositeState& state) {
  std::vector<Term> components;
  for (const FactPattern& component : state.components) components.push_back(ToTerm(component));
  return Term::Struct(
      "cst", {Term::Set(std::move(components)), ToTerm(state.guards), NamesToTerm(state.variable_names)});
}

std::optional<CompositeState> CompositeStateFromTerm(CompositeStateId id, const Term& definition) {
  if (!definition.IsStruct("cst") || definition.size() != 3 || !definition[0].is(TermKind::kSet))
    return std::nullopt;
  CompositeState state;
  state.id = id;
  for (const Term& item : definition[0].items()) {
    auto component = FactPatternFromTerm(item);
    if (!component) return std::nullopt;
    state.components.push_back(std::move(*component));
  }
  auto guards = GuardsFromTerm(definition[1]);
  auto names = NamesFromTerm(definition[2]);
  if (!guards || !names || state.components.empty()) return std::nullopt;
  state.guards = std::move(*guards);
  state.variable_names = std::move(*names);
  return state;
}

ModelKind KindOf(const Model& model) {
  if (IsImdl(model.rhs.payload)) {
    return model.rhs.positive ? ModelKind::kWeakRequirement : ModelKind::kStrongRequirement;
  }
  if (model.rhs.payload.is(TermKind::kEntity)) return ModelKind::kDrive;
  if (IsImdl(model.lhs.payload)) return ModelKind::kReuse;
  return ModelKind::kCausal;
}

std::string_view ToText(ModelKind kind) {
  switch (kind) {
    case ModelKind::kCausal:
      return "causal model";
    case ModelKind::kWeakRequirement:
      return "requirement model";
    case ModelKind::kStrongRequirement:
      return "strong requirement model";
    case ModelKind::kReuse:
      return "reuse model";
    case ModelKind::kDrive:
      return "drive model";
  }
  return {};
}

ModelId TargetModel(const Model& requirement) {
  if (IsImdl(requirement.rhs.payload)) return requirement.rhs.payload[0].model();
  if (IsImdl(requirement.lhs.payload)) return requirement.lhs.payload[0].model();
  return {};
}

CompositeStateId RequiredState(const Model& requirement) {
  if (!IsRequirement(requirement) || !IsIcst(requirement.lhs.payload)) return {};
  return requirement.lhs.payload[0].composite_state();
}

std::vector<int> TemplateVariables(const Model& model) {
  std::vector<int> variables;
  for (const Term& argument : model.template_arguments) {
    ForEachVariable(argument, [&](int v) {
      if (std::find(variables.begin(), variables.end(), v) == variables.end()) variables.push_back(v);
    });
  }
  return variables;
}

std::vector<int> ExposedVariables(const Model& model) {
  VariableSet variables;
  variables.Add(model.lhs);
  variables.Add(model.rhs);
  variables.Add(model.forward);
  variables.Add(model.backward);
  for (const int v : TemplateVariables(model)) variables.Erase(v);
  variables.Erase(model.lhs.after);
  variables.Erase(model.lhs.before);
  return variables.Ascending();
}

Term InstancePayload(const Model& model, const Bindings& bindings) {
  return Term::Struct("imdl",
                      {Term::Reference(model.id), Substitute(Term::Set(model.template_arguments), bindings),
                       ValueList(ExposedVariables(model), bindings)});
}

bool BindInstance(const Model& model, const Term& imdl_payload, Bindings& bindings) {
  return IsImdl(imdl_payload) && BindList(Term::Set(model.template_arguments), imdl_payload[1], bindings) &&
         BindList(VariableList(ExposedVariables(model)), imdl_payload[2], bindings);
}

std::string ToText(const Model& model) {
  std::string text = "mdl_" + std::to_string(model.id.value);
  for (const Term& argument : model.template_arguments) text += " " + ToText(argument, model.variable_names);
  text += "\n  " + ToText(model.lhs, model.variable_names) + "\n  -> " +
          ToText(model.rhs, model.variable_names) + "\n";
  return text + GuardLines("forward  ", model.forward, model.variable_names) +
         GuardLines("backward ", model.backward, model.variable_names);
}

Term DefinitionToTerm(const Model& model) {
  return Term::Struct("mdl",
                      {Term::Set(model.template_arguments), ToTerm(model.lhs), ToTerm(model.rhs),
                       ToTerm(model.forward), ToTerm(model.backward), NamesToTerm(model.variable_names)});
}

std::optional<Model> ModelFromTerm(ModelId id, const Term& definition) {
  if (!definition.IsStruct("mdl") || definition.size() != 6 || !definition[0].is(TermKind::kSet))
    return std::nullopt;
  auto lhs = FactPatternFromTerm(definition[1]);
  auto rhs = FactPatternFromTerm(definition[2]);
  auto forward = GuardsFromTerm(definition[3]);
  auto backward = GuardsFromTerm(definition[4]);
  auto names = NamesFromTerm(definition[5]);
  if (!lhs || !rhs || !forward || !backward || !names) return std::nullopt;
  const std::span<const Term> arguments = definition[0].items();
  return Model{id,
               {arguments.begin(), arguments.end()},
               std::move(*lhs),
               std::move(*rhs),
               std::move(*forward),
               std::move(*backward),
               std::move(*names)};
}

}  // namespace aerascope
