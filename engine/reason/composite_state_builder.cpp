#include "engine/reason/composite_state_builder.h"

#include <algorithm>

#include "engine/kb/term_codec.h"
#include "engine/reason/abstraction.h"

namespace aerascope {

bool Contains(const Situation& situation, std::size_t instance, std::size_t fact, int depth) {
  const std::vector<std::size_t>& components = situation[instance].components;
  return std::any_of(components.begin(), components.end(), [&](std::size_t i) {
    return i == fact || (depth > 1 && Contains(situation, i, fact, depth - 1));
  });
}

bool InSync(const TimeInterval& interval, const TimeInterval& reference) {
  return interval.after <= reference.after + kTimeTolerance && interval.before > reference.after;
}

std::vector<std::size_t> Outermost(const std::vector<std::size_t>& positions, const Situation& situation) {
  constexpr int kAnyDepth = 64;
  std::vector<std::size_t> outermost;
  for (const std::size_t i : positions) {
    const bool contained = std::any_of(positions.begin(), positions.end(), [&](std::size_t other) {
      return Contains(situation, other, i, kAnyDepth);
    });
    if (!contained) outermost.push_back(i);
  }
  return outermost;
}

std::optional<StateInstance> PutTogether(const std::vector<std::size_t>& members, const Situation& situation,
                                         const KnowledgeBase& knowledge, ValueRoles roles) {
  if (members.size() < 2) return std::nullopt;
  StateInstance instance;
  instance.facts = members;
  instance.interval = situation.interval();
  for (const std::size_t i : members) {
    const auto common = Intersection(instance.interval, situation[i].fact.interval);
    if (!common) return std::nullopt;
    instance.interval = *common;
  }
  Abstraction abstraction(roles);
  Term after;
  Term before;
  for (const std::size_t i : members) {
    const Fact& fact = situation[i].fact;
    Term payload = abstraction.Payload(fact.payload, knowledge);
    if (instance.state.components.empty()) {
      after = abstraction.Fresh(Term::Instant(instance.interval.after), "T0");
      before = abstraction.Fresh(Term::Instant(instance.interval.before), "T1");
    }
    instance.state.components.push_back({fact.positive, std::move(payload), after, before});
  }
  instance.state.variable_names = abstraction.names();
  instance.values = abstraction.instance();
  return instance;
}

StateInstance KnownOrNew(StateInstance instance, const KnowledgeBase& knowledge) {
  const Canonical canonical = knowledge.CanonicalOf(instance.state);
  const CompositeStateRecord* known = knowledge.Find(knowledge.FindState(canonical.hash));
  if (!known) return instance;
  Bindings values;
  for (std::size_t i = 0; i < canonical.variables.size(); ++i) {
    if (const Term* value = instance.values.Find(canonical.variables[i])) {
      values.Set(known->canonical.variables[i], *value);
    }
  }
  instance.state = known->state;
  instance.values = std::move(values);
  return instance;
}

StateInstance InstanceAt(std::size_t position, const Situation& situation, const KnowledgeBase& knowledge) {
  const SituationFact& fact = situation[position];
  StateInstance instance;
  instance.state = knowledge.Find(fact.fact.payload[0].composite_state())->state;
  BindInstance(instance.state, fact.fact.payload, instance.values);
  instance.interval = fact.fact.interval;
  instance.facts = fact.components;
  return instance;
}

std::string ContentKey(const Term& payload, const KnowledgeBase& knowledge) {
  const Term named = Rewritten(payload, [&](const Term& part) -> std::optional<Term> {
    if (!IsIcst(part) && !IsImdl(part)) return std::nullopt;
    const Canonical* canonical = nullptr;
    std::vector<int> listed;
    if (part[0].is(TermKind::kCompositeState)) {
      if (const CompositeStateRecord* record = knowledge.Find(part[0].composite_state())) {
        canonical = &record->canonical;
        listed = ArgumentVariables(record->state);
      }
    } else if (part[0].is(TermKind::kModel)) {
      if (const ModelRecord* record = knowledge.Find(part[0].model())) {
        canonical = &record->canonical;
        listed = ExposedVariables(record->model);
      }
    }
    if (!canonical) return part;
    std::vector<Term> arguments;
    for (const int variable : canonical->variables) {
      const auto it = std::find(listed.begin(), listed.end(), variable);
      const auto i = static_cast<std::size_t>(it - listed.begin());
      if (it != listed.end() && i < part[2].size()) arguments.push_back(part[2][i]);
    }
    return Term::Struct(part.name(),
                        {Term::String(ToText(canonical->hash)), part[1], Term::Set(std::move(arguments))});
  });
  return Encode(named);
}

}  // namespace aerascope
