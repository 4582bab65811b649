// What the [world] tables of all kinds of worlds have in common: names that the seed must declare, properties
// and kinds of commands.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/episode/config.h"
#include "engine/replicode/seed.h"
#include "engine/world/world_config.h"

namespace aerascope {

inline constexpr double kFar = 1e6;     // lengths and positions beyond this are mistakes
inline constexpr double kTurns = 1000;  // so are angles

// Report a name that the seed does not declare as an entity (or as an ontology symbol), with the closest that
// it does.
void CheckEntity(const SeedKnowledge& seed, const ConfigValue& where, const std::string& name,
                 ConfigErrors* errors);
void CheckOntology(const SeedKnowledge& seed, const ConfigValue& where, const std::string& name,
                   ConfigErrors* errors);

// The required key `entity`, and an ontology symbol under a key of its own.
std::string EntityKey(ConfigTable& table, const SeedKnowledge& seed, ConfigErrors* errors);
std::string OntologyKey(ConfigTable& table, std::string_view key, std::string fallback,
                        const SeedKnowledge& seed, ConfigErrors* errors);

// { shape = "cube", size = "small" }, in order of the alphabet.
std::vector<EntityProperty> Properties(ConfigTable& table, std::string_view key, const SeedKnowledge& seed,
                                       ConfigErrors* errors);

// What the seed says for ever about an entity, then what the table's `properties` add.
std::vector<EntityProperty> AllProperties(ConfigTable& table, const std::string& entity,
                                          const SeedKnowledge& seed, ConfigErrors* errors);

// The required key `kind`: one of these words, in the order of CommandKind. Nothing, and an error, if it is
// another.
std::optional<CommandKind> KindKey(ConfigTable& table, const std::vector<std::string>& kinds);

// Reports names that stand for two things.
void CheckDistinct(const std::vector<std::string>& names, const ConfigValue& where, std::string_view what,
                   ConfigErrors* errors);

template <class Config>
void CheckNames(const Config& config, const std::string& hand, const ConfigValue& world,
                ConfigErrors* errors) {
  std::vector<std::string> entities{hand};
  for (const auto& object : config.objects) entities.push_back(object.entity);
  CheckDistinct(entities, world, "entity", errors);
  std::vector<std::string> commands;
  for (const auto& command : config.commands) commands.push_back(command.name);
  CheckDistinct(commands, world, "command", errors);
}

}  // namespace aerascope
