#include "engine/event/event.h"

#include <type_traits>

#include "engine/base/text.h"
#include "engine/kb/term_codec.h"

namespace aerascope {
namespace {

std::string_view PrefixOf(ModelId) {
  return "mdl_";
}
std::string_view PrefixOf(CompositeStateId) {
  return "cst_";
}
std::string_view PrefixOf(FactId) {
  return "fact_";
}
std::string_view PrefixOf(GoalId) {
  return "goal_";
}
std::string_view PrefixOf(PredictionId) {
  return "pred_";
}
std::string_view PrefixOf(SimulationId) {
  return "sim_";
}

// How single values are written: exactly, for the digest (each event of a run passes here, so into one
// buffer) ...
struct Exact {
  static constexpr std::string_view kBetweenFields = "\x1f";

  static void Write(double value, std::string* out) { AppendExactNumber(value, out); }
  static void Write(std::int64_t value, std::string* out) { AppendInteger(value, out); }
  static void Write(const std::string& value, std::string* out) { AppendEncodedString(value, out); }
  static void Write(const Term& value, std::string* out) { AppendEncoded(value, out); }
  static void Write(Time value, std::string* out) { AppendInteger(value.us, out); }
  static void Write(const TimeInterval& value, std::string* out) {
    AppendInteger(value.after.us, out);
    *out += "..";
    AppendInteger(value.before.us, out);
  }
  static void Write(const Fact& value, std::string* out) {
    *out += value.positive ? "fact " : "fact-not ";
    AppendEncoded(value.payload, out);
    *out += ' ';
    Write(value.interval, out);
    *out += '@';
    AppendExactNumber(value.confidence, out);
  }
  static void Write(const Evidence& value, std::string* out) {
    AppendExactNumber(value.positive, out);
    *out += '/';
    AppendExactNumber(value.total, out);
  }
};

// ... or readably.
struct Readable {
  static constexpr std::string_view kBetweenFields = " ";

  static void Write(double value, std::string* out) { *out += FormatNumber(value, 6); }
  static void Write(std::int64_t value, std::string* out) { AppendInteger(value, out); }
  static void Write(const std::string& value, std::string* out) { *out += "\"" + Printable(value) + "\""; }
  static void Write(const Term& value, std::string* out) { *out += ToText(value); }
  static void Write(Time value, std::string* out) { *out += ToText(value); }
  static void Write(const TimeInterval& value, std::string* out) { *out += ToText(value); }
  static void Write(const Fact& value, std::string* out) { *out += ToText(value); }
  static void Write(const Evidence& value, std::string* out) {
    *out += FormatConfidence(value.rate()) + " (" + FormatNumber(value.positive, 6) + "/" +
            FormatNumber(value.total, 6) + ")";
  }
};

template <class Style, class Body>
void WriteFields(const Body& body, std::string* out);

template <class Style, class T>
void WriteValue(const T& value, std::string* out) {
  if constexpr (kIsId<T>) {
    if (!value.valid()) {
      *out += '-';
    } else {
      *out += PrefixOf(value);
      AppendInteger(value.value, out);
    }
  } else if constexpr (std::is_same_v<T, bool>) {
    *out += value ? "yes" : "no";
  } else if constexpr (std::is_enum_v<T>) {
    *out += EnumName(value);
  } else if constexpr (std::is_same_v<T, CompositeState> || std::is_same_v<T, Model>) {
    WriteValue<Style>(value.id, out);
    *out += ' ';
    Style::Write(DefinitionToTerm(value), out);
  } else if constexpr (kIsVector<T>) {
    *out += '[';
    for (std::size_t i = 0; i < value.size(); ++i) {
      if (i > 0) *out += ", ";
      WriteValue<Style>(value[i], out);
    }
    *out += ']';
  } else if constexpr (requires { T::Fields(); }) {
    *out += '{';
    WriteFields<Style>(value, out);
    *out += '}';
  } else {
    Style::Write(value, out);
  }
}

template <class Style, class Body>
void WriteFields(const Body& body, std::string* out) {
  bool first = true;
  ForEachField<Body>([&](const auto& field) {
    if (!first) *out += Style::kBetweenFields;
    first = false;
    *out += field.name;
    *out += '=';
    WriteValue<Style>(body.*(field.member), out);
  });
}

template <class Style>
void WriteBody(const EventBody& body, std::string* out) {
  std::visit([&](const auto& b) { WriteFields<Style>(b, out); }, body);
}

}  // namespace

std::string_view KindName(const EventBody& body) {
  return std::visit([](const auto& b) { return std::decay_t<decltype(b)>::kName; }, body);
}

std::size_t KindOfName(std::string_view name) {
  std::size_t found = kEventKinds;
  std::size_t kind = 0;
  ForEachKind([&]<class Body>() {
    if (Body::kName == name) found = kind;
    ++kind;
  });
  return found;
}

bool MayBeUncaused(const EventBody& body) {
  if (const auto* fact = std::get_if<FactObserved>(&body)) {
    return fact->source == FactSource::kSensor || fact->source == FactSource::kProperty;
  }
  if (const auto* state = std::get_if<CompositeStateCreated>(&body)) return state->origin == Origin::kSeed;
  if (const auto* model = std::get_if<ModelCreated>(&body)) return model->origin == Origin::kSeed;
  if (const auto* command = std::get_if<CommandIssued>(&body)) return command->by == Commander::kTeacher;
  return std::holds_alternative<EpisodeStarted>(body) || std::holds_alternative<SymbolDeclared>(body) ||
         std::holds_alternative<FrameStarted>(body) || std::holds_alternative<WorldStateRecorded>(body) ||
         std::holds_alternative<DriveInjected>(body) || std::holds_alternative<EpisodeEnded>(body);
}

std::string ToText(const Event& event) {
  std::string text =
      ToText(event.time) + " #" + std::to_string(event.id.value) + " " + std::string(KindName(event.body));
  if (event.simulation.valid()) text += " in sim_" + std::to_string(event.simulation.value);
  text += ' ';
  WriteBody<Readable>(event.body, &text);
  if (text.back() == ' ') text.pop_back();  // a kind without fields
  if (!event.causes.empty()) {
    text += " because";
    for (const EventId cause : event.causes) text += " #" + std::to_string(cause.value);
  }
  return text;
}

std::string EncodeForDigest(const Event& event) {
  std::string bytes;
  bytes.reserve(256);
  for (const std::int64_t number : {event.id.value, event.time.us, event.frame, event.simulation.value}) {
    AppendInteger(number, &bytes);
    bytes += '\x1f';
  }
  for (const EventId cause : event.causes) {
    AppendInteger(cause.value, &bytes);
    bytes += ',';
  }
  bytes += '\x1f';
  bytes += KindName(event.body);
  bytes += '\x1f';
  WriteBody<Exact>(event.body, &bytes);
  bytes += '\x1e';
  return bytes;
}

void EventDigest::Add(const Event& event) {
  hasher_.Add(EncodeForDigest(event));
}

}  // namespace aerascope
