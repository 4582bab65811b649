// A Fact says that its payload held, or with negative polarity did not hold (an anti-fact), throughout an
// interval. A FactPattern is a fact with variables: what composite states and models are made of
// (semantics 1.2, 1.6).
#pragma once

#include <optional>
#include <string>

#include "engine/base/time.h"
#include "engine/kb/match.h"
#include "engine/kb/term.h"

namespace aerascope {

struct Fact {
  bool positive = true;
  Term payload;
  TimeInterval interval;
  double confidence = 1;  // in [0, 1]

  bool operator==(const Fact&) const = default;
};

struct FactPattern {
  bool positive = true;
  Term payload;
  Term after;   // a variable, an instant or a wildcard
  Term before;  // the same

  bool operator==(const FactPattern&) const = default;
};

enum class EvidenceVerdict { kPositive, kNegative, kNone };

// Does the fact speak for or against the target (semantics 1.6, evidence test)? Positive or negative by
// polarity where payloads match and the intervals overlap; negative also for counter-evidence: the same
// object and attribute with another value, throughout the whole interval of the target.
EvidenceVerdict EvidenceFor(const Fact& fact, const Fact& target);

// Same object and attribute, another value.
bool ContradictsValue(const Term& payload, const Term& target_payload);

// Binds the payload and the interval variables strictly (same polarity). Bound interval variables must be
// synchronous.
bool MatchFact(const FactPattern& pattern, const Fact& fact, Bindings& bindings);

// The pattern with its bindings; nothing unless payload and interval became ground.
std::optional<Fact> Instantiate(const FactPattern& pattern, const Bindings& bindings, double confidence);

std::string ToText(const Fact& fact);
std::string ToText(const FactPattern& pattern, std::span<const std::string> variable_names = {});

// As terms, for storage: (fact payload after before confidence), (|fact ...) written "fact-not"; and patterns
// the same without confidence.
Term ToTerm(const Fact& fact);
std::optional<Fact> FactFromTerm(const Term& term);
Term ToTerm(const FactPattern& pattern);
std::optional<FactPattern> FactPatternFromTerm(const Term& term);

}  // namespace aerascope
