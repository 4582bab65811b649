#include "engine/reason/situation.h"

namespace aerascope {
namespace {

enum PayloadKind { kOther = 0, kValuePayload, kCommandPayload, kIcstPayload, kImdlPayload };

// The term a pattern slot stands for: itself if ground, its binding if it is a bound variable; else nothing.
const Term* Ground(const Term& slot, const Bindings* bindings) {
  if (slot.ground()) return &slot;
  if (bindings && slot.is(TermKind::kVariable)) return bindings->Find(slot.variable());
  return nullptr;
}

}  // namespace

Situation::Key Situation::KeyOf(const Term& payload, const Bindings* bindings) {
  const auto hash = [&](const Term& slot) -> std::uint64_t {
    const Term* term = Ground(slot, bindings);
    return term ? term->hash() | 1 : 0;
  };
  if (IsValue(payload)) return {kValuePayload, hash(payload[1]), hash(payload[0])};
  if (IsCommand(payload)) return {kCommandPayload, hash(payload[0]), 0};
  if (IsIcst(payload)) return {kIcstPayload, hash(payload[0]), 0};
  if (IsImdl(payload)) return {kImdlPayload, hash(payload[0]), 0};
  return {kOther, 0, 0};
}

std::size_t Situation::Add(SituationFact fact) {
  const std::size_t position = facts_.size();
  const Key exact = KeyOf(fact.fact.payload, nullptr);
  // Stored under each key a pattern may ask with: fully known, object unknown, attribute unknown, both unknown.
  by_key_[exact].push_back(position);
  if (exact.object != 0) by_key_[{exact.kind, exact.what, 0}].push_back(position);
  if (exact.what != 0) by_key_[{exact.kind, 0, exact.object}].push_back(position);
  if (exact.what != 0 && exact.object != 0) by_key_[{exact.kind, 0, 0}].push_back(position);
  facts_.push_back(std::move(fact));
  return position;
}

void Situation::SetEvent(std::size_t fact, FactId id, EventId event) {
  facts_[fact].id = id;
  facts_[fact].event = event;
}

const std::vector<std::size_t>& Situation::Candidates(const Term& payload, const Bindings& bindings) const {
  static const std::vector<std::size_t> none;
  const auto it = by_key_.find(KeyOf(payload, &bindings));
  return it == by_key_.end() ? none : it->second;
}

std::size_t Situation::FindMatch(const Term& payload, bool positive, const Bindings& bindings) const {
  for (const std::size_t i : Candidates(payload, bindings)) {
    Bindings trial = bindings;
    if (facts_[i].fact.positive == positive && Match(payload, facts_[i].fact.payload, trial)) return i;
  }
  return npos;
}

Situation Situation::Successor(const std::vector<SituationFact>& effects, Duration period) const {
  Situation next({interval_.after + period, interval_.before + period});
  for (const SituationFact& fact : facts_) {
    if (!fact.components.empty() || IsIcst(fact.fact.payload) || IsCommand(fact.fact.payload) ||
        IsImdl(fact.fact.payload)) {
      continue;
    }
    bool contradicted = false;
    for (const SituationFact& effect : effects) {
      const bool same = SameValue(effect.fact.payload, fact.fact.payload);
      contradicted = contradicted || same || ContradictsValue(effect.fact.payload, fact.fact.payload);
    }
    if (contradicted && !fact.permanent) continue;
    SituationFact copy = fact;
    if (!copy.permanent) copy.fact.interval = next.interval_;
    next.Add(std::move(copy));
  }
  for (const SituationFact& effect : effects) next.Add(effect);
  return next;
}

}  // namespace aerascope
