// Adoption is the last step of every kind of induction: what was built is checked against what is known
// (existence.h), and enters the knowledge base or is rejected, with events either way.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/event/event_body.h"
#include "engine/reason/composite_state_builder.h"
#include "engine/reason/journal.h"
#include "engine/reason/requirement_builder.h"

namespace aerascope {

// The conditions under which a model was right or wrong: a composite state that held, or one plain fact.
struct Condition {
  std::optional<StateInstance> state;
  Fact fact;                    // where there is no state
  std::vector<EventId> events;  // what it is made from
};
Condition OnState(StateInstance state, const Situation& situation);
Condition OnFact(const SituationFact& fact);

// A requirement model to be, with the model it speaks about, which may be new as well.
struct Candidate {
  const SituationFact& cause;
  std::string_view guard_form;
  Condition condition;
  ModelInstance target;  // its id is invalid if it is just built
  TimeInterval valid;    // when the target was right or wrong
  bool right = true;
};

// One run of induction, as far as it is written down.
class Adoption {
 public:
  Adoption(InductionKind kind, ValueRoles roles, Time now, Journal* journal)
      : kind_(kind), roles_(roles), now_(now), journal_(*journal) {}

  const KnowledgeBase& knowledge() const { return journal_.knowledge(); }

  // Whether inputs are recorded; if not, the work of listing them can be saved.
  bool records_inputs() const { return journal_.Records<InductionStarted>(); }
  // Writes InductionStarted; `causes` stand behind all that is learned. What was kept of the inputs is put
  // first.
  void Start(FactId premise, FactId consequent, const std::vector<EventId>& causes,
             std::vector<ConsideredInput> inputs);
  // Writes CauseConsidered.
  EventId Report(const SituationFact& input, CauseVerdict verdict, std::string_view guard_form = {});
  // Writes CauseConsidered and, for what was put together in vain, ModelRejected.
  void Reject(const SituationFact& input, CauseVerdict reason, Model candidate, ModelId same_as = {});

  // Writes the composite state, the target and the requirement model as far as they are new. True if a
  // requirement model was made.
  bool Adopt(Candidate candidate);
  // Writes a model without a requirement model.
  bool Adopt(const SituationFact& cause, Model model);

 private:
  Origin origin() const;
  EventId WriteModel(Model model, std::vector<EventId> causes);

  InductionKind kind_;
  ValueRoles roles_;
  Time now_;
  Journal& journal_;
  EventId started_;
  std::vector<EventId> evidence_;
};

}  // namespace aerascope
