#include "engine/reason/imagination.h"

#include <algorithm>

#include "engine/reason/chaining.h"

namespace aerascope {
namespace {

bool IsDerived(const Term& payload) {
  return IsIcst(payload) || IsImdl(payload);
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
  bool delayed = false;
  for (const ModelId id : knowledge.RequirementsOf(model)) {
    const ModelRecord* record = knowledge.Find(id);
    if (!record || record->state != ModelState::kActive) continue;
    delayed = delayed || !record->model.forward.empty();
    AskRequirements(knowledge, id);
    if (const CompositeStateRecord* state = knowledge.Find(RequiredState(record->model))) {
      FindInstances(knowledge, state->state);
    }
    for (Requirement& said : StatementsOf(*record, knowledge, situation_)) {
      if (said.allowed) situation_.Add(std::move(said));
    }
  }
  if (!delayed || !before_) return;
  // What was said in earlier frames about this one.
  before_->AskRequirements(knowledge, model);
  for (const std::size_t i : before_->situation_.RequirementsOn(model)) {
    Requirement said = before_->situation_.requirements()[i];
    if (!said.allowed || said.imdl.interval.before <= interval().after) continue;
    said.from = Situation::npos;
    said.above.clear();
    situation_.Add(std::move(said));
  }
}

ImaginedFrame::Passage ImaginedFrame::Next(std::vector<SituationFact> effects, Duration period) const {
  const TimeInterval interval{situation_.interval().after + period, situation_.interval().before + period};
  Passage passage{ImaginedFrame(Situation(interval)), {}, {}};
  if (period.us != 0) {
    auto before = std::make_shared<ImaginedFrame>(*this);
    before->pending_.clear();
    passage.frame.before_ = std::move(before);
  } else {
    passage.frame.before_ = before_;
    for (const Requirement& said : situation_.requirements()) {
      if (present_ && said.from == Situation::npos) passage.frame.situation_.Add(said);
    }
  }
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

std::vector<SituationFact> PendingPredictions(const KnowledgeBase& knowledge, const Situation& situation,
                                              Pending which) {
  std::vector<SituationFact> pending;
  for (const auto& [id, prediction] : knowledge.predictions()) {
    const Fact& target = prediction.target;
    if (target.confidence <= 0 || target.interval.after < situation.interval().before) continue;
    if (which == Pending::kFromFacts && !prediction.grounds.empty()) continue;
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
