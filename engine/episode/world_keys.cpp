#include "engine/episode/world_keys.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/base/text.h"
#include "engine/episode/scenario_world.h"

namespace aerascope {
namespace {

void CheckSymbol(const SeedKnowledge& seed, const ConfigValue& where, const std::string& name, TermKind kind,
                 ConfigErrors* errors) {
  const Term* symbol = FindSymbol(seed, name);
  if (symbol && symbol->is(kind)) return;
  std::vector<std::string> known;
  for (const Term& candidate : seed.symbols) {
    if (candidate.is(kind)) known.push_back(candidate.name());
  }
  const std::string closest = symbol ? "" : ClosestWord(name, known);
  errors->Add(where, std::string("expected ") +
                         (kind == TermKind::kEntity ? "an entity" : "an ontology symbol") +
                         " of the seed, found '" + Printable(name) + "', which " +
                         (symbol ? "is declared, but not as that" : "the seed does not declare") +
                         (closest.empty() ? "" : "; did you mean '" + closest + "'?"));
}

}  // namespace

bool IsLastingProperty(const Fact& fact) {
  return fact.positive && fact.confidence == 1 && fact.interval.after <= Time{0} &&
         fact.interval.before >= kForever && IsValue(fact.payload) && fact.payload[0].is(TermKind::kEntity) &&
         fact.payload[1].is(TermKind::kOntology) && fact.payload[2].is(TermKind::kOntology);
}

void CheckEntity(const SeedKnowledge& seed, const ConfigValue& where, const std::string& name,
                 ConfigErrors* errors) {
  CheckSymbol(seed, where, name, TermKind::kEntity, errors);
}

void CheckOntology(const SeedKnowledge& seed, const ConfigValue& where, const std::string& name,
                   ConfigErrors* errors) {
  CheckSymbol(seed, where, name, TermKind::kOntology, errors);
}

std::string EntityKey(ConfigTable& table, const SeedKnowledge& seed, ConfigErrors* errors) {
  std::string name = table.RequiredString("entity");
  if (!name.empty()) CheckEntity(seed, *table.Get("entity"), name, errors);
  return name;
}

std::string OntologyKey(ConfigTable& table, std::string_view key, std::string fallback,
                        const SeedKnowledge& seed, ConfigErrors* errors) {
  std::string name = table.String(key, std::move(fallback));
  const ConfigValue* value = table.Get(key);
  CheckOntology(seed, value ? *value : table.value(), name, errors);
  return name;
}

std::vector<EntityProperty> Properties(ConfigTable& table, std::string_view key, const SeedKnowledge& seed,
                                       ConfigErrors* errors) {
  std::vector<EntityProperty> properties;
  const ConfigValue* value = table.Get(key);
  if (!value) return properties;
  if (value->kind != ConfigValue::Kind::kTable) {
    errors->Add(*value, "expected properties such as { size = \"large\" } for '" + std::string(key) + "'");
    return properties;
  }
  ConfigTable list(*value, std::string(key), errors);
  for (std::size_t i = 0; i < value->keys.size(); ++i) {
    EntityProperty property{value->keys[i], list.RequiredString(value->keys[i])};
    ConfigValue key_place;
    std::tie(key_place.line, key_place.column) = value->key_positions[i];
    CheckOntology(seed, key_place, property.attribute, errors);
    if (!property.value.empty()) CheckOntology(seed, value->items[i], property.value, errors);
    properties.push_back(std::move(property));
  }
  return properties;
}

std::vector<EntityProperty> AllProperties(ConfigTable& table, const std::string& entity,
                                          const SeedKnowledge& seed, ConfigErrors* errors) {
  std::vector<EntityProperty> properties;
  for (const SeedFact& fact : seed.facts) {
    if (IsLastingProperty(fact.fact) && fact.fact.payload[0].name() == entity) {
      properties.push_back({fact.fact.payload[1].name(), fact.fact.payload[2].name()});
    }
  }
  for (EntityProperty& property : Properties(table, "properties", seed, errors)) {
    const auto same = std::find_if(properties.begin(), properties.end(), [&](const EntityProperty& known) {
      return known.attribute == property.attribute;
    });
    if (same == properties.end())
      properties.push_back(std::move(property));
    else if (same->value != property.value) {
      errors->Add(*table.Get("properties"), "expected " + property.attribute + " = \"" + same->value +
                                                "\" of " + entity + ", as the seed says, found \"" +
                                                property.value + "\"");
    }
  }
  return properties;
}

std::optional<CommandKind> KindKey(ConfigTable& table, const std::vector<std::string>& kinds) {
  table.Require("kind");
  constexpr CommandKind kKinds[] = {CommandKind::kMove, CommandKind::kGrab, CommandKind::kRelease,
                                    CommandKind::kChange};
  const std::optional<std::size_t> kind = table.Choice("kind", kinds, 0);
  return kind ? std::optional(kKinds[*kind]) : std::nullopt;
}

void CheckDistinct(const std::vector<std::string>& names, const ConfigValue& where, std::string_view what,
                   ConfigErrors* errors) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty() && std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i),
                                       names[i]) != names.begin() + static_cast<std::ptrdiff_t>(i)) {
      errors->Add(
          where, "expected each " + std::string(what) + " once in the world, found '" + names[i] + "' twice");
    }
  }
}

}  // namespace aerascope
