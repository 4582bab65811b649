#include "engine/reason/backward_chaining.h"

#include <algorithm>

#include "engine/kb/term_codec.h"
#include "engine/reason/chaining.h"

namespace aerascope {
namespace {

// Plans kept for one goal, partial arrangements looked at, and frames waited for one effect.
constexpr std::size_t kMaxPlansPerGoal = 16;
constexpr std::size_t kMaxArrangements = 256;
constexpr int kMaxWait = 32;
// Small steps of arranging that count as one node of the budget.
constexpr std::size_t kStepsPerNode = 16;
// Ways to one sub-goal that are carried on to the next.
constexpr std::size_t kMaxAlternatives = 3;

bool SameGoal(const Fact& a, const Fact& b) {
  return a.positive == b.positive && Closed(a.payload) == Closed(b.payload);
}

// The variables that stand for times: of the template's (ti after before) and of both sides' intervals.
std::vector<int> TimeVariables(const Model& model) {
  std::vector<int> variables;
  const auto add = [&](const Term& term) {
    if (term.is(TermKind::kVariable)) variables.push_back(term.variable());
  };
  for (const Term& argument : model.template_arguments) {
    if (argument.IsStruct("ti")) ForEachVariable(argument, [&](int v) { variables.push_back(v); });
  }
  for (const FactPattern* side : {&model.lhs, &model.rhs}) {
    add(side->after);
    add(side->before);
  }
  return variables;
}

bool IsRunning(const ModelRecord* record) {
  return record && record->state == ModelState::kActive;
}

}  // namespace

std::vector<Plan> BackwardChainer::PlansFor(const Fact& target, const GoalEntry& goal, const Frame& from,
                                            bool through_hypotheses) {
  through_hypotheses_ = through_hypotheses;
  nodes_ = 0;
  return Achieve({target, goal, 0}, from);
}

bool BackwardChainer::Spend(const Quest& quest) {
  if (++nodes_ <= context_.parameters.max_simulation_nodes) return true;
  goals_.Skip(quest.goal, quest.target, GoalSkipReason::kBudget);
  return false;
}

// Models whose right side could say the target, or (for an anti-fact) another value of the same thing.
std::vector<ModelId> BackwardChainer::ModelsFor(const Fact& target) const {
  const Term closed = Closed(target.payload);
  const bool any_value = !target.positive && IsValue(closed);
  return knowledge_.ModelsByRhs(any_value ? MakeValue(closed[0], closed[1], Term::Wildcard()) : closed);
}

std::vector<Plan> BackwardChainer::Achieve(const Quest& quest, const Frame& from) {
  std::vector<Plan> plans;
  const Fact& target = quest.target;
  const auto skip = [&](GoalSkipReason reason, EventId because = {}) {
    goals_.Skip(quest.goal, target, reason, because);
    return plans;
  };
  if (!Spend(quest)) return plans;
  if (quest.depth > context_.parameters.max_plan_depth) return skip(GoalSkipReason::kTooDeep);
  if (target.confidence <= 0) return skip(GoalSkipReason::kLowConfidence);
  // What is done in this frame is seen at the start of the next; that may be the very end of the goal's time.
  if (target.interval.before < from->interval().after + context_.period)
    return skip(GoalSkipReason::kTooLate);
  if (auto plan = WaitFor(quest, from)) {
    skip(GoalSkipReason::kPredicted);
    plans.push_back(std::move(*plan));
    return plans;
  }
  stack_.push_back(target);
  bool any_model = false;
  for (const ModelId id : ModelsFor(target)) {
    const ModelRecord* record = knowledge_.Find(id);
    if (!IsRunning(record)) continue;
    const FactPattern& rhs = record->model.rhs;
    Bindings bindings;
    const bool same = rhs.positive == target.positive && Match(rhs.payload, Closed(target.payload), bindings);
    if (!same) {
      // Another value of the same thing undoes an anti-fact's payload as well.
      if (target.positive || !rhs.positive || !IsValue(rhs.payload) || !IsValue(target.payload)) continue;
      bindings = {};
      const Term any = Closed(MakeValue(target.payload[0], target.payload[1], Term::Wildcard()));
      if (!Match(rhs.payload, any, bindings)) continue;
    }
    any_model = true;
    AchieveThrough(*record, bindings, quest, from, &plans);
  }
  stack_.pop_back();
  if (!any_model) {
    Bindings none;
    const Term any = IsValue(target.payload)
                         ? Closed(MakeValue(target.payload[0], target.payload[1], Term::Wildcard()))
                         : Closed(target.payload);
    const auto& candidates = context_.present.Candidates(any, none);
    const bool property = std::any_of(candidates.begin(), candidates.end(), [&](std::size_t i) {
      Bindings trial;
      return context_.present[i].permanent && Match(any, context_.present[i].fact.payload, trial);
    });
    return skip(property ? GoalSkipReason::kProperty : GoalSkipReason::kNoModel);
  }
  std::stable_sort(plans.begin(), plans.end(), [](const Plan& a, const Plan& b) {
    if (a.vetoed != b.vetoed) return !a.vetoed;
    if (a.score != b.score) return a.score > b.score;
    if (a.familiar != b.familiar) return a.familiar > b.familiar;
    return a.steps.size() < b.steps.size();
  });
  if (plans.size() > kMaxPlansPerGoal) plans.erase(plans.begin() + kMaxPlansPerGoal, plans.end());
  if (!plans.empty() && plans.front().vetoed) skip(GoalSkipReason::kVetoed, plans.front().veto);
  return plans;
}

// Nothing need be done for what is predicted already.
std::optional<Plan> BackwardChainer::WaitFor(const Quest& quest, const Frame& from) {
  const SituationFact* promised = nullptr;
  for (const SituationFact& expected : from->pending()) {
    if (expected.fact.confidence < quest.target.confidence || !BringsAbout(expected.fact, quest.target))
      continue;
    if (expected.fact.interval.after > quest.target.interval.before) continue;
    if (!promised || expected.fact.interval.after < promised->fact.interval.after) promised = &expected;
  }
  if (!promised) return std::nullopt;
  Plan plan;
  plan.score = promised->fact.confidence;
  plan.end = from;
  const Time due = promised->fact.interval.after;
  for (int wait = 0; wait < kMaxWait && plan.end->interval().before <= due; ++wait) {
    plan.end = std::make_shared<ImaginedFrame>(plan.end->Next({}, context_.period).frame);
    plan.steps.push_back({});
  }
  // What is predicted may be contradicted on the way.
  return HoldsIn(plan.end->situation(), quest.target) ? std::optional(std::move(plan)) : std::nullopt;
}

// When a model must fire for its right side to hold in the target's interval (semantics 4.2).
TimeInterval BackwardChainer::WindowOf(const Model& model, const Bindings& bindings,
                                       const TimeInterval& target) const {
  Bindings window = bindings;
  if (model.rhs.after.is(TermKind::kVariable))
    window.Set(model.rhs.after.variable(), Term::Instant(target.after));
  if (model.rhs.before.is(TermKind::kVariable))
    window.Set(model.rhs.before.variable(), Term::Instant(target.before));
  RunGuards(model.backward, window, OnUnbound::kDefer);
  const auto interval = [&](const Term& after, const Term& before) -> std::optional<TimeInterval> {
    const Term a = Substitute(after, window);
    const Term b = Substitute(before, window);
    if (!a.is(TermKind::kTime) || !b.is(TermKind::kTime)) return std::nullopt;
    return TimeInterval{a.time(), b.time()};
  };
  for (const Term& argument : model.template_arguments) {
    if (!argument.IsStruct("ti") || argument.size() != 2) continue;
    if (const auto found = interval(argument[0], argument[1])) return *found;
  }
  if (const auto found = interval(model.lhs.after, model.lhs.before)) return *found;
  return {target.after - context_.period, target.before - context_.period};
}

void BackwardChainer::AchieveThrough(const ModelRecord& record, const Bindings& bindings, const Quest& quest,
                                     const Frame& from, std::vector<Plan>* plans) {
  Quest through = quest;
  through.target.interval = WindowOf(record.model, bindings, quest.target.interval);
  through.target.confidence *= record.evidence.rate();
  for (const Way& way : Enable(record, bindings, through, from)) {
    for (Firing& firing : Fire(record, way, through, &quest.target)) {
      auto plan = Advance(std::move(firing), quest.target);
      if (!plan) continue;
      plan->solution_confidence = record.evidence.rate();
      plan->solution_delay = quest.target.interval.before - through.target.interval.before;
      plans->push_back(std::move(*plan));
    }
  }
}

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
                           [this](const Term& payload) { return CanBringAboutFact(payload, true); });
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
    return CanBringAboutFact(part.payload, part.positive) || Expected(part, *from);
  };
  for (const FactPattern& part : flat.parts) {
    const FactPattern bound{part.positive, Substitute(part.payload, bindings), part.after, part.before};
    if (from->situation().FindMatch(bound.payload, bound.positive, {}) == Situation::npos &&
        !may_be_left(bound)) {
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
    const std::size_t found = frame.situation().FindMatch(part.payload, part.positive, {});
    if (found == Situation::npos) continue;
    goals_.Skip(
        quest.goal, part,
        frame.situation()[found].permanent ? GoalSkipReason::kProperty : GoalSkipReason::kAlreadyHolds);
  }
}

