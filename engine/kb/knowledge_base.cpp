#include "engine/kb/knowledge_base.h"

#include <algorithm>

namespace aerascope {

const CompositeStateRecord* KnowledgeBase::Find(CompositeStateId id) const {
  const auto it = composite_states_.find(id);
  return it == composite_states_.end() ? nullptr : &it->second;
}

const ModelRecord* KnowledgeBase::Find(ModelId id) const {
  const auto it = models_.find(id);
  return it == models_.end() ? nullptr : &it->second;
}

CompositeStateId KnowledgeBase::FindState(Hash128 content) const {
  const auto it = state_by_content_.find(content);
  return it == state_by_content_.end() ? CompositeStateId{} : it->second;
}

ModelId KnowledgeBase::FindModel(Hash128 content) const {
  const auto it = model_by_content_.find(content);
  return it == model_by_content_.end() ? ModelId{} : it->second;
}

Definitions KnowledgeBase::DefinitionsHere() const {
  return {[this](CompositeStateId id) {
            const CompositeStateRecord* record = Find(id);
            return record ? &record->state : nullptr;
          },
          [this](ModelId id) {
            const ModelRecord* record = Find(id);
            return record ? &record->model : nullptr;
          }};
}

aerascope::CanonicalOf KnowledgeBase::CanonicalLookup() const {
  return [this](const Term& reference) -> const Canonical* {
    if (reference.is(TermKind::kCompositeState)) {
      const CompositeStateRecord* record = Find(reference.composite_state());
      return record ? &record->canonical : nullptr;
    }
    if (!reference.is(TermKind::kModel)) return nullptr;
    const ModelRecord* record = Find(reference.model());
    return record ? &record->canonical : nullptr;
  };
}

Canonical KnowledgeBase::CanonicalOf(const CompositeState& state) const {
  return Canonicalise(state, CanonicalLookup(), DefinitionsHere());
}

Canonical KnowledgeBase::CanonicalOf(const Model& model) const {
  return Canonicalise(model, CanonicalLookup(), DefinitionsHere());
}

const std::vector<ModelId>& KnowledgeBase::RequirementsOf(ModelId causal_model) const {
  static const std::vector<ModelId> none;
  const auto it = requirements_.find(causal_model);
  return it == requirements_.end() ? none : it->second;
}

void KnowledgeBase::SetNow(Time now, std::int64_t frame) {
  now_ = now;
  frame_ = frame;
}

void KnowledgeBase::AddSymbol(Term symbol) {
  symbols_.push_back(std::move(symbol));
}

void KnowledgeBase::AddFact(FactRecord record) {
  facts_.insert_or_assign(record.id, std::move(record));
}

void KnowledgeBase::ExpireFacts(Time now) {
  std::erase_if(facts_, [&](const auto& entry) { return entry.second.fact.interval.before <= now; });
}

void KnowledgeBase::AddCompositeState(CompositeStateRecord record) {
  record.canonical = CanonicalOf(record.state);
  state_by_content_.try_emplace(record.canonical.hash, record.state.id);
  const CompositeStateId id = record.state.id;
  composite_states_.insert_or_assign(id, std::move(record));
}

void KnowledgeBase::AddModel(ModelRecord record) {
  record.canonical = CanonicalOf(record.model);
  model_by_content_.try_emplace(record.canonical.hash, record.model.id);
  const ModelId id = record.model.id;
  models_.insert_or_assign(id, std::move(record));
  IndexRequirement(id);
}

void KnowledgeBase::IndexRequirement(ModelId id) {
  const ModelRecord& record = models_.at(id);
  if (!IsRequirement(record.model)) return;
  std::vector<ModelId>& known = requirements_[TargetModel(record.model)];
  std::erase(known, id);
  if (record.state != ModelState::kDeleted)
    known.insert(std::lower_bound(known.begin(), known.end(), id), id);
}

void KnowledgeBase::SetEvidence(ModelId id, Evidence evidence, bool strong) {
  const auto it = models_.find(id);
  if (it == models_.end()) return;
  it->second.evidence = evidence;
  it->second.strong = strong;
}

void KnowledgeBase::SetState(ModelId id, ModelState state) {
  const auto it = models_.find(id);
  if (it == models_.end()) return;
  it->second.state = state;
  IndexRequirement(id);
}

void KnowledgeBase::OpenGoal(GoalRecord record) {
  goals_.insert_or_assign(record.id, std::move(record));
}
void KnowledgeBase::CloseGoal(GoalId id) {
  goals_.erase(id);
}
void KnowledgeBase::OpenPrediction(PredictionRecord record) {
  predictions_.insert_or_assign(record.id, std::move(record));
}
void KnowledgeBase::ClosePrediction(PredictionId id) {
  predictions_.erase(id);
}

}  // namespace aerascope
