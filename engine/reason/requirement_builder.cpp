#include "engine/reason/requirement_builder.h"

#include <algorithm>
#include <set>

#include "engine/reason/abstraction.h"

namespace aerascope {
namespace {

// The template's variables that stand for instants, in order: the first two are its interval.
std::vector<int> TemplateInstants(const ModelInstance& instance) {
  std::vector<int> instants;
  for (const int variable : TemplateVariables(instance.model)) {
    const Term* value = instance.values.Find(variable);
    if (value && value->is(TermKind::kTime)) instants.push_back(variable);
  }
  return instants;
}

// The statement (imdl M [template] [exposed]) with the condition's variables where the values are the same.
class Statement {
 public:
  Statement(const ModelInstance& target, const KnownDefinitions& knowledge, ValueRoles roles,
            Abstraction* abstraction)
      : target_(target), knowledge_(knowledge), roles_(roles), abstraction_(*abstraction) {
    for (const int variable : TemplateVariables(target.model)) template_.insert(variable);
    for (const int variable : EffectVariablesLeftOpen(target.model)) open_.insert(variable);
  }

  Term Payload(const Term& after, const Term& before) {
    const std::vector<int> instants = TemplateInstants(target_);
    return Rewritten(InstancePayload(target_.model, {}), [&](const Term& part) -> std::optional<Term> {
      if (!part.is(TermKind::kVariable)) return std::nullopt;
      const int variable = part.variable();
      if (instants.size() >= 2 && variable == instants[0]) return after;
      if (instants.size() >= 2 && variable == instants[1]) return before;
      return VariableFor(variable);
    });
  }

 private:
  Term VariableFor(int variable) {
    const auto i = static_cast<std::size_t>(variable);
    const std::vector<std::string>& names = target_.model.variable_names;
    const std::string name = i < names.size() ? names[i] : "V";
    const Term* value = target_.values.Find(variable);
    if (!value) return abstraction_.Fresh(Term::Nil(), name);
    // An individual is the same wherever it stands. A quantity is passed on only where the model has no other
    // way to it: what it reads from its input or computes is its own affair. Where equal values are one
    // whatever they are of, it is passed on in any case.
    if (value->is(TermKind::kEntity)) return abstraction_.Entity(*value);
    if (template_.contains(variable) || open_.contains(variable) ||
        (IsQuantity(*value) && !HasRole(*value, roles_))) {
      const std::string role = RoleOfVariable(target_.model, variable, knowledge_);
      if (const Term* known = abstraction_.Find(*value, role)) return *known;
    }
    return abstraction_.Fresh(*value, name);
  }

  const ModelInstance& target_;
  const KnownDefinitions& knowledge_;
  ValueRoles roles_;
  Abstraction& abstraction_;
  std::set<int> template_;
  std::set<int> open_;
};

}  // namespace

std::vector<int> EffectVariablesLeftOpen(const Model& model) {
  std::set<int> given;
  for (const Term& argument : model.template_arguments)
    ForEachVariable(argument, [&](int v) { given.insert(v); });
  ForEachVariable(model.lhs.payload, [&](int v) { given.insert(v); });
  for (const Guard& guard : model.forward) {
    if (guard.target) given.insert(*guard.target);
  }
  std::vector<int> open;
  ForEachVariable(model.rhs.payload, [&](int v) {
    if (given.insert(v).second) open.push_back(v);
  });
  return open;
}

std::optional<TimeInterval> TemplateInterval(const Term& ground_template) {
  std::vector<Time> instants;
  ForEachTerm(ground_template, [&](const Term& part) {
    if (part.is(TermKind::kTime)) instants.push_back(part.time());
  });
  if (instants.size() < 2) return std::nullopt;
  return TimeInterval{instants[0], instants[1]};
}

std::optional<Model> BuildRequirement(const RequirementCase& observed, const KnownDefinitions& knowledge,
                                      ValueRoles roles) {
  const TimeInterval& held = observed.condition.interval;
  const TimeInterval& valid = observed.valid;
  Abstraction abstraction(roles);
  Model requirement;
  requirement.lhs.positive = observed.condition.positive;
  requirement.lhs.payload = abstraction.Payload(observed.condition.payload, knowledge);
  std::set<int> bound;
  ForEachVariable(requirement.lhs.payload, [&](int v) { bound.insert(v); });
  const Term t0 = abstraction.Fresh(Term::Instant(held.after), "T0");
  const Term t1 = abstraction.Fresh(Term::Instant(held.before), "T1");
  Term after = t0;
  Term before = t1;
  if (!(held == valid)) {
    after = abstraction.Fresh(Term::Instant(valid.after), "T2");
    before = abstraction.Fresh(Term::Instant(valid.before), "T3");
    const Term offset = Term::Span(valid.after - held.after);
    const Term end_offset = Term::Span(valid.before - held.before);
    requirement.forward = {Assignment(after, "+", t0, offset), Assignment(before, "+", t1, end_offset)};
    requirement.backward = {Assignment(t0, "-", after, offset), Assignment(t1, "-", before, end_offset)};
  }
  requirement.lhs.after = t0;
  requirement.lhs.before = t1;
  requirement.rhs = {observed.right,
                     Statement(observed.target, knowledge, roles, &abstraction).Payload(after, before), after,
                     before};
  requirement.variable_names = abstraction.names();

  for (const int variable : EffectVariablesLeftOpen(observed.target.model)) {
    const Term* value = observed.target.values.Find(variable);
    if (!value) return std::nullopt;
    const Term* known = abstraction.Find(*value, RoleOfVariable(observed.target.model, variable, knowledge));
    if (!known || !bound.contains(known->variable())) return std::nullopt;
  }
  return requirement;
}

}  // namespace aerascope
