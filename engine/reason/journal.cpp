#include "engine/reason/journal.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace aerascope {

void Journal::LeaveOut(const EventKindSet& kinds) {
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) assert(!kinds[kind] || IsReportKind(kind));
  left_out_ = kinds;
}

// The causes with stand-ins replaced by what they stand for.
std::vector<EventId> Journal::Recorded(const std::vector<EventId>& causes) const {
  std::vector<EventId> recorded;
  const auto add = [&](EventId cause) {
    if (std::find(recorded.begin(), recorded.end(), cause) == recorded.end()) recorded.push_back(cause);
  };
  for (const EventId cause : causes) {
    if (cause.value > 0) {
      add(cause);
    } else if (cause.value < 0) {
      for (const EventId own : stand_ins_[static_cast<std::size_t>(-cause.value) - 1]) add(own);
    }
  }
  return recorded;
}

EventId Journal::StandInFor(std::vector<EventId> causes) {
  if (causes.empty()) return {};
  if (causes.size() == 1) return causes.front();
  const EventId next{-static_cast<std::int64_t>(stand_ins_.size()) - 1};
  const auto [it, is_new] = stand_in_by_causes_.try_emplace(causes, next);
  if (is_new) stand_ins_.push_back(std::move(causes));
  return it->second;
}

EventId Journal::Write(Time time, EventBody body, const std::vector<EventId>& causes,
                       SimulationId simulation) {
  std::vector<EventId> recorded = Recorded(causes);
  if (left_out_[body.index()]) return last_written_ = StandInFor(std::move(recorded));
  Event event{{++last_event_}, time, frame_, simulation, std::move(recorded), std::move(body)};
  Apply(event, &knowledge_);
  last_written_ = event.id;
  sink_->Append(std::move(event));
  return last_written_;
}

}  // namespace aerascope
