#include "engine/query/without_numbers.h"

#include <optional>

namespace aerascope {
namespace {

FactPattern WithZeros(const FactPattern& pattern) {
  return {pattern.positive, aerascope::WithZeros(pattern.payload), aerascope::WithZeros(pattern.after),
          aerascope::WithZeros(pattern.before)};
}

void SetZeros(std::vector<Guard>* guards) {
  for (Guard& guard : *guards) guard.expression = aerascope::WithZeros(guard.expression);
}

CompositeState WithZeros(CompositeState state) {
  for (FactPattern& component : state.components) component = WithZeros(component);
  SetZeros(&state.guards);
  return state;
}

Model WithZeros(Model model) {
  for (Term& argument : model.template_arguments) argument = aerascope::WithZeros(argument);
  model.lhs = WithZeros(model.lhs);
  model.rhs = WithZeros(model.rhs);
  SetZeros(&model.forward);
  SetZeros(&model.backward);
  return model;
}

template <class Id>
const Canonical* FindIn(const std::map<Id, Canonical>& forms, Id id) {
  const auto it = forms.find(id);
  return it == forms.end() ? nullptr : &it->second;
}

}  // namespace

Term WithZeros(const Term& term) {
  return Rewritten(term, [](const Term& part) -> std::optional<Term> {
    if (part.is(TermKind::kNumber)) return Term::Number(0);
    if (part.is(TermKind::kTime)) return Term::Instant(Time{});
    if (part.is(TermKind::kDuration)) return Term::Span(Duration{});
    return std::nullopt;
  });
}

WithoutNumbers::WithoutNumbers(const KnowledgeBase& knowledge) {
  const Definitions definitions{[&](CompositeStateId id) {
                                  const CompositeStateRecord* record = knowledge.Find(id);
                                  return record ? &record->state : nullptr;
                                },
                                [&](ModelId id) {
                                  const ModelRecord* record = knowledge.Find(id);
                                  return record ? &record->model : nullptr;
                                }};
  const CanonicalOf known = [this](const Term& reference) -> const Canonical* {
    if (reference.is(TermKind::kCompositeState)) return FindIn(states_, reference.composite_state());
    return reference.is(TermKind::kModel) ? FindIn(models_, reference.model()) : nullptr;
  };
  // Both kinds in one order of creation, so that what is referred to comes first.
  auto state = knowledge.composite_states().begin();
  auto model = knowledge.models().begin();
  while (state != knowledge.composite_states().end() || model != knowledge.models().end()) {
    const bool take_state =
        model == knowledge.models().end() ||
        (state != knowledge.composite_states().end() && state->first.value < model->first.value);
    if (take_state) {
      states_[state->first] = Canonicalise(WithZeros(state->second.state), known, definitions);
      ++state;
    } else {
      models_[model->first] = Canonicalise(WithZeros(model->second.model), known, definitions);
      ++model;
    }
  }
}

Hash128 WithoutNumbers::HashOf(CompositeStateId id) const {
  const Canonical* form = FindIn(states_, id);
  return form ? form->hash : Hash128{};
}

Hash128 WithoutNumbers::HashOf(ModelId id) const {
  const Canonical* form = FindIn(models_, id);
  return form ? form->hash : Hash128{};
}

}  // namespace aerascope
