#include "engine/reason/induction.h"

#include <algorithm>
#include <optional>
#include <set>

#include "engine/reason/abstraction.h"

namespace aerascope {
namespace {

// Entities and quantities inside a payload: what two facts can have in common (ontology symbols do not count).
void CollectValues(const Term& payload, std::vector<Term>* values) {
  if (payload.is(TermKind::kEntity) || IsQuantity(payload)) {
    values->push_back(payload);
    return;
  }
  for (const Term& item : payload.items()) CollectValues(item, values);
}

bool SharesValue(const Term& payload, const std::vector<Term>& values) {
  std::vector<Term> own;
  CollectValues(payload, &own);
  return std::any_of(own.begin(), own.end(), [&](const Term& value) {
    return std::any_of(values.begin(), values.end(), [&](const Term& other) { return SameValue(value, other); });
  });
}

// The formula that leads from premise value and cause to the consequent's value.
enum class GuardForm { kTiming, kSum, kProduct };

std::string_view Name(GuardForm form) {
  switch (form) {
    case GuardForm::kTiming: return "timing";
    case GuardForm::kSum: return "sum";
    case GuardForm::kProduct: return "product";
  }
  return {};
}

struct Formula {
  GuardForm form = GuardForm::kTiming;
  std::size_t argument = 0;  // the command argument in the formula
};

std::optional<Term> Arithmetic(std::string_view op, const Term& a, const Term& b) {
  return Evaluate(Term::Struct(std::string(op), {a, b}), {});
}

std::optional<Formula> GuessFormula(const Term& premise_value, const Term& cause, const Term& consequent_value) {
  if (!IsQuantity(premise_value)) return Formula{};
  if (!IsCommand(cause)) return std::nullopt;
  const std::span<const Term> arguments = cause[1].items();
  for (const auto& [form, op] : {std::pair{GuardForm::kSum, "-"}, std::pair{GuardForm::kProduct, "/"}}) {
    const auto wanted = Arithmetic(op, consequent_value, premise_value);
    if (!wanted) continue;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
      if (SameValue(arguments[i], *wanted)) return Formula{form, i};
    }
  }
  return std::nullopt;
}

// A causal model together with the values its variables had when it was made.
struct Instance {
  Model model;
  Bindings values;
};

Instance BuildCausalModel(const SituationFact& premise, const SituationFact& cause, const SituationFact& consequent,
                          TimeInterval premise_interval, const Formula& formula) {
  Abstraction abstraction;
  Model model;
  const auto instant = [&](Time time, const std::string& name) {
    return abstraction.Fresh(Term::Instant(time), name);
  };
  const Term& premise_value = premise.fact.payload[2];
  const Term& attribute = premise.fact.payload[1];
  const std::string name = VariableNameFor(attribute.name());

  // Template: the value before, and when.
  Term before_value = premise_value;
  if (premise_value.is(TermKind::kSet) && premise_value.size() == 1) before_value = premise_value[0];
  const Term value_before = abstraction.Abstract(before_value, "before", name + "0");
  const Term t0 = instant(premise_interval.after, "T0");
  const Term t1 = instant(premise_interval.before, "T1");
  model.template_arguments = {value_before, Term::Struct("ti", {t0, t1})};

  // Left side: the command. Each quantity among its arguments has a role of its own.
  std::vector<Term> arguments;
  for (std::size_t i = 0; i < cause.fact.payload[1].size(); ++i) {
    const bool in_formula = formula.form != GuardForm::kTiming && formula.argument == i;
    arguments.push_back(abstraction.Abstract(cause.fact.payload[1][i], "argument " + std::to_string(i),
                                             in_formula && formula.form == GuardForm::kSum ? "D" : "A"));
  }
  const Term argument = formula.form == GuardForm::kTiming ? Term() : arguments[formula.argument];
  model.lhs = {cause.fact.positive, MakeCommand(cause.fact.payload[0], arguments), {}, {}};
  model.lhs.after = instant(cause.fact.interval.after, "Tc0");
  model.lhs.before = instant(cause.fact.interval.before, "Tc1");

  // Right side: the consequent.
  const Term object = abstraction.Abstract(consequent.fact.payload[0], "object", "X");
  const Term value_after = abstraction.Abstract(consequent.fact.payload[2], "after", name + "1");
  const Term t2 = instant(consequent.fact.interval.after, "T2");
  const Term t3 = instant(consequent.fact.interval.before, "T3");
  model.rhs = {consequent.fact.positive, MakeValue(object, attribute, value_after), t2, t3};

  const auto assign = [](const Term& target, std::string op, const Term& a, const Term& b) {
    return Guard{target.variable(), Term::Struct(std::move(op), {a, b})};
  };
  const Term period = Term::Span(consequent.fact.interval.after - premise_interval.after);
  const Term offset = Term::Span(consequent.fact.interval.after - cause.fact.interval.after);
  const Term end_offset = Term::Span(consequent.fact.interval.before - cause.fact.interval.before);
  model.forward = {assign(t2, "+", t0, period), assign(t3, "+", t1, period)};
  model.backward = {assign(t0, "-", t2, period), assign(t1, "-", t3, period),
                    assign(model.lhs.after, "-", t2, offset), assign(model.lhs.before, "-", t3, end_offset)};
  if (formula.form == GuardForm::kSum) {
    model.forward.push_back(assign(value_after, "+", value_before, argument));
    model.backward.push_back(assign(argument, "-", value_after, value_before));
  } else if (formula.form == GuardForm::kProduct) {
    model.forward.push_back(assign(value_after, "*", value_before, argument));
    model.backward.push_back(assign(argument, "/", value_after, value_before));
  }
  model.variable_names = abstraction.names();
  return {std::move(model), abstraction.instance()};
}

// A composite state together with its instance in the situation before.
struct StateInstance {
  CompositeState state;
  Term icst;                          // ground payload, with the state's own number
  std::vector<std::size_t> facts;     // positions in the situation
};

class Induction {
 public:
  Induction(const Change& change, const Situation& before, Time now, Journal* journal)
      : change_(change), premise_(before[change.premise]), before_(before), now_(now), journal_(*journal) {
    CollectValues(premise_.fact.payload, &values_);
    CollectValues(change_.consequent.fact.payload, &values_);
  }

