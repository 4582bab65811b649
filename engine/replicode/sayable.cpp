#include "engine/replicode/sayable.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/text.h"
#include "engine/base/time.h"
#include "engine/replicode/syntax.h"
#include "engine/replicode/words.h"

namespace aerascope {
namespace {

// How many expressions stand around a payload and around a guard, in a definition and in a fact.
constexpr int kAroundPattern = 3;
constexpr int kAroundGuard = 2;
constexpr int kAroundFact = 1;

bool IsOneOf(std::string_view word, const auto& words) {
  return std::any_of(words.begin(), words.end(), [&](const auto& known) { return known.first == word; });
}

bool IsOpen(const Term& term) {
  return term.is(TermKind::kVariable) || term.is(TermKind::kWildcard);
}

class Checker {
 public:
  explicit Checker(const SeedKnowledge& seed) : seed_(seed) {}

  Status Run() {
    for (const Term& symbol : seed_.symbols) CheckSymbol(symbol);
    for (const SeedCompositeState& item : seed_.composite_states) {
      subject_ = "cst_" + std::to_string(item.state.id.value);
      Check(item.state);
      arguments_[item.state.id.value] = ArgumentVariables(item.state).size();
    }
    for (const SeedModel& item : seed_.models) {
      subject_ = "mdl_" + std::to_string(item.model.id.value);
      Check(item);
      templates_[item.model.id.value] = item.model.template_arguments.size();
      arguments_[item.model.id.value] = ExposedVariables(item.model).size();
    }
    for (const SeedFact& item : seed_.facts) {
      subject_ = "the fact " + ToText(item.fact);
      Check(item.fact);
    }
    return error_ ? Status(*error_) : Ok();
  }

 private:
  void Expect(bool good, const std::string& what) {
    if (good || error_) return;
    error_ = Error{"expected knowledge that Replicode can say, found in " + Printable(subject_) + " " + what +
                   ", which has no form there"};
  }

  void CheckSymbol(const Term& symbol) {
    subject_ = "the list of symbols";
    Expect(symbol.is(TermKind::kEntity) || symbol.is(TermKind::kOntology), "the value " + ToText(symbol));
    CheckNames(symbol);
  }

  // A name is an entity or an ontology symbol, not one here and the other there.
  void CheckNames(const Term& term) {
    ForEachTerm(term, [&](const Term& part) {
      if (!part.is(TermKind::kEntity) && !part.is(TermKind::kOntology)) return;
      const auto [it, is_new] = kind_of_name_.try_emplace(part.name(), part.kind());
      Expect(it->second == part.kind(),
             "the name '" + Printable(part.name()) + "' for an entity and for a symbol");
    });
  }

  void CheckTimes(const Term& term) {
    ForEachTerm(term, [&](const Term& part) {
      if (part.is(TermKind::kTime)) CheckTime(part.time());
      if (part.is(TermKind::kDuration)) CheckTime({part.duration().us});
      if (part.IsStruct("ti")) {
        for (const Term& end : part.items()) {
          Expect(IsOpen(end) || end.is(TermKind::kTime), "the interval " + ToText(part));
        }
      }
    });
  }
  void CheckTime(Time time) {
    Expect(time <= kForever && time.us >= -kForever.us && time.us != kGigaSecondUs,
           "the time " + ToText(time));
  }

  void CheckTerm(const Term& term, int around) {
    Expect(term.depth() + around <= kMaxNesting,
           "values inside each other to a depth of " + std::to_string(term.depth()));
    CheckNames(term);
    CheckTimes(term);
  }

  void CheckPayload(const Term& payload, int around) {
    CheckTerm(payload, around);
    if (IsValue(payload)) {
      Expect(IsOpen(payload[0]) || payload[0].is(TermKind::kEntity), "a value of " + ToText(payload[0]));
      Expect(IsOpen(payload[1]) || payload[1].is(TermKind::kOntology), "the attribute " + ToText(payload[1]));
    } else if (IsCommand(payload)) {
      Expect(payload[0].is(TermKind::kOntology) && payload[1].is(TermKind::kSet),
             "the command " + ToText(payload));
    } else if (IsIcst(payload) && payload[0].is(TermKind::kCompositeState)) {
      Expect(
          payload[1] == Term::Set({}) && HasSize(payload[2], arguments_, payload[0].composite_state().value),
          "an instance with other arguments than its composite state has, " + ToText(payload));
    } else if (IsImdl(payload) && payload[0].is(TermKind::kModel)) {
      const std::int64_t id = payload[0].model().value;
      Expect(HasSize(payload[1], templates_, id) && HasSize(payload[2], arguments_, id),
             "an instance with other arguments than its model has, " + ToText(payload));
    } else {
      Expect(payload.is(TermKind::kEntity), "the payload " + ToText(payload));
    }
  }
  static bool HasSize(const Term& list, const std::map<std::int64_t, std::size_t>& sizes, std::int64_t id) {
    const auto it = sizes.find(id);
    return list.is(TermKind::kSet) && it != sizes.end() && list.size() == it->second;
  }

