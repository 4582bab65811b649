#include "engine/reason/causal_model_builder.h"

#include "engine/reason/abstraction.h"

namespace aerascope {
namespace {

// The variables a formula is written with.
struct ValueVariables {
  Term before;
  Term after;
  Term argument;  // of the command or model instance, or the value of the cause
  Duration period;
};

void AddFormula(const Formula& formula, const ValueVariables& v, Model* model) {
  const Term period = Term::Span(v.period);
  const auto forward = [&](const char* op, const Term& operand) {
    model->forward.push_back(Assignment(v.after, op, v.before, operand));
  };
  switch (formula.form) {
    case GuardForm::kTiming:
    case GuardForm::kGiven:
      return;
    case GuardForm::kSum:
      forward("+", v.argument);
      model->backward.push_back(Assignment(v.argument, "-", v.after, v.before));
      return;
    case GuardForm::kProduct:
      forward("*", v.argument);
      model->backward.push_back(Assignment(v.argument, "/", v.after, v.before));
      return;
    case GuardForm::kRate:
      forward("+", Term::Struct("*", {v.argument, period}));
      model->backward.push_back(Assignment(v.argument, "/", Term::Struct("-", {v.after, v.before}), period));
      return;
    case GuardForm::kConstantProduct:
      forward("*", formula.constant);
      model->backward.push_back(Assignment(v.before, "/", v.after, formula.constant));
      return;
    case GuardForm::kConstantSum:
      forward("+", formula.constant);
      model->backward.push_back(Assignment(v.before, "-", v.after, formula.constant));
      return;
  }
}

// The variable the formula takes from the left side.
Term ArgumentOf(const Formula& formula, const Term& lhs_payload) {
  if (formula.form == GuardForm::kSum || formula.form == GuardForm::kProduct) {
    return lhs_payload[IsCommand(lhs_payload) ? 1 : 2][formula.argument];
  }
  return formula.form == GuardForm::kRate ? lhs_payload[2] : Term();
}

// A command with a variable of its own for each quantity; the one in a sum is called a difference.
Term AbstractCommand(const Term& command, const Formula& formula, Abstraction* abstraction) {
  std::vector<Term> arguments;
  for (std::size_t i = 0; i < command[1].size(); ++i) {
    const bool difference = formula.form == GuardForm::kSum && formula.argument == i;
    arguments.push_back(abstraction->Abstract(command[1][i], ArgumentRole(i), difference ? "D" : "A"));
  }
  return MakeCommand(command[0], std::move(arguments));
}

}  // namespace

Guard Assignment(const Term& target, const char* op, const Term& a, const Term& b) {
  return Guard{target.variable(), Term::Struct(op, {a, b})};
}

ModelInstance BuildCausalModel(const ObservedChange& observed, const Formula& formula,
                               const KnowledgeBase& knowledge, ValueRoles roles) {
  const auto& [premise, cause, consequent] = observed;
  Abstraction abstraction(roles);
  Model model;
  const auto instant = [&](Time time, const char* role, const char* name) {
    return abstraction.Value(Term::Instant(time), role, name);
  };
  const Term& attribute = premise.payload[1];
  const std::string name = VariableNameFor(attribute.name());

  // Template: the value before, and when. Of a set of one thing, the thing.
  Term before_value = premise.payload[2];
  if (before_value.is(TermKind::kSet) && before_value.size() == 1) before_value = before_value[0];
  ValueVariables variables;
  variables.before = abstraction.Abstract(before_value, attribute.name(), name + "0");
  const Term t0 = instant(premise.interval.after, kTemplateAfter, "T0");
  const Term t1 = instant(premise.interval.before, kTemplateBefore, "T1");
  model.template_arguments = {variables.before, Term::Struct("ti", {t0, t1})};

  model.lhs.positive = cause.positive;
  model.lhs.payload = IsCommand(cause.payload) ? AbstractCommand(cause.payload, formula, &abstraction)
                                               : abstraction.Payload(cause.payload, knowledge);
  model.lhs.after = instant(cause.interval.after, kCauseAfter, "Tc0");
  model.lhs.before = instant(cause.interval.before, kCauseBefore, "Tc1");

  // A model that rides on another shares its timing and, where it is given, its value.
  model.rhs.positive = consequent.positive;
  const Term object = abstraction.Abstract(consequent.payload[0], "", "X");
  variables.after = abstraction.Abstract(consequent.payload[2], attribute.name(), name + "1");
  model.rhs.payload = MakeValue(object, attribute, variables.after);
  const Term t2 = model.rhs.after = instant(consequent.interval.after, kEffectAfter, "T2");
  const Term t3 = model.rhs.before = instant(consequent.interval.before, kEffectBefore, "T3");

  variables.period = consequent.interval.after - premise.interval.after;
  const Term period = Term::Span(variables.period);
  const Term end_period = Term::Span(consequent.interval.before - premise.interval.before);
  const Term offset = Term::Span(consequent.interval.after - cause.interval.after);
  const Term end_offset = Term::Span(consequent.interval.before - cause.interval.before);
  model.forward = {Assignment(t2, "+", t0, period), Assignment(t3, "+", t1, end_period)};
  model.backward = {Assignment(t0, "-", t2, period), Assignment(t1, "-", t3, end_period),
                    Assignment(model.lhs.after, "-", t2, offset),
                    Assignment(model.lhs.before, "-", t3, end_offset)};
  variables.argument = ArgumentOf(formula, model.lhs.payload);
  AddFormula(formula, variables, &model);
  model.variable_names = abstraction.names();
  return {std::move(model), abstraction.instance()};
}

}  // namespace aerascope