// Plans that bring about one thing after the other.
std::vector<Plan> BackwardChainer::InOrder(const std::vector<Fact>& wanted, const Quest& quest,
                                           const Frame& from) {
  Plan start;
  start.end = from;
  std::vector<Plan> plans{std::move(start)};
  for (const Fact& target : wanted) {
    if (std::any_of(stack_.begin(), stack_.end(),
                    [&](const Fact& other) { return SameGoal(other, target); })) {
      goals_.Skip(quest.goal, target, GoalSkipReason::kLoop);
      return {};
    }
    const GoalEntry goal = goals_.Set(quest.goal, {}, target);
    std::vector<Plan> extended;
    for (const Plan& plan : plans) {
      if (HoldsIn(plan.end->situation(), target)) {
        extended.push_back(plan);
        continue;
      }
      for (Plan& more : Achieve({target, goal, quest.depth + 1}, plan.end)) {
        Plan both = plan;
        both.steps.insert(both.steps.end(), more.steps.begin(), more.steps.end());
        both.score *= more.score;
        both.TakeVetoOf(more);
        both.familiar += more.familiar;
        both.end = std::move(more.end);
        extended.push_back(std::move(both));
        if (extended.size() >= kMaxAlternatives) break;
      }
      if (extended.size() >= kMaxAlternatives) break;
    }
    plans = std::move(extended);
    if (plans.empty()) break;
  }
  return plans;
}

