#include "engine/reason/goal_induction.h"

#include <algorithm>
#include <set>
#include <utility>

#include "engine/reason/abduction.h"
#include "engine/reason/abstraction.h"
#include "engine/reason/adoption.h"
#include "engine/reason/causal_model_builder.h"
#include "engine/reason/composite_state_builder.h"
#include "engine/reason/guard_form.h"
#include "engine/reason/requirement_builder.h"
#include "engine/reason/roles.h"

namespace aerascope {
namespace {

constexpr int kAnyDepth = 64;

class InductionFromGoal {
 public:
  InductionFromGoal(const ReachedGoal& goal, ValueRoles roles, Time now, Journal* journal)
      : goal_(goal),
        roles_(roles),
        wanted_(goal.target),
        adoption_(InductionKind::kGoalSuccess, roles, now, journal),
        values_(journal->knowledge(), roles) {
    // What the goal leaves open is as it was seen.
    if (!wanted_.payload.ground()) wanted_ = goal.evidence;
    wanted_.interval = goal.evidence.interval;
    values_.Add(wanted_.payload);
  }

  void Run(const std::vector<PredictedCommand>& came_true, const std::vector<const Situation*>& frames,
           bool pass_through) {
    const bool side_effect = !goal_.target.positive && !came_true.empty();
    if (pass_through && !side_effect) return;
    adoption_.Start(side_effect ? came_true.front().command.id : FactId{}, goal_.shown_by, goal_.events,
                    pass_through ? std::vector<ConsideredInput>{} : Inputs(frames));
    if (side_effect) {
      for (const PredictedCommand& done : came_true) TrySideEffect(done);
    }
    if (pass_through) return;
    for (const Situation* frame : frames) TryInputs(*frame);
  }

 private:
  const KnowledgeBase& kb() const { return adoption_.knowledge(); }

  void TrySideEffect(const PredictedCommand& done) {
    tried_.insert(done.command.id);
    ModelInstance model = Build(done.command.fact);
    if (done.condition == Situation::npos) return AdoptAlone(done.command, std::move(model.model));
    const SituationFact& held = (*done.frame)[done.condition];
    Condition condition = IsIcst(held.fact.payload)
                              ? OnState(InstanceAt(done.condition, *done.frame, kb()), *done.frame)
                              : OnFact(held);
    adoption_.Adopt({done.command, ToText(GuardForm::kTiming), std::move(condition), std::move(model),
                     held.fact.interval, true});
  }

  // What is made of what was seen or done in the frames, if that is recorded. An instance is tried with what
  // it contains, so it is no input of its own.
  std::vector<ConsideredInput> Inputs(const std::vector<const Situation*>& frames) const {
    std::vector<ConsideredInput> inputs;
    if (!adoption_.records_inputs()) return inputs;
    for (const Situation* frame : frames) {
      for (const SituationFact& input : frame->facts()) {
        if (!IsIcst(input.fact.payload)) inputs.push_back({input.id, VerdictOn(input)});
      }
    }
    return inputs;
  }

  InputVerdict VerdictOn(const SituationFact& input) const {
    const Time begins = goal_.evidence.interval.after;
    const bool over = input.fact.interval.before <= goal_.target.interval.after;  // before the goal was given
    if (over || input.permanent || input.concluded || IsImdl(input.fact.payload))
      return InputVerdict::kNotEligible;
    if (!values_.SharedBy(input.fact.payload)) return InputVerdict::kNoSharedValue;
    if (Synchronous(input.fact.interval.after, begins)) return InputVerdict::kOutOfStep;
    return input.fact.interval.after > begins ? InputVerdict::kTooLate : InputVerdict::kCause;
  }

