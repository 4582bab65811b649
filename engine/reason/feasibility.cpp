#include "engine/reason/feasibility.h"

#include "engine/kb/term_codec.h"
#include "engine/reason/abduction.h"

namespace aerascope {

bool Feasibility::CanBringAbout(const Term& payload, bool positive) {
  const Fact target{positive, Closed(payload), {}, 1};
  const auto [it, is_new] =
      can_bring_about_.try_emplace((positive ? "" : "not ") + Encode(target.payload), false);
  if (!is_new) return it->second;
  bool can = false;
  for (const ModelId id : ModelsFor(target, knowledge_)) {
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

bool Feasibility::CanFire(const ModelRecord& record, const Bindings& bindings, int depth) {
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

double Feasibility::Conceivable(const Term& payload) {
  const CompositeStateRecord* record = IsIcst(payload) && payload[0].is(TermKind::kCompositeState)
                                           ? knowledge_.Find(payload[0].composite_state())
                                           : nullptr;
  const auto changeable = [&](const Term& part, bool positive) {
    return !ModelsFor({positive, part, {}, 1}, knowledge_).empty();
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

}  // namespace aerascope
