#include "viewer/page/event_fields.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>

#include "engine/base/text.h"
#include "engine/query/describe.h"
#include "engine/query/kind_titles.h"
#include "viewer/page/report_context.h"
#include "viewer/page/shortened.h"

namespace aerascope {
namespace {

using nlohmann::json;

constexpr std::size_t kLongestValue = 2000;  // code points
constexpr std::size_t kLongestList = 24;     // items

// "prediction_failure" as words.
std::string Words(std::string_view name) {
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

using Value = std::optional<FieldText>;

class FieldAuthor {
 public:
  explicit FieldAuthor(const Run& run) : run_(run), knowledge_(run.final_knowledge()) {}

  Value Of(const std::string& text) const { return Plain(Shortened(Printable(text), kLongestValue)); }
  Value Of(bool value) const { return Plain(value ? "yes" : "no"); }
  Value Of(std::int64_t value) const { return Plain(std::to_string(value)); }
  Value Of(double value) const { return Plain(FormatNumber(value, 6)); }
  Value Of(Time time) const { return Plain(SecondsText(time)); }
  Value Of(const TimeInterval& interval) const {
    return Plain(SecondsText(interval.after) + " to " + SecondsText(interval.before));
  }
  Value Of(const Term& term) const {
    if (term.is(TermKind::kNil)) return {};
    return Plain(Shortened(PayloadText(knowledge_, term), kLongestValue));
  }
  Value Of(const Fact& fact) const {
    std::string text = Shortened(FactText(knowledge_, fact), kLongestValue);
    if (fact.interval.after < fact.interval.before)
      text += ", " + SecondsText(fact.interval.after) + " to " + SecondsText(fact.interval.before);
    if (fact.confidence < 1) text += ", confidence " + FormatConfidence(fact.confidence);
    return Plain(std::move(text));
  }
  Value Of(const Evidence& evidence) const {
    return Plain(FormatNumber(evidence.positive, 6) + " of " + FormatNumber(evidence.total, 6) + " = " +
                 FormatConfidence(evidence.rate()));
  }
  Value Of(FactId id) const {
    if (!id.valid()) return {};
    const Fact* fact = run_.FindFact(id);
    std::string text = fact == nullptr ? IdText(id) : FactText(knowledge_, *fact);
    const EventId event = run_.CreationOf(id);
    if (!event.valid()) return Plain(std::move(text));
    return FieldText{Shortened(text, kLongestValue), IdText(event)};
  }
  Value Of(SimulationId id) const {
    if (!id.valid()) return {};
    const EventId event = run_.CreationOf(id);
    return FieldText{IdText(id), event.valid() ? IdText(event) : ""};
  }
  Value Of(EventId id) const {
    if (!id.valid()) return {};
    return FieldText{IdText(id), IdText(id)};
  }
  Value Of(ModelId id) const { return Named(id, id.valid() ? TitleOf(knowledge_, id) : ""); }
  Value Of(CompositeStateId id) const { return Named(id, id.valid() ? TitleOf(knowledge_, id) : ""); }
  Value Of(GoalId id) const { return Named(id, ""); }
  Value Of(PredictionId id) const { return Named(id, ""); }
  Value Of(const Model& model) const {
    const ModelLines lines = LinesOf(knowledge_, model);
    return Defined(model.id, lines.lhs + " \u2192 " + lines.rhs);
  }
  Value Of(const CompositeState& state) const {
    return Defined(state.id, OneLine(ConditionsOf(knowledge_, state)));
  }
  Value Of(const std::vector<double>& numbers) const {
    if (numbers.empty()) return {};
    return Plain(std::to_string(numbers.size()) + " numbers");
  }
  template <class Item>
  Value Of(const std::vector<Item>& list) const {
    if (list.empty()) return {};
    if (list.size() == 1)
      if (Value only = Of(list.front()); only && !only->link.empty()) return only;
    std::vector<std::string> parts;
    for (std::size_t i = 0; i < std::min(list.size(), kLongestList); ++i) {
      Value value = Of(list[i]);
      parts.push_back(value ? std::move(value->text) : "none");
    }
    if (list.size() > kLongestList) parts.push_back(std::to_string(list.size() - kLongestList) + " more");
    return Plain(Shortened(Join(parts, "; "), kLongestValue));
  }
  template <class Other>
  Value Of(const Other& value) const {
    if constexpr (std::is_enum_v<Other>) {
      return Plain(Words(EnumName(value)));
    } else {
      std::vector<std::string> parts;
      ForEachField<Other>([&](const auto& field) {
        if (const Value part = Of(value.*field.member)) parts.push_back(Words(field.name) + " " + part->text);
      });
      return Plain(Shortened(Join(parts, ", "), kLongestValue));
    }
  }

 private:
  static Value Plain(std::string text) { return FieldText{std::move(text), ""}; }
  template <class Id>
  static Value Named(Id id, const std::string& title) {
    if (!id.valid()) return {};
    return FieldText{title.empty() ? IdText(id) : IdText(id) + ", " + title, IdText(id)};
  }
  // Knowledge that was not kept has no page of its own.
  template <class Id>
  Value Defined(Id id, const std::string& text) const {
    if (knowledge_.Find(id) == nullptr) return Plain(Shortened(text, kLongestValue));
    return FieldText{Shortened(IdText(id) + ": " + text, kLongestValue), IdText(id)};
  }

  const Run& run_;
  const KnowledgeBase& knowledge_;
};

}  // namespace

std::vector<std::optional<FieldText>> FieldsOf(const Run& run, const Event& event) {
  const FieldAuthor author(run);
  const std::string itself = IdText(event.id);
  std::vector<Value> fields;
  std::visit(
      [&](const auto& body) {
        ForEachField<std::remove_cvref_t<decltype(body)>>([&](const auto& field) {
          Value value = author.Of(body.*field.member);
          if (value && value->link == itself) value.reset();
          fields.push_back(std::move(value));
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
                     {"title", std::string(KindTitle(Body::kName))},
                     {"meaning", std::string(Body::kMeaning)},
                     {"fields", fields}});
  });
  return kinds;
}

}  // namespace aerascope
