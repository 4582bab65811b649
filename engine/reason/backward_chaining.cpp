#include "engine/reason/backward_chaining.h"

#include <algorithm>

#include "engine/reason/abduction.h"

namespace aerascope {
namespace {

// Plans kept for one goal, and ways to one sub-goal that are carried on to the next.
constexpr std::size_t kMaxPlansPerGoal = 16;
constexpr std::size_t kMaxAlternatives = 3;

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
  for (const ModelId id : ModelsFor(target, knowledge_)) {
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
  if (!any_model) return skip(WhyOutOfReach(target.payload));
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

// What no model leads to is a property, or nothing is known of how to change it.
GoalSkipReason BackwardChainer::WhyOutOfReach(const Term& payload) const {
  Bindings none;
  const Term any =
      IsValue(payload) ? Closed(MakeValue(payload[0], payload[1], Term::Wildcard())) : Closed(payload);
  const auto& candidates = context_.present.Candidates(any, none);
  const bool property = std::any_of(candidates.begin(), candidates.end(), [&](std::size_t i) {
    Bindings trial;
    return context_.present[i].permanent && Match(any, context_.present[i].fact.payload, trial);
  });
  return property ? GoalSkipReason::kProperty : GoalSkipReason::kNoModel;
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

void BackwardChainer::AchieveThrough(const ModelRecord& record, const Bindings& bindings, const Quest& quest,
                                     const Frame& from, std::vector<Plan>* plans) {
  Quest through = quest;
  through.target.interval = WindowOf(record.model, bindings, quest.target.interval, context_.period);
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

}  // namespace aerascope
