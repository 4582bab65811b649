#include "engine/reason/failure_induction.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/reason/adoption.h"
#include "engine/reason/chaining.h"
#include "engine/reason/composite_state_builder.h"
#include "engine/reason/requirement_builder.h"
#include "engine/reason/roles.h"

namespace aerascope {
namespace {

constexpr int kAnyDepth = 64;
// Facts tried while the ways in which a condition holds are counted; one that needs more has too many.
constexpr std::size_t kMaxJoinSteps = 20000;

bool IsSensed(const SituationFact& fact) {
  return IsValue(fact.fact.payload) && !fact.permanent && !fact.concluded;
}

class FailureInduction {
 public:
  FailureInduction(const FailedPrediction& failed, const std::vector<const Situation*>& frames,
                   const ReasonerParameters& parameters, Time now, Journal* journal)
      : failed_(failed),
        frames_(frames),
        parameters_(parameters),
        adoption_(InductionKind::kPredictionFailure, parameters.value_roles, now, journal),
        values_(journal->knowledge(), parameters.value_roles) {}

  void Run() {
    const ModelRecord* record = kb().Find(failed_.model);
    if (!record || record->state != ModelState::kActive || frames_.empty()) return;
    target_.model = record->model;
    if (!BindInstance(target_.model, failed_.instance, target_.values)) return;
    valid_ = TemplateInterval(failed_.instance[1]).value_or(frames_.front()->interval());
    values_.Add(failed_.instance);
    for (const Situation* frame : frames_) Keep(*frame);
    for (const Situation* frame : frames_) TakeBackIn(*frame);
    adoption_.Start(failed_.input, failed_.shown_by, failed_.events, Inputs());
    for (const auto& [input, verdict] : no_causes_) adoption_.Report(*input, verdict);
    for (std::size_t i = 0; i < frames_.size(); ++i) TryCauses(*frames_[i], kept_[i]);
  }

 private:
  const KnowledgeBase& kb() const { return adoption_.knowledge(); }

  // What shares a value with the failed instance.
  void Keep(const Situation& frame) {
    std::set<std::size_t>& kept = kept_.emplace_back();
    for (std::size_t i = 0; i < frame.facts().size(); ++i) {
      const SituationFact& input = frame[i];
      const Term& payload = input.fact.payload;
      if (IsCommand(payload) || IsImdl(payload) || input.concluded || !values_.SharedBy(payload)) continue;
      if (input.fact.interval.after > valid_.after && !input.permanent) {
        if (IsSensed(input)) no_causes_.emplace_back(&input, CauseVerdict::kTooLate);
        continue;
      }
      kept.insert(i);
      if (IsSensed(input)) same_value_.push_back(payload);
    }
  }

  // Sensed facts that are equal in attribute and value to one that was kept in any frame, and what contains
  // them.
  void TakeBackIn(const Situation& frame) {
    std::set<std::size_t>& kept = kept_[static_cast<std::size_t>(taken_back_++)];
    std::set<std::size_t> again;
    for (std::size_t i = 0; i < frame.facts().size(); ++i) {
      const SituationFact& input = frame[i];
      const Term& payload = input.fact.payload;
      if (!IsSensed(input) || kept.contains(i) || input.fact.interval.after > valid_.after) continue;
      const bool same = std::any_of(same_value_.begin(), same_value_.end(), [&](const Term& other) {
        return payload[1] == other[1] && SameValue(payload[2], other[2]);
      });
      if (same) again.insert(i);
    }
    for (std::size_t i = 0; i < frame.facts().size(); ++i) {
      if (!IsIcst(frame[i].fact.payload) || frame[i].fact.interval.after > valid_.after) continue;
      if (std::any_of(again.begin(), again.end(),
                      [&](std::size_t fact) { return Contains(frame, i, fact, kAnyDepth); })) {
        kept.insert(i);
      }
    }
    kept.insert(again.begin(), again.end());
    for (std::size_t i = 0; i < frame.facts().size(); ++i) {
      if (IsSensed(frame[i]) && !kept.contains(i) && frame[i].fact.interval.after <= valid_.after) {
        no_causes_.emplace_back(&frame[i], CauseVerdict::kNoSharedValue);
      }
    }
  }

  // What was made of each input, if that is recorded.
  std::vector<ConsideredInput> Inputs() const {
    std::vector<ConsideredInput> inputs;
    if (!adoption_.records_inputs()) return inputs;
    for (std::size_t f = 0; f < frames_.size(); ++f) {
      const Situation& frame = *frames_[f];
      for (std::size_t i = 0; i < frame.facts().size(); ++i)
        inputs.push_back({frame[i].id, VerdictOn(frame[i], kept_[f].contains(i))});
    }
    return inputs;
  }

  InputVerdict VerdictOn(const SituationFact& input, bool kept) const {
    const Term& payload = input.fact.payload;
    if (kept) return IsSensed(input) ? InputVerdict::kCause : InputVerdict::kCondition;
    if (IsCommand(payload) || IsImdl(payload) || input.concluded) return InputVerdict::kNotEligible;
    const bool late = input.fact.interval.after > valid_.after && !input.permanent;
    return late ? InputVerdict::kTooLate : InputVerdict::kNoSharedValue;
  }

  // Is this the thing the model was to change?
  bool IsPremise(const Term& payload) const {
    const Term& effect = failed_.target.payload;
    return IsValue(effect) && payload[0] == effect[0] && payload[1] == effect[1];
  }

