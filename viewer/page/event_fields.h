// The fields of an event for people: each with its value in words, and where a click on it leads.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/query/run.h"

namespace aerascope {

struct FieldText {
  std::string text;
  std::string link;  // id of a subject, or "#event"; may be empty
};

// A text for each field of the event's kind, in order; nothing for those that say nothing: none, empty, or
// the event itself.
std::vector<std::optional<FieldText>> FieldsOf(const Run& run, const Event& event);

// For each kind of event: its title, what it means, and the title and meaning of each field.
nlohmann::json DescribeKinds();

}  // namespace aerascope