  void Run() {
    started_ = journal_.Write(now_, InductionStarted{InductionKind::kChange, premise_.id, change_.consequent.id},
                              {change_.consequent.event, premise_.event});
    KeepInputs();
    for (const std::size_t i : causes_) TryCause(before_[i]);
  }

 private:
  const KnowledgeBase& kb() const { return journal_.knowledge(); }

  void Report(const SituationFact& input, CauseVerdict verdict, std::string_view form = {}) {
    journal_.Write(now_, CauseConsidered{input.id, verdict, std::string(form)}, {started_, input.event});
  }

  bool EveryComponentShares(std::size_t position) const {
    const SituationFact& fact = before_[position];
    if (fact.components.empty()) return SharesValue(fact.fact.payload, values_);
    return std::all_of(fact.components.begin(), fact.components.end(),
                       [&](std::size_t i) { return EveryComponentShares(i); });
  }

  // Selective attention: which inputs may be conditions, and which may be causes.
  void KeepInputs() {
    const Time premise_start = before_.interval().after;
    for (std::size_t i = 0; i < before_.facts().size(); ++i) {
      const SituationFact& input = before_[i];
      if (i == change_.premise || IsImdl(input.fact.payload)) continue;
      const bool instance = IsIcst(input.fact.payload);
      const bool could_be_cause = !instance && !input.permanent && !Synchronous(input.fact.interval.after, premise_start);
      if (!EveryComponentShares(i)) {
        if (!instance && !input.permanent) Report(input, CauseVerdict::kNoSharedValue);
        continue;
      }
      if (could_be_cause && input.fact.interval.after >= change_.consequent.fact.interval.after) {
        Report(input, CauseVerdict::kTooLate);
        continue;
      }
      if (could_be_cause) {
        causes_.push_back(i);
        continue;
      }
      if (!instance && !input.permanent) Report(input, CauseVerdict::kSimultaneous);
      conditions_.push_back(i);
    }
  }

