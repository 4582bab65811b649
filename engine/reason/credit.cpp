#include "engine/reason/credit.h"

#include <algorithm>

#include "engine/reason/rating.h"

namespace aerascope {
namespace {

constexpr int kMaxLevels = 16;  // of requirement models on requirement models

// Was this model right, if `predicting` was right or wrong as `success` says?
bool WasRight(const KnowledgeBase& knowledge, ModelId id, ModelId predicting, bool success) {
  bool right = success;
  for (int level = 0; level < kMaxLevels && id != predicting; ++level) {
    const ModelRecord* record = knowledge.Find(id);
    if (!record || !IsRequirement(record->model)) break;
    if (KindOf(record->model) == ModelKind::kStrongRequirement) right = !right;
    id = TargetModel(record->model);
  }
  return right;
}

void RateModel(ModelId id, bool right, EventId outcome, Time now, const ReasonerParameters& parameters,
               Journal* journal) {
  const ModelRecord* record = journal->knowledge().Find(id);
  if (!record || record->state == ModelState::kDeleted) return;
  const Rating before{record->evidence, record->strong, record->state};
  const Rating after = Rate(before, right, parameters);
  if (after == before) return;
  // What it stood at came of its last rating, or of how it was made.
  const EventId stood = record->rated.valid() ? record->rated : record->event;
  const EventId updated = journal->Write(
      now, EvidenceUpdated{id, right, before.evidence, after.evidence, before.strong, after.strong},
      {outcome, stood});
  if (after.state == before.state) return;
  if (after.state == ModelState::kDeleted)
    return Delete(id, StateChangeReason::kRating, updated, now, journal);
  journal->Write(now, ModelStateChanged{id, before.state, after.state, StateChangeReason::kRating},
                 {updated});
}

// Models that say something about this one, or ride on it; alive, by number.
std::vector<ModelId> ModelsOn(const KnowledgeBase& knowledge, ModelId id) {
  std::vector<ModelId> found;
  for (const auto& [other, record] : knowledge.models()) {
    if (record.state != ModelState::kDeleted && TargetModel(record.model) == id) found.push_back(other);
  }
  return found;
}

bool IsOrphan(const KnowledgeBase& knowledge, const ModelRecord& record) {
  if (record.state == ModelState::kDeleted || record.model.template_arguments.empty()) return false;
  const std::vector<ModelId>& requirements = knowledge.RequirementsOf(record.model.id);
  return std::none_of(requirements.begin(), requirements.end(),
                      [&](ModelId id) { return knowledge.Find(id)->model.rhs.positive; });
}

}  // namespace

void GiveCredit(const Outcome& outcome, Time now, const ReasonerParameters& parameters, Journal* journal) {
  // Who was right is settled before anyone is deleted.
  std::vector<std::pair<ModelId, bool>> ratings{{outcome.model, outcome.success}};
  for (const ModelId id : outcome.requirements) {
    const bool seen =
        std::any_of(ratings.begin(), ratings.end(), [&](const auto& entry) { return entry.first == id; });
    if (seen) continue;
    const bool right = WasRight(journal->knowledge(), id, outcome.model, outcome.success);
    const bool spoke =
        std::find(outcome.silenced.begin(), outcome.silenced.end(), id) == outcome.silenced.end();
    if (right || spoke) ratings.emplace_back(id, right);
  }
  for (const auto& [id, right] : ratings) RateModel(id, right, outcome.event, now, parameters, journal);
}

void Delete(ModelId id, StateChangeReason reason, EventId cause, Time now, Journal* journal) {
  const KnowledgeBase& knowledge = journal->knowledge();
  const ModelRecord* record = knowledge.Find(id);
  if (!record || record->state == ModelState::kDeleted) return;
  const EventId deleted =
      journal->Write(now, ModelStateChanged{id, record->state, ModelState::kDeleted, reason}, {cause});
  for (const ModelId on_it : ModelsOn(knowledge, id)) {
    Delete(on_it, StateChangeReason::kRefersToDeleted, deleted, now, journal);
  }
  if (!IsRequirement(record->model)) return;
  const ModelRecord* target = knowledge.Find(TargetModel(record->model));
  if (target && IsOrphan(knowledge, *target)) {
    Delete(target->model.id, StateChangeReason::kOrphaned, deleted, now, journal);
  }
}

}  // namespace aerascope
