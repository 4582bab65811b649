// Patterns against values: bindings, unification, substitution, and the arithmetic of guards
// (semantics 1.5, 1.6, 2).
#pragma once

#include <optional>
#include <vector>

#include "engine/kb/term.h"

namespace aerascope {

// Numbers closer than this are equal when matching (semantics 1.5).
inline constexpr double kNumberTolerance = 1e-5;

// What the variables of one pattern stand for. Indexed by variable number; grows as needed.
class Bindings {
 public:
  const Term* Find(int variable) const {
    const auto i = static_cast<std::size_t>(variable);
    return i < values_.size() && values_[i] ? &*values_[i] : nullptr;
  }
  void Set(int variable, Term value);
  void Clear(int variable);
  std::size_t size() const { return values_.size(); }
  bool operator==(const Bindings&) const = default;

 private:
  std::vector<std::optional<Term>> values_;
};

// Equal up to the tolerances: numbers by kNumberTolerance, instants and durations by kTimeTolerance.
bool SameValue(const Term& a, const Term& b);

// Unifies pattern with object. A wildcard or variable in the object matches anything and binds nothing; an
// unbound pattern variable binds; a bound one must be the same value. On failure `bindings` may hold part of
// the match: match a copy where that matters.
bool Match(const Term& pattern, const Term& object, Bindings& bindings);

// The pattern with its bound variables replaced. Unbound ones stay variables.
Term Substitute(const Term& pattern, const Bindings& bindings);

// The term with its variables made wildcards: variables that no one has bound mean nothing outside their
// model.
Term Closed(const Term& term);

// The value of a guard expression: a ground term, or (op a b) with op one of + - * / over numbers, vec2/vec3
// (element by element, or scaled by a number), instants and durations. Nothing if a variable is unbound or
// the kinds do not fit.
std::optional<Term> Evaluate(const Term& expression, const Bindings& bindings);

// One guard: either `target := expression`, or a test `(<> a b)`, `(= a b)`, `(< a b)`, `(> a b)`, `(<= a
// b)`, `(>= a b)`.
struct Guard {
  std::optional<int> target;  // the variable assigned; none for a test
  Term expression;

  bool operator==(const Guard&) const = default;
};

// Runs guards in order. An assignment overwrites a passed value (semantics 2). An assignment that cannot be
// evaluated succeeds iff its target is bound; a test that cannot be evaluated, or is false, fails. With
// `on_unbound` kDefer, unevaluable assignments and tests are passed over (used while planning backwards with
// partial bindings).
enum class OnUnbound { kFail, kDefer };
bool RunGuards(const std::vector<Guard>& guards, Bindings& bindings, OnUnbound on_unbound = OnUnbound::kFail);

std::string ToText(const Guard& guard, std::span<const std::string> variable_names = {});

}  // namespace aerascope