  void Check(const FactPattern& pattern) {
    CheckPayload(pattern.payload, kAroundPattern);
    for (const Term& end : {pattern.after, pattern.before}) {
      Expect(IsOpen(end) || end.is(TermKind::kTime), "the time " + ToText(end));
      CheckTimes(end);
    }
  }

  void Check(const std::vector<Guard>& guards) {
    for (const Guard& guard : guards) {
      CheckTerm(guard.expression, kAroundGuard);
      const bool test = guard.expression.is(TermKind::kStruct) && guard.expression.size() == 2 &&
                        IsOneOf(guard.expression.name(), kTestWords);
      Expect(guard.target.has_value() != test, "the guard " + ToText(guard));
      if (test) {
        for (const Term& operand : guard.expression.items()) CheckOperand(operand);
      } else {
        CheckOperand(guard.expression);
      }
    }
  }
  // Arithmetic over values; tests stand outside only.
  void CheckOperand(const Term& term) {
    if (term.is(TermKind::kStruct) && term.size() == 2 && IsOneOf(term.name(), kArithmeticWords)) {
      for (const Term& operand : term.items()) CheckOperand(operand);
      return;
    }
    ForEachTerm(term, [&](const Term& part) {
      Expect(!part.is(TermKind::kWildcard), "a wildcard in a guard");
      Expect(!part.is(TermKind::kStruct) || !IsOneOf(part.name(), kTestWords),
             "a test inside " + ToText(term));
    });
  }

  void Check(const CompositeState& state) {
    Expect(!state.components.empty() && state.components.size() <= kMaxComponents,
           std::to_string(state.components.size()) + " conditions");
    for (const FactPattern& component : state.components) {
      Check(component);
      Expect(IsValue(component.payload) || IsIcst(component.payload),
             "the condition " + ToText(component.payload));
      Expect(component.after.is(TermKind::kVariable) && component.after == state.components[0].after &&
                 component.before.is(TermKind::kVariable) && component.before == state.components[0].before,
             "conditions that do not share one interval");
    }
    Check(state.guards);
  }

  void Check(const SeedModel& item) {
    const Model& model = item.model;
    for (const Term& argument : model.template_arguments) {
      CheckTerm(argument, kAroundGuard);
      Expect(!argument.is(TermKind::kWildcard), "a wildcard as a template argument");
    }
    Check(model.lhs);
    Check(model.rhs);
    Expect(model.lhs.payload.is(TermKind::kStruct), "the left side " + ToText(model.lhs.payload));
    Expect(!IsCommand(model.rhs.payload), "a command on the right side");
    Check(model.forward);
    Check(model.backward);
    const Evidence& evidence = item.evidence;
    Expect(evidence.total >= 1 && evidence.total <= 1e9 && evidence.positive >= 0 &&
               evidence.positive <= evidence.total,
           "the evidence " + FormatNumber(evidence.positive) + " of " + FormatNumber(evidence.total));
  }

  void Check(const Fact& fact) {
    CheckPayload(fact.payload, kAroundFact);
    Expect(fact.payload.ground(), "variables");
    CheckTime(fact.interval.after);
    CheckTime(fact.interval.before);
    Expect(fact.interval.after <= fact.interval.before, "an end before its start");
    Expect(fact.confidence >= 0 && fact.confidence <= 1, "the confidence " + FormatNumber(fact.confidence));
  }

  const SeedKnowledge& seed_;
  std::string subject_;
  std::map<std::string, TermKind> kind_of_name_;
  // Of what was checked so far: knowledge refers backwards only.
  std::map<std::int64_t, std::size_t> templates_;
  std::map<std::int64_t, std::size_t> arguments_;
  std::optional<Error> error_;
};

}  // namespace

Status CheckSayable(const SeedKnowledge& seed) {
  return Checker(seed).Run();
}

}  // namespace aerascope
