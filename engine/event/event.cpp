#include "engine/event/event.h"

#include <type_traits>

#include "engine/base/text.h"
#include "engine/kb/term_codec.h"

namespace aerascope {
namespace {

// Writes any field value as text; `Style` decides between exact (storage, digest) and readable.
enum class Style { kExact, kReadable };

template <class T>
struct IsVector : std::false_type {};
template <class T>
struct IsVector<std::vector<T>> : std::true_type {};
template <class T>
struct IsId : std::false_type {};
template <class Tag>
struct IsId<Id<Tag>> : std::true_type {};

std::string TermText(const Term& term, Style style) { return style == Style::kExact ? Encode(term) : ToText(term); }

std::string PrefixOf(ModelId) { return "mdl_"; }
std::string PrefixOf(CompositeStateId) { return "cst_"; }
std::string PrefixOf(FactId) { return "fact_"; }
std::string PrefixOf(GoalId) { return "goal_"; }
std::string PrefixOf(PredictionId) { return "pred_"; }
std::string PrefixOf(SimulationId) { return "sim_"; }

template <class Body>
std::string FieldsText(const Body& body, Style style);

template <class T>
std::string ValueText(const T& value, Style style) {
  if constexpr (IsId<T>::value) {
    return value.valid() ? PrefixOf(value) + std::to_string(value.value) : "-";
  } else if constexpr (std::is_same_v<T, bool>) {
    return value ? "yes" : "no";
  } else if constexpr (std::is_enum_v<T>) {
    return std::string(EnumName(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    return style == Style::kExact ? FormatNumber(value, 17) : FormatNumber(value, 6);
  } else if constexpr (std::is_integral_v<T>) {
    return std::to_string(value);
  } else if constexpr (std::is_same_v<T, std::string>) {
    return style == Style::kExact ? Encode(Term::String(value)) : "\"" + Printable(value) + "\"";
  } else if constexpr (std::is_same_v<T, Term>) {
    return TermText(value, style);
  } else if constexpr (std::is_same_v<T, Time>) {
    return style == Style::kExact ? std::to_string(value.us) : ToText(value);
  } else if constexpr (std::is_same_v<T, TimeInterval>) {
    return style == Style::kExact ? std::to_string(value.after.us) + ".." + std::to_string(value.before.us)
                                  : ToText(value);
  } else if constexpr (std::is_same_v<T, Fact>) {
    // ToTerm rounds the confidence to 9 digits; the exact value follows it.
    return style == Style::kExact ? Encode(ToTerm(value)) + "@" + FormatNumber(value.confidence, 17) : ToText(value);
  } else if constexpr (std::is_same_v<T, Evidence>) {
    return style == Style::kExact ? FormatNumber(value.positive, 17) + "/" + FormatNumber(value.total, 17)
                                  : FormatConfidence(value.rate()) + " (" + FormatNumber(value.positive, 6) + "/" +
                                        FormatNumber(value.total, 6) + ")";
  } else if constexpr (std::is_same_v<T, CompositeState> || std::is_same_v<T, Model>) {
    return ValueText(value.id, style) + " " + TermText(DefinitionToTerm(value), style);
  } else if constexpr (IsVector<T>::value) {
    std::string text = "[";
    for (std::size_t i = 0; i < value.size(); ++i) text += (i > 0 ? ", " : "") + ValueText(value[i], style);
    return text + "]";
  } else {
    return "{" + FieldsText(value, style) + "}";
  }
}

template <class Body>
std::string FieldsText(const Body& body, Style style) {
  std::string text;
  ForEachField<Body>([&](const auto& field) {
    if (!text.empty()) text += style == Style::kExact ? "\x1f" : " ";
    text += std::string(field.name) + "=" + ValueText(body.*(field.member), style);
  });
  return text;
}

std::string BodyText(const EventBody& body, Style style) {
  return std::visit([&](const auto& b) { return FieldsText(b, style); }, body);
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
  std::string text = ToText(event.time) + " #" + std::to_string(event.id.value) + " " + std::string(KindName(event.body));
  if (event.simulation.valid()) text += " in sim_" + std::to_string(event.simulation.value);
  const std::string fields = BodyText(event.body, Style::kReadable);
  if (!fields.empty()) text += " " + fields;
  if (!event.causes.empty()) {
    text += " because";
    for (const EventId cause : event.causes) text += " #" + std::to_string(cause.value);
  }
  return text;
}

std::string EncodeForDigest(const Event& event) {
  std::string bytes = std::to_string(event.id.value) + "\x1f" + std::to_string(event.time.us) + "\x1f" +
                      std::to_string(event.frame) + "\x1f" + std::to_string(event.simulation.value) + "\x1f";
  for (const EventId cause : event.causes) bytes += std::to_string(cause.value) + ",";
  bytes += "\x1f";
  bytes += KindName(event.body);
  bytes += "\x1f" + BodyText(event.body, Style::kExact) + "\x1e";
  return bytes;
}

void EventDigest::Add(const Event& event) { hasher_.Add(EncodeForDigest(event)); }

}  // namespace aerascope
