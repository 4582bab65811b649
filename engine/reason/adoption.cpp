#include "engine/reason/adoption.h"

#include <algorithm>
#include <utility>

#include "engine/reason/existence.h"

namespace aerascope {
namespace {

CauseVerdict VerdictOn(const ModelRecord& equal) {
  return equal.state == ModelState::kDeleted ? CauseVerdict::kBlackListed : CauseVerdict::kDuplicate;
}

}  // namespace

Condition OnState(StateInstance state, const Situation& situation) {
  Condition condition;
  for (const std::size_t i : state.facts) condition.events.push_back(situation[i].event);
  condition.state = std::move(state);
  return condition;
}

Condition OnFact(const SituationFact& fact) {
  return {std::nullopt, fact.fact, {fact.event}};
}

Origin Adoption::origin() const {
  switch (kind_) {
    case InductionKind::kChange:
      return Origin::kInduction;
    case InductionKind::kPredictionFailure:
      return Origin::kPredictionFailure;
    case InductionKind::kGoalSuccess:
      return Origin::kGoalSuccess;
  }
  return Origin::kInduction;
}

void Adoption::Start(FactId premise, FactId consequent, const std::vector<EventId>& causes,
                     std::vector<ConsideredInput> inputs) {
  evidence_ = causes;
  std::stable_partition(inputs.begin(), inputs.end(), [](const ConsideredInput& one) {
    return one.verdict == InputVerdict::kCause || one.verdict == InputVerdict::kCondition;
  });
  started_ = journal_.Write(now_, InductionStarted{kind_, premise, consequent, std::move(inputs)}, causes);
}

EventId Adoption::Report(const SituationFact& input, CauseVerdict verdict, std::string_view guard_form) {
  return journal_.Write(now_, CauseConsidered{input.id, verdict, std::string(guard_form)},
                        {started_, input.event});
}

void Adoption::Reject(const SituationFact& input, CauseVerdict reason, Model candidate, ModelId same_as) {
  const EventId considered = Report(input, reason);
  if (reason == CauseVerdict::kBlackListed) journal_.ComeUpAgain(same_as);
  if (!candidate.id.valid()) candidate.id = journal_.NewId<ModelId>();
  const ModelRecord* same = knowledge().Find(same_as);
  journal_.Write(now_, ModelRejected{kind_, std::move(candidate), reason, same_as},
                 {considered, same ? same->event : EventId{}});
}

EventId Adoption::WriteModel(Model model, std::vector<EventId> causes) {
  return journal_.Write(now_, ModelCreated{std::move(model), {}, false, origin(), {}}, std::move(causes));
}

bool Adoption::Adopt(Candidate candidate) {
  const bool built = !candidate.target.model.id.valid();
  const ModelRecord* known =
      built ? FindEqual(candidate.target.model, knowledge()) : knowledge().Find(candidate.target.model.id);
  // A model that failed for good also blocks the requirement model on it.
  if (known && known->state == ModelState::kDeleted) {
    Reject(candidate.cause, CauseVerdict::kBlackListed, candidate.target.model, known->model.id);
    return false;
  }
  if (built && known) candidate.target = InTermsOf(*known, candidate.target, knowledge());
  if (!known) candidate.target.model.id = journal_.NewId<ModelId>();

  std::optional<StateInstance>& state = candidate.condition.state;
  const bool new_state = state && !state->state.id.valid();
  if (new_state) state->state.id = journal_.NewId<CompositeStateId>();
  const Fact condition = state ? Fact{true, InstancePayload(state->state, state->values), state->interval, 1}
                               : candidate.condition.fact;
  auto requirement =
      BuildRequirement({condition, candidate.target, candidate.valid, candidate.right},
                       KnownDefinitions(knowledge(), new_state ? &state->state : nullptr), roles_);
  if (!requirement) {
    Reject(candidate.cause, CauseVerdict::kFreeVariable, candidate.target.model,
           known ? known->model.id : ModelId{});
    return false;
  }
  if (known && !new_state) {
    if (const ModelRecord* equal = FindEqual(*requirement, knowledge())) {
      Reject(candidate.cause, VerdictOn(*equal), std::move(*requirement), equal->model.id);
      return false;
    }
  }

  const EventId considered = Report(candidate.cause, CauseVerdict::kBuilt, candidate.guard_form);
  EventId state_event;
  if (new_state) {
    std::vector<EventId> causes{considered};
    causes.insert(causes.end(), candidate.condition.events.begin(), candidate.condition.events.end());
    state_event = journal_.Write(now_, CompositeStateCreated{state->state, origin(), {}}, causes);
  } else if (state) {
    state_event = knowledge().Find(state->state.id)->event;
  }
  EventId target_event = known ? known->event : EventId{};
  if (!known) {
    std::vector<EventId> causes{considered, candidate.cause.event};
    causes.insert(causes.end(), evidence_.begin(), evidence_.end());
    target_event = WriteModel(candidate.target.model, std::move(causes));
  }
  std::vector<EventId> causes{considered, state_event, target_event};
  if (!state)
    causes.insert(causes.end(), candidate.condition.events.begin(), candidate.condition.events.end());
  requirement->id = journal_.NewId<ModelId>();
  WriteModel(std::move(*requirement), std::move(causes));
  return true;
}

bool Adoption::Adopt(const SituationFact& cause, Model model) {
  if (const ModelRecord* equal = FindEqual(model, knowledge())) {
    Reject(cause, VerdictOn(*equal), std::move(model), equal->model.id);
    return false;
  }
  const EventId considered = Report(cause, CauseVerdict::kBuilt, ToText(GuardForm::kTiming));
  model.id = journal_.NewId<ModelId>();
  std::vector<EventId> causes{considered, cause.event};
  causes.insert(causes.end(), evidence_.begin(), evidence_.end());
  WriteModel(std::move(model), std::move(causes));
  return true;
}

}  // namespace aerascope