// -------------------------------------------------------------------------------------------------------------
// firing

std::vector<BackwardChainer::Firing> BackwardChainer::Fire(const ModelRecord& record, const Way& way,
                                                           const Quest& quest, const Fact* wanted) {
  const Term& lhs = record.model.lhs.payload;
  if (IsImdl(lhs)) return FireOnInstance(record, way, quest, wanted);
  if (!IsCommand(lhs)) return FireOnFact(record, way, quest, wanted);
  Bindings bindings = way.bindings;
  if (!RunGuards(record.model.backward, bindings, OnUnbound::kDefer)) return {};
  Step step;
  step.command = Substitute(lhs, bindings);
  std::vector<Firing> firings;
  if (!step.command.ground()) {
    goals_.Skip(quest.goal, {true, step.command, quest.target.interval, quest.target.confidence},
                GoalSkipReason::kUnbound);
    return firings;
  }
  // The command is executed in its own part of the frame; models may pass on when.
  const TimeInterval frame = way.plan.end->interval();
  if (!Match(record.model.lhs.after, Term::Instant(frame.after + context_.parameters.command_offset),
             bindings) ||
      !Match(record.model.lhs.before, Term::Instant(frame.before), bindings)) {
    return firings;
  }
  if (auto firing = Finish(record, way, bindings, std::move(step), quest, wanted))
    firings.push_back(std::move(*firing));
  return firings;
}

