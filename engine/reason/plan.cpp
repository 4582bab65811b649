#include "engine/reason/plan.h"

#include <algorithm>

namespace aerascope {

bool BringsAbout(const Fact& fact, const Fact& target) {
  Bindings none;
  if (fact.positive == target.positive) return Match(Closed(target.payload), fact.payload, none);
  return fact.positive && ContradictsValue(fact.payload, target.payload);
}

bool HoldsIn(const Situation& situation, const Fact& target) {
  if (situation.FindMatch(Closed(target.payload), target.positive, {}) != Situation::npos) return true;
  if (target.positive || !IsValue(target.payload)) return false;
  const Term any = MakeValue(target.payload[0], target.payload[1], Term::Wildcard());
  const auto& candidates = situation.Candidates(any, {});
  return std::any_of(candidates.begin(), candidates.end(),
                     [&](std::size_t i) { return BringsAbout(situation[i].fact, target); });
}

}  // namespace aerascope
