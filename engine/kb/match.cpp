#include "engine/kb/match.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace aerascope {

void Bindings::Set(int variable, Term value) {
  const auto i = static_cast<std::size_t>(variable);
  size_ = std::max(size_, i + 1);
  if (i < kFew) {
    few_[i] = std::move(value);
    bound_few_ |= 1u << i;
    return;
  }
  if (i - kFew >= many_.size()) many_.resize(i - kFew + 1);
  many_[i - kFew] = std::move(value);
}

void Bindings::Clear(int variable) {
  const auto i = static_cast<std::size_t>(variable);
  if (i < kFew) {
    few_[i] = Term();
    bound_few_ &= ~(1u << i);
  } else if (i - kFew < many_.size()) {
    many_[i - kFew].reset();
  }
}

Bindings::Mark Bindings::Save() const {
  Mark mark;
  mark.few = bound_few_;
  if (!many_.empty()) {
    mark.many.reserve(many_.size());
    for (const std::optional<Term>& value : many_) mark.many.push_back(value.has_value());
  }
  return mark;
}

void Bindings::Restore(const Mark& mark) {
  bound_few_ &= mark.few;
  for (std::size_t i = 0; i < many_.size(); ++i) {
    if (i >= mark.many.size() || !mark.many[i]) many_[i].reset();
  }
}

bool Bindings::operator==(const Bindings& other) const {
  const auto highest = static_cast<int>(std::max(size_, other.size_));
  for (int i = 0; i < highest; ++i) {
    const Term* mine = Find(i);
    const Term* theirs = other.Find(i);
    if ((mine == nullptr) != (theirs == nullptr) || (mine && *mine != *theirs)) return false;
  }
  return true;
}

bool SameValue(const Term& a, const Term& b) {
  if (a == b) return true;
  if (a.kind() != b.kind()) return false;
  switch (a.kind()) {
    case TermKind::kNumber:
      return std::abs(a.number() - b.number()) < kNumberTolerance;
    case TermKind::kTime:
      return Synchronous(a.time(), b.time());
    case TermKind::kDuration:
      return Synchronous({a.duration().us}, {b.duration().us});
    case TermKind::kSet:
    case TermKind::kStruct: {
      if (a.size() != b.size() || a.name() != b.name()) return false;
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (!SameValue(a[i], b[i])) return false;
      }
      return true;
    }
    case TermKind::kNil:
    case TermKind::kEntity:
    case TermKind::kOntology:
    case TermKind::kString:
    case TermKind::kBool:
    case TermKind::kVariable:
    case TermKind::kWildcard:
    case TermKind::kCompositeState:
    case TermKind::kModel:
      return false;
  }
  return false;
}

bool Match(const Term& pattern, const Term& object, Bindings& bindings) {
  if (object.is(TermKind::kWildcard) || object.is(TermKind::kVariable)) return true;
  switch (pattern.kind()) {
    case TermKind::kWildcard:
      return true;
    case TermKind::kVariable: {
      if (const Term* bound = bindings.Find(pattern.variable())) {
        return object.ground() ? SameValue(*bound, object) : Match(*bound, object, bindings);
      }
      if (object.ground()) bindings.Set(pattern.variable(), object);
      return true;
    }
    case TermKind::kSet:
    case TermKind::kStruct: {
      if (pattern == object && pattern.ground()) return true;
      if (pattern.kind() != object.kind() || pattern.size() != object.size() ||
          pattern.name() != object.name()) {
        return false;
      }
      for (std::size_t i = 0; i < pattern.size(); ++i) {
        if (!Match(pattern[i], object[i], bindings)) return false;
      }
      return true;
    }
    case TermKind::kNil:
    case TermKind::kEntity:
    case TermKind::kOntology:
    case TermKind::kNumber:
    case TermKind::kTime:
    case TermKind::kDuration:
    case TermKind::kString:
    case TermKind::kBool:
    case TermKind::kCompositeState:
    case TermKind::kModel:
      return SameValue(pattern, object);
  }
  return false;
}

Term Substitute(const Term& pattern, const Bindings& bindings) {
  if (pattern.ground()) return pattern;
  return Rewritten(pattern, [&](const Term& term) -> std::optional<Term> {
    if (term.ground()) return term;
    if (!term.is(TermKind::kVariable)) return std::nullopt;
    const Term* bound = bindings.Find(term.variable());
    return bound ? *bound : term;
  });
}

Term Closed(const Term& term) {
  if (term.ground()) return term;
  return Rewritten(term, [](const Term& part) -> std::optional<Term> {
    if (part.ground()) return part;
    if (part.is(TermKind::kVariable)) return Term::Wildcard();
    return std::nullopt;
  });
}

