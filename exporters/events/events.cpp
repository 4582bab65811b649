#include "exporters/events/events.h"

#include <nlohmann/json.hpp>
#include <ostream>
#include <type_traits>

#include "engine/base/text.h"
#include "engine/kb/term_codec.h"
#include "engine/query/describe.h"
#include "exporters/escape/escape.h"

namespace aerascope {
namespace {

using Json = nlohmann::ordered_json;

template <class Body>
Json FieldsOf(const Body& body);

// The value of any field the schema may have (event_body.h names the types).
template <class T>
Json ValueOf(const T& value) {
  if constexpr (kIsId<T>) {
    return value.valid() ? Json(IdText(value)) : Json(nullptr);
  } else if constexpr (std::is_enum_v<T>) {
    return EnumName(value);
  } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
    return value;
  } else if constexpr (std::is_same_v<T, Term>) {
    return Encode(value);
  } else if constexpr (std::is_same_v<T, Time>) {
    return value.us;
  } else if constexpr (std::is_same_v<T, TimeInterval>) {
    return {{"after_us", value.after.us}, {"before_us", value.before.us}};
  } else if constexpr (std::is_same_v<T, Fact>) {
    return {{"positive", value.positive},
            {"payload", Encode(value.payload)},
            {"after_us", value.interval.after.us},
            {"before_us", value.interval.before.us},
            {"confidence", value.confidence}};
  } else if constexpr (std::is_same_v<T, Evidence>) {
    return {{"positive", value.positive}, {"total", value.total}};
  } else if constexpr (std::is_same_v<T, CompositeState> || std::is_same_v<T, Model>) {
    return {{"id", IdText(value.id)}, {"definition", Encode(DefinitionToTerm(value))}};
  } else if constexpr (kIsVector<T>) {
    Json list = Json::array();
    for (const auto& item : value) list.push_back(ValueOf(item));
    return list;
  } else {
    return FieldsOf(value);
  }
}

template <class Body>
Json FieldsOf(const Body& body) {
  Json object = Json::object();
  ForEachField<Body>(
      [&](const auto& field) { object[std::string(field.name)] = ValueOf(body.*(field.member)); });
  return object;
}

bool Passes(const EventFilter& filter, const Event& event) {
  if (filter.kind && *filter.kind != event.body.index()) return false;
  return filter.from <= event.time && event.time <= filter.to;
}

std::string Padded(std::string text, std::size_t width) {
  if (text.size() < width) text.append(width - text.size(), ' ');
  return text;
}

}  // namespace

std::vector<std::string> EventKindNames() {
  std::vector<std::string> names;
  ForEachKind([&]<class Body>() { names.emplace_back(Body::kName); });
  return names;
}

Status WriteEventsText(const Run& run, const EventFilter& filter, std::ostream& out) {
  std::size_t widest = 0;
  for (const std::string& name : EventKindNames()) widest = std::max(widest, name.size());
  for (const Event& event : run.events()) {
    if (!Passes(filter, event)) continue;
    out << Padded(SecondsText(event.time), 8) << " " << Padded(IdText(event.id), 7) << " "
        << Padded(std::string(KindName(event.body)), widest) << "  " << SentenceOf(run, event) << "\n";
  }
  out.flush();
  return StatusOf(out, "the list of events");
}

Status WriteEventsNdjson(const Run& run, const EventFilter& filter, std::ostream& out) {
  for (const Event& event : run.events()) {
    if (!Passes(filter, event)) continue;
    Json causes = Json::array();
    for (const EventId cause : event.causes) causes.push_back(cause.value);
    Json line = {{"id", event.id.value},
                 {"time_us", event.time.us},
                 {"frame", event.frame},
                 {"kind", KindName(event.body)},
                 {"simulation", ValueOf(event.simulation)},
                 {"causes", std::move(causes)}};
    line["body"] = std::visit([](const auto& body) { return FieldsOf(body); }, event.body);
    out << line.dump(-1, ' ', true, Json::error_handler_t::replace) << "\n";
  }
  out.flush();
  return StatusOf(out, "the list of events");
}

}  // namespace aerascope