  void TryCause(const SituationFact& cause) {
    const Fact& consequent = change_.consequent.fact;
    if (!IsCommand(cause.fact.payload)) return Report(cause, CauseVerdict::kNoGuardForm);
    const auto formula = GuessFormula(premise_.fact.payload[2], cause.fact.payload, consequent.payload[2]);
    if (!formula) return Report(cause, CauseVerdict::kNoGuardForm);
    const TimeInterval premise_interval = Intersection(premise_.fact.interval, before_.interval())
                                              .value_or(before_.interval());
    Instance causal = BuildCausalModel(premise_, cause, change_.consequent, premise_interval, *formula);

    auto conditions = FindOrBuildState();
    if (!conditions) return Report(cause, CauseVerdict::kNoCompositeState);

    // An equal causal model that is known already is used in the place of the new one.
    const Canonical canonical = kb().CanonicalOf(causal.model);
    const ModelId known = kb().FindModel(canonical.hash);
    if (known.valid()) {
      const ModelRecord& record = *kb().Find(known);
      if (record.state == ModelState::kDeleted) return Report(cause, CauseVerdict::kBlackListed);
      Bindings values;
      for (std::size_t i = 0; i < canonical.variables.size(); ++i) {
        if (const Term* value = causal.values.Find(canonical.variables[i])) {
          values.Set(record.canonical.variables[i], *value);
        }
      }
      causal = {record.model, std::move(values)};
    }
    if (!causal.model.id.valid()) causal.model.id = journal_.NewId<ModelId>();

    std::vector<EventId> source{started_, cause.event, premise_.event, change_.consequent.event};
    const bool new_state = !kb().Find(conditions->state.id);
    auto requirement = BuildRequirement(*conditions, causal);
    if (!requirement) return Report(cause, CauseVerdict::kFreeVariable);

    const bool everything_known = known.valid() && !new_state;
    if (everything_known) {
      const ModelId same = kb().FindModel(kb().CanonicalOf(*requirement).hash);
      if (same.valid()) {
        const bool black = kb().Find(same)->state == ModelState::kDeleted;
        return Report(cause, black ? CauseVerdict::kBlackListed : CauseVerdict::kDuplicate);
      }
    }
    Report(cause, CauseVerdict::kBuilt, Name(formula->form));
    const EventId built = journal_.last_event();
    EventId state_event;
    if (new_state) {
      std::vector<EventId> causes{built};
      for (const std::size_t i : conditions->facts) causes.push_back(before_[i].event);
      state_event = journal_.Write(now_, CompositeStateCreated{conditions->state, Origin::kInduction, {}}, causes);
    } else {
      state_event = kb().Find(conditions->state.id)->event;
    }
    EventId causal_event;
    if (!known.valid()) {
      source.insert(source.begin(), built);
      causal_event = journal_.Write(now_, ModelCreated{causal.model, {}, false, Origin::kInduction, {}}, source);
    } else {
      causal_event = kb().Find(known)->event;
    }
    journal_.Write(now_, ModelCreated{*requirement, {}, false, Origin::kInduction, {}},
                   {built, state_event, causal_event});
  }

  FindCompositeState Finder() const {
    return [this](CompositeStateId id) -> const CompositeState* {
      const CompositeStateRecord* record = kb().Find(id);
      return record ? &record->state : nullptr;
    };
  }

  bool Contains(std::size_t instance, std::size_t fact, int depth) const {
    const std::vector<std::size_t>& components = before_[instance].components;
    return std::any_of(components.begin(), components.end(), [&](std::size_t i) {
      return i == fact || (depth > 1 && Contains(i, fact, depth - 1));
    });
  }

  // An instance that contains the premise, the most direct one first; else one put together from the conditions.
  std::optional<StateInstance> FindOrBuildState() {
    for (int depth = 1; depth <= 3; ++depth) {
      for (const std::size_t i : conditions_) {
        if (!IsIcst(before_[i].fact.payload) || !Contains(i, change_.premise, depth)) continue;
        const Term& icst = before_[i].fact.payload;
        return StateInstance{kb().Find(icst[0].composite_state())->state, icst, before_[i].components};
      }
    }
    return BuildState();
  }

  std::optional<StateInstance> BuildState() {
    // Instances stand for the facts they contain; one that contains none of the kept facts says nothing new.
    std::set<std::size_t> absorbed;
    std::vector<std::size_t> instances;
    for (const std::size_t i : conditions_) {
      const std::vector<std::size_t>& components = before_[i].components;
      const bool present = std::any_of(components.begin(), components.end(), [&](std::size_t c) {
        return c == change_.premise || std::find(conditions_.begin(), conditions_.end(), c) != conditions_.end();
      });
      if (components.empty() || !present) continue;
      instances.push_back(i);
      absorbed.insert(components.begin(), components.end());
    }
    std::vector<std::size_t> members{change_.premise};
    for (const std::size_t i : conditions_) {
      if (before_[i].components.empty() && !absorbed.contains(i)) members.push_back(i);
    }
    for (const std::size_t i : instances) {
      if (!absorbed.contains(i)) members.push_back(i);
    }
    if (members.size() < 2) return std::nullopt;

    Abstraction abstraction;
    CompositeState state;
    Term after;
    Term before;
    for (const std::size_t i : members) {
      const Term payload = AbstractPayload(before_[i].fact.payload, &abstraction);
      if (state.components.empty()) {
        after = abstraction.Fresh(Term::Instant(before_.interval().after), "T0");
        before = abstraction.Fresh(Term::Instant(before_.interval().before), "T1");
      }
      state.components.push_back({before_[i].fact.positive, payload, after, before});
    }
    state.variable_names = abstraction.names();

    const Canonical canonical = kb().CanonicalOf(state);
    Bindings values = abstraction.instance();
    const CompositeStateId known = kb().FindState(canonical.hash);
    if (known.valid()) {
      const CompositeStateRecord& record = *kb().Find(known);
      Bindings known_values;
      for (std::size_t i = 0; i < canonical.variables.size(); ++i) {
        if (const Term* value = values.Find(canonical.variables[i])) {
          known_values.Set(record.canonical.variables[i], *value);
        }
      }
      return StateInstance{record.state, InstancePayload(record.state, known_values), members};
    }
    state.id = journal_.NewId<CompositeStateId>();
    Term icst = InstancePayload(state, values);
    return StateInstance{std::move(state), std::move(icst), std::move(members)};
  }

