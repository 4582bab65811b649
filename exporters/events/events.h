// The events of an episode: a line of words each, or a JSON object a line (NDJSON) with every field of the
// schema.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/query/run.h"

namespace aerascope {

struct EventFilter {
  std::optional<std::size_t> kind;  // position in EventBody, see KindOfName
  Time from{std::numeric_limits<std::int64_t>::min()};
  Time to = kForever;  // included
};

// Time, number, kind and a sentence.
Status WriteEventsText(const Run& run, const EventFilter& filter, std::ostream& out);

// {"id", "time_us", "frame", "kind", "simulation", "causes", "body"}, in ASCII. Ids as text (mdl_14), times
// in microseconds, terms in their exact encoding (engine/kb/term_codec.h), enums by name, facts, evidence and
// intervals as objects.
Status WriteEventsNdjson(const Run& run, const EventFilter& filter, std::ostream& out);

// A word list for "did you mean": the names of all kinds, in order of the schema.
std::vector<std::string> EventKindNames();

}  // namespace aerascope
