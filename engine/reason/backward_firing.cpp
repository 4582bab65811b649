#include <algorithm>

#include "engine/reason/abduction.h"
#include "engine/reason/backward_chaining.h"
#include "engine/reason/chaining.h"

// Firing: what a model does at the end of a plan, once it is allowed to (semantics 4.4).

namespace aerascope {
namespace {

// Does it say with some weight that the model is right or wrong in the frame?
bool SpeaksAbout(const Requirement& said, ModelId model, const TimeInterval& frame) {
  return said.target == model && said.imdl.confidence > 0 && said.imdl.interval.Overlaps(frame);
}

}  // namespace

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
    if (requirement.imdl.positive || !SpeaksAbout(requirement, model.id, way.plan.end->interval())) continue;
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
    if (requirement.imdl.positive || !SpeaksAbout(requirement, model.id, at->interval())) continue;
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
    return requirement.imdl.positive && SpeaksAbout(requirement, model.id, way.plan.end->interval()) &&
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

}  // namespace aerascope
