#include "engine/reason/time_outs.h"

#include <algorithm>

#include "engine/reason/credit.h"

namespace aerascope {
namespace {

// `span` after an instant, as far as time goes.
Time Later(Time from, Duration span) {
  return span.us >= kForever.us - from.us ? kForever : from + span;
}

}  // namespace

// Models made since the last look. Their numbers rise.
void TimeOuts::Register(Time now) {
  const auto& models = journal_.knowledge().models();
  for (auto it = models.upper_bound(last_registered_); it != models.end(); ++it) {
    last_registered_ = it->first;
    if (KindOf(it->second.model) == ModelKind::kDrive) continue;
    met_.try_emplace(it->first, it->second.created);
    const Duration first = std::min(parameters_.primary_thz, parameters_.secondary_thz);
    to_look_at_[std::max(Later(it->second.created, first), now)].push_back(it->first);
  }
}

void TimeOuts::Check(Time now, EventId frame) {
  for (const ModelId id : journal_.TakeComeUpAgain()) Met(id, now);
  Register(now);
  while (!to_look_at_.empty() && to_look_at_.begin()->first <= now) {
    std::vector<ModelId> due = std::move(to_look_at_.begin()->second);
    to_look_at_.erase(to_look_at_.begin());
    std::sort(due.begin(), due.end());
    for (const ModelId id : due) {
      const auto next = LookAt(id, now, frame);
      if (next && *next < kForever) to_look_at_[*next].push_back(id);
      if (!next) met_.erase(id);
    }
  }
}

std::optional<Time> TimeOuts::LookAt(ModelId id, Time now, EventId frame) {
  const ModelRecord& record = *journal_.knowledge().Find(id);
  const Time put_aside = Later(met_[id], parameters_.primary_thz);
  const Time forgotten = Later(met_[id], parameters_.secondary_thz);
  // While nothing is due, the next look is where the first thing could be.
  const Time next = forgotten > now ? std::min(put_aside, forgotten) : put_aside;
  const EventId stood = record.rated.valid() ? record.rated : record.event;
  switch (record.state) {
    case ModelState::kDeleted:
      if (!record.black_listed) return std::nullopt;
      if (forgotten > now) return forgotten;
      journal_.Write(now, ModelStateChanged{id, record.state, record.state, StateChangeReason::kForgotten},
                     {frame, stood});
      return std::nullopt;
    case ModelState::kActive:
      if (put_aside > now) return next;
      journal_.Write(
          now, ModelStateChanged{id, record.state, ModelState::kPhasedOut, StateChangeReason::kTimedOut},
          {frame, stood});
      return std::max(forgotten, now + Duration{1});
    case ModelState::kPhasedOut:
      if (forgotten > now) return forgotten;
      Delete(id, StateChangeReason::kTimedOut, frame, now, &journal_);
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace aerascope
