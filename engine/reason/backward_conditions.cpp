#include <algorithm>

#include "engine/reason/abduction.h"
#include "engine/reason/backward_chaining.h"
#include "engine/reason/chaining.h"

// Conditions: how a model comes to be allowed to fire (semantics 4.2, 4.3).

namespace aerascope {
namespace {

// Partial arrangements looked at.
constexpr std::size_t kMaxArrangements = 256;
// Small steps of arranging that count as one node of the budget.
constexpr std::size_t kStepsPerNode = 16;

}  // namespace

// The ways in which the model comes to be allowed to fire, under its bindings.
std::vector<BackwardChainer::Way> BackwardChainer::Enable(const ModelRecord& record, const Bindings& bindings,
                                                          const Quest& quest, const Frame& from) {
  std::vector<Way> ways;
  const Model& model = record.model;
  const Term imdl = Closed(InstancePayload(model, bindings));
  bool needs_requirement = false;
  std::optional<GoalEntry> imdl_goal;
  const std::vector<ModelId>& known = knowledge_.RequirementsOf(model.id);
  needs_requirement = std::any_of(known.begin(), known.end(), [&](ModelId id) {
    const ModelRecord* requirement = knowledge_.Find(id);
    return IsRunning(requirement) && requirement->model.rhs.positive;
  });
  for (const ModelId id : ConditionsFor(model, bindings)) {
    const ModelRecord* requirement = knowledge_.Find(id);
    if (!IsRunning(requirement) || !requirement->model.rhs.positive) continue;
    Bindings required;
    if (!Match(requirement->model.rhs.payload, imdl, required)) continue;
    Quest through = quest;
    if (!imdl_goal) {
      imdl_goal =
          goals_.Set(quest.goal, model.id, {true, imdl, quest.target.interval, quest.target.confidence});
    }
    through.goal = *imdl_goal;
    EnableThrough(*requirement, record, bindings, required, through, from, &ways);
  }
  if (imdl_goal && ways.empty()) {
    const EventId veto = VetoOnInstance(model, bindings, from);
    const Fact refused{true, imdl, quest.target.interval, quest.target.confidence};
    if (veto.valid()) goals_.Skip(quest.goal, refused, GoalSkipReason::kVetoed, veto);
  }
  if (!needs_requirement && model.template_arguments.empty()) {
    Way way;
    way.plan.end = from;
    way.bindings = bindings;
    ways.push_back(std::move(way));
  }
  return ways;
}

// The requirement models worth a look: if the goal names all that the model's right side speaks about, those
// that ask of it nothing that is known not to be so.
std::vector<ModelId> BackwardChainer::ConditionsFor(const Model& model, const Bindings& bindings) const {
  // Comparisons with conditions that are not familiar enough, so that one sees why not.
  constexpr std::size_t kNearMisses = 4;
  std::vector<Term> individuals;
  bool named = true;
  ForEachVariable(model.rhs.payload, [&](int variable) {
    const Term* value = bindings.Find(variable);
    if (!value) {
      named = false;
    } else if (value->is(TermKind::kEntity) &&
               std::find(individuals.begin(), individuals.end(), *value) == individuals.end()) {
      individuals.push_back(*value);
    }
  });
  if (!named) return knowledge_.RequirementsOf(model.id);
  return context_.retrieval.Candidates(knowledge_, model.id, individuals, context_.present,
                                       context_.parameters, kNearMisses);
}

void BackwardChainer::EnableThrough(const ModelRecord& requirement, const ModelRecord& record,
                                    const Bindings& bindings, const Bindings& required, const Quest& quest,
                                    const Frame& from, std::vector<Way>* ways) {
  if (!Spend(quest)) return;
  const FactPattern& lhs = requirement.model.lhs;
  const Term condition = Closed(Substitute(lhs.payload, required));
  const CompositeStateRecord* known = knowledge_.Find(RequiredState(requirement.model));
  // A plain fact on the left is a state of one part, in the requirement's own variables.
  CompositeState plain;
  plain.components = {lhs};
  Bindings state_bindings = required;
  if (known) {
    state_bindings = {};
    if (!BindInstance(known->state, condition, state_bindings)) return;
  } else if (IsIcst(lhs.payload)) {
    return;
  }
  Quest through = quest;
  through.target.confidence *= requirement.evidence.rate();
  through.goal = goals_.Set(quest.goal, requirement.model.id,
                            {lhs.positive, condition, quest.target.interval, through.target.confidence});

  const CompositeState& state = known ? known->state : plain;
  std::vector<Held> held;
  const bool complete = Hold(state, state_bindings, through, from, &held);
  std::erase_if(held, [&](Held& one) { return !Allow(requirement, state, state_bindings, through, &one); });
  for (const Held& one : held) {
    const Term instance =
        known ? InstancePayload(state, one.bindings) : Substitute(lhs.payload, one.bindings);
    if (auto way =
            Complete(requirement.model, requirement.evidence.rate(), one, instance, record.model, bindings)) {
      way->requirement = requirement.model.id;
      ways->push_back(std::move(*way));
    }
  }
  const bool always = context_.parameters.analogy_mode == AnalogyMode::kOpenaera;
  if (known && (always || !complete || held.empty())) {
    EnableByAnalogy(requirement, *known, record, bindings, state_bindings, through, from, ways);
  }
}

void BackwardChainer::EnableByAnalogy(const ModelRecord& requirement, const CompositeStateRecord& required,
                                      const ModelRecord& record, const Bindings& bindings,
                                      const Bindings& state_bindings, const Quest& quest, const Frame& from,
                                      std::vector<Way>* ways) {
  const int candidate =
      hypotheses_.Consider(requirement, required, state_bindings, from.get(), quest.target, quest.goal,
                           [this](const Term& payload) { return feasibility_.CanBringAbout(payload, true); });
  if (candidate < 0 || !through_hypotheses_) return;
  // The list of candidates may grow while plans are looked for: keep copies.
  const Hypothesis hypothesis = hypotheses_[candidate].hypothesis;
  const Bindings hypothesis_bindings = hypotheses_[candidate].bindings;
  const double confidence = hypotheses_[candidate].comparison.confidence;
  std::vector<Held> held;
  Hold(hypothesis.state, hypothesis_bindings, quest, from, &held);
  for (const Held& one : held) {
    const Term instance = InstancePayload(hypothesis.state, one.bindings);
    if (auto way = Complete(hypothesis.requirement, confidence, one, instance, record.model, bindings)) {
      way->requirement = requirement.model.id;
      way->hypothesis = candidate;
      way->plan.familiar += static_cast<int>(hypothesis.state.components.size());
      ways->push_back(std::move(*way));
    }
  }
}

// A requirement model may need a requirement itself: the condition for that is brought about too.
bool BackwardChainer::Allow(const ModelRecord& requirement, const CompositeState& state,
                            const Bindings& bindings, const Quest& quest, Held* held) {
  const std::vector<ModelId>& above = knowledge_.RequirementsOf(requirement.model.id);
  const bool needed = std::any_of(above.begin(), above.end(), [&](ModelId id) {
    const ModelRecord* record = knowledge_.Find(id);
    return IsRunning(record) && record->model.rhs.positive;
  });
  if (!needed) return true;
  if (quest.depth >= context_.parameters.max_plan_depth) return false;
  Quest deeper = quest;
  ++deeper.depth;
  Bindings own;
  const Term instance = state.id.valid() ? InstancePayload(state, held->bindings)
                                         : Substitute(state.components[0].payload, held->bindings);
  if (!Match(requirement.model.lhs.payload, instance, own)) return false;
  for (Way& way : Enable(requirement, own, deeper, held->plan.end)) {
    Plan plan = held->plan;
    plan.steps.insert(plan.steps.end(), way.plan.steps.begin(), way.plan.steps.end());
    plan.score *= way.plan.score;
    plan.TakeVetoOf(way.plan);
    plan.familiar += way.plan.familiar;
    plan.end = way.plan.end;
    if (!way.plan.steps.empty()) {
      plan.end->FindParts(knowledge_, state);
      const auto matches = JointMatches(state, plan.end->situation(), bindings, {1});
      if (matches.empty()) continue;
      held->bindings = matches.front().bindings;
    }
    held->plan = std::move(plan);
    return true;
  }
  return false;
}

// The requirement model fires on the instance and allows the model.
std::optional<BackwardChainer::Way> BackwardChainer::Complete(const Model& requirement, double rate,
                                                              const Held& held, const Term& instance,
                                                              const Model& model,
                                                              const Bindings& bindings) const {
  Bindings own;
  const TimeInterval interval = held.plan.end->interval();
  if (!Match(requirement.lhs.payload, instance, own) ||
      !Match(requirement.lhs.after, Term::Instant(interval.after), own) ||
      !Match(requirement.lhs.before, Term::Instant(interval.before), own) ||
      !RunGuards(requirement.forward, own, OnUnbound::kDefer)) {
    return std::nullopt;
  }
  Way way;
  way.bindings = bindings;
  if (!BindInstance(model, Closed(Substitute(requirement.rhs.payload, own)), way.bindings))
    return std::nullopt;
  way.plan = held.plan;
  way.plan.score *= rate;
  way.confidence = held.confidence * rate;
  way.required = true;
  return way;
}

// Ways to a frame in which the state holds. False if some part neither holds nor can be brought about, so
// that nothing but analogy could help.
bool BackwardChainer::Hold(const CompositeState& state, const Bindings& bindings, const Quest& quest,
                           const Frame& from, std::vector<Held>* held) {
  from->FindParts(knowledge_, state);
  for (JointMatch& match : JointMatches(state, from->situation(), bindings, {kMaxArrangements})) {
    Held one;
    one.plan.end = from;
    one.bindings = std::move(match.bindings);
    one.confidence = match.confidence;
    held->push_back(std::move(one));
  }
  if (!held->empty()) return true;

  const FlatState flat = Flatten(knowledge_, state);
  const auto may_be_left = [&](const FactPattern& part) {
    if (IsIcst(part.payload) || IsImdl(part.payload)) return false;
    return feasibility_.CanBringAbout(part.payload, part.positive) || Expected(part, *from);
  };
  for (const FactPattern& part : flat.parts) {
    const FactPattern bound{part.positive, Substitute(part.payload, bindings), part.after, part.before};
    if (from->situation().FindMatch(bound.payload, bound.positive, {}) == Situation::npos &&
        !may_be_left(bound)) {
      goals_.Skip(quest.goal, {bound.positive, bound.payload, quest.target.interval, quest.target.confidence},
                  WhyOutOfReach(bound.payload));
      return false;
    }
  }
  // The fewest sub-goals first; more only if these lead nowhere.
  bool all_unbound = true;
  for (std::size_t count = 1; count <= flat.parts.size() && held->empty(); ++count) {
    std::size_t steps = 0;
    const std::vector<Arrangement> arrangements =
        Arrange(flat, from->situation(), bindings, count, may_be_left, kMaxArrangements, &steps);
    nodes_ += static_cast<int>(steps / kStepsPerNode);
    for (const Arrangement& arrangement : arrangements) {
      const bool keeps = std::all_of(arrangement.left.begin(), arrangement.left.end(), [&](std::size_t i) {
        return KeepsToIndividuals(flat.parts[i], from->situation(), bindings, arrangement.bindings);
      });
      if (!keeps) continue;
      if (!Spend(quest)) return true;
      if (BringAbout(state, flat, arrangement, quest, from, held)) all_unbound = false;
    }
  }
  if (held->empty() && all_unbound) goals_.Skip(quest.goal, quest.target, GoalSkipReason::kUnbound);
  return true;
}

// Plans after which the parts that were left hold too. False if one of them is not fully bound.
bool BackwardChainer::BringAbout(const CompositeState& state, const FlatState& flat,
                                 const Arrangement& arrangement, const Quest& quest, const Frame& from,
                                 std::vector<Held>* held) {
  std::vector<Fact> wanted;
  for (const std::size_t i : arrangement.left) {
    Fact part{flat.parts[i].positive, Substitute(flat.parts[i].payload, arrangement.bindings),
              quest.target.interval, quest.target.confidence};
    if (from->situation().FindMatch(part.payload, part.positive, {}) != Situation::npos) continue;
    if (!part.payload.ground()) return false;
    const bool known =
        std::any_of(wanted.begin(), wanted.end(), [&](const Fact& w) { return SameGoal(w, part); });
    if (!known) wanted.push_back(std::move(part));
  }
  if (wanted.empty()) return true;
  // What is done later may undo what was done before: if one order fails, others are tried.
  std::vector<std::size_t> order(wanted.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  constexpr std::size_t kMaxPermuted = 4;
  do {
    std::vector<Fact> in_order;
    for (const std::size_t i : order) in_order.push_back(wanted[i]);
    for (Plan& plan : InOrder(in_order, quest, from)) {
      // What was bound by facts may have changed on the way: join anew in the situation reached.
      plan.end->FindParts(knowledge_, state);
      for (JointMatch& match :
           JointMatches(state, plan.end->situation(), arrangement.bindings, {kMaxArrangements})) {
        Held one;
        one.plan = plan;
        one.bindings = std::move(match.bindings);
        one.confidence = match.confidence;
        held->push_back(std::move(one));
      }
      if (held->empty()) continue;
      SkipWhatHolds(flat, arrangement, quest, *from);
      return true;
    }
  } while (order.size() <= kMaxPermuted && std::next_permutation(order.begin(), order.end()) && Spend(quest));
  return true;
}

// Of a condition that is pursued, the parts for which nothing need be done.
void BackwardChainer::SkipWhatHolds(const FlatState& flat, const Arrangement& arrangement, const Quest& quest,
                                    const ImaginedFrame& frame) {
  for (std::size_t i = 0; i < flat.parts.size(); ++i) {
    if (std::find(arrangement.left.begin(), arrangement.left.end(), i) != arrangement.left.end()) continue;
    const Fact part{flat.parts[i].positive, Substitute(flat.parts[i].payload, arrangement.bindings),
                    quest.target.interval, quest.target.confidence};
    if (frame.situation().FindMatch(part.payload, part.positive, {}) != Situation::npos)
      goals_.Skip(quest.goal, part, GoalSkipReason::kAlreadyHolds);
  }
}

bool BackwardChainer::Expected(const FactPattern& part, const ImaginedFrame& frame) const {
  const Fact target{part.positive, Closed(part.payload), frame.interval(), 1};
  return std::any_of(frame.pending().begin(), frame.pending().end(),
                     [&](const SituationFact& expected) { return BringsAbout(expected.fact, target); });
}

}  // namespace aerascope
