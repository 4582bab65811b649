// Patterns against values: bindings, unification, substitution, and the arithmetic of guards
// (semantics 1.5, 1.6, 2).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/kb/term.h"

namespace aerascope {

// Numbers closer than this are equal when matching (semantics 1.5).
inline constexpr double kNumberTolerance = 1e-5;

// What the variables of one pattern stand for. Indexed by variable number; grows as needed. Few variables, as
// most patterns have, need no memory of their own.
class Bindings {
 public:
  const Term* Find(int variable) const {
    const auto i = static_cast<std::size_t>(variable);
    if (i < kFew) return (bound_few_ >> i) & 1 ? &few_[i] : nullptr;
    return i - kFew < many_.size() && many_[i - kFew] ? &*many_[i - kFew] : nullptr;
  }
  void Set(int variable, Term value);
  void Clear(int variable);
  // Remembers what is bound; Restore unbinds what was bound since. What was bound must not have changed in
  // between.
  struct Mark {
    std::uint32_t few = 0;
    std::vector<bool> many;
  };
  Mark Save() const;
  void Restore(const Mark& mark);
  // One more than the highest number that was ever set.
  std::size_t size() const { return size_; }
  bool operator==(const Bindings& other) const;

 private:
  static constexpr std::size_t kFew = 12;

  std::uint32_t bound_few_ = 0;  // bit i: variable i is bound
  std::size_t size_ = 0;
  std::array<Term, kFew> few_;
  std::vector<std::optional<Term>> many_;  // from variable kFew
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
// (element by element, or scaled by a number), instants and durations. A number or vector times or over a
// duration counts seconds (own choice; OpenAERA counts microseconds). Nothing if a variable is unbound or
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
