#include "engine/episode/config.h"

#include <algorithm>
#include <tuple>

#include "engine/base/text.h"

// toml++ 3.3 asserts some properties of its input which hostile text does not have (and which, where they
// fail, it then reports as errors). Without NDEBUG these are its own TOML_ASSERT, else assumptions for the
// optimiser: in both cases they are taken out.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expression) static_cast<void>(0)
#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

namespace aerascope {
namespace {

ConfigValue FromToml(const toml::node& node) {
  ConfigValue value;
  value.line = static_cast<int>(node.source().begin.line);
  value.column = static_cast<int>(node.source().begin.column);
  if (const toml::table* table = node.as_table()) {
    value.kind = ConfigValue::Kind::kTable;
    for (const auto& [key, child] : *table) {
      value.keys.emplace_back(key.str());
      value.key_positions.emplace_back(key.source().begin.line, key.source().begin.column);
      value.items.push_back(FromToml(child));
    }
  } else if (const toml::array* array = node.as_array()) {
    value.kind = ConfigValue::Kind::kList;
    for (const toml::node& child : *array) value.items.push_back(FromToml(child));
  } else if (const auto* text = node.as_string()) {
    value.kind = ConfigValue::Kind::kString;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = ConfigValue::Kind::kInteger;
    value.integer = integer->get();
    value.number = static_cast<double>(value.integer);
  } else if (const auto* number = node.as_floating_point()) {
    value.kind = ConfigValue::Kind::kNumber;
    value.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = ConfigValue::Kind::kBool;
    value.integer = boolean->get() ? 1 : 0;
  }
  return value;
}

std::string Found(const ConfigValue& value) {
  switch (value.kind) {
    case ConfigValue::Kind::kTable:
      return "a table";
    case ConfigValue::Kind::kList:
      return "a list";
    case ConfigValue::Kind::kString:
      return "the text \"" + Printable(value.text.substr(0, 60)) + "\"";
    case ConfigValue::Kind::kInteger:
      return std::to_string(value.integer);
    case ConfigValue::Kind::kNumber:
      return FormatNumber(value.number);
    case ConfigValue::Kind::kBool:
      return value.integer ? "true" : "false";
    case ConfigValue::Kind::kOther:
      return "a date or time";
  }
  return {};
}

}  // namespace

Result<ConfigValue> ParseConfig(std::string_view text, const std::string& file) {
  const toml::parse_result parsed = toml::parse(text);
  if (parsed) return FromToml(parsed.table());
  const toml::source_position at = parsed.error().source().begin;
  return ErrorAt({file, static_cast<int>(at.line), static_cast<int>(at.column)},
                 "expected valid TOML, found trouble: " + Printable(parsed.error().description()));
}

void ConfigErrors::Add(int line, int column, std::string message) {
  entries_.push_back({false, line, column, ErrorAt({file_, line, column}, message)});
}

void ConfigErrors::AddMissing(const ConfigValue& table, std::string message) {
  entries_.push_back({true, table.line, table.column, ErrorAt({file_, table.line, table.column}, message)});
}

void ConfigErrors::Add(int line, int column, const Error& error) {
  entries_.push_back({false, line, column, error});
}

Status ConfigErrors::First() const {
  const auto first = std::min_element(entries_.begin(), entries_.end(), [](const Entry& a, const Entry& b) {
    return std::tie(a.missing, a.line, a.column) < std::tie(b.missing, b.line, b.column);
  });
  return first == entries_.end() ? Ok() : Status(first->error);
}

ConfigTable::ConfigTable(const ConfigValue& table, std::string name, ConfigErrors* errors)
    : table_(&table), name_(std::move(name)), errors_(errors) {}

const ConfigValue* ConfigTable::Find(std::string_view key) const {
  const auto it = std::find(table_->keys.begin(), table_->keys.end(), key);
  return it == table_->keys.end() ? nullptr
                                  : &table_->items[static_cast<std::size_t>(it - table_->keys.begin())];
}

const ConfigValue* ConfigTable::Get(std::string_view key) {
  known_.emplace(key);
  return Find(key);
}

const ConfigValue* ConfigTable::Require(std::string_view key) {
  const ConfigValue* value = Get(key);
  if (!value)
    errors_->AddMissing(*table_, "expected the key '" + std::string(key) + "' in " + name_ + ", found none");
  return value;
}

std::string ConfigTable::String(std::string_view key, std::string fallback) {
  const ConfigValue* value = Get(key);
  if (!value) return fallback;
  if (value->kind == ConfigValue::Kind::kString) return value->text;
  Fail(*value, "expected a text in quotes for '" + std::string(key) + "', found " + Found(*value));
  return fallback;
}

std::string ConfigTable::RequiredString(std::string_view key) {
  const ConfigValue* value = Require(key);
  if (!value) return {};
  std::string text = String(key, "");
  if (text.empty() && value->kind == ConfigValue::Kind::kString) {
    Fail(*value, "expected a text for '" + std::string(key) + "', found an empty one");
  }
  return text;
}

std::optional<double> ConfigTable::NumberOf(const ConfigValue& value, std::string_view key, double smallest,
                                            double largest) {
  const bool numeric = value.kind == ConfigValue::Kind::kInteger || value.kind == ConfigValue::Kind::kNumber;
  if (numeric && value.number >= smallest && value.number <= largest) return value.number;
  Fail(value, "expected a number from " + FormatNumber(smallest) + " to " + FormatNumber(largest) + " for '" +
                  std::string(key) + "', found " + Found(value));
  return std::nullopt;
}

double ConfigTable::Number(std::string_view key, double fallback, double smallest, double largest) {
  const ConfigValue* value = Get(key);
  return value ? NumberOf(*value, key, smallest, largest).value_or(fallback) : fallback;
}

std::int64_t ConfigTable::Integer(std::string_view key, std::int64_t fallback, std::int64_t smallest,
                                  std::int64_t largest) {
  const ConfigValue* value = Get(key);
  if (!value) return fallback;
  if (value->kind == ConfigValue::Kind::kInteger && value->integer >= smallest && value->integer <= largest) {
    return value->integer;
  }
  Fail(*value, "expected a whole number from " + std::to_string(smallest) + " to " + std::to_string(largest) +
                   " for '" + std::string(key) + "', found " + Found(*value));
  return fallback;
}

std::vector<std::string> ConfigTable::Strings(std::string_view key) {
  std::vector<std::string> texts;
  const ConfigValue* value = Get(key);
  if (!value) return texts;
  if (value->kind != ConfigValue::Kind::kList) {
    Fail(*value, "expected a list of texts for '" + std::string(key) + "', found " + Found(*value));
    return texts;
  }
  for (const ConfigValue& item : value->items) {
    if (item.kind == ConfigValue::Kind::kString && !item.text.empty())
      texts.push_back(item.text);
    else
      Fail(item, "expected a text in quotes in the list '" + std::string(key) + "', found " + Found(item));
  }
  return texts;
}

std::vector<double> ConfigTable::Numbers(std::string_view key, double smallest, double largest) {
  std::vector<double> numbers;
  const ConfigValue* value = Get(key);
  if (!value) return numbers;
  if (value->kind != ConfigValue::Kind::kList) {
    Fail(*value, "expected a list of numbers for '" + std::string(key) + "', found " + Found(*value));
    return numbers;
  }
  for (const ConfigValue& item : value->items) {
    if (const auto number = NumberOf(item, key, smallest, largest)) numbers.push_back(*number);
  }
  return numbers;
}

std::array<double, 2> ConfigTable::Pair(std::string_view key, std::array<double, 2> fallback, double smallest,
                                        double largest) {
  const ConfigValue* value = Get(key);
  if (!value) return fallback;
  const bool is_pair = value->kind == ConfigValue::Kind::kList && value->items.size() == 2;
  const std::vector<double> numbers = is_pair ? Numbers(key, smallest, largest) : std::vector<double>();
  if (numbers.size() == 2) return {numbers[0], numbers[1]};
  if (!is_pair)
    Fail(*value, "expected two numbers [x, y] for '" + std::string(key) + "', found " + Found(*value));
  return fallback;
}

std::optional<std::size_t> ConfigTable::Choice(std::string_view key, const std::vector<std::string>& choices,
                                               std::size_t fallback) {
  const ConfigValue* value = Get(key);
  if (!value) return fallback;
  const auto it = std::find(choices.begin(), choices.end(), value->text);
  if (value->kind == ConfigValue::Kind::kString && it != choices.end()) {
    return static_cast<std::size_t>(it - choices.begin());
  }
  const std::string closest = ClosestWord(value->text, choices);
  Fail(*value, "expected one of \"" + Join(choices, "\", \"") + "\" for '" + std::string(key) + "', found " +
                   Found(*value) + (closest.empty() ? "" : "; did you mean \"" + closest + "\"?"));
  return std::nullopt;
}

std::optional<ConfigTable> ConfigTable::Table(std::string_view key) {
  const ConfigValue* value = Get(key);
  if (!value) return std::nullopt;
  if (value->kind == ConfigValue::Kind::kTable)
    return ConfigTable(*value, "[" + std::string(key) + "]", errors_);
  Fail(*value, "expected a table [" + std::string(key) + "], found " + Found(*value));
  return std::nullopt;
}

std::vector<ConfigTable> ConfigTable::Tables(std::string_view key) {
  std::vector<ConfigTable> tables;
  const ConfigValue* value = Get(key);
  if (!value) return tables;
  if (value->kind != ConfigValue::Kind::kList) {
    Fail(*value, "expected tables [[" + std::string(key) + "]], found " + Found(*value));
    return tables;
  }
  for (const ConfigValue& item : value->items) {
    if (item.kind == ConfigValue::Kind::kTable)
      tables.emplace_back(item, "[[" + std::string(key) + "]]", errors_);
    else
      Fail(item, "expected tables [[" + std::string(key) + "]], found " + Found(item));
  }
  return tables;
}

void ConfigTable::Finish() {
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (std::size_t i = 0; i < table_->keys.size(); ++i) {
    const std::string& key = table_->keys[i];
    if (known_.contains(key)) continue;
    const std::string closest = ClosestWord(key, known);
    errors_->Add(
        table_->key_positions[i].first, table_->key_positions[i].second,
        "expected a known key in " + name_ + ", found '" + Printable(key) + "'; " +
            (closest.empty() ? "known are " + Join(known, ", ") : "did you mean '" + closest + "'?"));
  }
}

}  // namespace aerascope
