#include "engine/reason/analogy.h"

#include <algorithm>
#include <map>
#include <set>

#include "engine/base/text.h"

namespace aerascope {
namespace {

constexpr double kOpenaeraConfidence = 0.6;  // what the analogy branch of OpenAERA gives every hypothesis
constexpr int kOpenaeraMinMatched = 3;
constexpr std::size_t kMaxAssignments = 256;

// All ways to give the composite state's unbound variables those individuals that facts suggest for them. The
// first choice for each variable is "none", so the assignment that binds nothing comes first.
std::vector<Bindings> Assignments(const CompositeState& state, const Situation& situation,
                                  const Bindings& bindings) {
  std::map<int, std::vector<Term>> individuals;
  for (const FactPattern& component : state.components) {
    for (const std::size_t i : situation.Candidates(component.payload, bindings)) {
      Bindings trial = bindings;
      if (situation[i].fact.positive != component.positive ||
          !Match(component.payload, situation[i].fact.payload, trial)) {
        continue;
      }
      ForEachVariable(component.payload, [&](int variable) {
        const Term* value = trial.Find(variable);
        if (!value || bindings.Find(variable) || !value->is(TermKind::kEntity)) return;
        std::vector<Term>& list = individuals[variable];
        if (std::find(list.begin(), list.end(), *value) == list.end()) list.push_back(*value);
      });
    }
  }
  std::vector<Bindings> assignments{bindings};
  for (const auto& [variable, values] : individuals) {
    std::vector<Bindings> extended;
    for (const Bindings& assignment : assignments) {
      for (const Term& value : values) {
        if (extended.size() >= kMaxAssignments) break;
        extended.push_back(assignment);
        extended.back().Set(variable, value);
      }
    }
    if (!extended.empty()) assignments = std::move(extended);
  }
  return assignments;
}

// What the situation has in the place of a component that does not match: the same attribute of the same
// object, or the instance of the same composite state with the most equal arguments.
const SituationFact* Counterpart(const Term& payload, const Situation& situation) {
  const SituationFact* best = nullptr;
  int best_score = 0;
  const auto consider = [&](std::size_t i, int score) {
    if (score > best_score) {
      best = &situation[i];
      best_score = score;
    }
  };
  if (IsValue(payload)) {
    const Term any = MakeValue(payload[0], payload[1], Term::Wildcard());
    for (const std::size_t i : situation.Candidates(any, {})) {
      Bindings none;
      if (Match(any, situation[i].fact.payload, none)) consider(i, 1);
    }
  } else if (IsIcst(payload)) {
    const Term any = Term::Struct("icst", {payload[0], Term::Wildcard(), Term::Wildcard()});
    for (const std::size_t i : situation.Candidates(any, {})) {
      const Term& other = situation[i].fact.payload;
      if (other[2].size() != payload[2].size()) continue;
      int score = 0;
      bool same_individuals = true;
      for (std::size_t k = 0; k < payload[2].size(); ++k) {
        const bool same = payload[2][k].ground() && SameValue(payload[2][k], other[2][k]);
        if (payload[2][k].is(TermKind::kEntity)) same_individuals = same_individuals && same;
        score += same ? 1 : 0;
      }
      if (same_individuals) consider(i, score);
    }
  }
  return best;
}

const SituationFact* Predicted(const FactPattern& component, const std::vector<SituationFact>& predicted,
                               const Bindings& bindings) {
  for (const SituationFact& fact : predicted) {
    Bindings trial = bindings;
    if (fact.fact.positive == component.positive && Match(component.payload, fact.fact.payload, trial))
      return &fact;
  }
  return nullptr;
}

void CollectEntities(const Term& term, std::vector<Term>* entities) {
  ForEachTerm(term, [&](const Term& part) {
    if (part.is(TermKind::kEntity) &&
        std::find(entities->begin(), entities->end(), part) == entities->end()) {
      entities->push_back(part);
    }
  });
}

// Nothing if the assignment asks for other individuals than those that are there.
std::optional<Comparison> CompareUnder(const KnowledgeBase& knowledge, const ModelRecord& requirement,
                                       const CompositeState& state, const Situation& situation,
                                       const std::vector<SituationFact>& predicted,
                                       const Bindings& goal_bindings, const Bindings& bindings,
                                       const CanBringAbout& can_bring_about) {
  Comparison comparison;
  comparison.requirement = requirement.model.id;
  comparison.source = state.id;
  comparison.causal_model = TargetModel(requirement.model);
  comparison.bindings = bindings;
  int counterparts_of_missed = 0;
  for (std::size_t i = 0; i < state.components.size(); ++i) {
    ComparedComponent component;
    component.index = static_cast<std::int64_t>(i);
    component.pattern = Substitute(state.components[i].payload, bindings);
    std::size_t found = Situation::npos;
    component.status = StatusOf(state.components[i], knowledge, situation, bindings, can_bring_about, &found);
    if (component.status == ComponentStatus::kMatched) {
      component.found = situation[found].id;
      component.counterpart = situation[found].fact.payload;
      ++comparison.matched;
    } else if (const SituationFact* expected = Predicted(state.components[i], predicted, bindings)) {
      component.status = ComponentStatus::kMatched;
      component.counterpart = expected->fact.payload;
      ++comparison.matched;
    } else if (const SituationFact* counterpart = Counterpart(component.pattern, situation)) {
      component.counterpart = counterpart->fact.payload;
      if (component.status == ComponentStatus::kMissed) ++counterparts_of_missed;
    }
    if (component.status == ComponentStatus::kAchievable) {
      if (!KeepsToIndividuals(state.components[i], situation, goal_bindings, bindings)) return std::nullopt;
      ++comparison.achievable;
    }
    if (component.status != ComponentStatus::kMissed) comparison.kept.push_back(i);
    comparison.components.push_back(std::move(component));
  }
  const double total = static_cast<double>(state.components.size());
  const double kept = static_cast<double>(comparison.kept.size());
  comparison.psi = kept / total;
  comparison.jaccard = kept / (total + counterparts_of_missed);
  return comparison;
}

// Is every variable that the requirement passes on, and its composite state gave, still bound by what is
// kept?
bool BindsWhatIsPassedOn(const CompositeState& state, const Model& requirement,
                         const std::vector<std::size_t>& kept) {
  std::set<int> kept_variables;
  for (const std::size_t i : kept) {
    ForEachVariable(state.components[i].payload, [&](int v) { kept_variables.insert(v); });
  }
  const std::vector<int> arguments = ArgumentVariables(state);
  std::set<int> passed_on;
  ForEachVariable(requirement.rhs.payload, [&](int v) { passed_on.insert(v); });
  for (std::size_t i = 0; i < arguments.size() && i < requirement.lhs.payload[2].size(); ++i) {
    bool needed = false;
    ForEachVariable(requirement.lhs.payload[2][i], [&](int v) { needed = needed || passed_on.contains(v); });
    if (needed && !kept_variables.contains(arguments[i])) return false;
  }
  return true;
}

// Is something matched about every individual of the goal?
bool ObservedAboutGoal(const Comparison& comparison, const Term& goal) {
  std::vector<Term> individuals;
  CollectEntities(goal, &individuals);
  return std::all_of(individuals.begin(), individuals.end(), [&](const Term& individual) {
    return std::any_of(comparison.components.begin(), comparison.components.end(),
                       [&](const ComparedComponent& c) {
                         if (c.status != ComponentStatus::kMatched) return false;
                         std::vector<Term> about;
                         CollectEntities(c.counterpart, &about);
                         return std::find(about.begin(), about.end(), individual) != about.end();
                       });
  });
}

std::optional<AnalogyVerdict> Judge(const Comparison& comparison, const CompositeState& state,
                                    const Model& requirement, const Term& goal,
                                    const ReasonerParameters& parameters) {
  const std::size_t total = state.components.size();
  const bool openaera = parameters.analogy_mode == AnalogyMode::kOpenaera;
  if (comparison.kept.size() == total) return AnalogyVerdict::kFullMatch;
  const int counted = openaera ? comparison.matched : static_cast<int>(comparison.kept.size());
  if (counted < (openaera ? kOpenaeraMinMatched : parameters.analogy_min_matched))
    return AnalogyVerdict::kTooFewMatched;
  if (!openaera && comparison.psi <= parameters.analogy_min_psi) return AnalogyVerdict::kNotFamiliar;
  if (!ObservedAboutGoal(comparison, goal)) return AnalogyVerdict::kNothingObserved;
  if (!BindsWhatIsPassedOn(state, requirement, comparison.kept)) return AnalogyVerdict::kFreeVariable;
  return std::nullopt;
}

}  // namespace

ComponentStatus StatusOf(const FactPattern& component, const KnowledgeBase& knowledge,
                         const Situation& situation, const Bindings& bindings,
                         const CanBringAbout& can_bring_about, std::size_t* found) {
  const std::size_t match = situation.FindMatch(component.payload, component.positive, bindings);
  if (match != Situation::npos) {
    if (found) *found = match;
    return ComponentStatus::kMatched;
  }
  if (!component.positive) return ComponentStatus::kMissed;
  const Term payload = Substitute(component.payload, bindings);
  if (!IsIcst(payload)) {
    return can_bring_about(payload) ? ComponentStatus::kAchievable : ComponentStatus::kMissed;
  }
  const CompositeStateRecord* nested = knowledge.Find(payload[0].composite_state());
  Bindings inner;
  if (!nested || !BindInstance(nested->state, payload, inner)) return ComponentStatus::kMissed;
  // A nested state can be had if each of its parts holds or can be had.
  for (const FactPattern& part : nested->state.components) {
    if (StatusOf(part, knowledge, situation, inner, can_bring_about) == ComponentStatus::kMissed) {
      return ComponentStatus::kMissed;
    }
  }
  return ComponentStatus::kAchievable;
}

bool KeepsToIndividuals(const FactPattern& component, const Situation& situation,
                        const Bindings& goal_bindings, const Bindings& chosen) {
  if (situation.FindMatch(component.payload, component.positive, goal_bindings) == Situation::npos)
    return true;
  Bindings individuals = goal_bindings;
  for (std::size_t v = 0; v < chosen.size(); ++v) {
    const Term* value = chosen.Find(static_cast<int>(v));
    if (value && value->is(TermKind::kEntity)) individuals.Set(static_cast<int>(v), *value);
  }
  return situation.FindMatch(component.payload, component.positive, individuals) != Situation::npos;
}

Comparison Compare(const KnowledgeBase& knowledge, const ModelRecord& requirement, const Situation& situation,
                   const std::vector<SituationFact>& predicted, const Bindings& bindings, const Term& goal,
                   const CanBringAbout& can_bring_about, const ReasonerParameters& parameters) {
  const CompositeState& state = knowledge.Find(RequiredState(requirement.model))->state;
  std::optional<Comparison> best;
  // OpenAERA tries the first partial match only: what the goal binds, and nothing else; and what could be
  // brought about is no part of its comparison.
  const bool openaera = parameters.analogy_mode == AnalogyMode::kOpenaera;
  const CanBringAbout nothing = [](const Term&) { return false; };
  const CanBringAbout& could = openaera ? nothing : can_bring_about;
  const std::vector<Bindings> assignments =
      openaera ? std::vector<Bindings>{bindings} : Assignments(state, situation, bindings);
  for (const Bindings& assignment : assignments) {
    auto comparison =
        CompareUnder(knowledge, requirement, state, situation, predicted, bindings, assignment, could);
    if (!comparison) continue;
    // Something must be missing, or there is nothing to generalise; then the most that is seen counts, before
    // what could be brought about.
    const auto rank = [&](const Comparison& c) {
      const bool partial = c.kept.size() < state.components.size();
      return std::tuple(partial, c.matched, c.achievable);
    };
    if (!best || rank(*comparison) > rank(*best)) best = std::move(comparison);
  }
  if (!best)
    best = CompareUnder(knowledge, requirement, state, situation, predicted, bindings, bindings, could);
  best->rejection = Judge(*best, state, requirement.model, goal, parameters);
  best->confidence = parameters.analogy_mode == AnalogyMode::kOpenaera
                         ? kOpenaeraConfidence
                         : RoundNumber(best->psi * requirement.evidence.rate());
  return std::move(*best);
}

Hypothesis MakeHypothesis(const CompositeState& source, const Model& requirement,
                          const std::vector<std::size_t>& kept) {
  Hypothesis hypothesis;
  const auto name_of = [](const std::vector<std::string>& names, int variable) {
    const auto i = static_cast<std::size_t>(variable);
    return i < names.size() ? names[i] : std::string();
  };
  // Composite state: the kept components in order, variables numbered anew by first appearance.
  std::map<int, int> state_variable;
  const auto renumber_state = [&](const Term& term) {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (!part.is(TermKind::kVariable)) return std::nullopt;
      const auto [it, is_new] =
          state_variable.try_emplace(part.variable(), static_cast<int>(state_variable.size()));
      if (is_new) hypothesis.state.variable_names.push_back(name_of(source.variable_names, part.variable()));
      return Term::Variable(it->second);
    });
  };
  for (const std::size_t i : kept) {
    const FactPattern& component = source.components[i];
    FactPattern copy{component.positive, renumber_state(component.payload), {}, {}};
    copy.after = renumber_state(component.after);
    copy.before = renumber_state(component.before);
    hypothesis.state.components.push_back(std::move(copy));
  }
  for (const Guard& guard : source.guards) {
    bool still_meant = true;
    ForEachVariable(guard.expression,
                    [&](int v) { still_meant = still_meant && state_variable.contains(v); });
    if (guard.target) still_meant = still_meant && state_variable.contains(*guard.target);
    if (!still_meant) continue;
    Guard copy;
    if (guard.target) copy.target = state_variable.at(*guard.target);
    copy.expression = renumber_state(guard.expression);
    hypothesis.state.guards.push_back(std::move(copy));
  }

  // Requirement: the argument of each variable that is left, by substitution (not by its old place).
  const std::vector<int> old_arguments = ArgumentVariables(source);
  std::map<int, Term> argument_of;  // new state variable -> the requirement's term for it
  for (std::size_t i = 0; i < old_arguments.size() && i < requirement.lhs.payload[2].size(); ++i) {
    const auto it = state_variable.find(old_arguments[i]);
    if (it != state_variable.end()) argument_of.emplace(it->second, requirement.lhs.payload[2][i]);
  }
  std::vector<Term> arguments;
  for (const int variable : ArgumentVariables(hypothesis.state)) {
    const auto it = argument_of.find(variable);
    arguments.push_back(it == argument_of.end() ? Term::Wildcard() : it->second);
  }
  std::map<int, int> requirement_variable;
  const auto renumber = [&](const Term& term) {
    return Rewritten(term, [&](const Term& part) -> std::optional<Term> {
      if (!part.is(TermKind::kVariable)) return std::nullopt;
      const auto [it, is_new] =
          requirement_variable.try_emplace(part.variable(), static_cast<int>(requirement_variable.size()));
      if (is_new)
        hypothesis.requirement.variable_names.push_back(name_of(requirement.variable_names, part.variable()));
      return Term::Variable(it->second);
    });
  };
  Model& model = hypothesis.requirement;
  model.lhs.positive = requirement.lhs.positive;
  model.lhs.payload = renumber(MakeIcst({}, {}, std::move(arguments)));
  model.lhs.after = renumber(requirement.lhs.after);
  model.lhs.before = renumber(requirement.lhs.before);
  model.rhs.positive = requirement.rhs.positive;
  model.rhs.payload = renumber(requirement.rhs.payload);
  model.rhs.after = renumber(requirement.rhs.after);
  model.rhs.before = renumber(requirement.rhs.before);
  for (const Guard& guard : requirement.forward) {
    model.forward.push_back(
        {guard.target ? std::optional(renumber(Term::Variable(*guard.target)).variable()) : std::nullopt,
         renumber(guard.expression)});
  }
  for (const Guard& guard : requirement.backward) {
    model.backward.push_back(
        {guard.target ? std::optional(renumber(Term::Variable(*guard.target)).variable()) : std::nullopt,
         renumber(guard.expression)});
  }
  int last = -1;
  for (const auto& [old_variable, new_variable] : state_variable) last = std::max(last, old_variable);
  hypothesis.variable_of.assign(static_cast<std::size_t>(last + 1), -1);
  for (const auto& [old_variable, new_variable] : state_variable) {
    hypothesis.variable_of[static_cast<std::size_t>(old_variable)] = new_variable;
  }
  return hypothesis;
}

}  // namespace aerascope