  Term AbstractPayload(const Term& payload, Abstraction* abstraction) const {
    if (IsIcst(payload)) {
      return AbstractInstance(payload, kb().Find(payload[0].composite_state())->state, Finder(), abstraction);
    }
    if (!IsValue(payload)) return abstraction->Abstract(payload, "", "V");
    const std::string& attribute = payload[1].name();
    const Term object = abstraction->Abstract(payload[0], "", "X");
    return MakeValue(object, payload[1], abstraction->Abstract(payload[2], attribute, VariableNameFor(attribute)));
  }

  // Nothing if the effect holds something that neither command nor conditions give.
  std::optional<Model> BuildRequirement(const StateInstance& conditions, const Instance& causal) {
    Abstraction abstraction;
    Model requirement;
    const Term icst = AbstractInstance(conditions.icst, conditions.state, Finder(), &abstraction);
    const std::set<int> bound_by_conditions = [&] {
      std::set<int> variables;
      ForEachVariable(icst, [&](int v) { variables.insert(v); });
      return variables;
    }();
    const Term t0 = abstraction.Fresh(Term::Instant(before_.interval().after), "T0");
    const Term t1 = abstraction.Fresh(Term::Instant(before_.interval().before), "T1");

    std::vector<int> template_times;
    for (const Term& argument : causal.model.template_arguments) {
      if (argument.IsStruct("ti")) ForEachVariable(argument, [&](int v) { template_times.push_back(v); });
    }
    const auto name_of = [&](int variable) {
      const auto i = static_cast<std::size_t>(variable);
      return i < causal.model.variable_names.size() ? causal.model.variable_names[i] : std::string("V");
    };
    const std::string premise_role = premise_.fact.payload[1].name();
    const std::vector<int> template_variables = TemplateVariables(causal.model);
    const Term instance = InstancePayload(causal.model, {});
    const Term imdl = Rewritten(instance, [&](const Term& part) -> std::optional<Term> {
      if (!part.is(TermKind::kVariable)) return std::nullopt;
      const int variable = part.variable();
      if (template_times.size() == 2 && variable == template_times[0]) return t0;
      if (template_times.size() == 2 && variable == template_times[1]) return t1;
      const Term* value = causal.values.Find(variable);
      if (!value) return abstraction.Fresh(Term::Nil(), name_of(variable));
      const bool in_template = std::find(template_variables.begin(), template_variables.end(), variable) !=
                               template_variables.end();
      // An individual is the same wherever it stands; a quantity only where it is the premise's value.
      if (value->is(TermKind::kEntity)) return abstraction.Entity(*value);
      if (in_template) {
        if (const Term* known = abstraction.Find(*value, premise_role)) return *known;
      }
      return abstraction.Fresh(*value, name_of(variable));
    });

    // A variable of the effect that nothing else in the causal model gives must come from the conditions.
    std::set<int> given;
    for (const Term& argument : causal.model.template_arguments) {
      ForEachVariable(argument, [&](int v) { given.insert(v); });
    }
    ForEachVariable(causal.model.lhs.payload, [&](int v) { given.insert(v); });
    for (const Guard& guard : causal.model.forward) {
      if (guard.target) given.insert(*guard.target);
    }
    bool free = false;
    ForEachVariable(causal.model.rhs.payload, [&](int variable) {
      if (given.contains(variable)) return;
      const Term* value = causal.values.Find(variable);
      const Term* known = value ? abstraction.Find(*value, premise_role) : nullptr;
      free = free || !known || !bound_by_conditions.contains(known->variable());
    });
    if (free) return std::nullopt;

    requirement.id = journal_.NewId<ModelId>();
    requirement.lhs = {true, icst, t0, t1};
    requirement.rhs = {true, imdl, t0, t1};
    requirement.variable_names = abstraction.names();
    return requirement;
  }

  const Change& change_;
  const SituationFact& premise_;
  const Situation& before_;
  Time now_;
  Journal& journal_;
  EventId started_;
  std::vector<Term> values_;
  std::vector<std::size_t> conditions_;
  std::vector<std::size_t> causes_;
};

}  // namespace

void InduceFromChange(const Change& change, const Situation& before, Time now, Journal* journal) {
  Induction(change, before, now, journal).Run();
}

}  // namespace aerascope
