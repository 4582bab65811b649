// Why something happened, and what it led to, as the inspector lists it.
//
// Trees name events by number only, as [event, depth, sign]; each event is told once, in TellEvents.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "viewer/page/report_context.h"

namespace aerascope {

// How many effects, or happenings with a thing, a list shows before it only counts.
inline constexpr std::size_t kEventsListed = 12;

// The nearest causes as a tree: {nodes, levels, first, cut}.
nlohmann::json WhyData(const ReportContext& context, EventId event);

// Nothing to explain, for things that have no cause.
nlohmann::json NoWhyData();

// The nearest effects worth a line, in order of time: {nodes, left_out}.
nlohmann::json EffectData(const ReportContext& context, EventId event);

// These events as a flat list of the same form.
nlohmann::json ListData(const std::vector<EventId>& events);

// All events that the subjects name, by number: {at, mark, text, subject?, failed?}.
nlohmann::json TellEvents(const ReportContext& context, const nlohmann::json& subjects);

}  // namespace aerascope
