#include "engine/reason/imagination.h"

#include <algorithm>

#include "engine/reason/chaining.h"

namespace aerascope {
namespace {

bool IsDerived(const Term& payload) {
  return IsIcst(payload) || IsImdl(payload);
}

// The requirement models among `ids` that are active and of this polarity.
bool AnyActive(const KnowledgeBase& knowledge, const std::vector<ModelId>& ids, bool positive) {
  return std::any_of(ids.begin(), ids.end(), [&](ModelId id) {
    const ModelRecord* record = knowledge.Find(id);
    return record && record->state == ModelState::kActive && record->model.rhs.positive == positive;
  });
}

// A requirement model may itself need one: is this statement of it allowed here (semantics 3.3)?
bool Allowed(const KnowledgeBase& knowledge, const Situation& situation, const Model& model,
             const Requirement& said) {
  const std::vector<ModelId>& above = knowledge.RequirementsOf(model.id);
  if (above.empty()) return true;
  Bindings bindings;
  Fact from = situation[said.from].fact;
  if (auto common = Intersection(from.interval, situation.interval())) from.interval = *common;
  if (!MatchFact(model.lhs, from, bindings) || !RunGuards(model.forward, bindings)) return false;
  double allowed = AnyActive(knowledge, above, true) ? 0 : 1;
  double veto = 0;
  for (const std::size_t i : situation.RequirementsOn(model.id)) {
    const Requirement& other = situation.requirements()[i];
    Bindings trial = bindings;
    if (!BindInstance(model, other.imdl.payload, trial)) continue;
    double& side = other.imdl.positive ? allowed : veto;
    side = std::max(side, other.imdl.confidence);
  }
  return allowed > veto;
}

}  // namespace

ImaginedFrame ImaginedFrame::Present(Situation situation, std::vector<SituationFact> pending) {
  ImaginedFrame frame(std::move(situation));
  frame.pending_ = std::move(pending);
  frame.present_ = true;
  return frame;
}

void ImaginedFrame::FindParts(const KnowledgeBase& knowledge, const CompositeState& state) {
  for (const FactPattern& component : state.components) {
    if (!IsIcst(component.payload) || !component.payload[0].is(TermKind::kCompositeState)) continue;
    if (const CompositeStateRecord* nested = knowledge.Find(component.payload[0].composite_state())) {
      FindInstances(knowledge, nested->state);
    }
  }
}

void ImaginedFrame::FindInstances(const KnowledgeBase& knowledge, const CompositeState& state) {
  if (!state.id.valid() || !found_.insert(state.id).second) return;
  FindParts(knowledge, state);
  AddInstances(state, &situation_);
}

void ImaginedFrame::AskRequirements(const KnowledgeBase& knowledge, ModelId model) {
  if (present_ || !asked_.insert(model).second) return;
  for (const ModelId id : knowledge.RequirementsOf(model)) {
    const ModelRecord* record = knowledge.Find(id);
    if (!record || record->state != ModelState::kActive) continue;
    AskRequirements(knowledge, id);
    if (const CompositeStateRecord* state = knowledge.Find(RequiredState(record->model))) {
      FindInstances(knowledge, state->state);
    }
    for (Requirement& said : RequirementsFrom(*record, situation_)) {
      if (Allowed(knowledge, situation_, record->model, said)) situation_.Add(std::move(said));
    }
  }
}

ImaginedFrame::Passage ImaginedFrame::Next(std::vector<SituationFact> effects, Duration period) const {
  const TimeInterval interval{situation_.interval().after + period, situation_.interval().before + period};
  Passage passage{ImaginedFrame(Situation(interval)), {}, {}};
  std::vector<SituationFact> coming = pending_;
  coming.insert(coming.end(), std::make_move_iterator(effects.begin()),
                std::make_move_iterator(effects.end()));
  for (SituationFact& effect : coming) {
    if (effect.fact.interval.after >= interval.before) {
      passage.frame.pending_.push_back(std::move(effect));
    } else if (effect.fact.interval.before > interval.after &&
               std::none_of(passage.arrived.begin(), passage.arrived.end(), [&](const SituationFact& other) {
                 return other.fact.positive == effect.fact.positive &&
                        SameValue(other.fact.payload, effect.fact.payload);
               })) {
      passage.arrived.push_back(std::move(effect));
    }
  }
  for (const SituationFact& fact : situation_.facts()) {
    const bool passing = IsDerived(fact.fact.payload) || (period.us != 0 && IsCommand(fact.fact.payload));
    if (passing || !fact.components.empty()) continue;
    bool renewed = false;
    const SituationFact* against = nullptr;
    for (const SituationFact& effect : passage.arrived) {
      if (fact.permanent) break;
      if (PutsAnEndTo(effect.fact, fact.fact)) against = &effect;
      renewed = renewed || (effect.fact.positive == fact.fact.positive &&
                            SameValue(effect.fact.payload, fact.fact.payload));
    }
    if (against) {
      passage.defeated.push_back({fact, *against});
      continue;
    }
    if (renewed) continue;
    SituationFact carried = fact;
    // A fact that holds for a part of each frame (a value held until it changes) keeps to that part.
    if (!carried.permanent) {
      carried.fact.interval = {fact.fact.interval.after + period, fact.fact.interval.before + period};
    }
    passage.frame.situation_.Add(std::move(carried));
  }
  for (const SituationFact& effect : passage.arrived) passage.frame.situation_.Add(effect);
  return passage;
}

std::vector<SituationFact> PendingPredictions(const KnowledgeBase& knowledge, const Situation& situation) {
  std::vector<SituationFact> pending;
  for (const auto& [id, prediction] : knowledge.predictions()) {
    const Fact& target = prediction.target;
    if (target.confidence <= 0 || target.interval.after < situation.interval().before) continue;
    SituationFact expected;
    expected.fact = target;
    expected.event = prediction.event;
    pending.push_back(std::move(expected));
  }
  return pending;
}

bool PutsAnEndTo(const Fact& effect, const Fact& fact) {
  if (SameValue(effect.payload, fact.payload)) return effect.positive != fact.positive;
  return effect.positive && fact.positive && ContradictsValue(effect.payload, fact.payload);
}

}  // namespace aerascope