// The model waits for a fact: it holds, or it becomes a goal.
std::vector<BackwardChainer::Firing> BackwardChainer::FireOnFact(const ModelRecord& record, const Way& way,
                                                                 const Quest& quest, const Fact* wanted) {
  std::vector<Firing> firings;
  const FactPattern& lhs = record.model.lhs;
  Bindings bindings = way.bindings;
  if (!RunGuards(record.model.backward, bindings, OnUnbound::kDefer)) return firings;
  const auto fire_at = [&](const Way& there) {
    if (const CompositeStateRecord* state =
            IsIcst(lhs.payload) ? knowledge_.Find(lhs.payload[0].composite_state()) : nullptr) {
      there.plan.end->FindInstances(knowledge_, state->state);
    }
    const Situation& situation = there.plan.end->situation();
    const auto found = situation.Candidates(lhs.payload, bindings);
    const std::vector<std::size_t> candidates(found.begin(), found.end());
    for (const std::size_t i : candidates) {
      Bindings matched = bindings;
      Fact fact = situation[i].fact;
      if (auto common = Intersection(fact.interval, situation.interval())) fact.interval = *common;
      if (!MatchFact(lhs, fact, matched)) continue;
      if (auto firing = Finish(record, there, matched, {}, quest, wanted))
        firings.push_back(std::move(*firing));
    }
  };
  fire_at(way);
  if (!firings.empty()) return firings;

  const Fact needed{lhs.positive, Closed(Substitute(lhs.payload, bindings)), quest.target.interval,
                    quest.target.confidence};
  if (HoldsIn(way.plan.end->situation(), needed)) {
    goals_.Skip(quest.goal, needed,
                needed.payload.ground() ? GoalSkipReason::kAlreadyHolds : GoalSkipReason::kUnbound);
    return firings;
  }
  const GoalEntry goal = goals_.Set(quest.goal, record.model.id, needed);
  Quest deeper = quest;
  deeper.goal = goal;
  ++deeper.depth;
  std::vector<Held> held;
  if (IsIcst(lhs.payload)) {
    const CompositeStateRecord* known = knowledge_.Find(lhs.payload[0].composite_state());
    Bindings inside;
    if (known && BindInstance(known->state, needed.payload, inside)) {
      Hold(known->state, inside, deeper, way.plan.end, &held);
    }
  } else if (std::any_of(stack_.begin(), stack_.end(),
                         [&](const Fact& other) { return SameGoal(other, needed); })) {
    goals_.Skip(goal, needed, GoalSkipReason::kLoop);
  } else {
    deeper.target = needed;
    for (Plan& plan : Achieve(deeper, way.plan.end)) held.push_back({std::move(plan), {}, 1});
  }
  for (const Held& one : held) {
    Way there = way;
    there.plan.steps.insert(there.plan.steps.end(), one.plan.steps.begin(), one.plan.steps.end());
    there.plan.score *= one.plan.score;
    there.plan.TakeVetoOf(one.plan);
    there.plan.familiar += one.plan.familiar;
    there.plan.end = one.plan.end;
    // What allows the model to fire must still hold there.
    if (there.required && !StillAllowed(record.model, there)) continue;
    fire_at(there);
  }
  return firings;
}

