#include "engine/kb/fact.h"

#include "engine/base/text.h"

namespace aerascope {
namespace {

bool MatchInstant(const Term& pattern, Time time, Bindings& bindings) {
  return Match(pattern, Term::Instant(time), bindings);
}

std::string_view Head(bool positive) {
  return positive ? "fact" : "fact-not";
}

}  // namespace

bool ContradictsValue(const Term& payload, const Term& target_payload) {
  if (!IsValue(payload) || !IsValue(target_payload)) return false;
  return payload[0] == target_payload[0] && payload[1] == target_payload[1] &&
         !SameValue(payload[2], target_payload[2]);
}

EvidenceVerdict EvidenceFor(const Fact& fact, const Fact& target) {
  Bindings none;
  if (Match(target.payload, fact.payload, none)) {
    if (!fact.interval.Overlaps(target.interval)) return EvidenceVerdict::kNone;
    return fact.positive == target.positive ? EvidenceVerdict::kPositive : EvidenceVerdict::kNegative;
  }
  if (fact.positive && fact.interval.Includes(target.interval) && target.payload.ground() &&
      ContradictsValue(fact.payload, target.payload)) {
    return target.positive ? EvidenceVerdict::kNegative : EvidenceVerdict::kPositive;
  }
  return EvidenceVerdict::kNone;
}

bool MatchFact(const FactPattern& pattern, const Fact& fact, Bindings& bindings) {
  return pattern.positive == fact.positive && Match(pattern.payload, fact.payload, bindings) &&
         MatchInstant(pattern.after, fact.interval.after, bindings) &&
         MatchInstant(pattern.before, fact.interval.before, bindings);
}

std::optional<Fact> Instantiate(const FactPattern& pattern, const Bindings& bindings, double confidence) {
  Fact fact;
  fact.positive = pattern.positive;
  fact.payload = Substitute(pattern.payload, bindings);
  const Term after = Substitute(pattern.after, bindings);
  const Term before = Substitute(pattern.before, bindings);
  if (!fact.payload.ground() || !after.is(TermKind::kTime) || !before.is(TermKind::kTime))
    return std::nullopt;
  fact.interval = {after.time(), before.time()};
  fact.confidence = confidence;
  return fact;
}

std::string ToText(const Fact& fact) {
  std::string text = fact.positive ? "" : "not ";
  text += ToText(fact.payload) + " " + ToText(fact.interval);
  if (fact.confidence != 1) text += " cfd " + FormatConfidence(fact.confidence);
  return text;
}

std::string ToText(const FactPattern& pattern, std::span<const std::string> variable_names) {
  std::string text = pattern.positive ? "" : "not ";
  return text + ToText(pattern.payload, variable_names) + " [" + ToText(pattern.after, variable_names) +
         ", " + ToText(pattern.before, variable_names) + ")";
}

Term ToTerm(const Fact& fact) {
  return Term::Struct(std::string(Head(fact.positive)),
                      {fact.payload, Term::Instant(fact.interval.after), Term::Instant(fact.interval.before),
                       Term::Number(fact.confidence)});
}

std::optional<Fact> FactFromTerm(const Term& term) {
  if (!term.is(TermKind::kStruct) || term.size() != 4) return std::nullopt;
  const bool positive = term.name() == Head(true);
  if (!positive && term.name() != Head(false)) return std::nullopt;
  if (!term[1].is(TermKind::kTime) || !term[2].is(TermKind::kTime) || !term[3].is(TermKind::kNumber)) {
    return std::nullopt;
  }
  return Fact{positive, term[0], {term[1].time(), term[2].time()}, term[3].number()};
}

Term ToTerm(const FactPattern& pattern) {
  return Term::Struct(std::string(Head(pattern.positive)), {pattern.payload, pattern.after, pattern.before});
}

std::optional<FactPattern> FactPatternFromTerm(const Term& term) {
  if (!term.is(TermKind::kStruct) || term.size() != 3) return std::nullopt;
  const bool positive = term.name() == Head(true);
  if (!positive && term.name() != Head(false)) return std::nullopt;
  return FactPattern{positive, term[0], term[1], term[2]};
}

}  // namespace aerascope
