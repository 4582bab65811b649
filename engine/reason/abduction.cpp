#include "engine/reason/abduction.h"

namespace aerascope {

std::vector<ModelId> ModelsFor(const Fact& target, const KnowledgeBase& knowledge) {
  const Term closed = Closed(target.payload);
  const bool any_value = !target.positive && IsValue(closed);
  return knowledge.ModelsByRhs(any_value ? MakeValue(closed[0], closed[1], Term::Wildcard()) : closed);
}

TimeInterval WindowOf(const Model& model, const Bindings& bindings, const TimeInterval& target,
                      Duration period) {
  Bindings window = bindings;
  if (model.rhs.after.is(TermKind::kVariable))
    window.Set(model.rhs.after.variable(), Term::Instant(target.after));
  if (model.rhs.before.is(TermKind::kVariable))
    window.Set(model.rhs.before.variable(), Term::Instant(target.before));
  RunGuards(model.backward, window, OnUnbound::kDefer);
  const auto interval = [&](const Term& after, const Term& before) -> std::optional<TimeInterval> {
    const Term a = Substitute(after, window);
    const Term b = Substitute(before, window);
    if (!a.is(TermKind::kTime) || !b.is(TermKind::kTime)) return std::nullopt;
    return TimeInterval{a.time(), b.time()};
  };
  for (const Term& argument : model.template_arguments) {
    if (!argument.IsStruct("ti") || argument.size() != 2) continue;
    if (const auto found = interval(argument[0], argument[1])) return *found;
  }
  if (const auto found = interval(model.lhs.after, model.lhs.before)) return *found;
  return {target.after - period, target.before - period};
}

std::vector<int> TimeVariables(const Model& model) {
  std::vector<int> variables;
  const auto add = [&](const Term& term) {
    if (term.is(TermKind::kVariable)) variables.push_back(term.variable());
  };
  for (const Term& argument : model.template_arguments) {
    if (argument.IsStruct("ti")) ForEachVariable(argument, [&](int v) { variables.push_back(v); });
  }
  for (const FactPattern* side : {&model.lhs, &model.rhs}) {
    add(side->after);
    add(side->before);
  }
  return variables;
}

bool SameGoal(const Fact& a, const Fact& b) {
  return a.positive == b.positive && Closed(a.payload) == Closed(b.payload);
}

}  // namespace aerascope