// The model rides on another one (reuse): the goal is an instance of that one, and what fires is that one.
std::vector<BackwardChainer::Firing> BackwardChainer::FireOnInstance(const ModelRecord& record,
                                                                     const Way& way, const Quest& quest,
                                                                     const Fact* wanted) {
  std::vector<Firing> firings;
  Bindings bindings = way.bindings;
  if (!RunGuards(record.model.backward, bindings, OnUnbound::kDefer)) return firings;
  const Term imdl = Closed(Substitute(record.model.lhs.payload, bindings));
  const ModelRecord* ridden = imdl[0].is(TermKind::kModel) ? knowledge_.Find(imdl[0].model()) : nullptr;
  Bindings inside;
  if (!IsRunning(ridden) || !record.model.lhs.positive || !BindInstance(ridden->model, imdl, inside))
    return firings;
  if (quest.depth >= context_.parameters.max_plan_depth) {
    goals_.Skip(quest.goal, {true, imdl, quest.target.interval, quest.target.confidence},
                GoalSkipReason::kTooDeep);
    return firings;
  }
  // Its times are those of the frame it fires in, not the goal's.
  for (const int variable : TemplateVariables(ridden->model)) {
    const Term* value = inside.Find(variable);
    if (value && value->is(TermKind::kTime)) inside.Clear(variable);
  }
  for (const Term* time : {&ridden->model.rhs.after, &ridden->model.rhs.before}) {
    if (time->is(TermKind::kVariable)) inside.Clear(time->variable());
  }
  Quest deeper = quest;
  ++deeper.depth;
  deeper.goal =
      goals_.Set(quest.goal, record.model.id, {true, imdl, quest.target.interval, quest.target.confidence});
  for (Way& there : Enable(*ridden, inside, deeper, way.plan.end)) {
    Plan plan = way.plan;
    plan.steps.insert(plan.steps.end(), there.plan.steps.begin(), there.plan.steps.end());
    plan.score *= there.plan.score;
    plan.TakeVetoOf(there.plan);
    plan.familiar += there.plan.familiar;
    plan.end = there.plan.end;
    const bool moved = !there.plan.steps.empty();
    there.plan = std::move(plan);
    Way riding = way;
    riding.plan = there.plan;
    if (moved && way.required && !StillAllowed(record.model, riding)) continue;
    for (Firing& firing : Fire(*ridden, there, deeper, nullptr)) {
      const Term instance = InstancePayload(ridden->model, firing.bindings);
      Bindings matched = way.bindings;
      if (moved) {
        for (const int variable : TimeVariables(record.model)) matched.Clear(variable);
      }
      if (!Match(record.model.lhs.payload, instance, matched)) continue;
      riding.plan = firing.plan;
      const TimeInterval frame = firing.plan.end->interval();
      if (!Match(record.model.lhs.after, Term::Instant(frame.after + context_.parameters.command_offset),
                 matched) ||
          !Match(record.model.lhs.before, Term::Instant(frame.before), matched)) {
        continue;
      }
      auto ridden_firing = Finish(record, riding, matched, firing.step, quest, wanted);
      if (!ridden_firing) continue;
      ridden_firing->effects.insert(ridden_firing->effects.begin(), firing.effects.begin(),
                                    firing.effects.end());
      firings.push_back(std::move(*ridden_firing));
    }
  }
  return firings;
}

