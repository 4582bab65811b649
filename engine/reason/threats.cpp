#include "engine/reason/threats.h"

#include "engine/reason/abduction.h"

namespace aerascope {

Threats FindThreats(const Fact& target, const GoalEntry& goal, ImaginedFrame* present,
                    const PlanningContext& context, GoalLog* goals) {
  const KnowledgeBase& knowledge = context.knowledge;
  Threats threats;
  for (const ModelId id : knowledge.ModelsByRhs(Closed(target.payload))) {
    const ModelRecord* record = knowledge.Find(id);
    Bindings bindings;
    if (!IsRunning(record) || record->model.rhs.positive == target.positive || IsRequirement(record->model) ||
        !Match(record->model.rhs.payload, Closed(target.payload), bindings)) {
      continue;
    }
    const TimeInterval window = WindowOf(record->model, bindings, target.interval, context.period);
    const double confidence = target.confidence * record->evidence.rate();
    // What could make it fire now, and under which bindings.
    present->AskRequirements(knowledge, id);
    std::vector<Bindings> firing;
    bool required = false;
    for (const ModelId by : knowledge.RequirementsOf(id)) {
      const ModelRecord* requirement = knowledge.Find(by);
      required = required || (IsRunning(requirement) && requirement->model.rhs.positive);
    }
    if (!required && record->model.template_arguments.empty()) firing.push_back(bindings);
    for (const Requirement& requirement : present->situation().requirements()) {
      Bindings allowed = bindings;
      if (required && requirement.target == id && requirement.imdl.positive &&
          requirement.imdl.interval.Overlaps(present->interval()) &&
          BindInstance(record->model, requirement.imdl.payload, allowed)) {
        firing.push_back(std::move(allowed));
      }
    }
    const Model* acts = &record->model;
    for (Bindings& under : firing) {
      RunGuards(record->model.backward, under, OnUnbound::kDefer);
      Term cause = Closed(Substitute(record->model.lhs.payload, under));
      for (int ridden = 0; IsImdl(cause) && ridden < context.parameters.max_plan_depth; ++ridden) {
        const ModelRecord* other = cause[0].is(TermKind::kModel) ? knowledge.Find(cause[0].model()) : nullptr;
        Bindings inside;
        if (!IsRunning(other) || !BindInstance(other->model, cause, inside)) break;
        acts = &other->model;
        cause = Closed(Substitute(acts->lhs.payload, inside));
      }
      const Fact must_not{!record->model.lhs.positive, cause, window, confidence};
      if (IsCommand(cause)) {
        threats.prohibitions.push_back({cause, goals->Set(goal, id, must_not)});
      } else if (HoldsIn(present->situation(), must_not)) {
        goals->Skip(goal, must_not, GoalSkipReason::kAlreadyHolds);
      } else if (present->situation().FindMatch(cause, record->model.lhs.positive, {}) != Situation::npos) {
        threats.mandatory.push_back({goals->Set(goal, id, must_not), must_not});
      }
    }
  }
  return threats;
}

}  // namespace aerascope
