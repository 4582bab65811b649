// Report kinds: the kinds of events that only say what was considered or decided. The knowledge base does not
// move by them, nothing in an episode has its number from them, and no replay or picture needs them, so a
// scenario may leave them out of the recording (semantics section 9, "optional, high volume").
//
// Everything else is part of the story itself: leaving it out would leave knowledge without an origin.
#pragma once

#include <bitset>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "engine/event/event_body.h"

namespace aerascope {

// Kinds by their position in EventBody.
using EventKindSet = std::bitset<kEventKinds>;

template <class Body>
constexpr std::size_t KindOf() {
  std::size_t at = 0;
  std::size_t found = kEventKinds;
  ForEachKind([&]<class Kind>() {
    if (std::is_same_v<Kind, Body>) found = at;
    ++at;
  });
  return found;
}

bool IsReportKind(std::size_t kind);
// Their names, in order of EventBody.
std::vector<std::string> ReportKindNames();

// What is left out unless the scenario says otherwise.
EventKindSet LeftOutByDefault();

// The names of a set, in order of EventBody, with a space between.
std::string NamesOf(const EventKindSet& kinds);

}  // namespace aerascope