// The model fires at the end of the way with these bindings. Nothing if a guard says no or the effect is
// another than wanted.
std::optional<BackwardChainer::Firing> BackwardChainer::Finish(const ModelRecord& record, const Way& way,
                                                               const Bindings& bindings, Step step,
                                                               const Quest& quest, const Fact* wanted) {
  Firing firing;
  firing.bindings = bindings;
  const Model& model = record.model;
  if (!RunGuards(model.forward, firing.bindings, OnUnbound::kDefer)) return std::nullopt;
  const TimeInterval frame = way.plan.end->interval();
  SituationFact effect;
  effect.fact = {model.rhs.positive,
                 Substitute(model.rhs.payload, firing.bindings),
                 {frame.after + context_.period, frame.before + context_.period},
                 1};
  const Term after = Substitute(model.rhs.after, firing.bindings);
  const Term before = Substitute(model.rhs.before, firing.bindings);
  if (after.is(TermKind::kTime) && before.is(TermKind::kTime))
    effect.fact.interval = {after.time(), before.time()};
  if (!effect.fact.payload.ground()) {
    goals_.Skip(quest.goal,
                {true, Closed(effect.fact.payload), quest.target.interval, quest.target.confidence},
                GoalSkipReason::kUnbound);
    return std::nullopt;
  }
  if (effect.fact.interval.before <= frame.after) return std::nullopt;
  if (wanted && !BringsAbout(effect.fact, *wanted)) return std::nullopt;
  firing.plan = way.plan;
  firing.plan.score *= record.evidence.rate();
  const EventId veto = firing.plan.vetoed ? EventId{} : VetoOn(model, firing.bindings, way);
  if (veto.valid()) {
    firing.plan.vetoed = true;
    firing.plan.veto = veto;
  }
  firing.step = std::move(step);
  if (!firing.step.causal_model.valid()) {
    firing.step.causal_model = model.id;
    firing.step.requirement = way.requirement;
    firing.step.hypothesis = way.hypothesis;
  }
  firing.effects.push_back(std::move(effect));
  return firing;
}

// The strong requirement model's word that stands against the firing, if one does. A tie goes to the veto
// (semantics 3.3).
EventId BackwardChainer::VetoOn(const Model& model, const Bindings& bindings, const Way& way) const {
  way.plan.end->AskRequirements(knowledge_, model.id);
  for (const Requirement& requirement : way.plan.end->situation().requirements()) {
    if (requirement.target != model.id || requirement.imdl.positive) continue;
    Bindings trial = bindings;
    if (!BindInstance(model, requirement.imdl.payload, trial)) continue;
    if (!way.required || way.confidence <= requirement.imdl.confidence) return EventOf(requirement);
  }
  return {};
}

// What is said against the model's instance at that moment, whatever would have to hold besides.
EventId BackwardChainer::VetoOnInstance(const Model& model, const Bindings& bindings, const Frame& at) const {
  at->AskRequirements(knowledge_, model.id);
  Bindings timeless = bindings;
  for (const int variable : TimeVariables(model)) timeless.Clear(variable);
  for (const Requirement& requirement : at->situation().requirements()) {
    if (requirement.target != model.id || requirement.imdl.positive) continue;
    Bindings trial = timeless;
    if (BindInstance(model, requirement.imdl.payload, trial)) return EventOf(requirement);
  }
  return {};
}

// Where the word was only imagined, the model that would say it.
EventId BackwardChainer::EventOf(const Requirement& requirement) const {
  return requirement.event.valid() ? requirement.event : knowledge_.Find(requirement.requirement)->event;
}

bool BackwardChainer::StillAllowed(const Model& model, const Way& way) const {
  if (way.hypothesis >= 0) return true;  // not knowledge yet; the simulation will tell
  way.plan.end->AskRequirements(knowledge_, model.id);
  const auto& requirements = way.plan.end->situation().requirements();
  return std::any_of(requirements.begin(), requirements.end(), [&](const Requirement& requirement) {
    Bindings trial = way.bindings;
    for (const int variable : TimeVariables(model)) trial.Clear(variable);
    return requirement.target == model.id && requirement.imdl.positive &&
           BindInstance(model, requirement.imdl.payload, trial);
  });
}