namespace {

bool IsVector(const Term& term) {
  return term.IsStruct("vec2") || term.IsStruct("vec3");
}

// a + b or a - b microseconds; nothing where the result is further away than anything a clock can show.
std::optional<std::int64_t> Shifted(std::string_view op, std::int64_t a, std::int64_t b) {
  constexpr std::int64_t kFurthest = 2 * kForever.us;
  std::int64_t us = 0;
  const bool good = op == "+"   ? !__builtin_add_overflow(a, b, &us)
                    : op == "-" ? !__builtin_sub_overflow(a, b, &us)
                                : false;
  if (!good || us > kFurthest || us < -kFurthest) return std::nullopt;
  return us;
}

std::optional<Term> Apply(std::string_view op, const Term& a, const Term& b) {
  const auto number = [](double value) -> std::optional<Term> {
    if (!std::isfinite(value)) return std::nullopt;
    return Term::Number(value);
  };
  if (a.is(TermKind::kNumber) && b.is(TermKind::kNumber)) {
    if (op == "+") return number(a.number() + b.number());
    if (op == "-") return number(a.number() - b.number());
    if (op == "*") return number(a.number() * b.number());
    if (op == "/" && b.number() != 0) return number(a.number() / b.number());
    return std::nullopt;
  }
  if (a.is(TermKind::kTime) && b.is(TermKind::kDuration)) {
    const auto us = Shifted(op, a.time().us, b.duration().us);
    return us ? std::optional(Term::Instant({*us})) : std::nullopt;
  }
  const bool times = a.is(TermKind::kTime) && b.is(TermKind::kTime) && op == "-";
  const bool durations = a.is(TermKind::kDuration) && b.is(TermKind::kDuration);
  if (times || durations) {
    const auto us =
        times ? Shifted(op, a.time().us, b.time().us) : Shifted(op, a.duration().us, b.duration().us);
    return us ? std::optional(Term::Span({*us})) : std::nullopt;
  }
  // A rate is per second: rate * duration is a difference, difference / duration a rate.
  if (b.is(TermKind::kDuration) && (a.is(TermKind::kNumber) || IsVector(a))) {
    if (op != "*" && op != "/") return std::nullopt;
    return Apply(op, a, Term::Number(static_cast<double>(b.duration().us) / 1e6));
  }
  // Vectors: element by element with each other, or scaled by a number.
  if (IsVector(a) &&
      ((IsVector(b) && a.name() == b.name() && a.size() == b.size()) || b.is(TermKind::kNumber))) {
    if (b.is(TermKind::kNumber) && op != "*" && op != "/") return std::nullopt;
    std::vector<Term> items;
    for (std::size_t i = 0; i < a.size(); ++i) {
      auto item = Apply(op, a[i], IsVector(b) ? b[i] : b);
      if (!item) return std::nullopt;
      items.push_back(std::move(*item));
    }
    return Term::Struct(a.name(), std::move(items));
  }
  return std::nullopt;
}

// Less, equal or greater: -1, 0, 1 of two numbers, instants or durations.
std::optional<int> Compare(const Term& a, const Term& b) {
  if (SameValue(a, b)) return 0;
  if (a.kind() != b.kind()) return std::nullopt;
  if (a.is(TermKind::kNumber)) return a.number() < b.number() ? -1 : 1;
  if (a.is(TermKind::kTime)) return a.time() < b.time() ? -1 : 1;
  if (a.is(TermKind::kDuration)) return a.duration() < b.duration() ? -1 : 1;
  return std::nullopt;
}

std::optional<bool> Test(const Term& test, const Bindings& bindings) {
  if (!test.is(TermKind::kStruct) || test.size() != 2) return std::nullopt;
  const auto a = Evaluate(test[0], bindings);
  const auto b = Evaluate(test[1], bindings);
  if (!a || !b) return std::nullopt;
  if (test.name() == "=") return SameValue(*a, *b);
  if (test.name() == "<>") return !SameValue(*a, *b);
  const auto order = Compare(*a, *b);
  if (!order) return std::nullopt;
  if (test.name() == "<") return *order < 0;
  if (test.name() == ">") return *order > 0;
  if (test.name() == "<=") return *order <= 0;
  if (test.name() == ">=") return *order >= 0;
  return std::nullopt;
}

}  // namespace

std::optional<Term> Evaluate(const Term& expression, const Bindings& bindings) {
  if (expression.is(TermKind::kVariable)) {
    const Term* bound = bindings.Find(expression.variable());
    return bound ? std::optional(*bound) : std::nullopt;
  }
  const bool operation = expression.is(TermKind::kStruct) && expression.size() == 2 &&
                         (expression.name() == "+" || expression.name() == "-" || expression.name() == "*" ||
                          expression.name() == "/");
  if (!operation) {
    Term value = Substitute(expression, bindings);
    return value.ground() ? std::optional(value) : std::nullopt;
  }
  const auto a = Evaluate(expression[0], bindings);
  const auto b = Evaluate(expression[1], bindings);
  if (!a || !b) return std::nullopt;
  return Apply(expression.name(), *a, *b);
}

bool RunGuards(const std::vector<Guard>& guards, Bindings& bindings, OnUnbound on_unbound) {
  for (const Guard& guard : guards) {
    if (!guard.target) {
      const auto holds = Test(guard.expression, bindings);
      if (!holds && on_unbound == OnUnbound::kDefer) continue;
      if (!holds || !*holds) return false;
      continue;
    }
    auto value = Evaluate(guard.expression, bindings);
    if (value) {
      bindings.Set(*guard.target, std::move(*value));
    } else if (on_unbound == OnUnbound::kFail && !bindings.Find(*guard.target)) {
      return false;
    }
  }
  return true;
}

std::string ToText(const Guard& guard, std::span<const std::string> variable_names) {
  std::string text = ToText(guard.expression, variable_names);
  if (!guard.target) return text;
  return ToText(Term::Variable(*guard.target), variable_names) + " := " + text;
}

}  // namespace aerascope