  void TryCauses(const Situation& frame, const std::set<std::size_t>& kept) {
    const std::vector<std::size_t> all(kept.begin(), kept.end());
    const std::vector<std::size_t> outermost = Outermost(all, frame);
    struct Cause {
      bool other;  // than what was to be changed
      std::string content;
      std::size_t position;
      auto operator<=>(const Cause&) const = default;
    };
    std::vector<Cause> causes;
    for (const std::size_t i : all) {
      if (!IsSensed(frame[i])) continue;
      const Fact& fact = frame[i].fact;
      causes.push_back(
          {!IsPremise(fact.payload), ContentKey(fact.payload, kb()) + (fact.positive ? "+" : "-"), i});
    }
    std::sort(causes.begin(), causes.end());
    std::set<std::size_t> taken_up;
    for (const Cause& cause : causes) {
      if (!taken_up.contains(cause.position)) TryCause(frame, outermost, cause.position, &taken_up);
    }
  }

  void TryCause(const Situation& frame, const std::vector<std::size_t>& outermost, std::size_t position,
                std::set<std::size_t>* taken_up) {
    const SituationFact& cause = frame[position];
    const auto holds_cause = [&](std::size_t i) {
      return i == position || Contains(frame, i, position, kAnyDepth);
    };
    std::vector<std::pair<std::string, std::size_t>> instances;
    std::vector<std::size_t> together;
    for (const std::size_t i : outermost) {
      if (i != position && holds_cause(i)) instances.emplace_back(ContentKey(frame[i].fact.payload, kb()), i);
      if (InSync(frame[i].fact.interval, cause.fact.interval)) together.push_back(i);
    }
    std::sort(instances.begin(), instances.end());
    for (const auto& [key, i] : instances) Veto(cause, OnState(InstanceAt(i, frame, kb()), frame), frame);

    taken_up->insert(position);
    if (auto state = PutTogether(together, frame, kb(), parameters_.value_roles)) {
      for (const std::size_t i : together) TakeUp(frame, i, taken_up);
      if (HoldsInTooManyWays(state->state, frame)) {
        adoption_.Report(cause, CauseVerdict::kTooManyWays);
      } else {
        Veto(cause, OnState(KnownOrNew(std::move(*state), kb()), frame), frame);
      }
    } else if (instances.empty()) {
      Veto(cause, OnFact(cause), frame);
    }
  }

  // Asked before the state is brought into canonical form, which costs most for what has many ways.
  bool HoldsInTooManyWays(const CompositeState& state, const Situation& frame) const {
    const auto allowed = static_cast<std::size_t>(parameters_.max_veto_ways);
    JoinWork work;
    const std::size_t ways = JointMatches(state, frame, {}, {allowed + 1, kMaxJoinSteps}, &work).size();
    return ways > allowed || work.cut > 0;
  }

  void TakeUp(const Situation& frame, std::size_t position, std::set<std::size_t>* taken_up) const {
    taken_up->insert(position);
    for (const std::size_t component : frame[position].components) TakeUp(frame, component, taken_up);
  }

  void Veto(const SituationFact& cause, Condition condition, const Situation& frame) {
    if (condition.state && &frame == frames_.front() && condition.state->state.id.valid() &&
        Refuted(condition.state->state)) {
      adoption_.Report(cause, CauseVerdict::kContradicted);
      return;
    }
    adoption_.Adopt({cause, ToText(GuardForm::kTiming), std::move(condition), target_, valid_, false});
  }

  // Is the state a mere part of another under which the model was never wrong?
  bool Refuted(const CompositeState& state) const {
    for (const ModelId id : kb().RequirementsOf(target_.model.id)) {
      const ModelRecord& requirement = *kb().Find(id);
      const CompositeStateRecord* proven = kb().Find(RequiredState(requirement.model));
      if (!requirement.model.rhs.positive || !proven || proven->state.id == state.id) continue;
      if (requirement.evidence.positive < requirement.evidence.total) continue;
      if (IsPartOf(state, proven->state)) return true;
    }
    return false;
  }

  // Does every situation in which `whole` holds make `part` hold? Tried on one in which only the components
  // of `whole` hold, its variables being individuals of their own.
  bool IsPartOf(const CompositeState& part, const CompositeState& whole) const {
    if (part.components.size() >= whole.components.size()) return false;
    const TimeInterval frame = frames_.front()->interval();
    Situation situation(frame);
    for (const FactPattern& component : whole.components) {
      const Term payload = Rewritten(component.payload, [](const Term& term) -> std::optional<Term> {
        if (term.is(TermKind::kVariable)) return Term::Entity("#" + std::to_string(term.variable()));
        return std::nullopt;
      });
      SituationFact fact;
      fact.fact = {component.positive, payload, frame, 1};
      situation.Add(std::move(fact));
    }
    return !JointMatches(part, situation, {}, {1}).empty();
  }

  const FailedPrediction& failed_;
  const std::vector<const Situation*>& frames_;
  const ReasonerParameters& parameters_;
  Adoption adoption_;
  SharedValues values_;  // of the failed instance
  ModelInstance target_;
  TimeInterval valid_;                       // when the model was wrong
  std::vector<Term> same_value_;             // sensed payloads that share a value with the failed instance
  std::vector<std::set<std::size_t>> kept_;  // a set of positions for each frame
  int taken_back_ = 0;
  std::vector<std::pair<const SituationFact*, CauseVerdict>>
      no_causes_;  // sensed, and why they are no causes
};

}  // namespace

void InduceFromFailure(const FailedPrediction& failed, const std::vector<const Situation*>& frames,
                       const ReasonerParameters& parameters, Time now, Journal* journal) {
  FailureInduction(failed, frames, parameters, now, journal).Run();
}

}  // namespace aerascope