// The plan with the firing as its last step, and waiting until the effect is there.
std::optional<Plan> BackwardChainer::Advance(Firing firing, const Fact& wanted) {
  Plan plan = std::move(firing.plan);
  const bool at_once = !IsCommand(firing.step.command) &&
                       firing.effects.back().fact.interval.after < plan.end->interval().before;
  if (!at_once) plan.steps.push_back(std::move(firing.step));
  const Time due = firing.effects.back().fact.interval.after;
  plan.end = std::make_shared<ImaginedFrame>(
      plan.end->Next(std::move(firing.effects), at_once ? Duration{0} : context_.period).frame);
  for (int wait = 0; wait < kMaxWait && plan.end->interval().before <= due; ++wait) {
    plan.end = std::make_shared<ImaginedFrame>(plan.end->Next({}, context_.period).frame);
    plan.steps.push_back({});
  }
  return HoldsIn(plan.end->situation(), wanted) ? std::optional(std::move(plan)) : std::nullopt;
}

// --------------------------------------------------------------------------------------------- what could be
// had at all

bool BackwardChainer::Expected(const FactPattern& part, const ImaginedFrame& frame) const {
  const Fact target{part.positive, Closed(part.payload), frame.interval(), 1};
  return std::any_of(frame.pending().begin(), frame.pending().end(),
                     [&](const SituationFact& expected) { return BringsAbout(expected.fact, target); });
}

// Could a model bring this about, through a condition that is at least familiar? A condition that asks for
// unchangeable things which do not hold (a sphere that should be a hand) is no way to anything.
bool BackwardChainer::CanBringAboutFact(const Term& payload, bool positive) {
  const Fact target{positive, Closed(payload), {}, 1};
  const auto [it, is_new] =
      can_bring_about_.try_emplace((positive ? "" : "not ") + Encode(target.payload), false);
  if (!is_new) return it->second;
  bool can = false;
  for (const ModelId id : ModelsFor(target)) {
    const ModelRecord* record = knowledge_.Find(id);
    Bindings bindings;
    if (!IsRunning(record)) continue;
    const FactPattern& rhs = record->model.rhs;
    const bool same = rhs.positive == positive && Match(rhs.payload, target.payload, bindings);
    if (!same && (positive || !rhs.positive)) continue;
    if (!same) bindings = {};
    if (CanFire(*record, bindings, 0)) {
      can = true;
      break;
    }
  }
  can_bring_about_[(positive ? "" : "not ") + Encode(target.payload)] = can;
  return can;
}

bool BackwardChainer::CanFire(const ModelRecord& record, const Bindings& bindings, int depth) {
  const Model& model = record.model;
  if (depth > context_.parameters.max_plan_depth) return false;
  bool needs_requirement = false;
  bool allowed = false;
  const Term imdl = Closed(InstancePayload(model, bindings));
  for (const ModelId id : knowledge_.RequirementsOf(model.id)) {
    const ModelRecord* requirement = knowledge_.Find(id);
    if (!IsRunning(requirement) || !requirement->model.rhs.positive) continue;
    needs_requirement = true;
    Bindings required;
    if (!Match(requirement->model.rhs.payload, imdl, required)) continue;
    const Term condition = Substitute(requirement->model.lhs.payload, required);
    if (Conceivable(condition) > context_.parameters.analogy_min_psi) {
      allowed = true;
      break;
    }
  }
  if (needs_requirement ? !allowed : !model.template_arguments.empty()) return false;
  if (IsCommand(model.lhs.payload)) return true;
  const Term lhs = Closed(Substitute(model.lhs.payload, bindings));
  if (!IsImdl(lhs)) return Conceivable(lhs) > 0;
  const ModelRecord* ridden = lhs[0].is(TermKind::kModel) ? knowledge_.Find(lhs[0].model()) : nullptr;
  Bindings inside;
  return IsRunning(ridden) && BindInstance(ridden->model, lhs, inside) && CanFire(*ridden, {}, depth + 1);
}

