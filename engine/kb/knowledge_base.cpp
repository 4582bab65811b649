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
  // Found by the component that shares its place in the index with the fewest others; a slot left open counts
  // as eight.
  const Term* key = nullptr;
  std::size_t fewest = 0;
  for (const FactPattern& component : record.state.components) {
    const PayloadSlots slots = PayloadSlots::Of(component.payload, nullptr);
    const std::size_t crowd =
        key_components_.CrowdAt(component.payload) + 8 * static_cast<std::size_t>(3 - slots.exact());
    if (key && crowd >= fewest) continue;
    key = &component.payload;
    fewest = crowd;
  }
  if (key && !composite_states_.contains(id)) key_components_.Add(*key, id);
  composite_states_.insert_or_assign(id, std::move(record));
}

void KnowledgeBase::AddModel(ModelRecord record) {
  record.canonical = CanonicalOf(record.model);
  const auto [known, is_new] = model_by_content_.try_emplace(record.canonical.hash, record.model.id);
  if (!is_new) {
    const ModelRecord& equal = models_.at(known->second);
    if (equal.state == ModelState::kDeleted && !equal.black_listed) known->second = record.model.id;
  }
  const ModelId id = record.model.id;
  const auto earlier = models_.find(id);
  if (earlier != models_.end()) Unindex(earlier->second);
  Index(models_.insert_or_assign(id, std::move(record)).first->second);
}

void KnowledgeBase::Index(const ModelRecord& record) {
  if (record.state == ModelState::kDeleted) return;
  ++models_in_use_;
  const Model& model = record.model;
  left_sides_.Add(model.lhs.payload, model.id);
  right_sides_.Add(model.rhs.payload, model.id);
  if (!IsRequirement(model)) return;
  std::vector<ModelId>& known = requirements_[TargetModel(model)];
  known.insert(std::lower_bound(known.begin(), known.end(), model.id), model.id);
}

void KnowledgeBase::Unindex(const ModelRecord& record) {
  if (record.state == ModelState::kDeleted) return;
  --models_in_use_;
  const Model& model = record.model;
  left_sides_.Remove(model.lhs.payload, model.id);
  right_sides_.Remove(model.rhs.payload, model.id);
  if (IsRequirement(model)) std::erase(requirements_[TargetModel(model)], model.id);
}

std::vector<ModelId> KnowledgeBase::ModelsByLhs(const Term& payload) const {
  std::vector<ModelId> found;
  left_sides_.Find(payload, [&](ModelId id) { found.push_back(id); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<ModelId> KnowledgeBase::ModelsByRhs(const Term& payload) const {
  std::vector<ModelId> found;
  right_sides_.Find(payload, [&](ModelId id) { found.push_back(id); });
  std::sort(found.begin(), found.end());
  return found;
}

void KnowledgeBase::SetEvidence(ModelId id, Evidence evidence, bool strong, EventId event) {
  const auto it = models_.find(id);
  if (it == models_.end()) return;
  it->second.evidence = evidence;
  it->second.strong = strong;
  it->second.rated = event;
}

void KnowledgeBase::SetState(ModelId id, ModelState state, bool black_listed, EventId event) {
  const auto it = models_.find(id);
  if (it == models_.end()) return;
  Unindex(it->second);
  it->second.state = state;
  it->second.black_listed = black_listed;
  it->second.moved = event;
  Index(it->second);
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
