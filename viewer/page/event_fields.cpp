#include "viewer/page/event_fields.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "viewer/page/report_context.h"
#include "viewer/page/shortened.h"

namespace aerascope {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestValue = 2000;  // code points
constexpr std::size_t kLongestList = 24;     // items

// "prediction_failure" and "PredictionMade" as words.
std::string Words(std::string_view name) {
  std::string words;
  for (const char c : name) {
    const bool capital = c >= 'A' && c <= 'Z';
    if (capital && !words.empty()) words += ' ';
    words += c == '_' ? ' ' : capital && !words.empty() ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return words;
}

class FieldAuthor {
 public:
  explicit FieldAuthor(const Run& run) : run_(run), knowledge_(run.final_knowledge()) {}

  json Value(const std::string& text) const { return Shortened(Printable(text), kLongestValue); }
  json Value(bool value) const { return value ? "yes" : "no"; }
  json Value(std::int64_t value) const { return std::to_string(value); }
  json Value(double value) const { return FormatNumber(value, 6); }
  json Value(Time time) const { return SecondsText(time); }
  json Value(const TimeInterval& interval) const {
    return SecondsText(interval.after) + " to " + SecondsText(interval.before);
  }
  json Value(const Term& term) const {
    if (term.is(TermKind::kNil)) return nullptr;
    return Shortened(PayloadText(knowledge_, term), kLongestValue);
  }
  json Value(const Fact& fact) const {
    std::string text = Shortened(FactText(knowledge_, fact), kLongestValue);
    if (fact.interval.after < fact.interval.before)
      text += ", " + SecondsText(fact.interval.after) + " to " + SecondsText(fact.interval.before);
    if (fact.confidence < 1) text += ", confidence " + FormatConfidence(fact.confidence);
    return text;
  }
  json Value(const Evidence& evidence) const {
    return FormatNumber(evidence.positive, 6) + " of " + FormatNumber(evidence.total, 6) + " = " +
           FormatConfidence(evidence.rate());
  }
  json Value(FactId id) const {
    if (!id.valid()) return nullptr;
    const Fact* fact = run_.FindFact(id);
    const std::string text = fact == nullptr ? IdText(id) : FactText(knowledge_, *fact);
    const EventId event = run_.CreationOf(id);
    if (!event.valid()) return text;
    return {Shortened(text, kLongestValue), IdText(event)};
  }
  json Value(SimulationId id) const {
    const EventId event = id.valid() ? run_.CreationOf(id) : EventId{};
    if (!event.valid()) return id.valid() ? json(IdText(id)) : json(nullptr);
    return {IdText(id), IdText(event)};
  }
  json Value(EventId id) const { return id.valid() ? json{IdText(id), IdText(id)} : json(nullptr); }
  json Value(ModelId id) const { return Named(id, id.valid() ? TitleOf(knowledge_, id) : ""); }
  json Value(CompositeStateId id) const { return Named(id, id.valid() ? TitleOf(knowledge_, id) : ""); }
  json Value(GoalId id) const { return Named(id, ""); }
  json Value(PredictionId id) const { return Named(id, ""); }
  json Value(const Model& model) const {
    const ModelLines lines = LinesOf(knowledge_, model);
    const std::string text = lines.lhs + " \u2192 " + lines.rhs;
    if (knowledge_.Find(model.id) == nullptr) return Shortened(text, kLongestValue);
    return {Shortened(IdText(model.id) + ": " + text, kLongestValue), IdText(model.id)};
  }
  json Value(const CompositeState& state) const {
    const std::string text = OneLine(ConditionsOf(knowledge_, state));
    if (knowledge_.Find(state.id) == nullptr) return Shortened(text, kLongestValue);
    return {Shortened(IdText(state.id) + ": " + text, kLongestValue), IdText(state.id)};
  }
  json Value(const std::vector<double>& numbers) const {
    if (numbers.empty()) return nullptr;
    return std::to_string(numbers.size()) + " numbers";
  }
  template <class Item>
  json Value(const std::vector<Item>& list) const {
    if (list.empty()) return nullptr;
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < std::min(list.size(), kLongestList); ++i) {
      const json value = Value(list[i]);
      if (list.size() == 1 && value.is_array()) return value;
      parts.push_back(value.is_array()    ? value[0].template get<std::string>()
                      : value.is_string() ? value.template get<std::string>()
                                          : "none");
    }
    if (list.size() > kLongestList) parts.push_back(std::to_string(list.size() - kLongestList) + " more");
    return Shortened(Join(parts, "; "), kLongestValue);
  }
  template <class Other>
  json Value(const Other& value) const {
    if constexpr (std::is_enum_v<Other>) {
      return Words(EnumName(value));
    } else {
      std::vector<std::string> parts;
      ForEachField<Other>([&](const auto& field) {
        const json part = Value(value.*field.member);
        if (part.is_null()) return;
        parts.push_back(
            Words(field.name) + " " +
            (part.is_array() ? part[0].template get<std::string>() : part.template get<std::string>()));
      });
      return Shortened(Join(parts, ", "), kLongestValue);
    }
  }

 private:
  template <class Id>
  static json Named(Id id, const std::string& title) {
    if (!id.valid()) return nullptr;
    return {title.empty() ? IdText(id) : IdText(id) + ", " + title, IdText(id)};
  }

  const Run& run_;
  const KnowledgeBase& knowledge_;
};

}  // namespace

json FieldsOf(const Run& run, const Event& event) {
  const FieldAuthor author(run);
  json fields = json::array();
  std::visit(
      [&](const auto& body) {
        int position = 0;
        ForEachField<std::remove_cvref_t<decltype(body)>>([&](const auto& field) {
          json value = author.Value(body.*field.member);
          if (!value.is_null()) fields.push_back({position, std::move(value)});
          ++position;
        });
      },
      event.body);
  return fields;
}

json DescribeKinds() {
  json kinds = json::array();
  ForEachKind([&]<class Body>() {
    json fields = json::array();
    ForEachField<Body>([&](const auto& field) {
      fields.push_back({Words(field.name), std::string(field.meaning)});
    });
    kinds.push_back({{"name", std::string(Body::kName)},
                     {"title", Words(Body::kName)},
                     {"meaning", std::string(Body::kMeaning)},
                     {"fields", fields}});
  });
  return kinds;
}

}  // namespace aerascope