// The share of conditions that hold now or concern something a model can change.
double BackwardChainer::Conceivable(const Term& payload) {
  const CompositeStateRecord* record = IsIcst(payload) && payload[0].is(TermKind::kCompositeState)
                                           ? knowledge_.Find(payload[0].composite_state())
                                           : nullptr;
  const auto changeable = [&](const Term& part, bool positive) {
    return !ModelsFor({positive, part, {}, 1}).empty();
  };
  if (!record) {
    if (IsIcst(payload)) return 0;
    const bool holds = context_.present.FindMatch(Closed(payload), true, {}) != Situation::npos;
    return holds || changeable(payload, true) ? 1 : 0;
  }
  Bindings bindings;
  if (!BindInstance(record->state, Closed(payload), bindings)) return 0;
  double conceivable = 0;
  for (const FactPattern& component : record->state.components) {
    const Term part = Substitute(component.payload, bindings);
    const bool holds =
        context_.present.FindMatch(component.payload, component.positive, bindings) != Situation::npos;
    if (holds || (IsIcst(part) ? Conceivable(part) == 1 : changeable(part, component.positive)))
      conceivable += 1;
  }
  return conceivable / static_cast<double>(record->state.components.size());
}

// ------------------------------------------------------------------------------------------------------------
// threats

void BackwardChainer::FindThreats(const Fact& target, const GoalEntry& goal, ImaginedFrame* present,
                                  std::vector<Prohibition>* prohibitions,
                                  std::vector<MandatoryGoal>* mandatory) {
  for (const ModelId id : knowledge_.ModelsByRhs(Closed(target.payload))) {
    const ModelRecord* record = knowledge_.Find(id);
    Bindings bindings;
    if (!IsRunning(record) || record->model.rhs.positive == target.positive || IsRequirement(record->model) ||
        !Match(record->model.rhs.payload, Closed(target.payload), bindings)) {
      continue;
    }
    const TimeInterval window = WindowOf(record->model, bindings, target.interval);
    const double confidence = target.confidence * record->evidence.rate();
    // What could make it fire now, and under which bindings.
    present->AskRequirements(knowledge_, id);
    std::vector<Bindings> firing;
    bool required = false;
    for (const ModelId by : knowledge_.RequirementsOf(id)) {
      const ModelRecord* requirement = knowledge_.Find(by);
      required = required || (IsRunning(requirement) && requirement->model.rhs.positive);
    }
    if (!required && record->model.template_arguments.empty()) firing.push_back(bindings);
    for (const Requirement& requirement : present->situation().requirements()) {
      Bindings allowed = bindings;
      if (required && requirement.target == id && requirement.imdl.positive &&
          BindInstance(record->model, requirement.imdl.payload, allowed)) {
        firing.push_back(std::move(allowed));
      }
    }
    const Model* acts = &record->model;
    for (Bindings& under : firing) {
      RunGuards(record->model.backward, under, OnUnbound::kDefer);
      Term cause = Closed(Substitute(record->model.lhs.payload, under));
      for (int ridden = 0; IsImdl(cause) && ridden < context_.parameters.max_plan_depth; ++ridden) {
        const ModelRecord* other =
            cause[0].is(TermKind::kModel) ? knowledge_.Find(cause[0].model()) : nullptr;
        Bindings inside;
        if (!IsRunning(other) || !BindInstance(other->model, cause, inside)) break;
        acts = &other->model;
        cause = Closed(Substitute(acts->lhs.payload, inside));
      }
      const Fact must_not{!record->model.lhs.positive, cause, window, confidence};
      if (IsCommand(cause)) {
        prohibitions->push_back({cause, goals_.Set(goal, id, must_not)});
      } else if (HoldsIn(present->situation(), must_not)) {
        goals_.Skip(goal, must_not, GoalSkipReason::kAlreadyHolds);
      } else if (present->situation().FindMatch(cause, record->model.lhs.positive, {}) != Situation::npos) {
        mandatory->push_back({goals_.Set(goal, id, must_not), must_not});
      }
    }
  }
}

}  // namespace aerascope