  // What was seen or done in a frame, in the order of content.
  void TryInputs(const Situation& frame) {
    std::vector<std::size_t> all(frame.facts().size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const std::vector<std::size_t> outermost = Outermost(all, frame);
    std::vector<std::pair<std::string, std::size_t>> inputs;
    for (const std::size_t i : all) {
      const SituationFact& input = frame[i];
      const Term& payload = input.fact.payload;
      if (input.permanent || input.concluded || IsIcst(payload) || IsImdl(payload)) continue;
      inputs.emplace_back(ContentKey(payload, kb()) + (input.fact.positive ? "+" : "-"), i);
    }
    std::sort(inputs.begin(), inputs.end());
    std::set<std::size_t> states_tried;
    for (const auto& [content, i] : inputs) TryInput(frame, outermost, i, &states_tried);
  }

  void TryInput(const Situation& frame, const std::vector<std::size_t>& outermost, std::size_t position,
                std::set<std::size_t>* states_tried) {
    const SituationFact& input = frame[position];
    const InputVerdict verdict = VerdictOn(input);
    if (tried_.contains(input.id) || verdict == InputVerdict::kNotEligible) return;
    if (verdict == InputVerdict::kNoSharedValue) {
      adoption_.Report(input, CauseVerdict::kNoSharedValue);
    } else if (verdict == InputVerdict::kOutOfStep) {
      adoption_.Report(input, CauseVerdict::kSimultaneous);
    } else if (verdict == InputVerdict::kTooLate) {
      adoption_.Report(input, CauseVerdict::kTooLate);
    } else if (IsCommand(input.fact.payload)) {
      tried_.insert(input.id);
      if (Explained(input.fact)) {
        adoption_.Report(input, CauseVerdict::kDuplicate);
      } else {
        AdoptAlone(input, Build(input.fact).model);
      }
    } else {
      bool contained = false;
      for (const std::size_t i : outermost) {
        if (i == position || !Contains(frame, i, position, kAnyDepth)) continue;
        contained = true;
        if (states_tried->insert(i).second) AdoptAlone(input, Build(frame[i].fact).model);
      }
      if (!contained) AdoptAlone(input, Build(input.fact).model);
    }
  }

  // Does a known model lead from this command to what was seen?
  bool Explained(const Fact& command) const {
    const std::vector<ModelId> models = kb().ModelsByLhs(command.payload);
    return std::any_of(models.begin(), models.end(), [&](ModelId id) {
      const Model& model = kb().Find(id)->model;
      Bindings bindings;
      if (!Match(model.lhs.payload, command.payload, bindings)) return false;
      Bindings same = bindings;
      return (model.rhs.positive == wanted_.positive && Match(model.rhs.payload, wanted_.payload, same)) ||
             (model.rhs.positive && Match(model.rhs.payload, goal_.evidence.payload, bindings));
    });
  }

  void AdoptAlone(const SituationFact& cause, Model model) {
    if (EffectVariablesLeftOpen(model).empty()) {
      adoption_.Adopt(cause, std::move(model));
    } else {
      adoption_.Reject(cause, CauseVerdict::kFreeVariable, std::move(model));
    }
  }

  // Cause -> what was wanted, by the time between them.
  ModelInstance Build(const Fact& cause) const {
    Abstraction abstraction(roles_);
    Model model;
    const auto instant = [&](Time time, const char* role, const char* name) {
      return abstraction.Value(Term::Instant(time), role, name);
    };
    model.lhs.positive = cause.positive;
    model.lhs.payload = abstraction.Payload(cause.payload, kb());
    model.lhs.after = instant(cause.interval.after, kCauseAfter, "Tc0");
    model.lhs.before = instant(cause.interval.before, kCauseBefore, "Tc1");
    model.rhs.positive = wanted_.positive;
    model.rhs.payload = abstraction.Payload(wanted_.payload, kb());
    model.rhs.after = instant(wanted_.interval.after, kEffectAfter, "T2");
    model.rhs.before = instant(wanted_.interval.before, kEffectBefore, "T3");
    const Term offset = Term::Span(wanted_.interval.after - cause.interval.after);
    const Term end_offset = Term::Span(wanted_.interval.before - cause.interval.before);
    model.forward = {Assignment(model.rhs.after, "+", model.lhs.after, offset),
                     Assignment(model.rhs.before, "+", model.lhs.before, end_offset)};
    model.backward = {Assignment(model.lhs.after, "-", model.rhs.after, offset),
                      Assignment(model.lhs.before, "-", model.rhs.before, end_offset)};
    if (IsCommand(cause.payload)) Freeze(cause.payload, &model);
    model.variable_names = abstraction.names();
    return {std::move(model), abstraction.instance()};
  }

  // Backward, the quantities of the command are what they were, unless the goal says them.
  static void Freeze(const Term& command, Model* model) {
    std::set<int> said;
    ForEachVariable(model->rhs.payload, [&](int variable) { said.insert(variable); });
    for (std::size_t i = 0; i < command[1].size(); ++i) {
      const Term& argument = model->lhs.payload[1][i];
      if (!IsQuantity(command[1][i]) || !argument.is(TermKind::kVariable)) continue;
      if (said.insert(argument.variable()).second)
        model->backward.push_back(Guard{argument.variable(), command[1][i]});
    }
  }

  const ReachedGoal& goal_;
  ValueRoles roles_;
  Fact wanted_;
  Adoption adoption_;
  SharedValues values_;  // of the goal
  std::set<FactId> tried_;
};

}  // namespace

void InduceFromGoal(const ReachedGoal& goal, const std::vector<PredictedCommand>& came_true,
                    const std::vector<const Situation*>& frames, const ReasonerParameters& parameters,
                    Time now, Journal* journal) {
  InductionFromGoal(goal, parameters.value_roles, now, journal)
      .Run(came_true, frames, parameters.goal_induction == GoalInduction::kSideEffects);
}

}  // namespace aerascope
