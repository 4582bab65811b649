#include "engine/reason/guard_form.h"

#include "engine/kb/match.h"

namespace aerascope {
namespace {

std::optional<Term> Arithmetic(const char* op, const Term& a, const Term& b) {
  return Evaluate(Term::Struct(op, {a, b}), {});
}

std::optional<Formula> WithArgument(const ValueChange& change, const Term& arguments) {
  for (const auto& [form, op] : {std::pair{GuardForm::kSum, "-"}, std::pair{GuardForm::kProduct, "/"}}) {
    const auto wanted = Arithmetic(op, change.after, change.before);
    if (!wanted) continue;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (SameValue(arguments[i], *wanted)) return Formula{form, i, {}};
    }
  }
  return std::nullopt;
}

// A command's argument could mean anything; only where cause and effect are of one kind is an equal value the
// same value.
bool HoldsNewValue(const ValueChange& change, const Term& cause, const KnowledgeBase& knowledge) {
  bool holds = false;
  ForEachValue(cause, knowledge, [&](const Term& value, const std::string& role) {
    holds = holds || (role == change.attribute && SameValue(value, change.after));
  });
  return holds;
}

std::optional<Formula> FromFact(const ValueChange& change, const Term& value) {
  if (!IsQuantity(value)) return std::nullopt;
  const auto step = Difference(change.after, change.before);
  const auto rate = step ? Arithmetic("/", *step, Term::Span(change.period)) : std::nullopt;
  if (rate && SameValue(value, *rate)) return Formula{GuardForm::kRate, 0, {}};
  if (const auto factor = Arithmetic("/", change.after, change.before)) {
    return Formula{GuardForm::kConstantProduct, 0, *factor};
  }
  if (step) return Formula{GuardForm::kConstantSum, 0, *step};
  return std::nullopt;
}

}  // namespace

std::string_view ToText(GuardForm form) {
  switch (form) {
    case GuardForm::kTiming:
      return "timing";
    case GuardForm::kGiven:
      return "given";
    case GuardForm::kSum:
      return "sum";
    case GuardForm::kProduct:
      return "product";
    case GuardForm::kRate:
      return "rate";
    case GuardForm::kConstantProduct:
      return "constant product";
    case GuardForm::kConstantSum:
      return "constant sum";
  }
  return {};
}

std::optional<Term> Difference(const Term& after, const Term& before) {
  return Arithmetic("-", after, before);
}

std::optional<Formula> GuessFormula(const ValueChange& change, const Term& cause,
                                    const KnowledgeBase& knowledge) {
  if (!IsQuantity(change.before) || !IsQuantity(change.after)) return Formula{};
  if (IsCommand(cause)) return WithArgument(change, cause[1]);
  if (HoldsNewValue(change, cause, knowledge)) return Formula{GuardForm::kGiven, 0, {}};
  if (IsImdl(cause)) return WithArgument(change, cause[2]);
  if (IsValue(cause)) return FromFact(change, cause[2]);
  return std::nullopt;
}

}  // namespace aerascope
