#include "engine/reason/goal_log.h"

#include "engine/kb/term_codec.h"

namespace aerascope {
namespace {

Fact WithClosedPayload(const Fact& target) {
  Fact closed = target;
  closed.payload = Closed(target.payload);
  return closed;
}

std::string KeyOf(GoalId super, const Fact& target) {
  return std::to_string(super.value) + (target.positive ? "/" : "/not ") + Encode(target.payload);
}

}  // namespace

GoalEntry GoalLog::Set(const GoalEntry& super, ModelId model, const Fact& target) {
  const Fact closed = WithClosedPayload(target);
  const auto [it, is_new] = goals_.try_emplace(std::to_string(model.value) + "/" + KeyOf(super.id, closed));
  if (!is_new) return it->second;
  const ModelRecord* record = journal_.knowledge().Find(model);
  it->second.id = journal_.NewId<GoalId>();
  it->second.event = journal_.Write(now_, GoalSet{it->second.id, super.id, model, closed},
                                    {super.event, record ? record->event : EventId{}});
  lines_.push_back({it->second, super.id, model});
  return it->second;
}

void GoalLog::Skip(const GoalEntry& super, const Fact& target, GoalSkipReason reason, EventId because) {
  const Fact closed = WithClosedPayload(target);
  if (!skipped_.insert(KeyOf(super.id, closed)).second) return;
  const EventId skipped = journal_.Write(now_, GoalSkipped{super.id, closed, reason}, {super.event, because});
  if (Hinders(reason)) hindered_.push_back(skipped);
  if (reason != GoalSkipReason::kVetoed) return;
  vetoed_.push_back(skipped);
  if (IsImdl(closed.payload) && closed.payload[0].is(TermKind::kModel))
    refused_.emplace(closed.payload[0].model(), skipped);
}

}  // namespace aerascope
