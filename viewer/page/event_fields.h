// The fields of an event for people: each with its value in words, and where a click on it leads.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/query/run.h"

namespace aerascope {

// [[position of the field, value], ...] without fields that say nothing (none, empty). A value is a text or
// [text, id of a subject or "#event"].
nlohmann::json FieldsOf(const Run& run, const Event& event);

// For each kind of event: its title, what it means, and the title and meaning of each field.
nlohmann::json DescribeKinds();

}  // namespace aerascope
