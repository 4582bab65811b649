// A GuardForm is the kind of formula that leads from the value before and a cause to the value after;
// guessing it is the first step of induction from change (semantics 5.1, guard guess).
//
// A quantity needs a formula, and the first that fits is taken; anything else (sets, individuals) is only
// timed. Where the cause itself holds the new value in the role of that value, no formula is needed: this is
// how a model that rides on another (reuse) reads its effect from it.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/kb/fact.h"
#include "engine/reason/roles.h"

namespace aerascope {

enum class GuardForm {
  kTiming,   // after a period; the value is no quantity
  kGiven,    // after a period; the cause holds the value
  kSum,      // q1 := q0 + argument
  kProduct,  // q1 := q0 * argument
  kRate,     // q1 := q0 + value of the cause * period; rates count per second (OpenAERA: per microsecond)
  kConstantProduct,  // q1 := q0 * constant
  kConstantSum,      // q1 := q0 + constant
};
std::string_view ToText(GuardForm form);

struct Formula {
  GuardForm form = GuardForm::kTiming;
  std::size_t argument = 0;  // sum, product: which argument of the command, or exposed argument of the model
  Term constant;             // constant forms
};

// What the value of a sensed thing became, and when.
struct ValueChange {
  std::string attribute;
  Term before;
  Term after;
  Duration period;  // from the beginning of the fact before to that of the fact after
};

// The formula, if one fits. `cause` is the ground payload of the candidate: a command, a value or (imdl ...).
std::optional<Formula> GuessFormula(const ValueChange& change, const Term& cause,
                                    const KnowledgeBase& knowledge);

// The difference between two quantities, if they have one.
std::optional<Term> Difference(const Term& after, const Term& before);

}  // namespace aerascope
